/* SPDX-License-Identifier: MIT
 *
 * clustered-visibility gives the same bits (tests/gl/same_bits.h).
 */
#include "tests/support/compare.h"
#include "methods/method.h"
#include "tests/frame/fixture.h"
#include "tests/gl/same_bits.h"

extern const struct irb_method irb_method_clustered_visibility;
static const struct irb_method *const cv = &irb_method_clustered_visibility;

enum { VARIANTS = 2 };

static void render(struct irb_gl *gl, struct irb_image *images)
{
    static const char *const prefilters[VARIANTS] = {"mip", "sat"};
    static const char *const projections[VARIANTS] = {"paraboloid", "hemicube"};
    struct irb_error err = {0};
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
}

static void test_same_bits(void **state)
{
    (void)state;
    struct irb_image images[VARIANTS];
    fixture_same_bits(render, images, VARIANTS);
    for (int v = 0; v < VARIANTS; v++)
        irb_image_destroy(&images[v]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_same_bits)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
