/* SPDX-License-Identifier: MIT */
#include "tests/support/compare.h"

#include "core/frame/composite.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* 2x1: the left pixel shows geometry. */
static struct irb_gbuffer_image make_gbuffer(void)
{
    struct irb_error err = {0};
    struct irb_gbuffer_image g;
    REQUIRE_OK(irb_gbuffer_image_create(&g, 2, 1, &err));
    memcpy(g.position.data, (float[]){1, 2, 3, 1}, 16);
    memcpy(g.normal.data, (float[]){0, 1, 0, 3.5f}, 16);
    memcpy(g.geometric.data, (float[]){0, 1, 0}, 12);
    memcpy(g.diffuse.data, (float[]){0.5f, 0.25f, 0}, 12);
    memcpy(g.specular.data, (float[]){0.1f, 0.2f, 0.3f, 20}, 16);
    return g;
}

static struct irb_image make_image(float r, float g, float b)
{
    struct irb_error err = {0};
    struct irb_image image;
    REQUIRE_OK(irb_image_create(&image, 2, 1, 3, &err));
    for (int i = 0; i < 2; i++)
        memcpy(image.data + 3 * i, (float[]){r, g, b}, 12);
    return image;
}

static void test_composite(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct irb_gbuffer_image g = make_gbuffer();
    struct irb_image direct = make_image(1, 2, 3), e = make_image(6.2831853f, 12.566371f, 5);
    struct irb_image radiance = make_image(0, 0, 0.5f), indirect, full;
    REQUIRE_OK(irb_composite(&g, &direct, &e, &radiance, &indirect, &full, &err));
    /* k_d/pi E: 0.5/pi 2pi = 1; 0.25/pi 4pi = 1; 0 + 0.5 */
    const float expected_indirect[3] = {1, 1, 0.5f}, expected_full[3] = {2, 3, 3.5f};
    for (int c = 0; c < 3; c++) {
        REQUIRE_NEAR(indirect.data[c], expected_indirect[c], 1e-6);
        REQUIRE_NEAR(full.data[c], expected_full[c], 1e-6);
        REQUIRE_NEAR(indirect.data[3 + c], 0, 0);
        REQUIRE_NEAR(full.data[3 + c], 0, 0);
    }
    irb_image_destroy(&indirect);
    irb_image_destroy(&full);
    REQUIRE_OK(irb_composite(&g, &direct, &e, NULL, NULL, &full, &err));
    REQUIRE_NEAR(full.data[2], 3, 1e-6);
    irb_image_destroy(&full);
    /* a method's NaN stays visible to the scores, but not where there is no geometry */
    e.data[0] = e.data[3] = NAN;
    REQUIRE_OK(irb_composite(&g, &direct, &e, NULL, &indirect, NULL, &err));
    assert_true(isnan(indirect.data[0]));
    REQUIRE_NEAR(indirect.data[3], 0, 0);
    irb_image_destroy(&indirect);
    e.width = 1;
    assert_false(irb_composite(&g, &direct, &e, NULL, &indirect, NULL, &err));
    assert_int_equal(err.code, IRB_E_INPUT);
    assert_non_null(strstr(err.message, "irradiance has 1x1"));
    irb_image_destroy(&direct);
    irb_image_destroy(&e);
    irb_image_destroy(&radiance);
    irb_gbuffer_image_destroy(&g);
}

static void test_exposure(void **state)
{
    (void)state;
    struct irb_gbuffer_image g = make_gbuffer();
    struct irb_image image = make_image(4, 4, 4);
    memcpy(image.data + 3, (float[]){1, 1, 1}, 12);
    /* only the left pixel counts: 0.18/4; both: log-average 2 */
    REQUIRE_REL(irb_exposure_of(&image, &g), 0.045, 1e-6);
    REQUIRE_REL(irb_exposure_of(&image, NULL), 0.09, 1e-6);
    memcpy(image.data, (float[]){NAN, 0, 0}, 12);
    REQUIRE_REL(irb_exposure_of(&image, NULL), 0.18, 1e-6);
    memset(image.data, 0, 24);
    REQUIRE_NEAR(irb_exposure_of(&image, &g), 1, 0);
    irb_image_destroy(&image);
    irb_gbuffer_image_destroy(&g);
}

static void test_tonemap(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct irb_image image = make_image(0, 0, 0), srgb;
    /* grey 1 at exposure 1 maps to 1/2, whose sRGB code is 0.735357 (IEC 61966-2-1) */
    memcpy(image.data, (float[]){1, 1, 1, NAN, -1, INFINITY}, 24);
    REQUIRE_OK(irb_tonemap(&image, 1, &srgb, &err));
    for (int c = 0; c < 3; c++)
        REQUIRE_NEAR(srgb.data[c], 0.735357, 1e-5);
    REQUIRE_NEAR(srgb.data[3], 0, 0);
    REQUIRE_NEAR(srgb.data[4], 0, 0);
    REQUIRE_NEAR(srgb.data[5], 1, 0);
    irb_image_destroy(&srgb);
    /* 0.002 of 0.004/(1+1): the linear part, 12.92 */
    memcpy(image.data, (float[]){0.004f, 1.0f, 1e30f, 0, 0, 0}, 24);
    image.data[1] = image.data[2] = 0.004f;
    REQUIRE_OK(irb_tonemap(&image, 0.5, &srgb, &err));
    REQUIRE_NEAR(srgb.data[0], 12.92 * 0.002 / 1.002, 1e-6);
    irb_image_destroy(&srgb);
    irb_image_destroy(&image);
}

static void test_save_and_load(void **state)
{
    (void)state;
    struct irb_error err = {0};
    char path[64];
    snprintf(path, sizeof path, "gbuffer-%d.exr", (int)getpid());
    struct irb_gbuffer_image g = make_gbuffer(), loaded;
    struct irb_key key = irb_gbuffer_image_key(&g);
    REQUIRE_OK(irb_gbuffer_image_save(&g, path, &err));
    REQUIRE_OK(irb_gbuffer_image_load(&loaded, path, &err));
    assert_int_equal(loaded.width, 2);
    assert_int_equal(loaded.height, 1);
    assert_string_equal(irb_gbuffer_image_key(&loaded).hex, key.hex);
    assert_memory_equal(loaded.normal.data, g.normal.data, 32);
    loaded.specular.data[7] = 1;
    assert_string_not_equal(irb_gbuffer_image_key(&loaded).hex, key.hex);
    irb_gbuffer_image_destroy(&loaded);
    unlink(path);
    assert_false(irb_gbuffer_image_load(&loaded, path, &err));
    assert_non_null(strstr(err.message, path));
    assert_null(loaded.position.data);
    irb_gbuffer_image_destroy(&g);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_composite),
        cmocka_unit_test(test_exposure),
        cmocka_unit_test(test_tonemap),
        cmocka_unit_test(test_save_and_load),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
