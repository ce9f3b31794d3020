/* SPDX-License-Identifier: MIT
 *
 * The method rsm: closed forms, and a gather in double precision over the RSM that is read back.
 */
#include "tests/support/compare.h"
#include "methods/method.h"
#include "methods/rsm/polar.h"
#include "tests/frame/fixture.h"

extern const struct irb_method irb_method_rsm;
static const struct irb_method *const rsm = &irb_method_rsm;

static struct irb_gl *gl;

/* Parameters from "name", "value", ..., NULL; the caller frees them. */
static void *make_params(const char *const *settings)
{
    struct irb_error err = {0};
    void *params = calloc(1, rsm->params_size);
    irb_options_default(rsm->params, params);
    for (; settings && *settings; settings += 2)
        REQUIRE_OK(irb_option_set(rsm->params, params, settings[0], settings[1], &err));
    return params;
}

/* Irradiance (4 channels) of one frame with fresh state. */
static struct irb_image render(const struct fixture_frame *f, const char *const *settings,
                               uint64_t seed, struct irb_frame_output *out)
{
    struct irb_error err = {0};
    void *params = make_params(settings);
    void *state = rsm->create(gl, f->scene_gl, f->gbuffer->width, f->gbuffer->height, params, &err);
    REQUIRE_OK(state);
    REQUIRE_OK(rsm->begin_sequence(state, params, seed, &err));
    const struct irb_frame_inputs inputs = {.scene = f->scene_gl,
                                            .light = &f->light,
                                            .camera = &f->camera,
                                            .gbuffer = f->gbuffer,
                                            .rsm = f->rsm,
                                            .seed = seed,
                                            .params = params};
    REQUIRE_OK(rsm->render_frame(state, &inputs, out, &err));
    struct irb_image image = fixture_read(out->irradiance, 4);
    rsm->destroy(state);
    free(params);
    return image;
}

static void make_frame(struct fixture_frame *f, const char *scene, int width, int height,
                       int resolution)
{
    fixture_frame_create(f, gl, fixture_scene(scene), width, height, resolution);
    fixture_view(f->scene, &f->light, &f->camera);
    fixture_frame_render(f);
}

static const char *const all[] = {"mode", "all", NULL};

/* Integrating sphere: E = albedo P / (4 pi R^2) everywhere. */
static void test_sphere(void **state)
{
    (void)state;
    struct fixture_frame f;
    struct irb_frame_output out;
    double power[3];
    make_frame(&f, "sphere", 32, 24, 64);
    irb_light_power(&f.light, power);
    struct irb_image e = render(&f, all, 0, &out);
    for (size_t i = 0; i < irb_image_pixels(&e); i++)
        for (size_t c = 0; c < 3; c++)
            REQUIRE_REL(e.data[4 * i + c], 0.5 * power[c] / (4 * M_PI), 0.01);
    REQUIRE_NEAR(out.clamped_light, 0, 0);
    REQUIRE_NEAR(out.uncovered_flux, 0, 0);
    assert_string_equal(out.statistics[0].name, "vpls");
    /* the texels of the square image that lie in the cone */
    REQUIRE_REL(out.statistics[0].value, 64 * 64 * M_PI / 4, 0.01);
    irb_image_destroy(&e);
    fixture_frame_destroy(&f);
}

/* Form factor from a point to the rectangle [0,a] x [0,b] at distance 1, parallel, the point below
 * its corner; odd in a and b. */
static double corner_factor(double a, double b)
{
    double ra = sqrt(1 + a * a), rb = sqrt(1 + b * b);
    return (a / ra * atan(b / ra) + b / rb * atan(a / rb)) / (2 * M_PI);
}

/* Two parallel unit squares, 1 m apart, the lower one lit by 10 W/m2: the exact factor of each
 * point of the upper one, and their mean 0.19982 (Hottel's closed form). */
static void test_squares(void **state)
{
    (void)state;
    struct fixture_frame f;
    struct irb_frame_output out;
    make_frame(&f, "squares", 64, 64, 128);
    struct irb_image e = render(&f, all, 0, &out), position = fixture_read(f.gbuffer->position, 4);
    double sum = 0, covered = 0;
    for (size_t i = 0; i < irb_image_pixels(&e); i++) {
        const float *at = position.data + 4 * i;
        if (at[3] == 0)
            continue;
        double factor =
            corner_factor(0.5 - at[0], 0.5 - at[2]) + corner_factor(0.5 + at[0], 0.5 - at[2]) +
            corner_factor(0.5 - at[0], 0.5 + at[2]) + corner_factor(0.5 + at[0], 0.5 + at[2]);
        REQUIRE_REL(e.data[4 * i], 0.5 * 10 * factor, 1e-3);
        sum += e.data[4 * i];
        covered++;
    }
    REQUIRE_CMP(covered, >, 62 * 62);
    REQUIRE_REL(sum / covered, 0.5 * 10 * 0.19982, 2e-3);
    irb_image_destroy(&e);
    irb_image_destroy(&position);
    fixture_frame_destroy(&f);
}

/* E at one pixel in double precision over all texels, the geometry term cut at `bound`. */
static void brute_force(const struct irb_image texels[3], const float x[3], const float n[3],
                        double bound, double e[3], double *lost)
{
    e[0] = e[1] = e[2] = *lost = 0;
    for (size_t p = 0; p < irb_image_pixels(&texels[0]); p++) {
        const float *y = texels[0].data + 4 * p, *n_y = texels[1].data + 4 * p;
        const float *flux = texels[2].data + 4 * p;
        double d[3], r2 = 0, cos_x = 0, cos_y = 0;
        for (int i = 0; i < 3; i++) {
            d[i] = (double)y[i] - x[i];
            r2 += d[i] * d[i];
            cos_x += n[i] * d[i];
            cos_y -= n_y[i] * d[i];
        }
        double g = r2 > 0 ? fmax(0, cos_x) * fmax(0, cos_y) / (r2 * r2) : 0;
        double kept = bound > 0 ? fmin(g, bound) : g;
        for (int c = 0; c < 3; c++) {
            e[c] += flux[c] / M_PI * kept;
            *lost += flux[c] / M_PI * (g - kept) / 3;
        }
    }
}

static void check_against_brute_force(int width, int height, int resolution, const char *clamp)
{
    struct fixture_frame f;
    struct irb_frame_output out;
    make_frame(&f, "cornell", width, height, resolution);
    const char *const settings[] = {"mode", "all", "clamp", clamp, NULL};
    struct irb_image found = render(&f, settings, 0, &out);
    struct irb_image position = fixture_read(f.gbuffer->position, 4);
    struct irb_image normal = fixture_read(f.gbuffer->normal, 4);
    const struct irb_image texels[3] = {fixture_read(f.rsm->position, 4),
                                        fixture_read(f.rsm->normal, 4),
                                        fixture_read(f.rsm->flux, 4)};
    double diagonal = irb_scene_diagonal(f.scene), kept = 0, lost = 0;
    for (size_t i = 0; i < irb_image_pixels(&found); i++) {
        double e[3], gone;
        brute_force(texels, position.data + 4 * i, normal.data + 4 * i,
                    atof(clamp) / (diagonal * diagonal), e, &gone);
        if (position.data[4 * i + 3] == 0)
            e[0] = e[1] = e[2] = gone = 0;
        for (size_t c = 0; c < 3; c++)
            REQUIRE_NEAR(found.data[4 * i + c], e[c], 1e-4 * e[c]);
        kept += (e[0] + e[1] + e[2]) / 3;
        lost += gone;
    }
    REQUIRE_NEAR(out.clamped_light, lost / (lost + kept), 1e-4);
    if (atof(clamp) > 0)
        REQUIRE_CMP(out.clamped_light, >, 0.001);
    irb_image_destroy(&found);
    irb_image_destroy(&position);
    irb_image_destroy(&normal);
    for (int i = 0; i < 3; i++)
        irb_image_destroy((struct irb_image *)&texels[i]);
    fixture_frame_destroy(&f);
}

static void test_brute_force(void **state)
{
    (void)state;
    check_against_brute_force(1, 1, 16, "0");
    check_against_brute_force(13, 7, 33, "0");
    check_against_brute_force(67, 30, 48, "0"); /* two blocks of lights, a tile and a bit */
    check_against_brute_force(67, 30, 48, "3");
    check_against_brute_force(24, 20, 1, "0");
}

/* Mean absolute error of drawn lights, relative to the mean of `exact`, over four seeds. */
static double drawn_error(const struct fixture_frame *f, const struct irb_image *exact,
                          const char *mode, const char *samples)
{
    const char *const settings[] = {"mode", mode, "samples", samples, NULL};
    struct irb_frame_output out;
    double difference = 0, mean = 0;
    for (uint64_t seed = 0; seed < 4; seed++) {
        struct irb_image e = render(f, settings, seed, &out);
        for (size_t i = 0; i < irb_image_pixels(&e); i++) {
            difference += fabs((double)e.data[4 * i] - exact->data[4 * i]);
            mean += exact->data[4 * i];
        }
        irb_image_destroy(&e);
    }
    return difference / mean;
}

/* The drawn modes approach `all`, and no slower than random samples do: 64 times as many take the
 * error down by a factor of 8 at least. */
static void test_samples_converge(void **state)
{
    (void)state;
    struct fixture_frame f;
    struct irb_frame_output out;
    make_frame(&f, "cornell", 24, 18, 64);
    struct irb_image exact = render(&f, all, 0, &out);
    const char *const modes[] = {"uniform", "importance"};
    for (int m = 0; m < 2; m++) {
        double few = drawn_error(&f, &exact, modes[m], "64");
        double many = drawn_error(&f, &exact, modes[m], "4096");
        REQUIRE_CMP(many, <, 0.02);
        REQUIRE_CMP(many, <, few / 8);
    }
    irb_image_destroy(&exact);
    fixture_frame_destroy(&f);
}

/* The same frame twice, bit by bit; another seed is another image. */
static void test_same_bits_twice(void **state)
{
    (void)state;
    struct fixture_frame f;
    struct irb_frame_output out;
    make_frame(&f, "cornell", 33, 17, 64);
    const char *const modes[] = {"all", "uniform", "importance", "polar"};
    for (int m = 0; m < 4; m++) {
        const char *const settings[] = {"mode", modes[m], "clamp", "10", NULL};
        struct irb_image one = render(&f, settings, 5, &out), two = render(&f, settings, 5, &out);
        struct irb_image other = render(&f, settings, 6, &out);
        size_t bytes = irb_image_pixels(&one) * 16;
        assert_memory_equal(one.data, two.data, bytes);
        assert_int_equal(!memcmp(one.data, other.data, bytes), m == 0);
        assert_int_equal(isnan(out.uncovered_flux), m == 3); /* not measured */
        irb_image_destroy(&one);
        irb_image_destroy(&two);
        irb_image_destroy(&other);
    }
    fixture_frame_destroy(&f);
}

/* Parameters that change from frame to frame, a resize, and a light that lights nothing: the
 * state gives what a fresh one would. */
static void test_changing_frames(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct fixture_frame f;
    struct irb_frame_output out;
    make_frame(&f, "cornell", 20, 15, 32);
    void *params = make_params(NULL);
    void *method = rsm->create(gl, f.scene_gl, 7, 5, params, &err);
    REQUIRE_OK(method);
    REQUIRE_OK(rsm->resize(method, 20, 15, &err));
    struct irb_frame_inputs inputs = {.scene = f.scene_gl,
                                      .light = &f.light,
                                      .camera = &f.camera,
                                      .gbuffer = f.gbuffer,
                                      .rsm = f.rsm,
                                      .params = params};
    const char *const frames[][4] = {{"uniform", "100", "0", "0"},   {"uniform", "3000", "0", "0"},
                                     {"importance", "30", "5", "0"}, {"polar", "3000", "0", "0"},
                                     {"polar", "50", "5", "1"},      {"all", "1", "0", "1"},
                                     {"polar", "50", "5", "0"},      {"uniform", "100", "5", "0"}};
    for (int i = 0; i < 8; i++) {
        const char *const settings[] = {"mode",  frames[i][0], "samples", frames[i][1],
                                        "clamp", frames[i][2], NULL};
        for (int k = 0; settings[k]; k += 2)
            REQUIRE_OK(irb_option_set(rsm->params, params, settings[k], settings[k + 1], &err));
        struct irb_light light = f.light;
        if (frames[i][3][0] == '1')
            memset(light.intensity, 0, sizeof light.intensity);
        REQUIRE_OK(irb_rsm_render(f.rsm, f.scene_gl, &light, &err));
        REQUIRE_OK(rsm->render_frame(method, &inputs, &out, &err));
        struct irb_image found = fixture_read(out.irradiance, 4);
        if (frames[i][3][0] == '1') {
            if (strcmp(frames[i][0], "polar"))
                REQUIRE_NEAR(out.statistics[0].value, 0, 0);
            for (int c = 0; c < 4; c++)
                REQUIRE_NEAR(fixture_sum(&found, c), 0, 0);
        }
        struct irb_image fresh = render(&f, settings, 0, &out);
        assert_memory_equal(found.data, fresh.data, irb_image_pixels(&found) * 16);
        irb_image_destroy(&found);
        irb_image_destroy(&fresh);
    }
    rsm->destroy(method);
    free(params);
    fixture_frame_destroy(&f);
}

/* Largest difference of two images, relative to the value in the second, over pixels that have at
 * least `floor` of the largest value there; and the mean of all. */
struct difference {
    double largest, mean, bias; /* bias: of the sums */
};

static struct difference compare(const struct irb_image *a, const struct irb_image *b, double floor)
{
    struct difference d = {0};
    double top = 0, sum_a = 0, sum_b = 0, total = 0;
    for (size_t i = 0; i < irb_image_pixels(b); i++)
        top = fmax(top, b->data[4 * i + 1]);
    for (size_t i = 0; i < irb_image_pixels(b); i++) {
        double x = a->data[4 * i + 1], y = b->data[4 * i + 1];
        if (y > floor * top)
            d.largest = fmax(d.largest, fabs(x - y) / y);
        total += fabs(x - y);
        sum_a += x;
        sum_b += y;
    }
    d.mean = total / sum_b;
    d.bias = sum_a / sum_b - 1;
    return d;
}

/* Fetch of a texel under a sample, in the test's own terms: the receiver is projected with the
 * RSM's matrix, points beyond the image towards its centre. */
static void polar_force(const struct fixture_frame *f, const struct irb_image texels[3],
                        const struct rsm_pattern *pattern, const float x[3], const float n[3],
                        double e[3])
{
    const float *m = f->rsm->view_projection;
    const double square_sum = rsm_pattern_square_sum(pattern);
    double clip[4], at[2];
    for (int r = 0; r < 4; r++)
        clip[r] =
            (double)m[r] * x[0] + (double)m[4 + r] * x[1] + (double)m[8 + r] * x[2] + m[12 + r];
    double scale = fmax(fmax(fabs(clip[0]), fabs(clip[1])), clip[3]);
    for (int i = 0; i < 2; i++)
        at[i] = (clip[i] / scale * 0.5 + 0.5) * pattern->resolution;
    e[0] = e[1] = e[2] = 0;
    for (int s = 0; s < pattern->samples; s++) {
        float sample[3];
        rsm_pattern_sample(pattern, square_sum, s, sample);
        double tx = floor(at[0] + sample[0]), ty = floor(at[1] + sample[1]);
        if (tx < 0 || ty < 0 || tx >= pattern->resolution || ty >= pattern->resolution)
            continue;
        /* the image that was read has its first row at the top */
        size_t p =
            (size_t)(pattern->resolution - 1 - (int)ty) * (size_t)pattern->resolution + (size_t)tx;
        const float *y = texels[0].data + 4 * p, *n_y = texels[1].data + 4 * p;
        double d[3], r2 = 0, cos_x = 0, cos_y = 0;
        for (int i = 0; i < 3; i++) {
            d[i] = (double)y[i] - x[i];
            r2 += d[i] * d[i];
            cos_x += n[i] * d[i];
            cos_y -= n_y[i] * d[i];
        }
        double g = r2 > 0 ? fmax(0, cos_x) * fmax(0, cos_y) / (r2 * r2) : 0;
        for (int c = 0; c < 3; c++)
            e[c] += texels[2].data[4 * p + (size_t)c] * g * sample[2] / M_PI;
    }
}

/* The polar gather against the sum in double precision. A sample on the border between two texels
 * may fall on either side, which moves that pixel by a sample's share: few pixels may. */
static void test_polar_brute_force(void **state)
{
    (void)state;
    const char *const fetches[] = {"full", "packed"}, *const weights[] = {"xi2", "xi1"};
    struct fixture_frame f;
    struct irb_frame_output out;
    make_frame(&f, "cornell", 37, 22, 48);
    struct irb_image position = fixture_read(f.gbuffer->position, 4);
    struct irb_image normal = fixture_read(f.gbuffer->normal, 4);
    const struct irb_image texels[3] = {fixture_read(f.rsm->position, 4),
                                        fixture_read(f.rsm->normal, 4),
                                        fixture_read(f.rsm->flux, 4)};
    for (int k = 0; k < 4; k++) {
        const char *const settings[] = {
            "gather_scale", "1",   "fetch", fetches[k & 1], "weight", weights[k >> 1],
            "samples",      "300", "r_max", "0.4",          NULL};
        const struct rsm_pattern pattern = {
            .samples = 300, .radius = 0.4f, .weight = k >> 1, .resolution = 48, .first = 600};
        struct irb_image found = render(&f, settings, 2, &out);
        int off = 0, compared = 0;
        for (size_t i = 0; i < irb_image_pixels(&found); i++) {
            double e[3] = {0};
            if (position.data[4 * i + 3] > 0)
                polar_force(&f, texels, &pattern, position.data + 4 * i, normal.data + 4 * i, e);
            REQUIRE_CMP(isfinite(found.data[4 * i]), ==, 1);
            if (e[1] == 0)
                REQUIRE_NEAR(found.data[4 * i + 1], 0, 1e-9);
            else
                off += fabs(found.data[4 * i + 1] / e[1] - 1) > 1e-3;
            compared += e[1] > 0;
        }
        REQUIRE_CMP(compared, >, 400);
        REQUIRE_CMP(off, <, 0.02 * compared);
        irb_image_destroy(&found);
    }
    irb_image_destroy(&position);
    irb_image_destroy(&normal);
    for (int i = 0; i < 3; i++)
        irb_image_destroy((struct irb_image *)&texels[i]);
    fixture_frame_destroy(&f);
}

/* A constant over the disc is exact with xi2 for any number of samples, and with xi1 in the limit:
 * the samples stand for pi r_max^2 of the map's area. */
static void test_pattern(void **state)
{
    (void)state;
    const int counts[] = {1, 7, 400, 4096};
    for (int weight = 0; weight < 2; weight++)
        for (int k = 0; k < 4; k++) {
            const struct rsm_pattern p = {.samples = counts[k],
                                          .radius = 0.3f,
                                          .weight = weight,
                                          .first = 1234,
                                          .resolution = 512};
            const double square_sum = rsm_pattern_square_sum(&p), radius = 0.3 * 512;
            double sum = 0;
            for (int i = 0; i < p.samples; i++) {
                float s[3];
                rsm_pattern_sample(&p, square_sum, i, s);
                sum += s[2];
                REQUIRE_CMP(hypot(s[0], s[1]), <=, radius * (1 + 1e-6));
            }
            if (weight == RSM_WEIGHT_XI2 || k >= 2)
                REQUIRE_REL(sum, M_PI * radius * radius,
                            weight == RSM_WEIGHT_XI2 ? 1e-5
                            : k == 2                 ? 0.01
                                                     : 0.001);
        }
}

/* With r_max over the whole map xi1 converges to `all` and xi2 does not; the bias is printed. */
static void test_polar_converges(void **state)
{
    (void)state;
    const char *const counts[] = {"400", "3200", "25600"};
    struct fixture_frame f;
    struct irb_frame_output out;
    make_frame(&f, "cornell", 24, 18, 64);
    struct irb_image exact = render(&f, all, 0, &out);
    double error[3];
    for (int k = 0; k < 3; k++) {
        struct difference d[2];
        for (int w = 0; w < 2; w++) {
            const char *const settings[] = {"gather_scale",    "1",       "weight",
                                            w ? "xi2" : "xi1", "samples", counts[k],
                                            "r_max",           "1.4143",  NULL};
            struct irb_image e = render(&f, settings, 0, &out);
            d[w] = compare(&e, &exact, 0);
            irb_image_destroy(&e);
        }
        print_message("polar, %6s samples over the whole map: xi1 mean error %.4f bias %+.4f, "
                      "xi2 mean error %.4f bias %+.4f\n",
                      counts[k], d[0].mean, d[0].bias, d[1].mean, d[1].bias);
        error[k] = d[0].mean;
        if (k == 2)
            REQUIRE_CMP(d[1].mean, >, 0.1);
    }
    REQUIRE_CMP(error[2], <, 0.01);
    REQUIRE_CMP(error[2], <, error[0] / 8); /* random samples alone would give sqrt(64) */
    irb_image_destroy(&exact);
    fixture_frame_destroy(&f);
}

/* Packed texels against the RSM as it is: irradiance within 1e-3. */
static void test_packed(void **state)
{
    (void)state;
    const char *const scenes[] = {"cornell", "squares", "sphere"};
    for (int k = 0; k < 3; k++) {
        struct fixture_frame f;
        struct irb_frame_output out;
        make_frame(&f, scenes[k], 40, 30, 128);
        const char *settings[] = {"gather_scale", "1", "fetch", "full", "clamp", "30", NULL};
        struct irb_image full = render(&f, settings, 1, &out);
        settings[3] = "packed";
        struct irb_image packed = render(&f, settings, 1, &out);
        struct difference d = compare(&packed, &full, 1e-3);
        print_message("%s: packed against full, largest %.2g, mean %.2g, bias %+.2g\n", scenes[k],
                      d.largest, d.mean, d.bias);
        REQUIRE_CMP(fixture_sum(&full, 1), >, 0);
        REQUIRE_CMP(d.largest, <, 1e-3);
        REQUIRE_CMP(fabs(d.bias), <, 1e-4);
        irb_image_destroy(&full);
        irb_image_destroy(&packed);
        fixture_frame_destroy(&f);
    }
}

/* Lights shifted against their normals: on a floor they lie below it, so that a wall standing on
 * it gains at its foot. */
static void test_normal_offset(void **state)
{
    (void)state;
    const char *const names[] = {"polar", "all"};
    struct fixture_frame f;
    struct irb_frame_output out;
    make_frame(&f, "cornell", 40, 30, 64);
    for (int m = 0; m < 2; m++) {
        const char *settings[] = {"mode", names[m], "gather_scale", "1", "normal_offset",
                                  "0",    NULL};
        struct irb_image at = render(&f, settings, 0, &out);
        settings[5] = "1e-6";
        struct irb_image near = render(&f, settings, 0, &out);
        settings[5] = "0.02";
        struct irb_image below = render(&f, settings, 0, &out);
        REQUIRE_CMP(compare(&near, &at, 1e-3).mean, <, 2e-3);
        REQUIRE_CMP(compare(&below, &at, 1e-3).mean, >, 1e-2);
        irb_image_destroy(&at);
        irb_image_destroy(&near);
        irb_image_destroy(&below);
    }
    fixture_frame_destroy(&f);
}

/* The low-resolution gather: where no sample agrees with a pixel the image is the full one, bit by
 * bit; else it lies near it, and the wider apart the samples, the more pixels are gathered again.
 */
static void test_interpolation(void **state)
{
    (void)state;
    const char *const names[] = {"polar", "all"}, *const scales[] = {"2", "4", "8"};
    struct fixture_frame f;
    struct irb_frame_output out;
    make_frame(&f, "cornell-objects", 131, 77, 40);
    for (int m = 0; m < 2; m++) {
        const char *settings[] = {"mode", names[m], "gather_scale", "1", "position_threshold",
                                  "0.2",  NULL};
        struct irb_image full = render(&f, settings, 0, &out);
        double share = 0;
        for (int k = 0; k < 3; k++) {
            settings[3] = scales[k];
            settings[5] = "0.2";
            struct irb_image low = render(&f, settings, 0, &out);
            assert_string_equal(out.statistics[1].name, "reevaluated");
            struct difference d = compare(&low, &full, 0);
            print_message("%s, scale %s: mean difference %.4f, re-evaluated %.3f\n", names[m],
                          scales[k], d.mean, out.statistics[1].value);
            REQUIRE_CMP(out.statistics[1].value, >, share);
            share = out.statistics[1].value;
            REQUIRE_CMP(share, <, 0.8);
            REQUIRE_CMP(d.mean, <, 0.1);
            irb_image_destroy(&low);
            settings[5] = "0";
            low = render(&f, settings, 0, &out);
            assert_memory_equal(low.data, full.data, irb_image_pixels(&full) * 16);
            irb_image_destroy(&low);
        }
        irb_image_destroy(&full);
    }
    fixture_frame_destroy(&f);
    make_frame(&f, "squares", 50, 38, 32);
    const char *const settings[] = {"position_threshold", "1", NULL};
    struct irb_image low = render(&f, settings, 0, &out);
    REQUIRE_CMP(out.statistics[1].value, <, 0.2); /* along the square's outline only */
    irb_image_destroy(&low);
    fixture_frame_destroy(&f);
}

/* Either layout of G-buffer and RSM in every mode; what the slim one costs is printed. */
static void test_slim_layouts(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct fixture_frame f, slim;
    struct irb_frame_output out;
    make_frame(&f, "cornell", 64, 48, 128);
    slim = f;
    slim.gbuffer = irb_gbuffer_create_layout(gl, IRB_LAYOUT_SLIM, 64, 48, &err);
    REQUIRE_OK(slim.gbuffer);
    slim.rsm = irb_rsm_create_layout(gl, IRB_LAYOUT_SLIM, 128, &err);
    REQUIRE_OK(slim.rsm);
    fixture_frame_render(&slim);
    static const char *const settings[][7] = {
        {"mode", "all", "clamp", "30"},
        {"mode", "importance", "clamp", "30"},
        {"clamp", "30"},
        {"gather_scale", "1", "fetch", "full", "clamp", "30"},
        {"mode", "all", "clamp", "30"},
        {"gather_scale", "1", "fetch", "full", "clamp", "30"}};
    struct irb_gbuffer *const slim_gbuffer = slim.gbuffer;
    struct irb_rsm *const slim_rsm = slim.rsm;
    for (int k = 0; k < 6; k++) {
        slim.gbuffer = k == 5 ? f.gbuffer : slim_gbuffer; /* one of the two alone */
        slim.rsm = k == 4 ? f.rsm : slim_rsm;
        struct irb_image a = render(&f, settings[k], 0, &out),
                         b = render(&slim, settings[k], 0, &out);
        struct difference d = compare(&b, &a, 1e-2);
        print_message("%s=%s: slim against full, mean %.2g, bias %+.2g\n", settings[k][0],
                      settings[k][1], d.mean, d.bias);
        REQUIRE_CMP(d.mean, <, k == 1 ? 0.05 : 0.01); /* importance draws other texels */
        REQUIRE_CMP(d.mean, >, 0);
        irb_image_destroy(&a);
        irb_image_destroy(&b);
    }
    irb_gbuffer_destroy(slim_gbuffer);
    irb_rsm_destroy(slim_rsm);
    fixture_frame_destroy(&f);
}

/* The same scene a thousand times smaller or larger, and far weaker or stronger light: E goes with
 * I/s^2, and a clamp takes the same share. */
static void test_scales(void **state)
{
    (void)state;
    const double scales[] = {1, 1e-3, 1e3}, intensities[] = {1, 1e6, 1e-6};
    struct irb_image first = {0};
    double first_lost = 0;
    const char *const settings[] = {"mode", "importance", "clamp", "5", NULL};
    for (int k = 0; k < 3; k++) {
        struct fixture_frame f;
        struct irb_frame_output out;
        struct irb_scene *scene = fixture_scene("cornell");
        float s = (float)scales[k];
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
        fixture_frame_create(&f, gl, scene, 24, 18, 64);
        f.light = light;
        f.camera = camera;
        fixture_frame_render(&f);
        struct irb_image e = render(&f, settings, 0, &out);
        double unit = intensities[k] / (scales[k] * scales[k]), sum = fixture_sum(&e, 1);
        if (k == 0) {
            first = e;
            first_lost = out.clamped_light;
        } else {
            REQUIRE_REL(sum / unit, fixture_sum(&first, 1), 2e-3);
            REQUIRE_REL(out.clamped_light, first_lost, 0.02);
            irb_image_destroy(&e);
        }
        fixture_frame_destroy(&f);
    }
    irb_image_destroy(&first);
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sphere),          cmocka_unit_test(test_squares),
        cmocka_unit_test(test_brute_force),     cmocka_unit_test(test_samples_converge),
        cmocka_unit_test(test_same_bits_twice), cmocka_unit_test(test_changing_frames),
        cmocka_unit_test(test_scales),          cmocka_unit_test(test_polar_brute_force),
        cmocka_unit_test(test_pattern),         cmocka_unit_test(test_polar_converges),
        cmocka_unit_test(test_packed),          cmocka_unit_test(test_normal_offset),
        cmocka_unit_test(test_interpolation),   cmocka_unit_test(test_slim_layouts),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failed;
}
