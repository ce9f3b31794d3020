/* SPDX-License-Identifier: MIT
 *
 * Answers, equal time and equal error, and their files, from a run whose numbers and images the
 * test writes.
 */
#include "core/report/tradeoff_images.h"
#include "core/base/fs.h"
#include "core/base/str.h"
#include "core/image/exr.h"
#include "core/image/imageio.h"
#include "core/stats/interval.h"
#include "tests/report/trials.h"

#define M(name) IRB_METRIC_##name

static char folder[] = "/tmp/irb_tradeoff_XXXXXX";
static const struct irb_tradeoff_options by_default = {M(indirect_flip), NAN, NAN};
enum { SEEDS = 3, SIDE = 8 };

/* Scene box: fast covers 10 to 100 ms and FLIP 0.4 to 0.1, good 20 to 200 ms and 0.2 to 0.05. Each
 * seed differs by the share `jitter`, in the order 0, +, -, which for good:1 is the other way
 * round. */
static void add(struct irb_store *store, const char *method, const char *trial, double flip,
                double jitter, double ms)
{
    for (int seed = 0; seed < SEEDS; seed++) {
        int64_t id = trials_add(store, "box", method, trial, "{}", seed);
        const struct irb_store_value values[] = {
            {"indirect_flip", flip * (1 + (seed == 1   ? jitter
                                           : seed == 2 ? -jitter
                                                       : 0))},
            {"gl_bytes", 1 << 20}};
        trials_scores(store, id, -1, values, 2);
        for (int f = 0; f < 3; f++)
            trials_time(store, id, f, ms);
    }
}

static struct irb_store *store;
static struct irb_analysis analysis;

static int set_up(void **state)
{
    struct irb_error err = {0};
    (void)state;
    store = trials_open(folder);
    add(store, "fast", "fast:1", 0.4, 0.01, 10);
    add(store, "fast", "fast:2", 0.21, 0.05, 20);
    add(store, "fast", "fast:3", 0.1, 0.01, 100);
    add(store, "good", "good:1", 0.2, -0.05, 20);
    add(store, "good", "good:2", 0.05, 0, 200);
    REQUIRE_OK(irb_store_set_meta(store, "scene/box/preview_exposure", "1", &err));
    return irb_analysis_read(&analysis, store, 0.95, &err) ? 0 : -1;
}

static int tear_down(void **state)
{
    (void)state;
    irb_analysis_destroy(&analysis);
    return trials_close(store, folder);
}

static void expect(const char *text, const char *words)
{
    if (!strstr(text, words))
        fail_msg("'%s' is not in\n%s", words, text);
}

static char *write_text(struct irb_tradeoff_options options, enum irb_table_format format)
{
    struct irb_str out = {0};
    irb_tradeoff_write(&analysis, &options, format, false, &out);
    return out.text;
}

static void test_metric_names(void **state)
{
    (void)state;
    struct irb_error err = {0};
    int metric;
    REQUIRE_OK(irb_tradeoff_metric("flicker", &metric, &err));
    assert_int_equal(metric, M(indirect_flicker));
    assert_false(irb_tradeoff_metric("ssim", &metric, &err));
    assert_int_equal(err.code, IRB_E_USAGE);
    assert_string_equal(err.message,
                        "--metric: expected flip, relmse, rmse or flicker; found 'ssim'");
}

/* Without budgets: 20 ms, where good begins, to 100 ms, where fast ends; and FLIP 0.1 to 0.2. */
static void test_budgets(void **state)
{
    (void)state;
    char *text = write_text(by_default, IRB_TABLE_TEXT);
    expect(text, "box: equal time, at most 20.0 ms\n");
    expect(text, "box: equal time, at most 44.7 ms\n");
    expect(text, "box: equal time, at most 100 ms\n");
    expect(text, "box: equal error, at most 0.100\n");
    expect(text, "box: equal error, at most 0.141\n");
    expect(text, "box: equal error, at most 0.200\n");
    expect(text, "box, frame time and FLIP: nothing measured beats these 4 of 5 in both\n");
    expect(text, "box, memory and FLIP: nothing measured beats these 1 of 5 in both\n");
    free(text);
}

static void test_answers(void **state)
{
    (void)state;
    struct irb_tradeoff_options options = {M(indirect_flip), 50, 0.15};
    char *text = write_text(options, IRB_TABLE_MD);
    expect(text, "- least FLIP within 50.0 ms: good:1, 0.200 [");
    expect(text, "] in 20.0 ms; not distinguishable: fast:2\n");
    expect(text, "- least time for FLIP at most 0.150: fast:3, 100 ms with 0.1");
    expect(text, "; too few seeds or frames to tell: good:2\n"); /* whose times are all alike */
    /* at equal time, and the line between 20 and 200 ms: 0.2 (0.05 / 0.2)^(log 2.5 / log 10) */
    char between[64];
    snprintf(between, sizeof between, " %.3f (good:1 .. good:2) |",
             0.2 * pow(0.25, log(2.5) / log(10)));
    expect(text, between);
    expect(text, "| fast   | fast:2         |");
    expect(text, " best |");
    expect(text, " ~ 1.05 [");
    free(text);
    options.ms = 5;
    options.error = 0.01;
    text = write_text(options, IRB_TABLE_TEXT);
    expect(text,
           "- least FLIP within 5.00 ms: no measured trial; the nearest is fast:1 at 10.0 ms\n");
    expect(text,
           "- least time for FLIP at most 0.0100: no measured trial; the nearest is good:2 at "
           "0.0500\n");
    expect(text, "good    none (nearest: good:1 at 20.0 ms)");
    free(text);
}

static char *read_file(const char *name)
{
    struct irb_error err = {0};
    char *path = irb_asprintf("%s/tradeoff/%s", folder, name), *text;
    size_t size;
    REQUIRE_OK(irb_fs_read(path, 1 << 20, &text, &size, &err));
    free(path);
    return text;
}

static void test_files(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct irb_tradeoff_options options = {M(indirect_flip), 50, 0.01};
    char *path = irb_asprintf("%s/tradeoff", folder);
    REQUIRE_OK(irb_tradeoff_save(path, &analysis, &options, "THE END\n", &err));
    free(path);
    char *text = read_file("answers.csv");
    expect(text, "scene,wanted,bounded,bound,method,trial,value,low,high,unit,bounded_value,"
                 "not_distinguishable,nearest,nearest_bounded_value,too_few_units\n"
                 "box,indirect_flip,frame_ms,50,good,good:1,0.2,");
    expect(text, ",seed,20,fast:2,,,\n");
    expect(text, "box,frame_ms,indirect_flip,0.01,,,,,,none,,,good:2,0.05,\n");
    free(text);
    text = read_file("equal-time.csv");
    expect(text, "box,indirect_flip,frame_ms,50,fast,fast:2,0.21,");
    expect(text, ",fast:2,fast:3\n");
    expect(text, ",seed,20,1,1,1,");
    free(text);
    text = read_file("equal-error.csv");
    expect(text, "box,frame_ms,indirect_flip,0.01,good,,,,,none,,,,,,,good:2\n");
    free(text);
    text = read_file("pareto.csv");
    expect(text, "\nbox,fast,fast:1,10,,,1048576,0.4,");
    free(text);
    text = read_file("answers.md");
    expect(text, "# Error against cost\n");
    expect(text, "\nTHE END\n");
    free(text);
}

/* An image of one value in all its channels. */
static struct irb_image flat(int channels, float value)
{
    struct irb_error err = {0};
    struct irb_image image;
    REQUIRE_OK(irb_image_create(&image, SIDE, SIDE, channels, &err));
    for (size_t i = 0; i < irb_image_pixels(&image) * (size_t)channels; i++)
        image.data[i] = value;
    return image;
}

static void keep_image(const char *trial, float value, float flip)
{
    struct irb_error err = {0};
    struct irb_image images[] = {flat(3, value), flat(3, 1), flat(1, flip)};
    const struct irb_exr_layer layers[] = {{"indirect", "RGB", &images[0]},
                                           {"reference_indirect", "RGB", &images[1]},
                                           {"flip_indirect", "Y", &images[2]}};
    char *path = irb_asprintf("%s/box/%s/seed-0", folder, trial);
    REQUIRE_OK(irb_fs_make_dirs(path, &err));
    free(path);
    path = irb_asprintf("%s/box/%s/seed-0/image-0001.exr", folder, trial);
    REQUIRE_OK(irb_exr_write(path, layers, 3, NULL, 0, IRB_EXR_ZIP, &err));
    free(path);
    for (int i = 0; i < 3; i++)
        irb_image_destroy(&images[i]);
}

/* Reinhard's 1/2 and 3/4 of radiance 1 and 3; below the end of magma and black. */
static void test_images(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct irb_str markdown = {0};
    struct irb_image picture;
    struct irb_tradeoff_options options = {M(indirect_flip), 15, 0.01};
    if (!IRB_HAVE_IMAGES)
        skip();
    keep_image("fast:1", 3, 1);
    char *path = irb_asprintf("%s/tradeoff", folder);
    REQUIRE_OK(irb_tradeoff_images(path, folder, store, &analysis, &options, &markdown, &err));
    free(path);
    expect(markdown.text, "![box-equal-time.png](box-equal-time.png)\n\n*box, equal time, at most "
                          "15.0 ms, frame 1. From the left: reference, `fast:1`, `good` (none "
                          "within the budget).*\n");
    irb_str_free(&markdown);
    path = irb_asprintf("%s/tradeoff/box-equal-time.png", folder);
    REQUIRE_OK(irb_image_read_rgb(path, &picture, &err));
    free(path);
    assert_int_equal(picture.width, 3 * SIDE + 2 * 4);
    assert_int_equal(picture.height, 2 * SIDE + 4);
    REQUIRE_NEAR(*irb_image_at(&picture, 2, 2), 0.5, 0.01);
    REQUIRE_NEAR(*irb_image_at(&picture, SIDE + 4 + 2, 2), 0.75, 0.01);
    REQUIRE_CMP(*irb_image_at(&picture, SIDE + 4 + 2, SIDE + 4 + 2), >, 0.9);
    REQUIRE_NEAR(*irb_image_at(&picture, 2, SIDE + 4 + 2), 0, 0);
    REQUIRE_NEAR(*irb_image_at(&picture, 2 * (SIDE + 4) + 2, 2), 0, 0);
    irb_image_destroy(&picture);
}

static void test_no_data(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct irb_tradeoff_options options = {M(indirect_flicker), NAN, NAN};
    assert_false(irb_tradeoff_check(&analysis, &options, &err));
    assert_int_equal(err.code, IRB_E_INPUT);
    assert_string_equal(err.message, "tradeoff: no trial has both indirect_flicker and a time yet");
    assert_false(irb_tradeoff_save("/nowhere", &analysis, &options, NULL, &err));
    assert_int_equal(err.code, IRB_E_INPUT);
}

/* Folders of trials whose names are longer than a file's may be. */
static void test_short_names(void **state)
{
    (void)state;
    char longer[302], other[302];
    memset(longer, 'x', 301);
    longer[301] = 0;
    strcpy(other, longer);
    other[300] = 'y';
    char *a = irb_fs_short_name(longer), *b = irb_fs_short_name(other),
         *c = irb_fs_short_name("ism:vpls=16");
    REQUIRE_CMP(strlen(a), <=, 200);
    assert_int_equal(strncmp(a, longer, 160), 0);
    assert_string_not_equal(a, b);
    assert_string_equal(c, "ism:vpls=16");
    free(a);
    free(b);
    free(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_metric_names), cmocka_unit_test(test_budgets),
        cmocka_unit_test(test_answers),      cmocka_unit_test(test_files),
        cmocka_unit_test(test_short_names),  cmocka_unit_test(test_images),
        cmocka_unit_test(test_no_data),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
