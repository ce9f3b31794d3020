/* SPDX-License-Identifier: MIT
 *
 * Every pass of a frame gives the same bits (tests/gl/same_bits.h).
 */
#include "tests/support/compare.h"
#include "core/frame/direct.h"
#include "methods/method.h"
#include "tests/frame/fixture.h"
#include "tests/gl/same_bits.h"

extern const struct irb_method irb_method_rsm;
static const struct irb_method *const rsm = &irb_method_rsm;

enum { LAYERS = 11, MODES = 4, WIDTH = 61, HEIGHT = 35, RESOLUTION = 48 };

/* All layers of one frame; the last MODES are rsm's irradiance. */
static void render(struct irb_gl *gl, struct irb_image *layers)
{
    struct irb_error err = {0};
    struct fixture_frame f;
    fixture_frame_create(&f, gl, fixture_scene("cornell-objects"), WIDTH, HEIGHT, RESOLUTION);
    fixture_view(f.scene, &f.light, &f.camera);
    fixture_frame_render(&f);
    struct irb_direct *direct = irb_direct_create(gl, WIDTH, HEIGHT, &err);
    REQUIRE_OK(direct);
    REQUIRE_OK(irb_direct_render(direct, f.gbuffer, f.rsm, &f.light, &f.camera, &err));
    const struct irb_texture *const textures[LAYERS - MODES] = {
        f.gbuffer->position, f.gbuffer->normal, f.gbuffer->geometric, direct->radiance,
        f.rsm->position,     f.rsm->normal,     f.rsm->flux};
    for (int i = 0; i < LAYERS - MODES; i++)
        layers[i] = fixture_read(textures[i], 4);
    int *params = calloc(1, rsm->params_size);
    irb_options_default(rsm->params, params);
    void *state = rsm->create(gl, f.scene_gl, WIDTH, HEIGHT, params, &err);
    REQUIRE_OK(state);
    for (int mode = 0; mode < MODES; mode++) {
        static const char *const names[MODES] = {"all", "uniform", "importance", "polar"};
        struct irb_frame_output out;
        const struct irb_frame_inputs inputs = {.scene = f.scene_gl,
                                                .light = &f.light,
                                                .camera = &f.camera,
                                                .gbuffer = f.gbuffer,
                                                .rsm = f.rsm,
                                                .params = params};
        REQUIRE_OK(irb_option_set(rsm->params, params, "mode", names[mode], &err));
        REQUIRE_OK(rsm->render_frame(state, &inputs, &out, &err));
        layers[LAYERS - MODES + mode] = fixture_read(out.irradiance, 4);
    }
    rsm->destroy(state);
    free(params);
    irb_direct_destroy(direct);
    fixture_frame_destroy(&f);
}

static void test_same_bits(void **state)
{
    (void)state;
    struct irb_image layers[LAYERS];
    fixture_same_bits(render, layers, LAYERS);
    for (int i = 0; i < LAYERS; i++) {
        REQUIRE_CMP(fixture_sum(&layers[i], 0) != 0, ==, 1);
        irb_image_destroy(&layers[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_same_bits)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
