/* SPDX-License-Identifier: MIT
 *
 * The method clustered-visibility: without shadows against plain RSM, with them against the same
 * VPLs with rays in double precision; what must hold in every frame.
 */
#include "tests/support/compare.h"
#include "tests/support/raycast.h"
#include "core/lights/vpl.h"
#include "methods/clustered_visibility/params.h"
#include "methods/method.h"
#include "tests/frame/fixture.h"

extern const struct irb_method irb_method_clustered_visibility, irb_method_rsm;
static const struct irb_method *const cv = &irb_method_clustered_visibility;

static struct irb_gl *gl;

static void set_all(const struct irb_method *method, void *params, const char *const *settings)
{
    struct irb_error err = {0};
    for (; settings && *settings; settings += 2)
        REQUIRE_OK(irb_option_set(method->params, params, settings[0], settings[1], &err));
}

static void *make_params(const struct irb_method *method, const char *const *settings)
{
    void *params = calloc(1, method->params_size);
    irb_options_default(method->params, params);
    set_all(method, params, settings);
    return params;
}

static struct irb_frame_inputs inputs_of(const struct fixture_frame *f, const void *params,
                                         bool debug)
{
    return (struct irb_frame_inputs){.scene = f->scene_gl,
                                     .light = &f->light,
                                     .camera = &f->camera,
                                     .gbuffer = f->gbuffer,
                                     .rsm = f->rsm,
                                     .params = params,
                                     .debug = debug};
}

static double statistic(const struct irb_frame_output *out, const char *name)
{
    for (int i = 0; i < out->statistic_count; i++)
        if (!strcmp(out->statistics[i].name, name))
            return out->statistics[i].value;
    fail_msg("no statistic %s", name);
    return 0;
}

/* Finite, not negative, share in [0,1]. */
static void check(const struct irb_image *e)
{
    for (size_t i = 0; i < 4 * irb_image_pixels(e); i++) {
        assert_true(isfinite(e->data[i]));
        REQUIRE_CMP(e->data[i], >=, 0);
        if (i % 4 == 3)
            REQUIRE_CMP(e->data[i], <=, 1);
    }
}

/* One frame with fresh state. */
static struct irb_image render(const struct irb_method *method, const struct fixture_frame *f,
                               const char *const *settings, struct irb_frame_output *out)
{
    struct irb_error err = {0};
    void *params = make_params(method, settings);
    void *state =
        method->create(gl, f->scene_gl, f->gbuffer->width, f->gbuffer->height, params, &err);
    REQUIRE_OK(state);
    REQUIRE_OK(method->begin_sequence(state, params, 0, &err));
    const struct irb_frame_inputs inputs = inputs_of(f, params, false);
    REQUIRE_OK(method->render_frame(state, &inputs, out, &err));
    struct irb_image image = fixture_read(out->irradiance, 4);
    method->destroy(state);
    free(params);
    check(&image);
    return image;
}

static void make_frame(struct fixture_frame *f, const char *scene, int width, int height)
{
    fixture_frame_create(f, gl, fixture_scene(scene), width, height, 64);
    fixture_view(f->scene, &f->light, &f->camera);
    fixture_frame_render(f);
}

static double mean_difference(const struct irb_image *a, const struct irb_image *b)
{
    double difference = 0, sum = 0;
    for (size_t i = 0; i < irb_image_pixels(b); i++) {
        difference += fabs((double)a->data[4 * i + 1] - b->data[4 * i + 1]);
        sum += b->data[4 * i + 1];
    }
    return sum > 0 ? difference / sum : difference;
}

/* Without shadows the lights are those of rsm's importance, whatever the clusters: pixel by pixel
 * for one tile, and the same light in all for several. */
static void test_unshadowed(void **state)
{
    (void)state;
    struct fixture_frame f;
    struct irb_frame_output out;
    make_frame(&f, "cornell-objects", 48, 36);
    const char *const counts[] = {"1", "100", "512", "2048"};
    for (int k = 0; k < 4; k++) {
        const char *const rsm[] = {"mode", "importance", "samples", counts[k], NULL};
        const char *const one[] = {"visibility", "none", "interleave_n", "1", "interleave_m",
                                   "1",          "vpls", counts[k],      NULL};
        const char *const many[] = {"visibility", "none", "interleave_n", "3", "interleave_m",
                                    "3",          "vpls", counts[k],      NULL};
        struct irb_image expected = render(&irb_method_rsm, &f, rsm, &out);
        struct irb_image found = render(cv, &f, one, &out);
        for (size_t i = 0; i < irb_image_pixels(&found); i++)
            for (size_t c = 0; c < 3; c++)
                REQUIRE_NEAR(found.data[4 * i + c], expected.data[4 * i + c],
                             1e-5 * expected.data[4 * i + c]);
        REQUIRE_NEAR(fixture_sum(&found, 3), 0, 0);
        irb_image_destroy(&found);
        if (k >= 2) {
            found = render(cv, &f, many, &out);
            REQUIRE_REL(fixture_sum(&found, 1), fixture_sum(&expected, 1), 0.05);
            irb_image_destroy(&found);
        }
        irb_image_destroy(&expected);
    }
    fixture_frame_destroy(&f);
}

/* --- against rays --- */

/* A floor that a spot lights, a ceiling, and a square between: six triangles. */
static struct irb_scene *make_hall(void)
{
    static const float grey[3] = {0.6f, 0.6f, 0.6f};
    static const double floor[4][3] = {{-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}};
    static const double ceiling[4][3] = {{-2, 2, -2}, {2, 2, -2}, {2, 2, 2}, {-2, 2, 2}};
    static const double square[4][3] = {
        {-0.8, 1.2, 0.6}, {0.5, 1.2, 0.6}, {0.5, 1.2, -0.6}, {-0.8, 1.2, -0.6}};
    struct irb_error err = {0};
    struct irb_builder builder;
    irb_builder_begin(&builder, "hall");
    irb_builder_object(&builder, "all", irb_builder_material(&builder, "grey", grey));
    irb_builder_quad(&builder, floor);
    irb_builder_quad(&builder, ceiling);
    irb_builder_quad(&builder, square);
    struct irb_scene *scene = irb_builder_finish(&builder, &err);
    REQUIRE_OK(scene);
    return scene;
}

static void make_hall_frame(struct fixture_frame *f)
{
    static const float spot[3] = {-1, 0.8f, 0}, target[3] = {-0.3f, 0, 0}, side[3] = {0, 0, -1};
    static const float eye[3] = {-0.3f, 1.21f, 0}, up[3] = {-0.3f, 2, 0}; /* above the square */
    fixture_frame_create(f, gl, make_hall(), 40, 30, 64);
    f->light = fixture_spot(spot, target, 40);
    f->camera = fixture_camera(eye, up, side, 110);
    fixture_frame_render(f);
}

struct vpl {
    float position[4], normal[4], flux[4];
};

/* The VPLs that the method draws for one tile. */
static struct vpl *draw_vpls(const struct fixture_frame *f, int count)
{
    struct irb_error err = {0};
    struct vpl *vpls = malloc((size_t)count * sizeof *vpls);
    struct irb_vpl_set *set =
        irb_vpl_set_create(gl, IRB_VPL_IMPORTANCE, f->rsm->resolution, count, &err);
    REQUIRE_OK(set);
    REQUIRE_OK(irb_vpl_set_sample(set, f->rsm, count, 0, &err));
    REQUIRE_NEAR(set->count, count, 0);
    REQUIRE_OK(irb_buffer_read(set->lights, 0, count * (int64_t)sizeof *vpls, vpls, &err));
    irb_vpl_set_destroy(set);
    return vpls;
}

/* Irradiance in double precision, channel 1, with exact visibility of every VPL. */
static struct irb_image trace(const struct fixture_frame *f, const struct vpl *vpls, int count)
{
    struct irb_error err = {0};
    struct irb_image e, position = fixture_read(f->gbuffer->position, 4);
    struct irb_image normal = fixture_read(f->gbuffer->normal, 4);
    struct raycast cast;
    raycast_create(&cast, f->scene);
    REQUIRE_OK(irb_image_create(&e, f->gbuffer->width, f->gbuffer->height, 4, &err));
    for (size_t i = 0; i < irb_image_pixels(&e); i++) {
        double sum = 0;
        for (int l = 0; l < count; l++) {
            double from[3], d[3], r2 = 0, cos_x = 0, cos_y = 0;
            for (int k = 0; k < 3; k++) {
                from[k] = vpls[l].position[k];
                d[k] = position.data[4 * i + (size_t)k] - from[k];
                r2 += d[k] * d[k];
                cos_x -= normal.data[4 * i + (size_t)k] * d[k];
                cos_y += vpls[l].normal[k] * d[k];
            }
            if (cos_x > 0 && cos_y > 0 && raycast_nearest(&cast, from, d, 1e-4) > 1 - 1e-4)
                sum += vpls[l].flux[1] / M_PI * cos_x * cos_y / (r2 * r2);
        }
        e.data[4 * i + 1] = (float)sum;
    }
    raycast_destroy(&cast);
    irb_image_destroy(&position);
    irb_image_destroy(&normal);
    return e;
}

struct shadow_case {
    const char *name, *vals, *order, *offset, *scale, *search_scale, *prefilter, *projection;
    double most; /* mean difference to the truth, as a share of its mean */
};

/* Mean |difference| of the ceiling's irradiance, which a square shadows; without shadows it is
 * 127 %. Limits: what comes out, and a little more. */
static void test_against_rays(void **state)
{
    (void)state;
    enum { VPLS = 128 };
    static const struct shadow_case cases[] = {
        {"one VAL", "1", "4", "0", "2", "1", "mip", "paraboloid", 0.32},
        {"default", "16", "4", "0", "2", "1", "mip", "paraboloid", 0.053},
        {"tables", "16", "4", "0", "2", "1", "sat", "paraboloid", 0.043},
        {"hemicube", "16", "4", "0", "2", "1", "mip", "hemicube", 0.04},
        {"M = 16", "16", "16", "1", "1", "3", "mip", "paraboloid", 0.045},
        {"M = 16, tables", "16", "16", "1", "1", "3", "sat", "paraboloid", 0.038},
        {"M = 16, hemicube", "16", "16", "1", "1", "3", "sat", "hemicube", 0.032},
        {"a VAL for each", "128", "16", "1", "1", "3", "mip", "paraboloid", 0.023},
    };
    struct fixture_frame f;
    struct irb_frame_output out;
    make_hall_frame(&f);
    struct vpl *vpls = draw_vpls(&f, VPLS);
    struct irb_image truth = trace(&f, vpls, VPLS);
    const char *const none[] = {"visibility", "none", "interleave_n", "1", "interleave_m",
                                "1",          "vpls", "128",          NULL};
    struct irb_image lit = render(cv, &f, none, &out);
    const double unshadowed = mean_difference(&lit, &truth);
    print_message("no shadows: %.4f\n", unshadowed);
    REQUIRE_CMP(unshadowed, >, 1);
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const struct shadow_case *c = &cases[k];
        const char *const settings[] = {"interleave_n",
                                        "1",
                                        "interleave_m",
                                        "1",
                                        "vpls",
                                        "128",
                                        "map_size",
                                        "128",
                                        "vals",
                                        c->vals,
                                        "csm_order",
                                        c->order,
                                        "csm_offset",
                                        c->offset,
                                        "csm_scale",
                                        c->scale,
                                        "csm_prefilter",
                                        c->prefilter,
                                        "search_scale",
                                        c->search_scale,
                                        "projection",
                                        c->projection,
                                        NULL};
        struct irb_image found = render(cv, &f, settings, &out);
        const double error = mean_difference(&found, &truth);
        print_message("%-17s %.4f, energy %.3f\n", c->name, error,
                      fixture_sum(&found, 1) / fixture_sum(&truth, 1));
        REQUIRE_CMP(error, <, c->most);
        irb_image_destroy(&found);
    }
    irb_image_destroy(&lit);
    irb_image_destroy(&truth);
    free(vpls);
    fixture_frame_destroy(&f);
}

/* --- what holds in every frame --- */

/* Settings and frames that change, resizes and a light that lights nothing: the state gives what a
 * fresh one would, and debug layers change nothing. */
static void test_changing_frames(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct fixture_frame f;
    struct irb_frame_output out;
    make_frame(&f, "cornell", 20, 15);
    static const char *const small[] = {"map_size", "64", "vals", "5", NULL};
    void *params = make_params(cv, small);
    void *method = cv->create(gl, f.scene_gl, 7, 5, params, &err);
    REQUIRE_OK(method);
    REQUIRE_OK(cv->resize(method, 20, 15, &err));
    static const char *const frames[][10] = {
        {"vpls", "100"},
        {"vpls", "1", "csm_prefilter", "sat"},
        {"vpls", "2048"},
        {"vals", "1", "vpls", "40"},
        {"vals", "128"},
        {"projection", "hemicube", "vals", "7"},
        {"dark"},
        {"csm_order", "3", "csm_prefilter", "mip", "clamp", "5"},
        {"interleave_n", "1", "interleave_m", "1"},
        {"interleave_n", "8", "interleave_m", "8", "area", "max", "centre", "member"},
        {"visibility", "none"},
        {"visibility", "clustered", "clamp", "0"}};
    for (size_t i = 0; i < sizeof frames / sizeof *frames; i++) {
        struct irb_light light = f.light;
        const bool dark = !strcmp(frames[i][0], "dark");
        if (dark)
            memset(light.intensity, 0, sizeof light.intensity);
        else
            set_all(cv, params, frames[i]);
        REQUIRE_OK(irb_rsm_render(f.rsm, f.scene_gl, &light, &err));
        struct irb_frame_inputs inputs = inputs_of(&f, params, i % 2 == 0);
        REQUIRE_OK(cv->render_frame(method, &inputs, &out, &err));
        struct irb_image found = fixture_read(out.irradiance, 4);
        check(&found);
        REQUIRE_NEAR(fixture_sum(&found, 0) > 0, !dark, 0);
        REQUIRE_NEAR(out.clamped_light > 0, i == 7 || i == 8 || i == 9 || i == 10, 0);
        REQUIRE_CMP(out.clamped_light, <, 1);
        if (inputs.debug)
            REQUIRE_CMP(out.debug_count, >=, 2);
        else
            REQUIRE_NEAR(out.debug_count, 0, 0);
        void *fresh = cv->create(gl, f.scene_gl, 20, 15, params, &err);
        REQUIRE_OK(fresh);
        inputs.debug = i % 2 == 1;
        REQUIRE_OK(cv->render_frame(fresh, &inputs, &out, &err));
        struct irb_image expected = fixture_read(out.irradiance, 4);
        assert_memory_equal(found.data, expected.data, irb_image_pixels(&found) * 16);
        cv->destroy(fresh);
        irb_image_destroy(&found);
        irb_image_destroy(&expected);
    }
    cv->destroy(method);
    free(params);
    fixture_frame_destroy(&f);
}

/* Reuse goes on from the frame before, and begin_sequence forgets. */
static void test_history(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct fixture_frame f;
    struct irb_frame_output out;
    make_frame(&f, "cornell", 16, 12);
    static const char *const settings[] = {"map_size", "64", "start", "reuse", NULL};
    void *params = make_params(cv, settings);
    void *method = cv->create(gl, f.scene_gl, 16, 12, params, &err);
    REQUIRE_OK(method);
    const struct irb_frame_inputs inputs = inputs_of(&f, params, false);
    double in_use[4], iterations[4];
    for (int frame = 0; frame < 4; frame++) {
        if (frame == 3)
            REQUIRE_OK(cv->begin_sequence(method, params, 0, &err));
        REQUIRE_OK(cv->render_frame(method, &inputs, &out, &err));
        in_use[frame] = statistic(&out, "vals_in_use");
        iterations[frame] = statistic(&out, "iterations");
        REQUIRE_NEAR(statistic(&out, "converged"), 1, 0);
    }
    REQUIRE_NEAR(iterations[1], 2, 0); /* nothing has moved: assigned once, and again */
    REQUIRE_NEAR(iterations[3], iterations[0], 0);
    REQUIRE_CMP(iterations[0], >, 2);
    for (int frame = 0; frame < 4; frame++)
        REQUIRE_NEAR(in_use[frame], in_use[0], 0);
    cv->destroy(method);
    free(params);
    fixture_frame_destroy(&f);
}

/* The split image of all VALs, in batches of at most `capacity`, through the parts of the method.
 */
static struct irb_image light_in_batches(const struct fixture_frame *f, int capacity, int *batches)
{
    enum { VPLS = 1500, VALS = 7 };
    struct irb_error err = {0};
    struct irb_vpl_set *set = irb_vpl_set_create(gl, IRB_VPL_IMPORTANCE, 64, VPLS, &err);
    struct irb_interleave *il = irb_interleave_create(gl, 16, 12, 1, 1, &err);
    struct irb_vals *vals = irb_vals_create(gl, &err);
    REQUIRE_OK(set && il && vals);
    REQUIRE_OK(irb_vpl_set_sample(set, f->rsm, VPLS, 0, &err));
    const struct irb_virtual_lights vpls = irb_vpl_set_view(set);
    void *params = make_params(cv, (const char *const[]){"vals", "7", "clamp", "5", NULL});
    struct cv_resolved r;
    cv_params_resolve(params, irb_scene_diagonal(f->scene), 0, &r);
    r.lighting.size = 64;
    REQUIRE_OK(irb_vals_cluster(vals, &vpls, &r.clustering, &err));
    REQUIRE_OK(irb_vals_order(vals, &vpls, 1, &err));
    REQUIRE_OK(irb_interleave_split(il, f->gbuffer, &err));
    struct irb_val_lighting l;
    struct irb_val_batch batch = {.count = -1};
    irb_val_lighting_init(&l, gl);
    REQUIRE_OK(irb_val_lighting_prepare(&l, il, &r.lighting, capacity, &err));
    for (*batches = 0; irb_val_lighting_next(&l, &r.lighting, VALS, &batch); ++*batches) {
        REQUIRE_OK(irb_val_lighting_maps(&l, f->scene_gl, vals, &r.lighting, &batch, &err));
        REQUIRE_OK(irb_csm_basis(l.csm, l.maps, &r.lighting.csm, &err));
        REQUIRE_OK(irb_csm_prefilter(l.csm, &err));
        REQUIRE_OK(irb_val_lighting_run(&l, il, vals, &r.lighting, &batch, &err));
    }
    struct irb_image image = fixture_read(il->split, 4);
    irb_val_lighting_destroy(&l);
    irb_vals_destroy(vals);
    irb_interleave_destroy(il);
    irb_vpl_set_destroy(set);
    free(params);
    return image;
}

/* However many maps fit, it is the same light; two blocks of VPLs. */
static void test_batches(void **state)
{
    (void)state;
    struct fixture_frame f;
    make_frame(&f, "cornell", 16, 12);
    static const int capacities[] = {7, 3, 1}, expected_batches[] = {1, 3, 7};
    struct irb_image first = {0};
    for (int k = 0; k < 3; k++) {
        int batches;
        struct irb_image e = light_in_batches(&f, capacities[k], &batches);
        REQUIRE_NEAR(batches, expected_batches[k], 0);
        if (k == 0) {
            first = e;
            REQUIRE_CMP(fixture_sum(&e, 1), >, 0);
            continue;
        }
        for (size_t i = 0; i < 4 * irb_image_pixels(&e); i++)
            REQUIRE_NEAR(e.data[i], first.data[i], 1e-5 * first.data[i] + 1e-7);
        irb_image_destroy(&e);
    }
    irb_image_destroy(&first);
    fixture_frame_destroy(&f);
}

/* A thousand times smaller or larger, far weaker or stronger light: E goes with I/s^2. */
static void test_scales(void **state)
{
    (void)state;
    static const double scales[] = {1, 1e-3, 1e3}, intensities[] = {1, 1e6, 1e-6};
    static const char *const settings[] = {"map_size", "64", NULL};
    struct irb_image first = {0};
    for (int k = 0; k < 3; k++) {
        struct fixture_frame f;
        struct irb_frame_output out;
        struct irb_scene *scene = fixture_scene("cornell");
        const float s = (float)scales[k];
        struct irb_light light;
        struct irb_camera camera;
        fixture_view(scene, &light, &camera);
        for (size_t i = 0; i < 3 * (size_t)scene->vertex_count; i++)
            scene->positions[i] *= s;
        for (int i = 0; i < 3; i++) {
            scene->bounds_min[i] *= s;
            scene->bounds_max[i] *= s;
            light.position[i] *= s;
            light.intensity[i] = (float)intensities[k];
            camera.position[i] *= s;
            camera.target[i] *= s;
        }
        camera.z_near *= s;
        camera.z_far *= s;
        fixture_frame_create(&f, gl, scene, 20, 15, 64);
        f.light = light;
        f.camera = camera;
        fixture_frame_render(&f);
        struct irb_image e = render(cv, &f, settings, &out);
        const double unit = intensities[k] / (scales[k] * scales[k]);
        if (k == 0)
            first = e;
        else
            REQUIRE_REL(fixture_sum(&e, 1) / unit, fixture_sum(&first, 1), 0.01);
        if (k)
            irb_image_destroy(&e);
        fixture_frame_destroy(&f);
    }
    irb_image_destroy(&first);
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_unshadowed),      cmocka_unit_test(test_against_rays),
        cmocka_unit_test(test_changing_frames), cmocka_unit_test(test_history),
        cmocka_unit_test(test_batches),         cmocka_unit_test(test_scales),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failed;
}
