/* SPDX-License-Identifier: MIT
 *
 * clustered-visibility gives the same bits on one thread and two, on OSMesa and EGL, when both are
 * llvmpipe.
 */
#include "tests/support/compare.h"
#include "methods/method.h"
#include "tests/frame/fixture.h"

extern const struct irb_method irb_method_clustered_visibility;
static const struct irb_method *const cv = &irb_method_clustered_visibility;

enum { VARIANTS = 2 };

static void render(enum irb_backend backend, const char *threads, struct irb_image images[VARIANTS])
{
    static const char *const prefilters[VARIANTS] = {"mip", "sat"};
    static const char *const projections[VARIANTS] = {"paraboloid", "hemicube"};
    struct irb_error err = {0};
    setenv("LP_NUM_THREADS", threads, 1); /* llvmpipe reads it for each context */
    struct irb_gl *gl = fixture_gl(backend, NULL);
    if (!gl->software) {
        printf("skipped: %s is no software rasteriser\n", gl->renderer);
        exit(TEST_SKIPPED);
    }
    struct fixture_frame f;
    fixture_frame_create(&f, gl, fixture_scene("cornell"), 31, 23, 48);
    fixture_view(f.scene, &f.light, &f.camera);
    fixture_frame_render(&f);
    void *params = calloc(1, cv->params_size);
    irb_options_default(cv->params, params);
    for (int v = 0; v < VARIANTS; v++) {
        struct irb_frame_output out;
        const struct irb_frame_inputs inputs = {.scene = f.scene_gl,
                                                .light = &f.light,
                                                .camera = &f.camera,
                                                .gbuffer = f.gbuffer,
                                                .rsm = f.rsm,
                                                .params = params};
        REQUIRE_OK(irb_option_set(cv->params, params, "map_size", "64", &err));
        REQUIRE_OK(irb_option_set(cv->params, params, "csm_prefilter", prefilters[v], &err));
        REQUIRE_OK(irb_option_set(cv->params, params, "projection", projections[v], &err));
        void *state = cv->create(gl, f.scene_gl, 31, 23, params, &err);
        REQUIRE_OK(state);
        REQUIRE_OK(cv->render_frame(state, &inputs, &out, &err));
        images[v] = fixture_read(out.irradiance, 4);
        REQUIRE_CMP(fixture_sum(&images[v], 0), >, 0);
        cv->destroy(state);
    }
    free(params);
    fixture_frame_destroy(&f);
    assert_int_equal(gl->bytes, 0);
    irb_gl_destroy(gl);
}

static void test_same_bits(void **state)
{
    (void)state;
    struct irb_image expected[VARIANTS], found[VARIANTS];
    render(IRB_BACKEND_OSMESA, "2", expected);
    for (int other = 0; other < 2; other++) {
        render(other ? IRB_BACKEND_EGL : IRB_BACKEND_OSMESA, other ? "2" : "1", found);
        for (int v = 0; v < VARIANTS; v++) {
            assert_memory_equal(found[v].data, expected[v].data,
                                irb_image_pixels(&expected[v]) * 16);
            irb_image_destroy(&found[v]);
        }
    }
    for (int v = 0; v < VARIANTS; v++)
        irb_image_destroy(&expected[v]);
}

int main(void)
{
    irb_gl_destroy(fixture_gl(IRB_BACKEND_EGL, NULL)); /* skips where it is missing */
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_same_bits)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
