/* SPDX-License-Identifier: MIT
 *
 * What rasterised shadow maps make of shadows: a square's against its closed form, many lights in a
 * detailed scene against rays traced in double precision at three sizes, planes that must not
 * shadow themselves, and any number of lights in batches. Single lights in a plain box:
 * test_shade_raster.c.
 */
#include "tests/support/compare.h"
#include "tests/support/raycast.h"
#include "tests/lights/shade_receivers.h"

static struct irb_gl *gl;
static struct irb_shade *shade;

enum { PROJECTIONS = 2 };
static const char *const projection_names[] = {"hemicube", "paraboloid"};
static const float grey[3] = {0.5f, 0.5f, 0.5f};

/* What stands this near to the receiver, as a share of its distance, is not looked for. */
static const double bias = 1e-3;
/* No slope: flat receivers need none. */
static const struct irb_shade_settings raster = {
    .visibility = IRB_SHADE_RASTER, .bias = 1e-3f, .offset = 1e-5f};

static struct irb_buffer *upload(const struct shade_light *lights, int count)
{
    struct irb_error err = {0};
    struct irb_buffer *buffer = shade_lights_upload(gl, lights, count, &err);
    REQUIRE_OK(buffer);
    return buffer;
}

struct job {
    struct irb_scene *scene; /* owned */
    struct irb_scene_gl *scene_gl;
    struct irb_raster_maps *maps;
};

static void job_create(struct job *job, struct irb_scene *scene, int projection, int size,
                       int capacity)
{
    struct irb_error err = {0};
    job->scene = scene;
    REQUIRE_OK(job->scene_gl = irb_scene_gl_create(gl, scene, &err));
    REQUIRE_OK(job->maps = irb_raster_maps_create(gl, (enum irb_raster_projection)projection, size,
                                                  capacity, &err));
}

static void job_destroy(struct job *job)
{
    irb_raster_maps_destroy(job->maps);
    irb_scene_gl_destroy(job->scene_gl);
    irb_scene_destroy(job->scene);
}

/* Merged, not filtered: irradiance; what is in shadow (mean of the channels). */
static struct irb_image run(struct job *job, struct shading *s, const struct shade_light *lights,
                            int count, const struct irb_shade_settings *settings)
{
    struct irb_error err = {0};
    struct irb_buffer *buffer = upload(lights, count);
    const struct irb_virtual_lights view = {buffer, count};
    const struct irb_shade_raster in_maps = {job->maps, job->scene_gl, .near = 1e-4f};
    REQUIRE_OK(irb_shade_run_raster(s->shade, s->interleave, &view, &in_maps, settings, &err));
    REQUIRE_OK(irb_interleave_merge(s->interleave, &err));
    struct irb_image image = fixture_read(s->interleave->merged, 4);
    for (size_t i = 0; i < 4 * irb_image_pixels(&image); i++)
        if (!(isfinite(image.data[i]) && image.data[i] >= 0))
            fail_msg("value %zu of the image is %g", i, image.data[i]);
    irb_buffer_destroy(buffer);
    return image;
}

/* How far the direction of a texel may be from that which is looked up in it, near the normal:
 * test_raster_maps.c. */
static double footprint(int projection, int size)
{
    return (projection == IRB_RASTER_HEMICUBE ? 1 : 2) * M_SQRT2 / size;
}

/* ---- A square ---- */

/* Half a metre a side, halfway between a light at z = 1 and a floor. */
static struct irb_scene *make_square(void)
{
    const double corners[4][3] = {
        {-0.25, -0.25, 0.5}, {0.25, -0.25, 0.5}, {0.25, 0.25, 0.5}, {-0.25, 0.25, 0.5}};
    return fixture_quad(corners, grey);
}

/* From (a, 0, 1) its shadow on z = 0 is |x + a| < 1/2, |y| < 1/2. All floor points but those that a
 * texel's footprint, a small angle that reaches r^2 as far on the floor, may take over its edge. */
static void check_square(const struct receiver *receivers, int count, const struct irb_image *image,
                         double a, double reach)
{
    const struct shade_light light = {.position = {(float)a, 0, 1}, .normal = {0, 0, -1}};
    int compared = 0, shadowed = 0;
    for (int i = 0; i < count; i++) {
        double x = receivers[i].position[0], y = receivers[i].position[1];
        double r2 = 1 + (x - a) * (x - a) + y * y;
        double inside = fmin(0.5 - fabs(x + a), 0.5 - fabs(y));
        double f = form_factor(&receivers[i], &light, 0);
        if (fabs(inside) < 1.1 * reach * r2)
            continue;
        REQUIRE_NEAR(image->data[4 * i], inside > 0 ? 0 : f, 2e-5 * f);
        REQUIRE_NEAR(image->data[4 * i + 3], inside > 0 ? f : 0, 2e-5 * f);
        compared++;
        shadowed += inside > 0;
    }
    REQUIRE_CMP(compared, >, 0.7 * count);
    REQUIRE_CMP(shadowed, >, 0.02 * count);
}

static void test_square(void **state)
{
    (void)state;
    enum { WIDTH = 64, HEIGHT = 64, SIZE = 128 };
    static struct receiver receivers[WIDTH * HEIGHT];
    const double shifts[] = {0, 0.1, 0.6};
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        receivers[i] = (struct receiver){.normal = {0, 0, 1}};
        for (uint32_t c = 0; c < 2; c++)
            receivers[i].position[c] = (float)(3 * uniform(1, 2 * i + c) - 1.5);
    }
    for (int p = 0; p < PROJECTIONS; p++) {
        struct job job;
        struct shading s;
        job_create(&job, make_square(), p, SIZE, 1);
        shading_create(&s, shade, gl, receivers, WIDTH, HEIGHT, 1, 1);
        for (int k = 0; k < 3; k++) {
            const struct shade_light light = {
                .position = {(float)shifts[k], 0, 1}, .normal = {0, 0, -1}, .flux = {1, 1, 1}};
            struct irb_image image = run(&job, &s, &light, 1, &raster);
            check_square(receivers, WIDTH * HEIGHT, &image, shifts[k], footprint(p, SIZE));
            irb_image_destroy(&image);
        }
        shading_destroy(&s);
        job_destroy(&job);
    }
}

/* ---- A whole scene ---- */

/* On a random triangle: its front, or its back. */
static void put_on(const struct raycast *cast, uint32_t seed, uint32_t i, float position[3],
                   float normal[3])
{
    double u[3], v[3], n[3], length, a = uniform(seed, 3 * i), b = uniform(seed, 3 * i + 1);
    const uint32_t t = (uint32_t)(uniform(seed, 3 * i + 2) * cast->count);
    const double(*corners)[3] = (const double(*)[3])cast->corners[t];
    if (a + b > 1) {
        a = 1 - a;
        b = 1 - b;
    }
    for (int c = 0; c < 3; c++) {
        u[c] = corners[1][c] - corners[0][c];
        v[c] = corners[2][c] - corners[0][c];
        position[c] = (float)(corners[0][c] + a * u[c] + b * v[c]);
    }
    raycast_cross(u, v, n);
    length = sqrt(raycast_dot(n, n));
    for (int c = 0; c < 3; c++)
        normal[c] = (float)(n[c] / length);
}

/* The box's own triangles come first: two of three points go there, the others on sphere and
 * knot. */
static void put_in_box(const struct raycast *all, uint32_t seed, uint32_t i, float position[3],
                       float normal[3])
{
    struct raycast box = *all;
    box.count = 10;
    put_on(i % 3 ? &box : all, seed, i, position, normal);
}

enum { ROW = 16, RECEIVERS = ROW * 14, LIGHTS = 24 };

/* The Cornell box with sphere and knot, lights and receivers on its surfaces. */
struct whole {
    struct raycast cast;
    struct shade_light lights[LIGHTS];
    struct receiver receivers[RECEIVERS];
    bool visible[LIGHTS][RECEIVERS]; /* by rays */
};

static double unit_between(const float from[3], const float to[3], double along[3])
{
    double r;
    for (int c = 0; c < 3; c++)
        along[c] = (double)to[c] - from[c];
    r = sqrt(raycast_dot(along, along));
    for (int c = 0; c < 3; c++)
        along[c] /= r;
    return r;
}

static double nearest_from(const struct whole *w, const struct shade_light *light,
                           const double along[3])
{
    const double from[3] = {light->position[0], light->position[1], light->position[2]};
    return raycast_nearest(&w->cast, from, along, 1e-4);
}

static void make_whole(struct whole *w, const struct irb_scene *scene)
{
    raycast_create(&w->cast, scene);
    for (uint32_t l = 0; l < LIGHTS; l++) {
        w->lights[l] = (struct shade_light){.area = l % 2 ? 0.001f : 0, .flux = {1, 1, 1}};
        put_in_box(&w->cast, 2, l, w->lights[l].position, w->lights[l].normal);
    }
    for (uint32_t i = 0; i < RECEIVERS; i++)
        put_in_box(&w->cast, 3, i, w->receivers[i].position, w->receivers[i].normal);
    for (int l = 0; l < LIGHTS; l++)
        for (int i = 0; i < RECEIVERS; i++) {
            double along[3];
            double r = unit_between(w->lights[l].position, w->receivers[i].position, along);
            if (form_factor(&w->receivers[i], &w->lights[l], 0) > 0)
                w->visible[l][i] = nearest_from(w, &w->lights[l], along) > r * (1 - bias);
        }
}

/* Whether some ray within `reach` of the one to the receiver finds the receiver's plane where that
 * is blocked, or is blocked where that is not: then the pair is at a silhouette. */
static bool is_at_silhouette(const struct whole *w, int l, int i, double reach)
{
    enum { TRIES = 400 };
    const struct receiver *x = &w->receivers[i];
    const struct shade_light *y = &w->lights[l];
    double along[3], ray[3];
    const double r = unit_between(y->position, x->position, along);
    for (uint32_t k = 0; k < TRIES; k++) {
        float off[3];
        double to_plane = 0, slant = 0, length;
        random_normal(4, k, -1, off);
        for (int c = 0; c < 3; c++)
            ray[c] = along[c] + reach * cbrt(uniform(5, k)) * off[c];
        length = sqrt(raycast_dot(ray, ray));
        for (int c = 0; c < 3; c++) {
            ray[c] /= length;
            to_plane += along[c] * r * x->normal[c];
            slant += ray[c] * x->normal[c];
        }
        double receiver = to_plane / slant > 0 ? fmin(to_plane / slant, r) : r;
        if ((nearest_from(w, y, ray) > receiver * (1 - bias)) != w->visible[l][i])
            return true;
    }
    return false;
}

struct disagreement {
    double all, missing, extra; /* W/m2, summed over receivers */
    int pairs, differing;       /* of those that see any light without visibility */
};

/* One light at a time, so that errors do not cancel. */
static void add_light(struct disagreement *d, const struct whole *w, int l,
                      const struct irb_image *image, double reach)
{
    for (int i = 0; i < RECEIVERS; i++) {
        double f = form_factor(&w->receivers[i], &w->lights[l], w->lights[l].area);
        double found = image->data[4 * i], expected = w->visible[l][i] ? f : 0;
        if (!(f > 0))
            continue;
        REQUIRE_NEAR(found + image->data[4 * i + 3], f, 1e-4 * f);
        d->pairs++;
        d->all += expected;
        if (fabs(found - expected) < 0.5 * f)
            continue;
        d->differing++;
        d->missing += fmax(expected - found, 0);
        d->extra += fmax(found - expected, 0);
        if (!is_at_silhouette(w, l, i, reach))
            fail_msg("light %d and receiver %d: visibility is %d", l, i, w->visible[l][i]);
    }
}

/* Every pair against a ray. Those that differ are at silhouettes, within the footprint of a texel;
 * all lights together give the sum. */
static struct disagreement check_whole(const struct whole *w, struct job *job, struct shading *s)
{
    const double reach = footprint(job->maps->projection, job->maps->size);
    struct disagreement d = {0};
    double sum[RECEIVERS] = {0};
    for (int l = 0; l < LIGHTS; l++) {
        struct irb_image image = run(job, s, &w->lights[l], 1, &raster);
        add_light(&d, w, l, &image, reach);
        for (int i = 0; i < RECEIVERS; i++)
            sum[i] += image.data[4 * i];
        irb_image_destroy(&image);
    }
    struct irb_image all = run(job, s, w->lights, LIGHTS, &raster);
    for (int i = 0; i < RECEIVERS; i++)
        REQUIRE_NEAR(all.data[4 * i], sum[i], 1e-5 * sum[i]);
    irb_image_destroy(&all);
    print_message("%s %d: %d of %d pairs differ; irradiance missing %.3g %%, too much %.3g %%\n",
                  projection_names[job->maps->projection], job->maps->size, d.differing, d.pairs,
                  100 * d.missing / d.all, 100 * d.extra / d.all);
    return d;
}

/* Silhouettes are lines: the pairs that differ go down with the size. */
static void test_scene(void **state)
{
    (void)state;
    static struct whole w;
    static const int sizes[] = {32, 128, 512};
    for (int p = 0; p < PROJECTIONS; p++)
        for (int k = 0, before = 0; k < 3; k++) {
            struct job job;
            struct shading s;
            job_create(&job, fixture_scene("cornell-objects"), p, sizes[k], 10);
            if (!w.cast.count)
                make_whole(&w, job.scene);
            shading_create(&s, shade, gl, w.receivers, ROW, RECEIVERS / ROW, 1, 1);
            struct disagreement d = check_whole(&w, &job, &s);
            REQUIRE_CMP(d.pairs, >, 1000);
            if (k > 0)
                REQUIRE_CMP(d.differing, <=, 0.6 * before);
            if (sizes[k] == 128)
                REQUIRE_CMP(d.differing, <=, (p == IRB_RASTER_HEMICUBE ? 0.02 : 0.03) * d.pairs);
            before = d.differing;
            shading_destroy(&s);
            job_destroy(&job);
        }
    raycast_destroy(&w.cast);
}

/* ---- Batches, planes, refusals ---- */

/* A floor at z = 0, a kilometre to either side. */
static struct irb_scene *make_floor(void)
{
    const double corners[4][3] = {
        {-1000, -1000, 0}, {1000, -1000, 0}, {1000, 1000, 0}, {-1000, 1000, 0}};
    return fixture_quad(corners, grey);
}

/* Above the floor, looking down at it, from steep to nearly level. */
static void make_lights_above(struct shade_light *lights, int count)
{
    for (uint32_t l = 0; l < (uint32_t)count; l++) {
        lights[l] = (struct shade_light){.area = l % 2 ? 0.05f : 0, .flux = {1, 1, 1}};
        lights[l].position[0] = (float)(uniform(12, l) - 0.5);
        lights[l].position[1] = (float)(uniform(15, l) - 0.5);
        lights[l].position[2] = (float)(0.3 + uniform(13, l));
        random_normal(14, l, 0.05, lights[l].normal);
        lights[l].normal[2] *= -1;
    }
}

/* A plane shadows none of itself with next to no bias, however coarse the map. What is 5 cm under
 * it is in shadow in full where the plane's distance changes by less over a texel: all of it at 128
 * texels a side, where receivers up to 2 m away are seen at 8 degrees and more. */
static void test_no_acne(void **state)
{
    (void)state;
    enum { WIDTH = 64, HEIGHT = 64, COUNT = 24 };
    static struct receiver receivers[WIDTH * HEIGHT];
    struct shade_light lights[COUNT];
    make_lights_above(lights, COUNT);
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        receivers[i] = (struct receiver){.normal = {0, 0, 1}};
        for (uint32_t c = 0; c < 2; c++)
            receivers[i].position[c] = (float)(2 * uniform(11, 2 * i + c) - 1);
        receivers[i].position[2] = i % 2 ? -0.05f : 0;
    }
    for (int p = 0; p < PROJECTIONS; p++)
        for (int size = 8; size <= 128; size *= 4) {
            struct job job;
            struct shading s;
            double lit[2] = {0}, dark[2] = {0};
            job_create(&job, make_floor(), p, size, COUNT);
            shading_create(&s, shade, gl, receivers, WIDTH, HEIGHT, 1, 1);
            struct irb_image image = run(&job, &s, lights, COUNT, &raster);
            for (size_t i = 0; i < WIDTH * HEIGHT; i++) {
                lit[i % 2] += image.data[4 * i];
                dark[i % 2] += image.data[4 * i + 3];
            }
            print_message("%s %d: share of a plane in its own shadow %.2g, lit through it %.2g\n",
                          projection_names[p], size, dark[0] / (dark[0] + lit[0]),
                          lit[1] / (dark[1] + lit[1]));
            REQUIRE_CMP(dark[0], <=, 1e-4 * lit[0]);
            if (size == 128)
                REQUIRE_CMP(lit[1], <=, 1e-4 * dark[1]);
            irb_image_destroy(&image);
            shading_destroy(&s);
            job_destroy(&job);
        }
}

/* However many lights a batch has, dark ones among them: the same irradiance, each light in its own
 * tile. No lights: none. */
static void test_batches(void **state)
{
    (void)state;
    enum { WIDTH = 12, HEIGHT = 10, COUNT = 41 };
    static const int capacities[] = {COUNT, 64, 7, 1}, counts[] = {COUNT, 3, 0};
    struct receiver receivers[WIDTH * HEIGHT];
    struct shade_light lights[COUNT];
    make_lights_above(lights, COUNT);
    for (int l = 0; l < COUNT; l += 5)
        memset(&lights[l], 0, sizeof lights[l]);
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        receivers[i] = (struct receiver){.normal = {0, 0, 1}};
        for (uint32_t c = 0; c < 3; c++)
            receivers[i].position[c] = (float)(2 * uniform(16, 3 * i + c) - 1);
    }
    for (int p = 0; p < PROJECTIONS; p++)
        for (int k = 0; k < 3; k++) {
            struct irb_image whole = {0};
            for (int b = 0; b < 4; b++) {
                struct job job;
                struct shading s;
                job_create(&job, make_square(), p, 32, capacities[b]);
                shading_create(&s, shade, gl, receivers, WIDTH, HEIGHT, 3, 2);
                struct irb_image image = run(&job, &s, lights, counts[k], &raster);
                for (size_t i = 0; b > 0 && i < 4 * irb_image_pixels(&image); i++)
                    REQUIRE_REL(image.data[i], whole.data[i], 1e-5);
                if (b == 0)
                    whole = image;
                else
                    irb_image_destroy(&image);
                shading_destroy(&s);
                job_destroy(&job);
            }
            REQUIRE_NEAR(fixture_sum(&whole, 0) > 0, counts[k] > 0, 0);
            if (counts[k] == COUNT)
                REQUIRE_CMP(fixture_sum(&whole, 3), >, 0);
            irb_image_destroy(&whole);
        }
}

static void test_refusals(void **state)
{
    (void)state;
    struct irb_error err = {0};
    const struct receiver receiver = {{0, 0, 0}, {0, 0, 1}, {0, 0, 0}};
    const struct shade_light lights[3] = {{.normal = {0, 0, -1}}};
    struct irb_shade_settings none = raster;
    struct job job;
    struct shading s;
    job_create(&job, make_square(), 0, 16, 4);
    shading_create(&s, shade, gl, &receiver, 1, 1, 1, 1);
    struct irb_buffer *buffer = upload(lights, 3);
    const struct irb_virtual_lights view = {buffer, 3};
    const struct irb_shade_batch batch = {.count = 3, .raster = job.maps}, no_maps = {.count = 3};
    REQUIRE_OK(irb_raster_maps_render(job.maps, job.scene_gl, &view, 0, 2, 0, &err));
    assert_false(irb_shade_run_batch(shade, s.interleave, &view, NULL, &raster, &batch, &err));
    REQUIRE_CONTAINS(err.message, "2 shadow maps for 3 lights");
    assert_false(irb_shade_run_batch(shade, s.interleave, &view, NULL, &raster, &no_maps, &err));
    none.visibility = 99;
    const struct irb_shade_raster all = {job.maps, job.scene_gl, .near = 0};
    assert_false(irb_shade_run_raster(shade, s.interleave, &view, &all, &none, &err));
    assert_int_equal(err.code, IRB_E_INTERNAL);
    irb_buffer_destroy(buffer);
    shading_destroy(&s);
    job_destroy(&job);
}

int main(int argc, char **argv)
{
    struct irb_error err = {0};
    gl = fixture_gl(fixture_backend(argc, argv), NULL);
    shade = irb_shade_create(gl, &err);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_square),   cmocka_unit_test(test_scene),
        cmocka_unit_test(test_no_acne),  cmocka_unit_test(test_batches),
        cmocka_unit_test(test_refusals),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_shade_destroy(shade);
    irb_gl_destroy(gl);
    return failed;
}
