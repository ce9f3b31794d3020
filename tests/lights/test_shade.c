/* SPDX-License-Identifier: MIT
 *
 * Lighting from virtual lights: form factors against closed forms, sums against double precision,
 * interleaved sums against whole ones, visibility of the lights' centres against rays, and the
 * cases in which numbers break. Soft shadows: test_pcss.c.
 */
#include "tests/support/compare.h"
#include "tests/lights/shade_receivers.h"

static struct irb_gl *gl;
static struct irb_shade *shade;

static const struct irb_shade_settings no_visibility = {
    .visibility = IRB_SHADE_NONE, .taps = 16, .blocker_taps = 16};
static const struct irb_shade_settings binary = {.visibility = IRB_SHADE_BINARY,
                                                 .bias = 1e-3f,
                                                 .slope = 0,
                                                 .offset = 1e-5f,
                                                 .taps = 16,
                                                 .blocker_taps = 16};
static const struct irb_shade_settings pcss = {.visibility = IRB_SHADE_PCSS,
                                               .bias = 1e-3f,
                                               .slope = 0,
                                               .offset = 1e-5f,
                                               .taps = 16,
                                               .blocker_taps = 16,
                                               .search_scale = 3,
                                               .penumbra_scale = 1};

static struct irb_buffer *upload(const struct shade_light *lights, int count)
{
    struct irb_error err = {0};
    struct irb_buffer *buffer = shade_lights_upload(gl, lights, count, &err);
    REQUIRE_OK(buffer);
    return buffer;
}

/* One light above the origin, looking down, and receivers; the irradiance of each as a share of the
 * flux, without visibility. */
static void irradiance_of(const struct receiver *receivers, int count, float area, float *out)
{
    const struct shade_light light = {.normal = {0, 0, -1}, .area = area, .flux = {1, 1, 1}};
    struct irb_buffer *buffer = upload(&light, 1);
    struct shading s;
    shading_create(&s, shade, gl, receivers, count, 1, 1, 1);
    struct irb_image image =
        shading_run(&s, &(struct irb_virtual_lights){buffer, 1}, NULL, &no_visibility);
    for (int i = 0; i < count; i++)
        out[i] = image.data[4 * i];
    irb_image_destroy(&image);
    shading_destroy(&s);
    irb_buffer_destroy(buffer);
}

/* Exact share of a disc of radius 1 (at the origin, looking down) in the hemisphere of a parallel
 * receiver h below it and a off its axis (Howell, catalog of configuration factors, B-13). */
static double exact_parallel(double h, double a)
{
    double z = 1 + a * a + h * h;
    return 0.5 * (1 - (a * a + h * h - 1) / sqrt(z * z - 4 * a * a));
}

/* The disc of radius 1: on its axis eq. 5.5 is the closed form at every distance, 1 at contact; far
 * away it is so everywhere; off the axis of a parallel receiver it never exceeds it. */
static void test_disc(void **state)
{
    (void)state;
    enum { AXIS = 24, OFFSETS = 24, COUNT = AXIS * OFFSETS };
    static struct receiver receivers[COUNT];
    static float found[COUNT];
    for (int i = 0; i < COUNT; i++) {
        double h = pow(10, -4 + 7.0 * (i / OFFSETS) / (AXIS - 1)); /* 0.1 mm to 1 km */
        double a = i % OFFSETS * 0.25 * fmax(h, 1);
        receivers[i] = (struct receiver){{(float)a, 0, (float)-h}, {0, 0, 1}};
    }
    irradiance_of(receivers, COUNT, (float)M_PI, found);
    for (int i = 0; i < COUNT; i++) {
        double a = receivers[i].position[0], h = -(double)receivers[i].position[2];
        double exact = exact_parallel(h, a), share = M_PI * found[i];
        REQUIRE_CMP(share, <=, exact * (1 + 1e-5) + 1e-7);
        REQUIRE_CMP(share, <=, 1 + 1e-6);
        if (a == 0)
            REQUIRE_REL(share, 1 / (1 + h * h), 1e-5);
        /* second order of the integral over the disc, and of A in the denominator: 2 + 1 */
        if (h * h + a * a > 100)
            REQUIRE_REL(share, exact, 3.2 / (h * h + a * a) + 1e-5);
    }
    REQUIRE_NEAR(M_PI * found[0], 1, 1e-6); /* 0.1 mm off its middle */
}

/* Area 0 is the point light of eq. 3.6: Phi/pi cos cos/r^2; a tilted receiver, millimetres to
 * kilometres. */
static void test_point(void **state)
{
    (void)state;
    enum { COUNT = 200 };
    const struct shade_light light = {.normal = {0, 0, -1}};
    struct receiver receivers[COUNT];
    float found[COUNT];
    for (uint32_t i = 0; i < COUNT; i++) {
        double scale = pow(10, -3 + 6.0 * i / (COUNT - 1));
        for (uint32_t c = 0; c < 3; c++)
            receivers[i].position[c] = (float)(scale * (uniform(1, 3 * i + c) - (c == 2)));
        random_normal(2, i, -0.3, receivers[i].normal);
    }
    irradiance_of(receivers, COUNT, 0, found);
    for (int i = 0; i < COUNT; i++)
        REQUIRE_REL(found[i], form_factor(&receivers[i], &light, 0), 2e-5);
}

/* Random lights in a box of 2 m, looking anywhere, every third one a point light. */
static void random_lights(struct shade_light *lights, int count)
{
    for (uint32_t l = 0; l < (uint32_t)count; l++) {
        struct shade_light *light = &lights[l];
        *light = (struct shade_light){.area = l % 3 ? (float)(0.2 * uniform(3, l)) : 0};
        for (uint32_t c = 0; c < 3; c++) {
            light->position[c] = (float)(2 * uniform(4, 3 * l + c) - 1);
            light->flux[c] = (float)uniform(5, 3 * l + c);
        }
        random_normal(6, l, -1, light->normal);
    }
}

static void random_receivers(struct receiver *receivers, int count)
{
    for (uint32_t i = 0; i < (uint32_t)count; i++) {
        for (uint32_t c = 0; c < 3; c++)
            receivers[i].position[c] = (float)(2 * uniform(7, 3 * i + c) - 1);
        random_normal(8, i, -1, receivers[i].normal);
    }
}

/* All lights in each pixel, more than one block of them; bound and what it takes; point form
 * factors. */
static void test_sum(void **state)
{
    (void)state;
    enum { WIDTH = 9, HEIGHT = 7, LIGHTS = 1500 };
    static struct shade_light lights[LIGHTS];
    struct receiver receivers[WIDTH * HEIGHT];
    struct irb_error err = {0};
    random_lights(lights, LIGHTS);
    random_receivers(receivers, WIDTH * HEIGHT);
    struct irb_buffer *buffer = upload(lights, LIGHTS);
    struct shading s;
    shading_create(&s, shade, gl, receivers, WIDTH, HEIGHT, 1, 1);
    for (int kind = 0; kind < 4; kind++) {
        struct irb_shade_settings settings = no_visibility;
        settings.point_form_factor = kind & 1;
        settings.bound = kind & 2 ? 2 : 0;
        struct irb_image image =
            shading_run(&s, &(struct irb_virtual_lights){buffer, LIGHTS}, NULL, &settings);
        double kept = 0, lost = 0, share;
        for (size_t i = 0; i < WIDTH * HEIGHT; i++) {
            double sum[3] = {0};
            for (int l = 0; l < LIGHTS; l++) {
                double f = form_factor(&receivers[i], &lights[l],
                                       settings.point_form_factor ? 0 : lights[l].area);
                double cut = settings.bound > 0 ? fmin(f, settings.bound / M_PI) : f;
                for (int c = 0; c < 3; c++) {
                    sum[c] += lights[l].flux[c] * cut;
                    kept += lights[l].flux[c] * cut;
                    lost += lights[l].flux[c] * (f - cut);
                }
            }
            for (size_t c = 0; c < 3; c++)
                REQUIRE_REL(image.data[4 * i + c], sum[c], 2e-5);
            REQUIRE_NEAR(image.data[4 * i + 3], 0, 0);
        }
        REQUIRE_OK(irb_shade_lost(s.shade, s.interleave, &share, &err));
        REQUIRE_NEAR(share, lost / (kept + lost), 1e-5);
        if (kind & 2)
            REQUIRE_CMP(share, >, 0.01);
        irb_image_destroy(&image);
    }
    shading_destroy(&s);
    irb_buffer_destroy(buffer);
}

static const int tiles[][2] = {{1, 1}, {2, 2}, {3, 3}, {4, 4}, {3, 2}, {8, 8}};
static const int light_counts[] = {0, 1, 5, 10, 128};
enum { TILES = 6, LIGHT_COUNTS = 5, LIGHTS_MOST = 128 };

/* A ball in the middle of things, m. */
static const double ball_radius = 0.3;

/* Distance along a ray to the ball at `scene` (its centre, double[3]). */
static double to_ball(const void *scene, const double from[3], const double along[3])
{
    const double *centre = scene;
    double b = 0, c = -ball_radius * ball_radius;
    for (int i = 0; i < 3; i++) {
        b += (from[i] - centre[i]) * along[i];
        c += (from[i] - centre[i]) * (from[i] - centre[i]);
    }
    double root = b * b - c, t = -b - sqrt(fmax(root, 0));
    return root > 0 && c > 0 && t > 0 ? t : INFINITY;
}

/* Maps of all lights with the ball in them. */
static void make_maps(struct irb_ism *ism, int size, const struct shade_light *lights, int count,
                      const double centre[3])
{
    struct irb_error err = {0};
    REQUIRE_OK(shade_maps_create(ism, gl, size, count, &err));
    for (int l = 0; l < count; l++)
        shade_map_fill(ism, l, &lights[l], to_ball, centre, NULL);
}

/* All pixels the same receiver: whatever the tiles, image size and number of lights, the filtered
 * image is the sum over all lights; so is the share in shadow. */
static void test_interleaved(void **state)
{
    (void)state;
    enum { WIDTH = 23, HEIGHT = 17 };
    static struct shade_light lights[LIGHTS_MOST];
    static struct receiver receivers[WIDTH * HEIGHT];
    const double centre[3] = {0.1, 0.2, 0.1};
    struct irb_ism ism;
    random_lights(lights, LIGHTS_MOST);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        receivers[i] = (struct receiver){{0.1f, 0.2f, -0.9f}, {0, 0, 1}};
    make_maps(&ism, 32, lights, LIGHTS_MOST, centre);
    struct irb_buffer *buffer = upload(lights, LIGHTS_MOST);
    const struct irb_shade_settings *const settings[] = {&no_visibility, &binary, &pcss};
    for (int k = 0; k < LIGHT_COUNTS; k++)
        for (int v = 0; v < 3; v++) {
            const struct irb_virtual_lights some = {buffer, light_counts[k]};
            float whole[4] = {0};
            for (int t = 0; t < TILES; t++) {
                struct shading s;
                shading_create(&s, shade, gl, receivers, WIDTH, HEIGHT, tiles[t][0], tiles[t][1]);
                struct irb_image image = shading_run(&s, &some, &ism, settings[v]);
                irb_image_destroy(&image);
                image = shading_filter(&s);
                if (t == 0)
                    memcpy(whole, image.data, 16);
                for (size_t i = 0; i < 4 * irb_image_pixels(&image); i++)
                    REQUIRE_REL(image.data[i], whole[i % 4], 1e-5);
                irb_image_destroy(&image);
                shading_destroy(&s);
            }
            if (light_counts[k] == LIGHTS_MOST) {
                REQUIRE_CMP(whole[0], >, 0.1);
                REQUIRE_NEAR(whole[3] > 0.005, v > 0, 0);
            }
        }
    irb_texture_destroy(ism.atlas);
    irb_buffer_destroy(buffer);
}

/* A rendered plane under lights 1 km up: lighting is the same all over a window to 1e-6. */
static void test_plane(void **state)
{
    (void)state;
    enum { WIDTH = 50, HEIGHT = 31, LIGHTS = 10 };
    struct irb_error err = {0};
    struct fixture_frame f;
    fixture_frame_create(&f, gl, fixture_floor(5, (const float[]){1, 1, 1}), WIDTH, HEIGHT, 1);
    f.camera = fixture_camera((const float[]){0, 0.3f, 0}, (const float[]){0, 0, 0},
                              (const float[]){0, 0, -1}, 20);
    REQUIRE_OK(irb_gbuffer_render(f.gbuffer, f.scene_gl, &f.camera, &err));
    struct shade_light lights[LIGHTS];
    random_lights(lights, LIGHTS);
    for (int l = 0; l < LIGHTS; l++) {
        lights[l].position[1] = 1000;
        memcpy(lights[l].normal, (const float[]){0, -1, 0}, 12);
    }
    struct irb_buffer *buffer = upload(lights, LIGHTS);
    struct irb_image whole = {0};
    for (int t = 0; t < TILES; t++) {
        struct shading s = {.gbuffer = f.gbuffer, .shade = shade};
        REQUIRE_OK(s.interleave =
                       irb_interleave_create(gl, WIDTH, HEIGHT, tiles[t][0], tiles[t][1], &err));
        REQUIRE_OK(irb_interleave_split(s.interleave, s.gbuffer, &err));
        REQUIRE_OK(irb_shade_run(s.shade, s.interleave,
                                 &(struct irb_virtual_lights){buffer, LIGHTS}, NULL, &no_visibility,
                                 &err));
        struct irb_image image = shading_filter(&s);
        if (t == 0)
            whole = image;
        for (size_t i = 0; i < 4 * irb_image_pixels(&image); i++)
            REQUIRE_REL(image.data[i], whole.data[i], 1e-5);
        if (t > 0)
            irb_image_destroy(&image);
        irb_interleave_destroy(s.interleave);
    }
    irb_image_destroy(&whole);
    irb_buffer_destroy(buffer);
    fixture_frame_destroy(&f);
}

/* Lights in batches: in the tiles that they have among all, and the same sum. */
static void test_batches(void **state)
{
    (void)state;
    enum { WIDTH = 20, HEIGHT = 11, LIGHTS = 1100 };
    static struct shade_light lights[LIGHTS];
    static struct receiver receivers[WIDTH * HEIGHT];
    struct irb_error err = {0};
    random_lights(lights, LIGHTS);
    random_receivers(receivers, WIDTH * HEIGHT);
    struct irb_buffer *buffer = upload(lights, LIGHTS);
    const struct irb_virtual_lights all = {buffer, LIGHTS};
    struct irb_shade_settings settings = no_visibility;
    settings.bound = 2;
    struct shading s;
    double share, batched_share;
    shading_create(&s, shade, gl, receivers, WIDTH, HEIGHT, 3, 3);
    struct irb_image whole = shading_run(&s, &all, NULL, &settings);
    REQUIRE_OK(irb_shade_lost(s.shade, s.interleave, &share, &err));
    const int firsts[] = {0, 0, 7, 500, 1023, 1024, 1100, 1100};
    for (int b = 0; b + 1 < 8; b++) {
        const struct irb_shade_batch batch = {
            .first = firsts[b], .count = firsts[b + 1] - firsts[b], .accumulate = b > 0};
        REQUIRE_OK(irb_shade_run_batch(s.shade, s.interleave, &all, NULL, &settings, &batch, &err));
    }
    REQUIRE_OK(irb_shade_lost(s.shade, s.interleave, &batched_share, &err));
    REQUIRE_REL(batched_share, share, 1e-5);
    REQUIRE_OK(irb_interleave_merge(s.interleave, &err));
    struct irb_image batched = fixture_read(s.interleave->merged, 4);
    for (size_t i = 0; i < 4 * irb_image_pixels(&whole); i++)
        REQUIRE_REL(batched.data[i], whole.data[i], 1e-5);
    irb_image_destroy(&batched);
    irb_image_destroy(&whole);
    shading_destroy(&s);
    irb_buffer_destroy(buffer);
}

enum truth { LIT, HIDDEN, UNSURE };

/* What rays say of a receiver under a ball, unless the map may say something else: where not all
 * directions that its texel's centre may have (half a diagonal off; a texel is widest at the map's
 * centre) agree, and where the ball is nearer to the receiver than the bias that shade.h states. */
static enum truth truth_of(const struct receiver *x, const struct shade_light *light,
                           const double centre[3], int map_size)
{
    double from[3], along[3], r2 = 0, cos_x = 0, frame[3][3];
    float axis[3];
    for (int c = 0; c < 3; c++) {
        from[c] = light->position[c];
        along[c] = x->position[c] - from[c];
        r2 += along[c] * along[c];
        cos_x -= along[c] * x->normal[c];
    }
    const double r = sqrt(r2), texel = 4.0 / map_size, tangent = sqrt(r2 / (cos_x * cos_x) - 1);
    for (int c = 0; c < 3; c++) {
        along[c] /= r;
        axis[c] = (float)along[c];
    }
    shade_frame(axis, frame);
    const double gap = r - to_ball(centre, from, along);
    for (int k = 0; k < 16; k++) {
        double tilt = (k % 2 + 1) * 0.36 * texel, near[3];
        for (int c = 0; c < 3; c++)
            near[c] = cos(tilt) * along[c] + sin(tilt) * (cos(k * M_PI / 8) * frame[0][c] +
                                                          sin(k * M_PI / 8) * frame[1][c]);
        if ((to_ball(centre, from, near) < r) != (gap > 0))
            return UNSURE;
    }
    if (gap > 0 && gap < 1.1 * (r * (binary.bias + 0.71 * texel * tangent) + binary.offset))
        return UNSURE;
    return gap > 0 ? HIDDEN : LIT;
}

/* Lights round the ball, towards it. */
static void lights_round(const double centre[3], struct shade_light *lights, int count)
{
    for (uint32_t l = 0; l < (uint32_t)count; l++) {
        struct shade_light *light = &lights[l];
        *light = (struct shade_light){.flux = {1, 2, 3}};
        for (uint32_t c = 0; c < 3; c++) {
            double side = l % 2 ? 0.9 : -0.9;
            light->position[c] = (float)(c == l % 3 ? side : uniform(9, 3 * l + c));
            light->normal[c] =
                (float)(centre[c] - light->position[c] + 0.3 * uniform(10, 3 * l + c));
        }
        unit(light->normal);
    }
}

/* The ball between lights and receivers, all about it: wherever the map can know, visibility is
 * what a ray says, and what is in shadow is the rest. */
static void test_binary(void **state)
{
    (void)state;
    enum { WIDTH = 50, HEIGHT = 40, LIGHTS = 12, MAP = 64 };
    static struct receiver receivers[WIDTH * HEIGHT];
    struct shade_light lights[LIGHTS];
    const double centre[3] = {0.05, -0.1, 0.1};
    struct irb_error err = {0};
    struct irb_ism ism;
    struct shading s;
    int found[3] = {0};
    random_receivers(receivers, WIDTH * HEIGHT);
    shading_create(&s, shade, gl, receivers, WIDTH, HEIGHT, 1, 1);
    lights_round(centre, lights, LIGHTS);
    make_maps(&ism, MAP, lights, LIGHTS, centre);
    struct irb_buffer *buffer = upload(lights, LIGHTS);
    const struct irb_virtual_lights all = {buffer, LIGHTS};
    for (int l = 0; l < LIGHTS; l++) {
        const struct irb_shade_batch batch = {.first = l, .count = 1};
        REQUIRE_OK(irb_shade_run_batch(s.shade, s.interleave, &all, &ism, &binary, &batch, &err));
        REQUIRE_OK(irb_interleave_merge(s.interleave, &err));
        struct irb_image image = fixture_read(s.interleave->merged, 4);
        for (size_t i = 0; i < WIDTH * HEIGHT; i++) {
            double f = form_factor(&receivers[i], &lights[l], 0);
            double tolerance = 2e-5 * f + 1e-7; /* rounding of both cosines */
            enum truth truth = truth_of(&receivers[i], &lights[l], centre, MAP);
            if (!(f > 0) || truth == UNSURE)
                continue;
            REQUIRE_NEAR(image.data[4 * i + 3], truth == HIDDEN ? 2 * f : 0, tolerance);
            REQUIRE_NEAR(image.data[4 * i], truth == HIDDEN ? 0 : f, tolerance);
            found[truth]++;
        }
        irb_image_destroy(&image);
    }
    REQUIRE_CMP(found[LIT], >, 2000);
    REQUIRE_CMP(found[HIDDEN], >, 200);
    irb_buffer_destroy(buffer);
    irb_texture_destroy(ism.atlas);
    shading_destroy(&s);
}

/* A plane of bent shading normals seen from lights at all angles shadows none of itself, and one
 * behind it in full: the bias is neither too small nor too large. `scene`: height of the plane. */
static double to_floor(const void *scene, const double from[3], const double along[3])
{
    double t = (*(const double *)scene - from[2]) / along[2];
    return t > 0 ? t : INFINITY;
}

static void test_no_acne(void **state)
{
    (void)state;
    enum { WIDTH = 64, HEIGHT = 64, LIGHTS = 16, MAP = 128 };
    static struct receiver receivers[WIDTH * HEIGHT];
    struct shade_light lights[LIGHTS];
    struct irb_error err = {0};
    const double floor_height = 0;
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        receivers[i] = (struct receiver){.geometric = {0, 0, 1}};
        random_normal(15, i, 0.9, receivers[i].normal); /* up to 25 degrees off the triangle's */
        for (uint32_t c = 0; c < 2; c++)
            receivers[i].position[c] = (float)(4 * uniform(11, 2 * i + c) - 2);
        receivers[i].position[2] = i % 2 ? -0.4f : 0; /* every other one under the plane */
    }
    for (uint32_t l = 0; l < LIGHTS; l++) {
        lights[l] = (struct shade_light){.area = 0.05f, .flux = {1, 1, 1}};
        lights[l].position[0] = (float)(uniform(12, l) - 0.5);
        lights[l].position[2] = (float)(0.3 + uniform(13, l));
        random_normal(14, l, 0.2, lights[l].normal);
        lights[l].normal[2] *= -1;
    }
    struct irb_ism ism;
    struct shading s;
    REQUIRE_OK(shade_maps_create(&ism, gl, MAP, LIGHTS, &err));
    for (int l = 0; l < LIGHTS; l++)
        shade_map_fill(&ism, l, &lights[l], to_floor, &floor_height, NULL);
    shading_create(&s, shade, gl, receivers, WIDTH, HEIGHT, 1, 1);
    struct irb_buffer *buffer = upload(lights, LIGHTS);
    for (int v = 0; v < 2; v++) {
        struct irb_image image = shading_run(&s, &(struct irb_virtual_lights){buffer, LIGHTS}, &ism,
                                             v ? &pcss : &binary);
        double lit[2] = {0}, dark[2] = {0};
        for (size_t i = 0; i < WIDTH * HEIGHT; i++) {
            lit[i % 2] += image.data[4 * i];
            dark[i % 2] += image.data[4 * i + 3];
        }
        print_message("%s: share of a plane in its own shadow %.2g, of what is under it lit %.2g\n",
                      v ? "PCSS" : "binary", dark[0] / (dark[0] + lit[0]),
                      lit[1] / (dark[1] + lit[1]));
        REQUIRE_CMP(dark[0], <=, 1e-4 * lit[0]);
        REQUIRE_CMP(lit[1], <=, 1e-4 * dark[1]);
        irb_image_destroy(&image);
    }
    irb_buffer_destroy(buffer);
    irb_texture_destroy(ism.atlas);
    shading_destroy(&s);
}

/* Where numbers break: lights on receivers and a hair off them, in planes of one another, huge and
 * tiny areas, fluxes 0 to 1e30, lights without normals, maps of 0 and of +Inf. All stays finite (as
 * shading_run requires), and where the answer is known it comes out. */
static void test_extremes(void **state)
{
    (void)state;
    enum { WIDTH = 8, HEIGHT = 4, LIGHTS = 12 };
    struct irb_error err = {0};
    static struct receiver receivers[WIDTH * HEIGHT];
    const float hair[] = {0, 1e-30f, 1e-20f, 1e-12f, 1e-6f, 1, 1e6f, 1e9f};
    const float areas[] = {0, 1e-30f, 1e-6f, 1, 1e10f, 1e38f};
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        receivers[i] = (struct receiver){{0, 0, -hair[i % WIDTH]}, {0, 0, 1}};
        receivers[i].position[0] = i / WIDTH % 2 ? hair[i % WIDTH] : 0;
        if (i / WIDTH >= 2)
            memcpy(receivers[i].normal, (const float[]){-1, 0, 0}, 12);
    }
    struct shade_light lights[LIGHTS];
    for (int l = 0; l < LIGHTS; l++) {
        lights[l] = (struct shade_light){
            .area = areas[l % 6], .normal = {0, 0, -1}, .flux = {1e-30f, 1, 1e18f}};
        if (l >= 10) /* dark, as free clusters are */
            lights[l] = (struct shade_light){.area = 0};
    }
    struct shading s;
    struct irb_ism ism;
    shading_create(&s, shade, gl, receivers, WIDTH, HEIGHT, 2, 2);
    REQUIRE_OK(shade_maps_create(&ism, gl, 16, LIGHTS, &err));
    struct irb_buffer *buffer = upload(lights, LIGHTS);
    const float fills[] = {0, 1e-30f, 1, INFINITY};
    for (int k = 0; k < 4; k++) {
        uint32_t bits;
        memcpy(&bits, &fills[k], 4);
        gl->api.ClearTexImage(ism.atlas->id, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, &bits);
        for (int v = 0; v < 3; v++) {
            struct irb_shade_settings settings = v == 0 ? no_visibility : v == 1 ? binary : pcss;
            settings.bound = k == 1 ? 1e-3f : 0;
            struct irb_image image =
                shading_run(&s, &(struct irb_virtual_lights){buffer, LIGHTS}, &ism, &settings);
            for (size_t i = 0; k == 3 && i < 4 * irb_image_pixels(&image); i += 4)
                REQUIRE_NEAR(image.data[i + 3], 0, 0); /* empty maps shadow nothing */
            irb_image_destroy(&image);
        }
    }
    irb_texture_destroy(ism.atlas);
    irb_buffer_destroy(buffer);
    shading_destroy(&s);
}

static void test_refusals(void **state)
{
    (void)state;
    struct irb_error err = {0};
    const struct shade_light light = {.normal = {0, 0, 1}};
    struct receiver receiver = {{0, 0, 1}, {0, 0, -1}};
    struct irb_buffer *buffer = upload(&light, 1);
    const struct irb_virtual_lights two = {buffer, 2};
    struct irb_ism ism;
    struct shading s;
    shading_create(&s, shade, gl, &receiver, 1, 1, 1, 1);
    REQUIRE_OK(shade_maps_create(&ism, gl, 16, 1, &err));
    assert_false(irb_shade_run(s.shade, s.interleave, &two, &ism, &binary, &err));
    REQUIRE_CONTAINS(err.message, "1 shadow maps for 2 lights");
    assert_false(irb_shade_run(s.shade, s.interleave, &two, NULL, &pcss, &err));
    struct irb_shade_settings settings = pcss;
    settings.taps = IRB_SHADOW_TAPS_MOST + 1;
    assert_false(irb_shade_run(s.shade, s.interleave, &two, &ism, &settings, &err));
    assert_int_equal(err.code, IRB_E_INTERNAL);
    irb_texture_destroy(ism.atlas);
    irb_buffer_destroy(buffer);
    shading_destroy(&s);
}

int main(int argc, char **argv)
{
    struct irb_error err = {0};
    gl = fixture_gl(fixture_backend(argc, argv), NULL);
    shade = irb_shade_create(gl, &err);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_disc),     cmocka_unit_test(test_point),
        cmocka_unit_test(test_sum),      cmocka_unit_test(test_interleaved),
        cmocka_unit_test(test_plane),    cmocka_unit_test(test_batches),
        cmocka_unit_test(test_binary),   cmocka_unit_test(test_no_acne),
        cmocka_unit_test(test_extremes), cmocka_unit_test(test_refusals),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_shade_destroy(shade);
    irb_gl_destroy(gl);
    return failed;
}
