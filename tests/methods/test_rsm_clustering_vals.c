/* SPDX-License-Identifier: MIT
 *
 * rsm-clustering with visibility=clustered: where nothing blocks and where all is blocked; against
 * every texel of the RSM with rays in double precision; frames that change.
 */
#include "tests/support/compare.h"
#include "tests/support/raycast.h"
#include "core/lights/vpl.h"
#include "methods/method.h"
#include "methods/rsm_clustering/params.h"
#include "tests/frame/fixture.h"

extern const struct irb_method irb_method_rsm_clustering;
static const struct irb_method *const method = &irb_method_rsm_clustering;

static struct irb_gl *gl;

struct trial {
    const struct fixture_frame *f;
    struct rsc_params params;
    void *state;
    struct irb_frame_output out;
};

/* Defaults, then "name", "value", ..., NULL. */
static void set(struct trial *t, const char *const *settings)
{
    struct irb_error err = {0};
    irb_options_default(method->params, &t->params);
    for (; *settings; settings += 2)
        REQUIRE_OK(irb_option_set(method->params, &t->params, settings[0], settings[1], &err));
}

static void begin(struct trial *t, const struct fixture_frame *f, const char *const *settings)
{
    struct irb_error err = {0};
    *t = (struct trial){.f = f};
    set(t, settings);
    t->state =
        method->create(gl, f->scene_gl, f->gbuffer->width, f->gbuffer->height, &t->params, &err);
    REQUIRE_OK(t->state);
    REQUIRE_OK(method->begin_sequence(t->state, &t->params, 1, &err));
}

/* Finite, not negative, share of shadow in [0,1]. */
static struct irb_image next_frame(struct trial *t)
{
    struct irb_error err = {0};
    const struct irb_frame_inputs inputs = {.scene = t->f->scene_gl,
                                            .light = &t->f->light,
                                            .camera = &t->f->camera,
                                            .gbuffer = t->f->gbuffer,
                                            .rsm = t->f->rsm,
                                            .seed = 1,
                                            .params = &t->params};
    REQUIRE_OK(method->render_frame(t->state, &inputs, &t->out, &err));
    struct irb_image e = fixture_read(t->out.irradiance, 4);
    for (size_t i = 0; i < 4 * irb_image_pixels(&e); i++) {
        assert_true(isfinite(e.data[i]) && e.data[i] >= 0);
        REQUIRE_CMP(e.data[i], <=, i % 4 == 3 ? 1 : INFINITY);
    }
    return e;
}

static struct irb_image render(const struct fixture_frame *f, const char *const *settings)
{
    struct trial t;
    begin(&t, f, settings);
    struct irb_image e = next_frame(&t);
    method->destroy(t.state);
    return e;
}

static double statistic(const struct irb_frame_output *out, const char *name)
{
    for (int i = 0; i < out->statistic_count; i++)
        if (!strcmp(out->statistics[i].name, name))
            return out->statistics[i].value;
    return NAN;
}

/* --- a hall --- */

/* A floor that a spot lights, a ceiling, and if `side` (m) is positive a square between. The
 * ceiling reaches farther than the view: the depths that a map holds are divided by the farthest,
 * and what is beyond that would not be told from a blocker there. */
static void make_hall(struct fixture_frame *f, double side)
{
    static const float grey[3] = {0.6f, 0.6f, 0.6f};
    static const double floor[4][3] = {{-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}};
    static const double ceiling[4][3] = {{-4, 2, -4}, {4, 2, -4}, {4, 2, 4}, {-4, 2, 4}};
    const double s = 0.5 * side;
    const double square[4][3] = {{-s, 1, s}, {s, 1, s}, {s, 1, -s}, {-s, 1, -s}};
    static const float spot[3] = {-0.9f, 0.8f, 0}, target[3] = {-0.3f, 0, 0}, out[3] = {0, 0, -1};
    static const float eye[3] = {-0.3f, 1.01f, 0}, up[3] = {-0.3f, 2, 0}; /* above the square */
    struct irb_error err = {0};
    struct irb_builder builder;
    irb_builder_begin(&builder, "hall");
    irb_builder_object(&builder, "all", irb_builder_material(&builder, "grey", grey));
    irb_builder_quad(&builder, floor);
    irb_builder_quad(&builder, ceiling);
    if (side > 0)
        irb_builder_quad(&builder, square);
    struct irb_scene *scene = irb_builder_finish(&builder, &err);
    REQUIRE_OK(scene);
    fixture_frame_create(f, gl, scene, 40, 30, 64);
    f->light = fixture_spot(spot, target, 40);
    f->camera = fixture_camera(eye, up, out, 110);
    fixture_frame_render(f);
}

/* The ceiling without a blocker has all of its light, the series's ringing apart; behind one that
 * covers all it is dark. One disc and one VAL, and many. */
static void test_open_and_closed(void **state)
{
    (void)state;
    static const struct {
        const char *clusters, *vals;
    } cases[] = {{"1", "1"}, {"200", "1"}, {"200", "16"}, {"2048", "16"}};
    for (int closed = 0; closed < 2; closed++) {
        struct fixture_frame f;
        make_hall(&f, closed ? 3.4 : 0);
        for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
            struct irb_image none =
                render(&f, (const char *const[]){"clusters", cases[k].clusters, NULL});
            struct irb_image found =
                render(&f, (const char *const[]){"clusters", cases[k].clusters, "vals",
                                                 cases[k].vals, "visibility", "clustered", NULL});
            const double share = fixture_sum(&found, 1) / fixture_sum(&none, 1);
            double least = INFINITY;
            for (size_t i = 0; i < irb_image_pixels(&none); i++) {
                const double all = none.data[4 * i + 1], seen = found.data[4 * i + 1];
                REQUIRE_CMP(seen, <=, all * (1 + 1e-5));
                REQUIRE_NEAR(found.data[4 * i + 3], all > 0 ? 1 - seen / all : 0, 1e-4);
                least = fmin(least, all > 0 ? seen / all : 1);
            }
            print_message("%s, %s lights, %s VALs: %.4f of the light, least %.4f\n",
                          closed ? "closed" : "open", cases[k].clusters, cases[k].vals, share,
                          least);
            if (closed)
                REQUIRE_CMP(share, <, 0.02);
            else
                REQUIRE_CMP(least, >, 0.98);
            irb_image_destroy(&none);
            irb_image_destroy(&found);
        }
        fixture_frame_destroy(&f);
    }
}

/* --- against rays --- */

struct vpl {
    float position[4], normal[4], flux[4];
};

/* Irradiance in double precision, channel 1, from every texel of the RSM with exact visibility. */
static struct irb_image trace(const struct fixture_frame *f)
{
    struct irb_error err = {0};
    const int n = f->rsm->resolution;
    struct vpl *vpls = malloc((size_t)n * (size_t)n * sizeof *vpls);
    struct irb_vpl_set *set = irb_vpl_set_create(gl, IRB_VPL_ALL, n, n * n, &err);
    REQUIRE_OK(set && irb_vpl_set_sample(set, f->rsm, n * n, 0, &err));
    REQUIRE_OK(irb_buffer_read(set->lights, 0, set->count * (int64_t)sizeof *vpls, vpls, &err));
    struct irb_image e, position = fixture_read(f->gbuffer->position, 4);
    struct irb_image normal = fixture_read(f->gbuffer->normal, 4);
    struct raycast cast;
    raycast_create(&cast, f->scene);
    REQUIRE_OK(irb_image_create(&e, f->gbuffer->width, f->gbuffer->height, 4, &err));
    for (size_t i = 0; i < irb_image_pixels(&e); i++)
        for (int l = 0; l < set->count; l++) {
            double from[3], d[3], r2 = 0, cos_x = 0, cos_y = 0;
            for (int k = 0; k < 3; k++) {
                from[k] = vpls[l].position[k];
                d[k] = position.data[4 * i + (size_t)k] - from[k];
                r2 += d[k] * d[k];
                cos_x -= normal.data[4 * i + (size_t)k] * d[k];
                cos_y += vpls[l].normal[k] * d[k];
            }
            if (cos_x > 0 && cos_y > 0 && raycast_nearest(&cast, from, d, 1e-4) > 1 - 1e-4)
                e.data[4 * i + 1] += (float)(vpls[l].flux[1] / M_PI * cos_x * cos_y / (r2 * r2));
        }
    raycast_destroy(&cast);
    irb_image_destroy(&position);
    irb_image_destroy(&normal);
    irb_vpl_set_destroy(set);
    free(vpls);
    return e;
}

/* Mean |difference|, as a share of the mean. */
static double error_of(const struct fixture_frame *f, const struct irb_image *truth,
                       const char *const *settings)
{
    struct irb_image found = render(f, settings);
    double difference = 0;
    for (size_t i = 0; i < irb_image_pixels(truth); i++)
        difference += fabs((double)found.data[4 * i + 1] - truth->data[4 * i + 1]);
    irb_image_destroy(&found);
    return difference / fixture_sum(truth, 1);
}

/* Shadows bring the image nearer to the truth, and more VALs nearer than one. */
static void check_against_rays(struct fixture_frame *f, const char *name, double most)
{
    static const char *const none[] = {"clusters", "500", NULL};
    static const char *const one[] = {"clusters", "500", "visibility", "clustered",
                                      "vals",     "1",   NULL};
    static const char *const many[] = {"clusters", "500", "visibility", "clustered", NULL};
    struct irb_image truth = trace(f);
    const double without = error_of(f, &truth, none), with = error_of(f, &truth, many);
    const double with_one = error_of(f, &truth, one);
    print_message("%s: mean error %.1f %% without shadows, %.1f %% with one VAL, %.1f %% with 16\n",
                  name, 100 * without, 100 * with_one, 100 * with);
    REQUIRE_CMP(with, <, most * without);
    REQUIRE_CMP(with, <, with_one);
    irb_image_destroy(&truth);
    fixture_frame_destroy(f);
}

static void test_against_rays(void **state)
{
    (void)state;
    struct fixture_frame f;
    make_hall(&f, 1.2);
    check_against_rays(&f, "hall", 0.5);
    fixture_frame_create(&f, gl, fixture_scene("cornell"), 32, 24, 40);
    fixture_view(f.scene, &f.light, &f.camera);
    fixture_frame_render(&f);
    check_against_rays(&f, "cornell", 0.8);
}

/* A light that goes out and on again, other lights, VALs and maps, other kinds of shadow, tiles of
 * interleaved sampling: all finite (next_frame), dark is 0, and what was there before does not
 * matter to the shadows of the frame. */
static void test_changing_frames(void **state)
{
    (void)state;
    static const struct {
        const char *settings[9];
        int dark;
    } frames[] = {
        {{"visibility", "clustered", NULL}, 1},
        {{"visibility", "clustered", NULL}, 0},
        {{"visibility", "clustered", "vals", "128", "map_size", "64", "csm_order", "1", NULL}, 0},
        {{"visibility", "none", NULL}, 0},
        {{"visibility", "clustered", "vals", "3", "clusters", "2", NULL}, 0},
        {{"visibility", "clustered", "interleave_n", "3", "interleave_m", "3", "clusters", "7",
          NULL},
         0},
        {{"visibility", "pcss", "clusters", "20", "point_count", "10000", NULL}, 0},
        {{"visibility", "clustered", "w_x", "0", "w_a", "0", NULL}, 0},
        {{"visibility", "clustered", "clusters", "2048", NULL}, 1},
        {{"visibility", "clustered", "csm_order", "16", "map_size", "128", NULL}, 0},
    };
    struct fixture_frame f;
    struct trial t;
    make_hall(&f, 1.2);
    const struct irb_light lamp = f.light;
    begin(&t, &f, frames[0].settings);
    for (size_t i = 0; i < sizeof frames / sizeof *frames; i++) {
        set(&t, frames[i].settings);
        f.light = lamp;
        for (int c = 0; frames[i].dark && c < 3; c++)
            f.light.intensity[c] = 0;
        fixture_frame_render(&f);
        struct irb_image e = next_frame(&t);
        const double vals = statistic(&t.out, "vals_in_use");
        if (frames[i].dark)
            REQUIRE_NEAR(fixture_sum(&e, 1), 0, 0);
        else
            REQUIRE_CMP(fixture_sum(&e, 1), >, 0);
        if (!strcmp(frames[i].settings[1], "clustered"))
            REQUIRE_NEAR(vals > 0, !frames[i].dark, 0);
        else
            assert_true(isnan(vals));
        irb_image_destroy(&e);
    }
    method->destroy(t.state);
    fixture_frame_destroy(&f);
}

/* Tiles share the lights out: the same light in all. */
static void test_tiles(void **state)
{
    (void)state;
    struct fixture_frame f;
    make_hall(&f, 1.2);
    struct irb_image one = render(&f, (const char *const[]){"visibility", "clustered", NULL});
    struct irb_image tiles =
        render(&f, (const char *const[]){"visibility", "clustered", "interleave_n", "3",
                                         "interleave_m", "3", NULL});
    print_message("tiles: %.4f of the light\n", fixture_sum(&tiles, 1) / fixture_sum(&one, 1));
    REQUIRE_REL(fixture_sum(&tiles, 1), fixture_sum(&one, 1), 0.02);
    irb_image_destroy(&one);
    irb_image_destroy(&tiles);
    fixture_frame_destroy(&f);
}

static void test_refusals(void **state)
{
    (void)state;
    static const struct {
        const char *settings[5], *message;
    } cases[] = {
        {{"visibility", "clustered", "shape", "polygon", NULL}, "shape=disc"},
        {{"visibility", "clustered", "clusters", "2049", NULL}, "at most 2048"},
    };
    for (int i = 0; i < 2; i++) {
        struct irb_error err = {0};
        struct rsc_resolved r;
        struct trial t;
        set(&t, cases[i].settings);
        assert_false(rsc_params_resolve(&t.params, 1, 1, 0, &r, &err));
        assert_int_equal(err.code, IRB_E_INPUT);
        REQUIRE_CONTAINS(err.message, cases[i].message);
    }
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_open_and_closed), cmocka_unit_test(test_against_rays),
        cmocka_unit_test(test_changing_frames), cmocka_unit_test(test_tiles),
        cmocka_unit_test(test_refusals),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failed;
}
