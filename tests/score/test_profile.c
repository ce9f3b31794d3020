/* SPDX-License-Identifier: MIT
 *
 * Profiles of images that are known: an edge that moves.
 */
#include "core/score/profile.h"

#include "core/frame/composite.h"
#include "tests/support/compare.h"

static struct irb_error err;

enum { W = 40, H = 24, FRAMES = 9 };

/* In row 11 an edge at column 3 + 4 t moves two pixels a frame more than in rows 7 and 17. */
static struct irb_image frame_of(int frame)
{
    struct irb_image image;
    REQUIRE_OK(irb_image_create(&image, W, H, 3, &err));
    for (int y = 0; y < H; y++) {
        int edge = y == 11 ? 3 + 4 * frame : y == 7 || y == 17 ? 3 + 2 * frame : 20;
        for (int x = 0; x < W; x++)
            for (int c = 0; c < 3; c++)
                irb_image_at(&image, x, y)[c] = x < edge ? 2 : 0.25f * (float)c;
    }
    return image;
}

static int busiest_of_frames(double rows[H], int first, int last)
{
    for (int y = 0; y < H; y++)
        rows[y] = 0;
    for (int i = first + 1; i <= last; i++) {
        struct irb_image a = frame_of(i - 1), b = frame_of(i);
        irb_row_change_add(rows, &a, &b);
        irb_image_destroy(&a);
        irb_image_destroy(&b);
    }
    return irb_busiest_row(rows, H);
}

static void the_row_that_changes_most(void **state)
{
    (void)state;
    double rows[H];
    assert_int_equal(busiest_of_frames(rows, 0, FRAMES - 1), 11);
    /* eight steps of 4 pixels; 2 + 1.75 + 1.5 over the channels */
    REQUIRE_NEAR(rows[11], 8 * 4 * 5.25, 1e-12);
    REQUIRE_NEAR(rows[7], 8 * 2 * 5.25, 1e-12);
    REQUIRE_NEAR(rows[17], rows[7], 0);
    REQUIRE_NEAR(rows[0], 0, 0);
    rows[11] = 0;
    assert_int_equal(irb_busiest_row(rows, H), 7); /* of equals the first */
    assert_int_equal(busiest_of_frames(rows, 0, 0), H / 2);
    assert_int_equal(irb_busiest_row(rows, 1), 0);
    struct irb_image a = frame_of(0), b = frame_of(0);
    irb_image_at(&b, 3, 5)[1] = NAN;
    irb_image_at(&b, 3, 6)[1] = INFINITY;
    irb_image_at(&b, 3, 9)[1] += 1e-3f;
    irb_row_change_add(rows, &a, &b);
    assert_int_equal(irb_busiest_row(rows, H), 9);
    irb_image_destroy(&a);
    irb_image_destroy(&b);
}

static struct irb_image profile_of(int row)
{
    struct irb_image profile;
    REQUIRE_OK(irb_image_create(&profile, W, FRAMES, 3, &err));
    for (int i = 0; i < FRAMES; i++) {
        struct irb_image image = frame_of(i);
        irb_profile_set(&profile, i, &image, row);
        irb_image_destroy(&image);
    }
    return profile;
}

static void the_edge_is_where_it_was(void **state)
{
    (void)state;
    struct irb_image fast = profile_of(11), slow = profile_of(7), still = profile_of(0);
    for (int i = 0; i < FRAMES; i++)
        for (int x = 0; x < W; x++)
            for (int c = 0; c < 3; c++) {
                float dark = 0.25f * (float)c;
                REQUIRE_NEAR(irb_image_at(&fast, x, i)[c], x < 3 + 4 * i ? 2 : dark, 0);
                REQUIRE_NEAR(irb_image_at(&slow, x, i)[c], x < 3 + 2 * i ? 2 : dark, 0);
                REQUIRE_NEAR(irb_image_at(&still, x, i)[c], x < 20 ? 2 : dark, 0);
            }
    irb_image_destroy(&fast);
    irb_image_destroy(&slow);
    irb_image_destroy(&still);
}

static void the_picture_has_both(void **state)
{
    (void)state;
    struct irb_image result = profile_of(11), reference = profile_of(7), sheet, shown[2];
    REQUIRE_OK(irb_profile_sheet(&result, &reference, 1.5, &sheet, &err));
    REQUIRE_OK(irb_tonemap(&result, 1.5, &shown[0], &err));
    REQUIRE_OK(irb_tonemap(&reference, 1.5, &shown[1], &err));
    assert_int_equal(sheet.width, 2 * W + 4);
    assert_int_equal(sheet.height, FRAMES * 16); /* at most 16 pixels a frame */
    for (int y = 0; y < sheet.height; y++)
        for (int x = 0; x < sheet.width; x++)
            for (int c = 0; c < 3; c++) {
                bool left = x < W, right = x >= W + 4;
                float expected = left    ? irb_image_at(&shown[0], x, y / 16)[c]
                                 : right ? irb_image_at(&shown[1], x - W - 4, y / 16)[c]
                                         : 0;
                REQUIRE_NEAR(irb_image_at(&sheet, x, y)[c], expected, 0);
            }
    for (int i = 0; i < 2; i++)
        irb_image_destroy(&shown[i]);
    irb_image_destroy(&sheet);
    irb_image_destroy(&result);
    irb_image_destroy(&reference);
}

static void long_sequences_have_thin_rows(void **state)
{
    (void)state;
    struct irb_image profile, sheet;
    const int frames[] = {1, 36, 300}, heights[] = {16, 7 * 36, 3 * 300};
    for (int i = 0; i < 3; i++) {
        REQUIRE_OK(irb_image_create(&profile, 5, frames[i], 3, &err));
        REQUIRE_OK(irb_profile_sheet(&profile, &profile, 1, &sheet, &err));
        assert_int_equal(sheet.height, heights[i]);
        irb_image_destroy(&sheet);
        irb_image_destroy(&profile);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_row_that_changes_most),
        cmocka_unit_test(the_edge_is_where_it_was),
        cmocka_unit_test(the_picture_has_both),
        cmocka_unit_test(long_sequences_have_thin_rows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
