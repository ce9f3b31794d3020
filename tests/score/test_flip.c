/* SPDX-License-Identifier: MIT
 *
 * FLIP against values of the public FLIP 1.6 tool on images given by formulas, and what follows
 * from its definition.
 */
#include "core/score/flip.h"

#include "core/base/clock.h"
#include "core/base/hash.h"
#include "tests/score/flip_brute.h"
#include "tests/support/compare.h"

#include <stdlib.h>
#include <string.h>

static struct irb_error err;

static const double pi = 3.14159265358979323846;

static struct irb_image image3(int width, int height)
{
    struct irb_image image;
    REQUIRE_OK(irb_image_create(&image, width, height, 3, &err));
    return image;
}

static bool chequer(int x, int y)
{
    return ((x >> 3) + (y >> 3)) & 1;
}

static void set8(struct irb_image *image, int x, int y, int r, int g, int b)
{
    float *p = irb_image_at(image, x, y);
    p[0] = (float)r / 255;
    p[1] = (float)g / 255;
    p[2] = (float)b / 255;
}

enum pattern { REF8, TEST_A, SHIFTED, FLAT, FLAT_RED };

static struct irb_image ldr(enum pattern pattern)
{
    struct irb_image image = image3(256, 256);
    for (int y = 0; y < 256; y++)
        for (int x = 0; x < 256; x++) {
            int left = x > 0 ? x - 1 : 0, brighter = x + 8 < 255 ? x + 8 : 255;
            if (pattern == REF8)
                set8(&image, x, y, x, y, x ^ y);
            else if (pattern == TEST_A)
                set8(&image, x, y, chequer(x, y) ? brighter : x, y, x ^ y);
            else if (pattern == SHIFTED)
                set8(&image, x, y, left, y, left ^ y);
            else
                set8(&image, x, y, pattern == FLAT_RED ? 132 : 128, 128, 128);
        }
    return image;
}

static struct irb_flip_scores ldr_scores(enum pattern test, enum pattern reference)
{
    struct irb_image t = ldr(test), r = ldr(reference);
    struct irb_flip_scores scores;
    REQUIRE_OK(irb_flip_ldr(&t, &r, NULL, IRB_FLIP_PPD, 0, NULL, &scores, &err));
    print_message("mean %.6f weighted median %.6f min %.6f max %.6f\n", scores.mean,
                  scores.weighted_median, scores.min, scores.max);
    irb_image_destroy(&t);
    irb_image_destroy(&r);
    return scores;
}

/* Both oracles of a pair. The tool works in single precision; where features differ by nothing but
 * rounding, the exponent 0.5 turns an error of 1e-7 into 3e-4, which moves its flat pair by 1.4e-5.
 * `exact` is the brute force of flip_brute.c, in double, on the whole image (seconds to minutes).
 */
struct oracle {
    struct irb_flip_scores tool, exact;
};

static const double tool_error = 1e-5, flat_error = 2e-5, rounding = 4e-6;
static const double mean_rounding = 5e-7; /* single errors cancel */

static void require_scores(struct irb_flip_scores s, const struct oracle *oracle, double tolerance)
{
    REQUIRE_NEAR(s.mean, oracle->tool.mean, tolerance);
    REQUIRE_NEAR(s.weighted_median, oracle->tool.weighted_median, tolerance);
    REQUIRE_NEAR(s.min, oracle->tool.min, tolerance);
    REQUIRE_NEAR(s.max, oracle->tool.max, tolerance);
    REQUIRE_NEAR(s.mean, oracle->exact.mean, mean_rounding);
    REQUIRE_NEAR(s.weighted_median, oracle->exact.weighted_median, rounding);
    REQUIRE_NEAR(s.min, oracle->exact.min, rounding);
    REQUIRE_NEAR(s.max, oracle->exact.max, rounding);
}

static void ldr_agrees_with_the_public_tool(void **state)
{
    (void)state;
    /* mean, minimum, maximum, weighted median */
    static const struct oracle red = {{0.065781, 0.000017, 0.171634, 0.093828},
                                      {0.0657810, 0.0000167, 0.1716337, 0.0938270}};
    static const struct oracle shifted = {{0.047806, 0.000540, 0.372393, 0.051659},
                                          {0.0478056, 0.0005452, 0.3723959, 0.0516590}};
    /* The tool's mean, 0.065372, is its summation: every pixel has the minimum. */
    static const struct oracle flat = {{0.065321, 0.065321, 0.065321, 0.065321},
                                       {0.0653074, 0.0653074, 0.0653074, 0.0653074}};
    require_scores(ldr_scores(TEST_A, REF8), &red, tool_error);
    require_scores(ldr_scores(SHIFTED, REF8), &shifted, tool_error);
    require_scores(ldr_scores(FLAT_RED, FLAT), &flat, flat_error);
}

struct hdr_pair {
    struct irb_image test, reference;
};

static struct hdr_pair hdr(int width, int height)
{
    struct hdr_pair pair = {image3(width, height), image3(width, height)};
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            double s = pow(4, y / (height - 1.0));
            double rgb[3] = {(0.1 + 0.9 * x / (width - 1.0)) * s,
                             (0.5 + 0.5 * sin(2 * pi * x / 32)) * s, y / (height - 1.0) * s};
            for (int c = 0; c < 3; c++) {
                irb_image_at(&pair.reference, x, y)[c] = (float)rgb[c];
                irb_image_at(&pair.test, x, y)[c] =
                    chequer(x, y) ? 1.1f * (float)rgb[c] : (float)rgb[c];
            }
        }
    return pair;
}

static void hdr_destroy(struct hdr_pair *pair)
{
    irb_image_destroy(&pair->test);
    irb_image_destroy(&pair->reference);
}

static struct irb_flip_exposures exposures_of(const struct irb_image *reference)
{
    struct irb_flip_exposures exposures;
    assert_true(irb_flip_exposures_of(&reference, NULL, 1, &exposures));
    return exposures;
}

static void require_prepared_the_same(const struct hdr_pair *pair,
                                      const struct irb_flip_exposures *exposures,
                                      const struct irb_flip_scores *expected)
{
    struct irb_flip_scores scores;
    struct irb_flip_reference *reference =
        irb_flip_reference_create(&pair->reference, exposures, IRB_FLIP_PPD, 2, &err);
    REQUIRE_OK(reference != NULL);
    REQUIRE_OK(irb_flip_hdr_prepared(&pair->test, reference, NULL, 2, NULL, &scores, &err));
    assert_memory_equal(&scores, expected, sizeof scores);
    irb_flip_reference_destroy(reference);
}

static struct irb_flip_scores hdr_scores(int width, int height, double *seconds)
{
    struct hdr_pair pair = hdr(width, height);
    struct irb_flip_exposures exposures = exposures_of(&pair.reference);
    struct irb_flip_scores scores;
    double start = irb_clock_s();
    REQUIRE_OK(irb_flip_hdr(&pair.test, &pair.reference, NULL, &exposures, IRB_FLIP_PPD, 0, NULL,
                            &scores, &err));
    *seconds = irb_clock_s() - start;
    require_prepared_the_same(&pair, &exposures, &scores);
    print_message("%d x %d: mean %.6f weighted median %.6f min %.6f max %.6f, exposures %.4f to "
                  "%.4f in %d: %.0f ms\n",
                  width, height, scores.mean, scores.weighted_median, scores.min, scores.max,
                  exposures.start, exposures.stop, exposures.count, 1e3 * *seconds);
    hdr_destroy(&pair);
    return scores;
}

static void hdr_agrees_with_the_public_tool(void **state)
{
    (void)state;
    static const struct oracle small = {{0.085128, 0.000742, 0.220133, 0.111079},
                                        {0.0851284, 0.0007461, 0.2201330, 0.1110779}};
    double seconds;
    require_scores(hdr_scores(256, 256, &seconds), &small, tool_error);
    struct irb_flip_scores s = hdr_scores(512, 512, &seconds);
    REQUIRE_NEAR(s.mean, 0.085395, tool_error);
    REQUIRE_NEAR(s.mean, 0.0853967, mean_rounding);
    REQUIRE_NEAR(s.max, 0.221448, tool_error);
#ifndef __SANITIZE_ADDRESS__ /* ten times slower there */
    s = hdr_scores(1920, 1080, &seconds);
    REQUIRE_NEAR(s.mean, 0.085606, tool_error);
    REQUIRE_NEAR(s.max, 0.221392, tool_error);
#endif
}

/* Two views of displayed images score as the encoded images do. */
static void views_agree_with_ldr(void **state)
{
    (void)state;
    struct irb_image t = ldr(TEST_A), r = ldr(REF8), map, expected_map;
    struct irb_flip_scores expected, found;
    REQUIRE_OK(irb_flip_ldr(&t, &r, NULL, IRB_FLIP_PPD, 0, &expected_map, &expected, &err));
    for (size_t i = 0; i < 3 * irb_image_pixels(&t); i++) {
        t.data[i] =
            t.data[i] <= 0.04045f ? t.data[i] / 12.92f : powf((t.data[i] + 0.055f) / 1.055f, 2.4f);
        r.data[i] =
            r.data[i] <= 0.04045f ? r.data[i] / 12.92f : powf((r.data[i] + 0.055f) / 1.055f, 2.4f);
    }
    struct irb_flip_reference *a = irb_flip_view_create(&t, IRB_FLIP_PPD, 2, &err);
    struct irb_flip_reference *b = irb_flip_view_create(&r, IRB_FLIP_PPD, 1, &err);
    REQUIRE_OK(a && b);
    REQUIRE_OK(irb_flip_views(a, b, NULL, 2, &map, &found, &err));
    REQUIRE_NEAR(found.mean, 0.065781, tool_error);
    REQUIRE_NEAR(found.mean, expected.mean, 1e-7);
    REQUIRE_NEAR(found.max, expected.max, rounding);
    for (size_t i = 0; i < irb_image_pixels(&map); i++)
        REQUIRE_NEAR(map.data[i], expected_map.data[i], 1e-4);
    REQUIRE_OK(irb_flip_views(a, a, NULL, 1, NULL, &found, &err));
    REQUIRE_NEAR(found.max, 0, 0);
    irb_flip_reference_destroy(a);
    irb_flip_reference_destroy(b);
    irb_image_destroy(&t);
    irb_image_destroy(&r);
    irb_image_destroy(&map);
    irb_image_destroy(&expected_map);
}

static void automatic_exposures(void **state)
{
    (void)state;
    struct hdr_pair pair = hdr(256, 256);
    struct irb_flip_exposures e = exposures_of(&pair.reference);
    REQUIRE_NEAR(e.start, -0.8916, 5e-5);
    REQUIRE_NEAR(e.stop, 1.1797, 5e-5);
    assert_int_equal(e.count, 3);
    hdr_destroy(&pair);
}

static struct irb_image noise(int width, int height, uint64_t seed)
{
    struct irb_image image = image3(width, height);
    for (size_t i = 0; i < 3 * irb_image_pixels(&image); i++)
        image.data[i] = (float)(irb_hash_mix(seed, i) >> 40) / 16777216.0f;
    return image;
}

/* sRGB of IEC 61966-2-1, so that the pipeline sees the linear image that the brute force gets. */
static void encode(const struct irb_image *linear, struct irb_image *srgb)
{
    for (size_t i = 0; i < 3 * irb_image_pixels(linear); i++) {
        double v = linear->data[i];
        srgb->data[i] = (float)(v <= 0.0031308 ? 12.92 * v : 1.055 * pow(v, 1 / 2.4) - 0.055);
    }
}

/* Noise has every frequency and gamut colours; sizes and densities that make kernels even and odd,
 * wider than the image, and of one tap. */
static void pixels_agree_with_brute_force(void **state)
{
    (void)state;
    const struct {
        int width, height;
        double ppd;
    } cases[] = {{31, 22, 67.02}, {9, 7, 67.02}, {1, 1, 67.02},
                 {1, 12, 40},     {24, 1, 20.5}, {13, 14, 3}};
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        int width = cases[c].width, height = cases[c].height;
        struct irb_image t = noise(width, height, 1), r = noise(width, height, 2), map;
        struct irb_image ts = image3(width, height), rs = image3(width, height);
        encode(&t, &ts);
        encode(&r, &rs);
        struct irb_flip_scores scores;
        double *expected = malloc(irb_image_pixels(&t) * sizeof *expected);
        flip_brute(&t, &r, cases[c].ppd, expected);
        REQUIRE_OK(irb_flip_ldr(&ts, &rs, NULL, cases[c].ppd, 2, &map, &scores, &err));
        for (size_t i = 0; i < irb_image_pixels(&map); i++)
            REQUIRE_NEAR(map.data[i], expected[i], 3e-5);
        free(expected);
        struct irb_image *all[] = {&t, &r, &ts, &rs, &map};
        for (int i = 0; i < 5; i++)
            irb_image_destroy(all[i]);
    }
}

static void identical_images_give_zero(void **state)
{
    (void)state;
    struct irb_image a = noise(67, 45, 1), b = noise(67, 45, 1);
    struct irb_flip_scores s;
    struct irb_flip_exposures exposures = exposures_of(&a);
    REQUIRE_OK(irb_flip_hdr(&a, &b, NULL, &exposures, IRB_FLIP_PPD, 2, NULL, &s, &err));
    REQUIRE_NEAR(s.max, 0, 0);
    REQUIRE_NEAR(s.weighted_median, 0, 0);
    REQUIRE_OK(irb_flip_ldr(&a, &b, NULL, IRB_FLIP_PPD, 2, NULL, &s, &err));
    REQUIRE_NEAR(s.max, 0, 0);
    irb_image_destroy(&a);
    irb_image_destroy(&b);
}

static void threads_do_not_matter(void **state)
{
    (void)state;
    struct irb_image t = noise(83, 61, 1), r = noise(83, 61, 2), map[4];
    struct irb_flip_exposures exposures = exposures_of(&r);
    struct irb_flip_scores s[4];
    for (int i = 0; i < 4; i++) {
        REQUIRE_OK(
            irb_flip_hdr(&t, &r, NULL, &exposures, IRB_FLIP_PPD, i * i, &map[i], &s[i], &err));
        assert_memory_equal(map[i].data, map[0].data, irb_image_pixels(&t) * sizeof(float));
        assert_memory_equal(&s[i], &s[0], sizeof s[0]);
    }
    for (int i = 0; i < 4; i++)
        irb_image_destroy(&map[i]);
    irb_image_destroy(&t);
    irb_image_destroy(&r);
}

/* One reference, several test images and threads, its image gone: the maps of irb_flip_hdr. */
static void a_prepared_reference_gives_the_same_bits(void **state)
{
    (void)state;
    struct irb_image r = noise(83, 61, 1), t[2] = {noise(83, 61, 2), noise(83, 61, 3)};
    struct irb_image small = noise(82, 61, 1), map, expected[2];
    struct irb_flip_exposures exposures = {-3, 2, 5}, broken = {NAN, 2, 5};
    struct irb_flip_scores s, expected_scores[2];
    struct irb_flip_reference *p = irb_flip_reference_create(&r, &exposures, 40, 3, &err);
    REQUIRE_OK(p != NULL);
    for (int i = 0; i < 2; i++)
        REQUIRE_OK(irb_flip_hdr(&t[i], &r, NULL, &exposures, 40, 1, &expected[i],
                                &expected_scores[i], &err));
    assert_null(irb_flip_reference_create(&r, &broken, 40, 1, &err));
    assert_null(irb_flip_reference_create(&r, &exposures, 0, 1, &err));
    irb_image_destroy(&r);
    for (int i = 0; i < 4; i++) {
        REQUIRE_OK(irb_flip_hdr_prepared(&t[i % 2], p, NULL, i, &map, &s, &err));
        assert_memory_equal(map.data, expected[i % 2].data, 83 * 61 * sizeof(float));
        assert_memory_equal(&s, &expected_scores[i % 2], sizeof s);
        irb_image_destroy(&map);
    }
    assert_false(irb_flip_hdr_prepared(&small, p, NULL, 1, &map, &s, &err));
    irb_flip_reference_destroy(p);
    struct irb_image *all[] = {&small, &t[0], &t[1], &expected[0], &expected[1]};
    for (int i = 0; i < 5; i++)
        irb_image_destroy(all[i]);
}

/* The map is the largest of the exposures' maps; the exposure map says of which. */
static void hdr_is_the_maximum_over_exposures(void **state)
{
    (void)state;
    struct hdr_pair pair = hdr(48, 40);
    struct irb_flip_exposures all = {-2, 2, 3};
    struct irb_flip_scores s;
    struct irb_image map, which, one[3];
    REQUIRE_OK(irb_flip_hdr_maps(&pair.test, &pair.reference, NULL, &all, IRB_FLIP_PPD, 1, &map,
                                 &which, &s, &err));
    for (int i = 0; i < 3; i++) {
        struct irb_flip_exposures single = {2 * i - 2, 2 * i - 2, 1};
        REQUIRE_OK(irb_flip_hdr(&pair.test, &pair.reference, NULL, &single, IRB_FLIP_PPD, 1,
                                &one[i], &s, &err));
    }
    int seen[3] = {0};
    for (size_t p = 0; p < irb_image_pixels(&map); p++) {
        int i = (int)lrintf(which.data[p] * 2);
        seen[i]++;
        REQUIRE_NEAR(map.data[p], one[i].data[p], 0);
        for (int j = 0; j < 3; j++)
            REQUIRE_CMP(map.data[p], >=, one[j].data[p]);
    }
    REQUIRE_CMP(seen[0] * seen[2], >, 0);
    for (int i = 0; i < 3; i++)
        irb_image_destroy(&one[i]);
    irb_image_destroy(&map);
    irb_image_destroy(&which);
    hdr_destroy(&pair);
}

static void masks_choose_pixels(void **state)
{
    (void)state;
    struct irb_image t = noise(20, 10, 1), r = noise(20, 10, 2), map;
    struct irb_flip_scores all, some, none;
    uint8_t mask[200];
    REQUIRE_OK(irb_flip_ldr(&t, &r, NULL, IRB_FLIP_PPD, 1, &map, &all, &err));
    double sum = 0, least = 1, largest = 0;
    for (int i = 0; i < 200; i++) {
        mask[i] = i % 3 == 0 ? 255 : 0;
        if (!mask[i])
            continue;
        sum += map.data[i];
        least = fmin(least, map.data[i]);
        largest = fmax(largest, map.data[i]);
    }
    irb_image_destroy(&map);
    REQUIRE_OK(irb_flip_ldr(&t, &r, mask, IRB_FLIP_PPD, 1, NULL, &some, &err));
    REQUIRE_NEAR(some.mean, sum / 67, 1e-12);
    REQUIRE_NEAR(some.min, least, 0);
    REQUIRE_NEAR(some.max, largest, 0);
    memset(mask, 0, sizeof mask);
    REQUIRE_OK(irb_flip_ldr(&t, &r, mask, IRB_FLIP_PPD, 1, NULL, &none, &err));
    assert_true(isnan(none.mean) && isnan(none.max) && isnan(none.weighted_median));
    irb_image_destroy(&t);
    irb_image_destroy(&r);
}

/* Indirect light alone leaves most of an image black: the median of all pixels is 0 and has no
 * exposure, the median of the lit ones has. */
static void black_pixels_do_not_set_exposures(void **state)
{
    (void)state;
    struct irb_image image = image3(10, 10), lit = image3(3, 1);
    const float values[3] = {0.02f, 0.5f, 7};
    for (int i = 0; i < 3; i++)
        for (int c = 0; c < 3; c++)
            image.data[3 * (40 + 7 * i) + c] = lit.data[3 * i + c] = values[i];
    image.data[3 * 90] = NAN;
    image.data[3 * 91] = INFINITY;
    image.data[3 * 92] = -5;
    struct irb_flip_exposures sparse = exposures_of(&image), dense = exposures_of(&lit);
    REQUIRE_NEAR(sparse.start, dense.start, 0);
    REQUIRE_NEAR(sparse.stop, dense.stop, 0);
    REQUIRE_NEAR(sparse.stop - sparse.start, log2(7 / 0.5), 1e-6);
    assert_int_equal(sparse.count, 4);
    /* A mask, and several images: 0.5 is the median of what is left of {0.02, 0.5}, {0.5, 7}. */
    const struct irb_image *images[2] = {&lit, &lit};
    const uint8_t first[3] = {1, 1, 0}, second[3] = {0, 1, 1};
    const uint8_t *masks[2] = {first, second};
    struct irb_flip_exposures both;
    assert_true(irb_flip_exposures_of(images, masks, 2, &both));
    REQUIRE_NEAR(both.start, dense.start, 0);
    REQUIRE_NEAR(both.stop, dense.stop, 0);
    irb_image_destroy(&image);
    irb_image_destroy(&lit);
}

static void no_light_has_no_exposure(void **state)
{
    (void)state;
    struct irb_image black = image3(4, 4);
    const struct irb_image *images[1] = {&black};
    struct irb_flip_exposures e;
    assert_false(irb_flip_exposures_of(images, NULL, 1, &e));
    irb_image_destroy(&black);
}

/* A scene 1e6 times brighter has the same error at exposures that follow it; extreme ranges are
 * covered by a bounded number of steps. */
static void exposures_follow_the_scale(void **state)
{
    (void)state;
    struct hdr_pair pair = hdr(40, 32);
    struct irb_flip_scores s[2];
    for (int i = 0; i < 2; i++) {
        struct irb_flip_exposures e = exposures_of(&pair.reference);
        REQUIRE_OK(irb_flip_hdr(&pair.test, &pair.reference, NULL, &e, IRB_FLIP_PPD, 1, NULL, &s[i],
                                &err));
        for (size_t p = 0; p < 3 * irb_image_pixels(&pair.test); p++) {
            pair.test.data[p] *= 1e6f;
            pair.reference.data[p] *= 1e6f;
        }
    }
    REQUIRE_NEAR(s[1].mean, s[0].mean, 1e-5);
    for (int i = 0; i < 3; i++) {
        pair.reference.data[3 * 7 + i] = 1e30f;
        pair.reference.data[i] = 1e-30f;
    }
    struct irb_flip_exposures e = exposures_of(&pair.reference);
    assert_int_equal(e.count, IRB_FLIP_MAX_EXPOSURES);
    hdr_destroy(&pair);
}

static void non_finite_values_stay_local(void **state)
{
    (void)state;
    struct irb_image r = noise(64, 48, 2), t = noise(64, 48, 2), map;
    t.data[3 * (20 * 64 + 20)] = NAN;
    t.data[3 * (20 * 64 + 30)] = INFINITY;
    t.data[3 * (20 * 64 + 40)] = -3;
    struct irb_flip_exposures e = exposures_of(&r);
    struct irb_flip_scores s;
    REQUIRE_OK(irb_flip_hdr(&t, &r, NULL, &e, IRB_FLIP_PPD, 1, &map, &s, &err));
    for (size_t i = 0; i < irb_image_pixels(&map); i++)
        REQUIRE_CMP(map.data[i], >=, 0); /* false for NaN */
    REQUIRE_CMP(map.data[20 * 64 + 30], >, 0);
    REQUIRE_NEAR(map.data[47 * 64 + 60], 0, 0);
    REQUIRE_CMP(s.mean, <, 0.2);
    irb_image_destroy(&map);
    irb_image_destroy(&r);
    irb_image_destroy(&t);
}

static void bad_input_is_refused(void **state)
{
    (void)state;
    struct irb_image a = noise(4, 4, 1), b = noise(5, 4, 1), map = {1, 1, 1, NULL};
    struct irb_flip_scores s;
    const double densities[] = {0, -1, NAN, 1001, INFINITY};
    assert_false(irb_flip_ldr(&a, &b, NULL, IRB_FLIP_PPD, 1, &map, &s, &err));
    assert_null(map.data);
    for (int i = 0; i < 5; i++)
        assert_false(irb_flip_ldr(&a, &a, NULL, densities[i], 1, &map, &s, &err));
    irb_image_destroy(&a);
    irb_image_destroy(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ldr_agrees_with_the_public_tool),
        cmocka_unit_test(views_agree_with_ldr),
        cmocka_unit_test(hdr_agrees_with_the_public_tool),
        cmocka_unit_test(automatic_exposures),
        cmocka_unit_test(pixels_agree_with_brute_force),
        cmocka_unit_test(identical_images_give_zero),
        cmocka_unit_test(threads_do_not_matter),
        cmocka_unit_test(a_prepared_reference_gives_the_same_bits),
        cmocka_unit_test(hdr_is_the_maximum_over_exposures),
        cmocka_unit_test(masks_choose_pixels),
        cmocka_unit_test(black_pixels_do_not_set_exposures),
        cmocka_unit_test(no_light_has_no_exposure),
        cmocka_unit_test(exposures_follow_the_scale),
        cmocka_unit_test(non_finite_values_stay_local),
        cmocka_unit_test(bad_input_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
