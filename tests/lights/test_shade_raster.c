/* SPDX-License-Identifier: MIT
 *
 * Lighting with rasterised shadow maps, in batches, against rays through the coloured box.
 */
#include "tests/support/compare.h"
#include "tests/lights/shade_receivers.h"
#include "tests/support/raycast.h"

static struct irb_gl *gl;
static struct irb_shade *shade;

enum { WIDTH = 32, HEIGHT = 24, LIGHTS = 12, MAP = 128, BATCH = 5 };
static const float near = 1e-3f; /* m */

static const struct irb_shade_settings settings = {
    .visibility = IRB_SHADE_RASTER, .bias = 2e-3f, .offset = 1e-5f, .taps = 16, .blocker_taps = 16};

enum truth { LIT, HIDDEN, UNSURE };

/* How much nearer than the receiver, and than its tangent plane, the surface in one direction is,
 * as a share of the distance; negative where it is farther. */
static double gap_of(const struct raycast *cast, const double from[3], const double along[3],
                     const struct receiver *x)
{
    double facing = 0, height = 0, r2 = 0;
    for (int c = 0; c < 3; c++) {
        double d = x->position[c] - from[c];
        facing += along[c] * x->normal[c];
        height += d * x->normal[c];
        r2 += d * d;
    }
    double limit = sqrt(r2);
    if (height / facing > 0)
        limit = fmin(limit, height / facing);
    return (limit - raycast_nearest(cast, from, along, near)) / limit;
}

/* What rays say, unless those to all sides within half a texel's diagonal say something else, or it
 * is a matter of the bias. */
static enum truth truth_of(const struct raycast *cast, const struct shade_light *light,
                           const struct receiver *x)
{
    double from[3], to[3], frame[3][3];
    float axis[3];
    int hidden = 0;
    for (int c = 0; c < 3; c++) {
        from[c] = light->position[c];
        axis[c] = (float)(x->position[c] - from[c]);
    }
    unit(axis);
    shade_frame(axis, frame);
    for (int k = 0; k < 17; k++) {
        double tilt = k ? (k % 2 + 1) * 0.36 * 4 / MAP : 0;
        for (int c = 0; c < 3; c++)
            to[c] = cos(tilt) * axis[c] +
                    sin(tilt) * (cos(k * M_PI / 8) * frame[0][c] + sin(k * M_PI / 8) * frame[1][c]);
        double gap = gap_of(cast, from, to, x);
        if (gap > 0.2 * settings.bias && gap < 5 * settings.bias)
            return UNSURE;
        hidden += gap > settings.bias;
    }
    return hidden == 17 ? HIDDEN : hidden ? UNSURE : LIT;
}

static void make_lights(struct shade_light *lights, const struct irb_scene *scene)
{
    for (uint32_t l = 0; l < LIGHTS; l++) {
        lights[l] = (struct shade_light){.area = 0.001f, .flux = {1, 1, 1}};
        for (uint32_t c = 0; c < 3; c++) {
            const float low = scene->bounds_min[c], high = scene->bounds_max[c];
            lights[l].position[c] =
                low + (float)(0.05 + 0.9 * uniform(20, 3 * l + c)) * (high - low);
        }
        random_normal(21, l, -1, lights[l].normal);
    }
}

/* One batch: renders its maps, lights with them. */
static struct irb_image run_batch(struct shading *s, const struct fixture_frame *f,
                                  struct irb_raster_maps *maps,
                                  const struct irb_virtual_lights *lights, int first, int count,
                                  bool accumulate)
{
    struct irb_error err = {0};
    const struct irb_shade_batch batch = {first, count, accumulate, maps};
    REQUIRE_OK(irb_raster_maps_render(maps, f->scene_gl, lights, first, count, near, &err));
    REQUIRE_OK(irb_shade_run_batch(s->shade, s->interleave, lights, NULL, &settings, &batch, &err));
    REQUIRE_OK(irb_interleave_merge(s->interleave, &err));
    return fixture_read(s->interleave->merged, 4);
}

/* Each light alone: visibility as by rays. found: how many were so. */
static void check_light(const struct irb_image *image, const struct irb_gbuffer_image *g,
                        const struct raycast *cast, const struct shade_light *light, int found[3])
{
    for (size_t i = 0; i < WIDTH * HEIGHT; i++) {
        struct receiver x;
        memcpy(x.position, g->position.data + 4 * i, 12);
        memcpy(x.normal, g->normal.data + 4 * i, 12);
        const double f = form_factor(&x, light, light->area), tolerance = 1e-4 * f + 1e-5;
        if (!(g->position.data[4 * i + 3] > 0) || !(f > 0))
            continue;
        enum truth truth = truth_of(cast, light, &x);
        found[truth]++;
        if (truth == UNSURE)
            continue;
        REQUIRE_NEAR(image->data[4 * i], truth == LIT ? f : 0, tolerance);
        REQUIRE_NEAR(image->data[4 * i + 3], truth == LIT ? 0 : f, tolerance);
    }
}

static void check_projection(const struct fixture_frame *f, enum irb_raster_projection projection)
{
    struct irb_error err = {0};
    struct shade_light lights[LIGHTS];
    struct shading s = {.gbuffer = f->gbuffer, .shade = shade};
    struct irb_gbuffer_image g;
    struct irb_image sum = {0};
    struct raycast cast;
    int found[3] = {0};
    make_lights(lights, f->scene);
    raycast_create(&cast, f->scene);
    REQUIRE_OK(irb_gbuffer_read(f->gbuffer, &g, &err));
    struct irb_buffer *buffer = shade_lights_upload(gl, lights, LIGHTS, &err);
    struct irb_raster_maps *maps = irb_raster_maps_create(gl, projection, MAP, BATCH, &err);
    REQUIRE_OK(buffer && maps);
    REQUIRE_OK(s.interleave = irb_interleave_create(gl, WIDTH, HEIGHT, 1, 1, &err));
    REQUIRE_OK(irb_interleave_split(s.interleave, s.gbuffer, &err));
    const struct irb_virtual_lights all = {buffer, LIGHTS};
    REQUIRE_OK(irb_image_create(&sum, WIDTH, HEIGHT, 4, &err));
    for (int l = 0; l < LIGHTS; l++) {
        struct irb_image image = run_batch(&s, f, maps, &all, l, 1, false);
        check_light(&image, &g, &cast, &lights[l], found);
        for (size_t i = 0; i < 4 * irb_image_pixels(&sum); i++)
            sum.data[i] += image.data[i];
        irb_image_destroy(&image);
    }
    print_message("%s: as rays say %d lit, %d hidden; %d too close to tell\n",
                  irb_raster_projection_names[projection], found[LIT], found[HIDDEN],
                  found[UNSURE]);
    REQUIRE_CMP(found[LIT], >, 1000);
    REQUIRE_CMP(found[HIDDEN], >, 200);
    for (int first = 0; first < LIGHTS; first += BATCH) {
        const int rest = LIGHTS - first;
        struct irb_image image =
            run_batch(&s, f, maps, &all, first, rest < BATCH ? rest : BATCH, first > 0);
        for (size_t i = 0; rest <= BATCH && i < 4 * irb_image_pixels(&sum); i++)
            REQUIRE_NEAR(image.data[i], sum.data[i], 1e-5 * sum.data[i]);
        irb_image_destroy(&image);
    }
    const struct irb_shade_batch too_many = {0, BATCH + 1, false, maps};
    assert_false(irb_shade_run_batch(shade, s.interleave, &all, NULL, &settings, &too_many, &err));
    irb_image_destroy(&sum);
    irb_raster_maps_destroy(maps);
    irb_buffer_destroy(buffer);
    irb_interleave_destroy(s.interleave);
    irb_gbuffer_image_destroy(&g);
    raycast_destroy(&cast);
}

static void test_raster(void **state)
{
    (void)state;
    struct fixture_frame f;
    fixture_frame_create(&f, gl, fixture_scene("cornell"), WIDTH, HEIGHT, 1);
    fixture_view(f.scene, &f.light, &f.camera);
    fixture_frame_render(&f);
    check_projection(&f, IRB_RASTER_HEMICUBE);
    check_projection(&f, IRB_RASTER_PARABOLOID);
    fixture_frame_destroy(&f);
}

int main(int argc, char **argv)
{
    struct irb_error err = {0};
    gl = fixture_gl(fixture_backend(argc, argv), NULL);
    shade = irb_shade_create(gl, &err);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_raster),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_shade_destroy(shade);
    irb_gl_destroy(gl);
    return failed;
}
