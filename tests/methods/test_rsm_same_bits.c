/* SPDX-License-Identifier: MIT
 *
 * OSMesa and EGL on llvmpipe give the same bits for every pass of a frame.
 */
#include "tests/support/compare.h"
#include "core/frame/direct.h"
#include "methods/method.h"
#include "tests/frame/fixture.h"

extern const struct irb_method irb_method_rsm;
static const struct irb_method *const rsm = &irb_method_rsm;

enum { LAYERS = 11, MODES = 4, WIDTH = 61, HEIGHT = 35, RESOLUTION = 48 };

/* All layers of one frame on one backend; the last MODES are rsm's irradiance. */
static void render(enum irb_backend backend, struct irb_image layers[LAYERS])
{
    struct irb_error err = {0};
    struct irb_gl *gl = fixture_gl(backend, NULL);
    if (!gl->software) {
        printf("skipped: %s is no software rasteriser\n", gl->renderer);
        exit(TEST_SKIPPED);
    }
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
    irb_gl_destroy(gl);
}

static void test_backends(void **state)
{
    (void)state;
    struct irb_image osmesa[LAYERS], egl[LAYERS];
    render(IRB_BACKEND_OSMESA, osmesa);
    render(IRB_BACKEND_EGL, egl);
    for (int i = 0; i < LAYERS; i++) {
        size_t bytes = irb_image_pixels(&osmesa[i]) * 16;
        REQUIRE_CMP(fixture_sum(&osmesa[i], 0) != 0, ==, 1);
        if (memcmp(osmesa[i].data, egl[i].data, bytes))
            fail_msg("layer %d differs", i);
        irb_image_destroy(&osmesa[i]);
        irb_image_destroy(&egl[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_backends)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
