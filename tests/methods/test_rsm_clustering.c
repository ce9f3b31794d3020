/* SPDX-License-Identifier: MIT
 *
 * The method rsm-clustering: its light against sums in double precision over its area lights (eq. 2
 * of Prutkin et al. 2012; the contour integral over clipped corners), its history, and what must
 * not happen in odd frames.
 */
#include "tests/support/compare.h"
#include "methods/method.h"
#include "methods/rsm_clustering/params.h"
#include "tests/frame/fixture.h"

extern const struct irb_method irb_method_rsm_clustering;
static const struct irb_method *const method = &irb_method_rsm_clustering;

static struct irb_gl *gl;

/* Parameters from "name", "value", ..., NULL; the caller frees them. */
static struct rsc_params *make_params(const char *const *settings)
{
    struct irb_error err = {0};
    void *params = calloc(1, method->params_size);
    irb_options_default(method->params, params);
    for (; settings && *settings; settings += 2)
        REQUIRE_OK(irb_option_set(method->params, params, settings[0], settings[1], &err));
    return params;
}

static void make_frame(struct fixture_frame *f, const char *scene, int width, int height,
                       int resolution)
{
    fixture_frame_create(f, gl, fixture_scene(scene), width, height, resolution);
    fixture_view(f->scene, &f->light, &f->camera);
    fixture_frame_render(f);
}

/* A state and what it is given. */
struct trial {
    const struct fixture_frame *f;
    struct rsc_params *params;
    void *state;
    struct irb_frame_output out;
};

static void begin(struct trial *t, const struct fixture_frame *f, const char *const *settings)
{
    struct irb_error err = {0};
    t->f = f;
    t->params = make_params(settings);
    t->state =
        method->create(gl, f->scene_gl, f->gbuffer->width, f->gbuffer->height, t->params, &err);
    REQUIRE_OK(t->state);
    REQUIRE_OK(method->begin_sequence(t->state, t->params, 1, &err));
}

static struct irb_image next_frame(struct trial *t)
{
    struct irb_error err = {0};
    const struct irb_frame_inputs inputs = {.scene = t->f->scene_gl,
                                            .light = &t->f->light,
                                            .camera = &t->f->camera,
                                            .gbuffer = t->f->gbuffer,
                                            .rsm = t->f->rsm,
                                            .seed = 1,
                                            .params = t->params};
    REQUIRE_OK(method->render_frame(t->state, &inputs, &t->out, &err));
    struct irb_image e = fixture_read(t->out.irradiance, 4);
    for (size_t i = 0; i < 4 * irb_image_pixels(&e); i++)
        assert_true(isfinite(e.data[i]) && e.data[i] >= 0);
    REQUIRE_CMP(t->out.uncovered_flux, >=, 0);
    REQUIRE_CMP(t->out.uncovered_flux, <=, 1);
    REQUIRE_NEAR(t->out.clamped_light, 0, 0);
    return e;
}

static void end(struct trial *t)
{
    method->destroy(t->state);
    free(t->params);
}

/* The image of frame `frames`, counted from 1. */
static struct irb_image render(const struct fixture_frame *f, const char *const *settings,
                               int frames)
{
    struct trial t;
    begin(&t, f, settings);
    struct irb_image e = next_frame(&t);
    while (--frames > 0) {
        irb_image_destroy(&e);
        e = next_frame(&t);
    }
    end(&t);
    return e;
}

static double statistic(const struct irb_frame_output *out, const char *name)
{
    for (int i = 0; i < out->statistic_count; i++)
        if (!strcmp(out->statistics[i].name, name))
            return out->statistics[i].value;
    fail_msg("no statistic '%s'", name);
    return 0;
}

/* Area lights of the same first frame, made by the parts themselves: 3 + corners/2 vec4 each. */
static float *make_lights(const struct fixture_frame *f, const char *const *settings, int *corners)
{
    struct irb_error err = {0};
    struct rsc_params *params = make_params(settings);
    struct rsc_resolved r;
    const int n = f->rsm->resolution;
    REQUIRE_OK(rsc_params_resolve(params, irb_scene_diagonal(f->scene), 1, 0, &r, &err));
    struct irb_importance *importance = irb_importance_create(gl, n, &err);
    struct irb_pyramid *pyramid = irb_pyramid_create(gl, n, &err);
    struct rsc_clusters *c = rsc_clusters_create(gl, n, &err);
    struct rsc_area_lights *lights = rsc_area_lights_create(gl, &err);
    REQUIRE_OK(importance && pyramid && c && lights);
    REQUIRE_OK(
        irb_importance_compute(importance, f->rsm, &f->light, f->gbuffer, &r.importance, &err) &&
        irb_pyramid_build(pyramid, importance->map, &err) &&
        rsc_clusters_prepare(c, &r.clustering, &err) &&
        rsc_area_lights_prepare(lights, r.clustering.clusters, r.corners, &err) &&
        rsc_clusters_seed(c, f->rsm, pyramid, &r.clustering, &err) &&
        rsc_clusters_grid(c, &r.clustering, &err) &&
        rsc_clusters_assign(c, f->rsm, &r.clustering, &err) &&
        rsc_clusters_sort(c, f->rsm, &r.clustering, &err) &&
        rsc_clusters_update(c, f->rsm, &r.clustering, &err) &&
        rsc_area_lights_make(lights, c, f->rsm, &r.clustering, r.area, r.corners, &err));
    const struct irb_buffer *buffer = rsc_area_lights_view(lights).buffer;
    float *out = malloc((size_t)buffer->bytes);
    REQUIRE_OK(irb_buffer_read(buffer, 0, buffer->bytes, out, &err));
    *corners = r.corners;
    irb_importance_destroy(importance);
    irb_pyramid_destroy(pyramid);
    rsc_clusters_destroy(c);
    rsc_area_lights_destroy(lights);
    free(params);
    return out;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static void widen(const float in[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = in[i];
}

/* Eq. 2 over A: light[0] position and area, [1] normal. */
static double disc_factor(const float *light, const double x[3], const double n[3])
{
    double d[3], n_y[3];
    widen(light, d);
    widen(light + 4, n_y);
    for (int i = 0; i < 3; i++)
        d[i] -= x[i];
    const double r2 = dot(d, d);
    return r2 > 0
               ? fmax(0, dot(n, d)) * fmax(0, -dot(n_y, d)) / (r2 * (M_PI * r2 + (double)light[3]))
               : 0;
}

enum { MOST_CORNERS = 17 };

/* World position of a corner. Frame of Duff et al. 2017, as shaders/lights/paraboloid.glsl. */
static void corner_at(const float *light, int i, double out[3])
{
    double n[3];
    widen(light + 4, n);
    const double s = copysign(1, n[2]), a = -1 / (s + n[2]), b = n[0] * n[1] * a;
    const double t[3] = {1 + s * n[0] * n[0] * a, s * b, -s * n[0]};
    const double u[3] = {b, s + n[1] * n[1] * a, -n[1]};
    const float *corner = light + 12 + 2 * i;
    for (int m = 0; m < 3; m++)
        out[m] = (double)light[m] + (double)corner[0] * t[m] + (double)corner[1] * u[m];
}

/* Corners relative to x, cut at the horizon (Sutherland and Hodgman 1974); how many are left. */
static int clip(const float *light, int corners, const double x[3], const double n[3],
                double out[MOST_CORNERS][3])
{
    int count = 0;
    for (int i = 0; i < corners; i++) {
        double a[3], b[3];
        corner_at(light, i, a);
        corner_at(light, (i + 1) % corners, b);
        for (int m = 0; m < 3; m++) {
            a[m] -= x[m];
            b[m] -= x[m];
        }
        const double height_a = dot(n, a), height_b = dot(n, b);
        if (height_a > 0)
            memcpy(out[count++], a, sizeof a);
        if ((height_a > 0) != (height_b > 0)) {
            for (int m = 0; m < 3; m++)
                out[count][m] = a[m] + height_a / (height_a - height_b) * (b[m] - a[m]);
            count++;
        }
    }
    return count;
}

/* F/A of a polygon by the contour integral with arc cosines. */
static double polygon_factor(const float *light, int corners, const double x[3], const double n[3])
{
    double v[MOST_CORNERS][3], normal[3], d[3], sum = 0;
    widen(light, d);
    widen(light + 4, normal);
    for (int m = 0; m < 3; m++)
        d[m] = x[m] - d[m];
    if (!(light[3] > 0) || !(dot(d, normal) > 1e-5 * (double)light[7]))
        return 0;
    const int count = clip(light, corners, x, n, v);
    for (int i = 0; i < count; i++) {
        const double *a = v[i], *b = v[(i + 1) % count];
        double c[3];
        cross(b, a, c);
        const double length = sqrt(dot(c, c));
        if (length > 0)
            sum += atan2(length, dot(a, b)) * dot(n, c) / length;
    }
    return fmax(0, sum) / (2 * M_PI) / (double)light[3];
}

/* Irradiance of every pixel against the sum over all lights. */
static void check_light(const char *const *settings, double tolerance)
{
    struct fixture_frame f;
    int corners, lit = 0;
    make_frame(&f, "cornell-objects", 31, 23, 64);
    struct irb_image found = render(&f, settings, 1);
    struct irb_image position = fixture_read(f.gbuffer->position, 4);
    struct irb_image normal = fixture_read(f.gbuffer->normal, 4);
    float *lights = make_lights(&f, settings, &corners);
    struct rsc_params *params = make_params(settings);
    for (size_t i = 0; i < irb_image_pixels(&found); i++) {
        double x[3], n[3], e[3] = {0};
        widen(position.data + 4 * i, x);
        widen(normal.data + 4 * i, n);
        for (int l = 0; l < params->clusters; l++) {
            const float *light = lights + (size_t)l * (size_t)(12 + 2 * corners);
            const double factor =
                corners ? polygon_factor(light, corners, x, n) : disc_factor(light, x, n);
            for (int c = 0; c < 3; c++)
                e[c] += (double)light[8 + c] * factor;
        }
        for (size_t c = 0; c < 3; c++)
            REQUIRE_NEAR(found.data[4 * i + c], e[c], tolerance * e[c] + 1e-7);
        lit += e[0] > 0;
    }
    REQUIRE_CMP(lit, >, 300);
    free(params);
    free(lights);
    irb_image_destroy(&found);
    irb_image_destroy(&position);
    irb_image_destroy(&normal);
    fixture_frame_destroy(&f);
}

static void test_discs(void **state)
{
    (void)state;
    const char *const areas[] = {"texels", "moment", "max"};
    for (int i = 0; i < 3; i++)
        check_light((const char *const[]){"clusters", "100", "area", areas[i], NULL}, 1e-4);
    check_light((const char *const[]){"clusters", "1500", NULL}, 1e-4);
}

static void test_polygons(void **state)
{
    (void)state;
    check_light((const char *const[]){"clusters", "100", "shape", "polygon", NULL}, 2e-4);
    check_light(
        (const char *const[]){"clusters", "1500", "shape", "polygon", "corners", "16", NULL}, 2e-4);
}

/* Sum of all channels. */
static double total(const struct irb_image *e)
{
    return fixture_sum(e, 0) + fixture_sum(e, 1) + fixture_sum(e, 2);
}

static double difference(const struct irb_image *a, const struct irb_image *b)
{
    double sum = 0;
    for (size_t i = 0; i < irb_image_pixels(a); i++)
        for (size_t c = 0; c < 3; c++)
            sum += fabs((double)a->data[4 * i + c] - b->data[4 * i + c]);
    return sum / total(b);
}

/* Discs and polygons light a scene alike (figure 3), the more so the more there are, and so do the
 * three ways to find texels, which give the same bits. */
static void test_shapes_agree(void **state)
{
    (void)state;
    struct fixture_frame f;
    make_frame(&f, "cornell", 48, 36, 128);
    const char *const counts[] = {"64", "1024"};
    const double most[] = {0.10, 0.03};
    for (int i = 0; i < 2; i++) {
        struct irb_image disc = render(&f, (const char *const[]){"clusters", counts[i], NULL}, 3);
        struct irb_image polygon =
            render(&f, (const char *const[]){"clusters", counts[i], "shape", "polygon", NULL}, 3);
        print_message("%s clusters: discs and polygons differ by %.2f %%, in sum by %.2f %%\n",
                      counts[i], 100 * difference(&polygon, &disc),
                      100 * (total(&polygon) / total(&disc) - 1));
        REQUIRE_CMP(difference(&polygon, &disc), <, most[i]);
        irb_image_destroy(&disc);
        irb_image_destroy(&polygon);
    }
    const char *const ways[] = {"sort", "window", "direct"};
    struct irb_image images[3];
    for (int i = 0; i < 3; i++)
        images[i] =
            render(&f, (const char *const[]){"clusters", "200", "reduction", ways[i], NULL}, 3);
    for (int i = 1; i < 3; i++)
        assert_memory_equal(images[i].data, images[0].data, irb_image_pixels(&images[0]) * 16);
    for (int i = 0; i < 3; i++)
        irb_image_destroy(&images[i]);
    fixture_frame_destroy(&f);
}

/* Under a light at rest the clusters settle: images change less from frame to frame, and a new
 * sequence starts where the first one did, bit by bit, as a fresh state does. */
static void test_history(void **state)
{
    (void)state;
    struct fixture_frame f;
    make_frame(&f, "cornell", 32, 24, 96);
    const char *const settings[] = {"clusters", "150", NULL};
    struct trial t;
    begin(&t, &f, settings);
    struct irb_image images[8];
    for (int i = 0; i < 8; i++)
        images[i] = next_frame(&t);
    REQUIRE_NEAR(statistic(&t.out, "clusters"), 150, 0);
    REQUIRE_CMP(statistic(&t.out, "clusters_in_use"), >, 100);
    REQUIRE_CMP(difference(&images[7], &images[6]), <, difference(&images[1], &images[0]));
    struct irb_error err = {0};
    REQUIRE_OK(method->begin_sequence(t.state, t.params, 1, &err));
    for (int i = 0; i < 2; i++) {
        struct irb_image again = next_frame(&t);
        assert_memory_equal(again.data, images[i].data, irb_image_pixels(&again) * 16);
        irb_image_destroy(&again);
    }
    struct irb_image fresh = render(&f, settings, 3);
    assert_memory_equal(fresh.data, images[2].data, irb_image_pixels(&fresh) * 16);
    irb_image_destroy(&fresh);
    for (int i = 0; i < 8; i++)
        irb_image_destroy(&images[i]);
    end(&t);
    fixture_frame_destroy(&f);
}

/* A light that is dark, that jumps, that is switched on again; parameters that change; a camera
 * that looks at nothing. All values stay finite (next_frame), and dark is 0. */
static void test_odd_frames(void **state)
{
    (void)state;
    struct fixture_frame f;
    make_frame(&f, "cornell", 20, 15, 64);
    const struct irb_light lamp = f.light;
    const struct irb_camera camera = f.camera;
    static const struct {
        const char *settings[9];
        int dark, turned, away;
    } frames[] = {
        {{"clusters", "300", NULL}, 0, 0, 0},
        {{"clusters", "300", "shape", "polygon", NULL}, 1, 0, 0},
        {{"clusters", "300", "shape", "polygon", NULL}, 0, 0, 0},
        {{"clusters", "1", "shape", "polygon", "corners", "16", NULL}, 0, 1, 0},
        {{"clusters", "5000", "assignment", "brute", "reseed", "next", NULL}, 0, 1, 1},
        {{"clusters", "2000", "reduction", "window", "metric_unit", "bbox", NULL}, 0, 0, 1},
        {{"clusters", "7", "reduction", "direct", "interleave_n", "3", "interleave_m", "3", NULL},
         0,
         0,
         0},
        {{"clusters", "7", "reach", "0", "view_weight", "0", NULL}, 0, 0, 0},
    };
    struct trial t;
    begin(&t, &f, NULL);
    for (size_t i = 0; i < sizeof frames / sizeof *frames; i++) {
        free(t.params);
        t.params = make_params(frames[i].settings);
        f.light = lamp;
        f.camera = camera;
        for (int c = 0; frames[i].dark && c < 3; c++)
            f.light.intensity[c] = 0;
        if (frames[i].turned)
            memcpy(f.light.direction, (const float[]){1, 0, 0}, 12);
        if (frames[i].away)
            for (int c = 0; c < 3; c++)
                f.camera.target[c] = 2 * camera.position[c] - camera.target[c];
        fixture_frame_render(&f);
        struct irb_image e = next_frame(&t);
        if (frames[i].dark) {
            REQUIRE_NEAR(total(&e), 0, 0);
            REQUIRE_NEAR(statistic(&t.out, "clusters_in_use"), 0, 0);
            REQUIRE_NEAR(t.out.uncovered_flux, 0, 0);
        } else {
            REQUIRE_CMP(statistic(&t.out, "clusters_in_use"), >, 0);
            REQUIRE_NEAR(total(&e) > 0, !frames[i].away, 0);
        }
        irb_image_destroy(&e);
    }
    end(&t);
    fixture_frame_destroy(&f);
}

/* The light's power scales the image, no more: bit by bit for a power of two. */
static void test_intensity(void **state)
{
    (void)state;
    struct fixture_frame f;
    make_frame(&f, "cornell", 20, 15, 64);
    const char *const settings[] = {"clusters", "90", NULL};
    struct irb_image one = render(&f, settings, 2);
    for (int c = 0; c < 3; c++)
        f.light.intensity[c] *= 0x1p-10f;
    fixture_frame_render(&f);
    struct irb_image other = render(&f, settings, 2);
    for (size_t i = 0; i < irb_image_pixels(&one); i++)
        for (size_t c = 0; c < 3; c++)
            REQUIRE_NEAR(other.data[4 * i + c], one.data[4 * i + c] * 0x1p-10f, 0);
    irb_image_destroy(&one);
    irb_image_destroy(&other);
    fixture_frame_destroy(&f);
}

/* Shadow maps take light away and add none, whatever the shape; discs and polygons alike. */
static void test_visibility(void **state)
{
    (void)state;
    const char *const shapes[] = {"disc", "polygon"}, *const kinds[] = {"none", "ism", "pcss"};
    struct fixture_frame f;
    make_frame(&f, "cornell", 40, 30, 96);
    for (int shape = 0; shape < 2; shape++) {
        struct irb_image images[3];
        for (int kind = 0; kind < 3; kind++)
            images[kind] = render(&f,
                                  (const char *const[]){"clusters", "128", "shape", shapes[shape],
                                                        "visibility", kinds[kind], "point_count",
                                                        "100000", NULL},
                                  2);
        for (int kind = 1; kind < 3; kind++) {
            for (size_t i = 0; i < irb_image_pixels(&images[0]); i++)
                for (size_t c = 0; c < 3; c++)
                    REQUIRE_CMP(images[kind].data[4 * i + c], <=,
                                images[0].data[4 * i + c] * (1 + 1e-5));
            print_message("%s, %s: %.3f of the light without shadows\n", shapes[shape], kinds[kind],
                          total(&images[kind]) / total(&images[0]));
            REQUIRE_CMP(total(&images[kind]), <, 0.97 * total(&images[0]));
            REQUIRE_CMP(total(&images[kind]), >, 0.5 * total(&images[0]));
        }
        for (int kind = 0; kind < 3; kind++)
            irb_image_destroy(&images[kind]);
    }
    fixture_frame_destroy(&f);
}

/* A floor and a wall of `scale` metres, all of the view with them. */
static void make_corner(struct fixture_frame *f, float scale)
{
    const double m = (double)scale;
    const double quads[2][4][3] = {{{-m, 0, m}, {m, 0, m}, {m, 0, -m}, {-m, 0, -m}},
                                   {{-m, 0, -m}, {m, 0, -m}, {m, 2 * m, -m}, {-m, 2 * m, -m}}};
    const float colours[2][3] = {{0.7f, 0.6f, 0.5f}, {0.2f, 0.4f, 0.9f}};
    struct irb_error err = {0};
    struct irb_builder builder;
    irb_builder_begin(&builder, "corner");
    for (int i = 0; i < 2; i++) {
        irb_builder_object(&builder, "quad", irb_builder_material(&builder, "m", colours[i]));
        irb_builder_quad(&builder, quads[i]);
    }
    struct irb_scene *scene = irb_builder_finish(&builder, &err);
    REQUIRE_OK(scene);
    fixture_frame_create(f, gl, scene, 20, 15, 64);
    f->light = fixture_spot((const float[]){0.25f * scale, 1.5f * scale, 0.75f * scale},
                            (const float[]){0, 0.25f * scale, -0.5f * scale}, 40);
    f->camera = fixture_camera((const float[]){0.5f * scale, scale, 3 * scale},
                               (const float[]){0, 0.5f * scale, 0}, (const float[]){0, 1, 0}, 50);
    f->camera.z_near = 0.01f * scale;
    f->camera.z_far = 10 * scale;
    fixture_frame_render(f);
}

/* With metric_unit=bbox a scene in millimetres or kilometres is clustered and lit as one in metres:
 * E goes with 1/scale^2, bit by bit for powers of two. In metres it isn't. */
static void test_scale(void **state)
{
    (void)state;
    const float scales[] = {0x1p-10f, 1, 0x1p10f};
    const char *const units[] = {"bbox", "metres"};
    for (int unit = 0; unit < 2; unit++) {
        struct irb_image images[3];
        int differ = 0;
        for (int i = 0; i < 3; i++) {
            struct fixture_frame f;
            make_corner(&f, scales[i]);
            images[i] = render(
                &f, (const char *const[]){"clusters", "60", "metric_unit", units[unit], NULL}, 3);
            for (size_t p = 0; p < 4 * irb_image_pixels(&images[i]); p++)
                images[i].data[p] *= p % 4 == 3 ? 1 : scales[i] * scales[i];
            fixture_frame_destroy(&f);
        }
        for (int i = 0; i < 3; i += 2)
            for (size_t p = 0; p < 4 * irb_image_pixels(&images[1]); p++)
                differ += images[i].data[p] != images[1].data[p];
        REQUIRE_NEAR(differ > 0, unit == 1, 0);
        for (int i = 0; i < 3; i++)
            irb_image_destroy(&images[i]);
    }
}

static void test_refusals(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct rsc_resolved r;
    struct rsc_params *params =
        make_params((const char *const[]){"clusters", "1025", "visibility", "pcss", NULL});
    assert_false(rsc_params_check(params, 64, &err));
    assert_int_equal(err.code, IRB_E_INPUT);
    REQUIRE_CONTAINS(err.message, "visibility=none");
    assert_false(rsc_params_resolve(params, 1, 1, 0, &r, &err));
    free(params);
    params = make_params((const char *const[]){"clusters", "4096", NULL});
    REQUIRE_OK(rsc_params_check(params, 724, &err));
    assert_false(rsc_params_check(params, 1024, &err));
    REQUIRE_CONTAINS(err.message, "at most 4095 clusters of an RSM of 1024 x 1024 texels, found "
                                  "4096; use reduction=window");
    free(params);
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_discs),        cmocka_unit_test(test_polygons),
        cmocka_unit_test(test_shapes_agree), cmocka_unit_test(test_history),
        cmocka_unit_test(test_odd_frames),   cmocka_unit_test(test_intensity),
        cmocka_unit_test(test_visibility),   cmocka_unit_test(test_scale),
        cmocka_unit_test(test_refusals),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failed;
}
