/* SPDX-License-Identifier: MIT
 *
 * Noise, determinism, resuming, and the files.
 */
#include "core/base/fs.h"
#include "tests/reference/fixture.h"
#include "tests/support/compare.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void require_same_image(const struct irb_image *a, const struct irb_image *b)
{
    assert_int_equal(a->width, b->width);
    assert_int_equal(a->height, b->height);
    assert_memory_equal(a->data, b->data,
                        irb_image_pixels(a) * (size_t)a->channels * sizeof *a->data);
}

static void require_same(const struct irb_reference_image *a, const struct irb_reference_image *b)
{
    require_same_image(&a->direct, &b->direct);
    require_same_image(&a->bounce1, &b->bounce1);
    require_same_image(&a->bounce2, &b->bounce2);
    require_same_image(&a->rest, &b->rest);
    require_same_image(&a->unoccluded, &b->unoccluded);
    require_same_image(&a->variance, &b->variance);
    require_same_image(&a->unoccluded_variance, &b->unoccluded_variance);
    assert_int_equal(a->samples, b->samples);
    assert_memory_equal(&a->noise, &b->noise, sizeof a->noise);
    assert_memory_equal(&a->rest_remainder, &b->rest_remainder, sizeof a->rest_remainder);
    assert_true(a->rays == b->rays);
}

static void cornell(struct fixture *f, int samples, int bounces)
{
    fixture_builtin(f, "cornell");
    f->settings.min_samples = f->settings.max_samples = samples;
    f->settings.bounces = bounces;
    fixture_look(f, 40, 30); /* tiles that are not full */
}

/* Errors against an image of many samples and another seed: at least the root of their number. */
static void test_noise_falls(void **state)
{
    (void)state;
    enum { STEPS = 3 };
    struct fixture f;
    struct irb_reference_image truth, out;
    double error[STEPS], unoccluded[STEPS];
    cornell(&f, 4096, 1);
    f.settings.unoccluded = true;
    f.settings.seed = 99;
    fixture_must_render(&f, &truth);
    f.settings.seed = 1;
    for (int i = 0; i < STEPS; i++) {
        f.settings.min_samples = f.settings.max_samples = 16 << (2 * i);
        fixture_must_render(&f, &out);
        error[i] = fixture_rmse(&out.bounce1, &truth.bounce1);
        unoccluded[i] = fixture_rmse(&out.unoccluded, &truth.unoccluded);
        /* what it says of itself, and what it is */
        double mean = 0;
        for (size_t k = 0; k < irb_image_pixels(&out.variance); k++)
            mean += (double)out.variance.data[k];
        REQUIRE_REL(sqrt(mean / (double)irb_image_pixels(&out.variance)), error[i], 0.25);
        irb_reference_image_destroy(&out);
    }
    double slope = log(error[STEPS - 1] / error[0]) / log(16);
    print_message("slope of the error: %.3f, without occlusion %.3f\n", slope,
                  log(unoccluded[STEPS - 1] / unoccluded[0]) / log(16));
    REQUIRE_CMP(slope, <=, -0.5);
    REQUIRE_CMP(log(unoccluded[STEPS - 1] / unoccluded[0]) / log(16), <=, -0.5);
    irb_reference_image_destroy(&truth);
    fixture_destroy(&f);
}

static void test_threads_do_not_matter(void **state)
{
    (void)state;
    struct fixture f;
    struct irb_reference_image one, three;
    cornell(&f, 16, 6);
    f.settings.unoccluded = true;
    f.threads = 1;
    fixture_must_render(&f, &one);
    f.threads = 3;
    fixture_must_render(&f, &three);
    require_same(&one, &three);
    irb_reference_image_destroy(&one);
    irb_reference_image_destroy(&three);
    fixture_destroy(&f);
}

/* A second tracer of the same scene: the tree must not depend on anything but the scene. */
static void test_another_tracer_gives_the_same(void **state)
{
    (void)state;
    struct fixture f, g;
    struct irb_reference_image a, b;
    cornell(&f, 16, 4);
    cornell(&g, 16, 4);
    fixture_must_render(&f, &a);
    fixture_must_render(&g, &b);
    require_same(&a, &b);
    irb_reference_image_destroy(&a);
    irb_reference_image_destroy(&b);
    fixture_destroy(&f);
    fixture_destroy(&g);
}

static void test_noise_target_and_passes(void **state)
{
    (void)state;
    struct fixture f;
    struct irb_reference_image out, at_once;
    cornell(&f, 8, 2);
    f.settings.max_samples = 5000; /* 4096 */
    f.settings.noise = 0.03f;
    fixture_must_render(&f, &out);
    REQUIRE_CMP(out.noise, <=, f.settings.noise);
    REQUIRE_CMP(out.samples, >, 8);
    REQUIRE_CMP(out.samples, <, 4096);
    /* the same samples in one pass: sums in another order only */
    f.settings.min_samples = f.settings.max_samples = out.samples;
    f.settings.noise = 0;
    fixture_must_render(&f, &at_once);
    REQUIRE_CMP(fixture_rmse(&out.bounce1, &at_once.bounce1), <=,
                1e-6 * fixture_mean(&out.bounce1));
    irb_reference_image_destroy(&out);
    irb_reference_image_destroy(&at_once);
    /* a budget that is not met */
    f.settings.min_samples = 8;
    f.settings.max_samples = 40;
    f.settings.noise = 1e-6f;
    fixture_must_render(&f, &out);
    assert_int_equal(out.samples, 32);
    irb_reference_image_destroy(&out);
    fixture_destroy(&f);
}

/* Corrupts or truncates part of the file. */
static void damage(const char *path, long offset, bool truncated)
{
    if (truncated) {
        assert_int_equal(truncate(path, offset), 0);
        return;
    }
    FILE *file = fopen(path, "r+b");
    assert_non_null(file);
    assert_int_equal(fseek(file, offset, SEEK_SET), 0);
    for (int i = 0; i < 64; i++)
        fputc(0x5a, file);
    fclose(file);
}

static void test_stopped_job_goes_on(void **state)
{
    (void)state;
    char path[] = "/tmp/irbench-checkpoint-XXXXXX";
    struct fixture f;
    struct irb_reference_image undisturbed, out;
    struct irb_error err = {0};
    volatile sig_atomic_t stop = 1;
    close(mkstemp(path));
    cornell(&f, 8, 4);
    f.settings.max_samples = 64;
    fixture_must_render(&f, &undisturbed);
    f.checkpoint = path;
    f.stop = &stop;
    assert_false(fixture_render(&f, &out, &err));
    assert_int_equal(err.code, IRB_E_INTERRUPTED);
    assert_null(out.bounce1.data);
    stop = 0;
    fixture_must_render(&f, &out); /* from nothing */
    require_same(&out, &undisturbed);
    irb_reference_image_destroy(&out);
    fixture_must_render(&f, &out); /* all is there */
    require_same(&out, &undisturbed);
    irb_reference_image_destroy(&out);
    /* Torn: tiles of the last pass lost, of all passes lost, cut off, and a header destroyed. */
    static const struct {
        long offset;
        bool truncated;
    } damages[] = {{5000, false}, {30000, false}, {70000, true}, {40, true}, {0, false}};
    for (size_t i = 0; i < sizeof damages / sizeof *damages; i++) {
        damage(path, damages[i].offset, damages[i].truncated);
        fixture_must_render(&f, &out);
        require_same(&out, &undisturbed);
        irb_reference_image_destroy(&out);
    }
    /* another job's file is not taken for this one's */
    f.settings.seed = 5;
    fixture_must_render(&f, &out);
    REQUIRE_CMP(fixture_rmse(&out.bounce1, &undisturbed.bounce1), >, 0);
    irb_reference_image_destroy(&out);
    irb_reference_image_destroy(&undisturbed);
    fixture_destroy(&f);
    unlink(path);
}

static void test_unwritable_checkpoint(void **state)
{
    (void)state;
    struct fixture f;
    struct irb_reference_image out;
    struct irb_error err = {0};
    cornell(&f, 8, 1);
    f.checkpoint = "/nonexistent/folder/checkpoint";
    assert_false(fixture_render(&f, &out, &err));
    assert_int_equal(err.code, IRB_E_IO);
    assert_non_null(strstr(err.message, f.checkpoint));
    fixture_destroy(&f);
}

static void test_refused_settings(void **state)
{
    (void)state;
    struct fixture f;
    struct irb_reference_image out;
    struct irb_error err = {0};
    cornell(&f, 8, 17);
    assert_false(fixture_render(&f, &out, &err));
    assert_int_equal(err.code, IRB_E_INPUT);
    assert_non_null(strstr(err.message, "1..16, found 17"));
    f.settings.bounces = 1;
    f.settings.min_samples = 0;
    assert_false(fixture_render(&f, &out, &err));
    assert_int_equal(err.code, IRB_E_INPUT);
    fixture_destroy(&f);
}

static void test_file_round_trip(void **state)
{
    (void)state;
    char path[] = "/tmp/irbench-reference-XXXXXX";
    struct fixture f;
    struct irb_reference_image out, loaded;
    struct irb_error err = {0};
    close(mkstemp(path));
    cornell(&f, 8, 3);
    f.settings.unoccluded = true;
    fixture_must_render(&f, &out);
    REQUIRE_OK(irb_reference_image_save(&out, path, "0123", &err));
    REQUIRE_OK(irb_reference_image_load(&loaded, path, &err));
    require_same(&out, &loaded);
    assert_true(out.seconds == loaded.seconds);
    irb_reference_image_destroy(&loaded);
    REQUIRE_OK(irb_fs_write(path, "no image", 8, &err));
    assert_false(irb_reference_image_load(&loaded, path, &err));
    assert_int_equal(err.code, IRB_E_INPUT);
    assert_null(loaded.bounce1.data);
    irb_reference_image_destroy(&out);
    fixture_destroy(&f);
    unlink(path);
}

static void test_key_sees_every_input(void **state)
{
    (void)state;
    struct fixture f;
    cornell(&f, 8, 3);
    struct irb_key scene = {"a"}, gbuffer = {"b"}, other = {"c"}, keys[7];
    struct irb_light light = f.light;
    struct irb_camera camera = f.camera;
    struct irb_reference_settings settings = f.settings;
    light.intensity[1] *= 2;
    camera.vertical_fov *= 2;
    settings.unoccluded = !settings.unoccluded;
    keys[0] = irb_reference_key(&scene, &f.light, &f.camera, &gbuffer, &f.settings);
    keys[1] = irb_reference_key(&other, &f.light, &f.camera, &gbuffer, &f.settings);
    keys[2] = irb_reference_key(&scene, &light, &f.camera, &gbuffer, &f.settings);
    keys[3] = irb_reference_key(&scene, &f.light, &camera, &gbuffer, &f.settings);
    keys[4] = irb_reference_key(&scene, &f.light, &f.camera, &other, &f.settings);
    keys[5] = irb_reference_key(&scene, &f.light, &f.camera, &gbuffer, &settings);
    keys[6] = irb_reference_key(&scene, &f.light, &f.camera, &gbuffer, &f.settings);
    for (int i = 1; i < 6; i++)
        assert_string_not_equal(keys[0].hex, keys[i].hex);
    assert_string_equal(keys[0].hex, keys[6].hex);
    fixture_destroy(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_noise_falls),
        cmocka_unit_test(test_threads_do_not_matter),
        cmocka_unit_test(test_another_tracer_gives_the_same),
        cmocka_unit_test(test_noise_target_and_passes),
        cmocka_unit_test(test_stopped_job_goes_on),
        cmocka_unit_test(test_unwritable_checkpoint),
        cmocka_unit_test(test_refused_settings),
        cmocka_unit_test(test_file_round_trip),
        cmocka_unit_test(test_key_sees_every_input),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
