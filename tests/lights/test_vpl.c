/* SPDX-License-Identifier: MIT
 *
 * Virtual point lights against the RSM that they are drawn from, read back.
 */
#include "tests/support/compare.h"
#include "core/lights/vpl.h"
#include "tests/frame/fixture.h"

static struct irb_gl *gl;

struct vpl {
    float position[4], normal[4], flux[4];
};

static const double luminance_weights[3] = {0.2126, 0.7152, 0.0722};

static double luminance(const float flux[3])
{
    return flux[0] * luminance_weights[0] + flux[1] * luminance_weights[1] +
           flux[2] * luminance_weights[2];
}

/* The coloured box under its lamp. */
static void make_cornell(struct fixture_frame *f, int resolution)
{
    struct irb_error err = {0};
    struct irb_scene *scene = fixture_scene("cornell");
    fixture_frame_create(f, gl, scene, 1, 1, resolution);
    fixture_view(scene, &f->light, &f->camera);
    f->light.position[0] = 0.4f; /* off the middle, so that nothing is symmetric */
    REQUIRE_OK(irb_rsm_render(f->rsm, f->scene_gl, &f->light, &err));
}

static struct irb_vpl_set *sample(const struct irb_rsm *rsm, enum irb_vpl_sampling sampling,
                                  int samples, unsigned first)
{
    struct irb_error err = {0};
    struct irb_vpl_set *set = irb_vpl_set_create(gl, sampling, rsm->resolution, samples, &err);
    REQUIRE_OK(set);
    REQUIRE_OK(irb_vpl_set_sample(set, rsm, samples, first, &err));
    return set;
}

/* The lights in whole blocks; what follows `count` must be dark. */
static struct vpl *read_lights(const struct irb_vpl_set *set)
{
    struct irb_error err = {0};
    size_t lights = (size_t)irb_vpl_set_blocks(set) * IRB_VPL_BLOCK;
    struct vpl *vpls = malloc((lights + 1) * sizeof *vpls);
    REQUIRE_OK(!lights ||
               irb_buffer_read(set->lights, 0, (int64_t)(lights * sizeof *vpls), vpls, &err));
    for (size_t i = 0; i < lights; i++)
        for (int c = 0; c < 3; c++) {
            if ((int)i >= set->count)
                REQUIRE_NEAR(vpls[i].flux[c], 0, 0);
            assert_true(isfinite(vpls[i].flux[c]) && vpls[i].flux[c] >= 0);
        }
    return vpls;
}

static void sum_flux(const struct vpl *vpls, int count, double sum[3])
{
    for (int c = 0; c < 3; c++) {
        sum[c] = 0;
        for (int i = 0; i < count; i++)
            sum[c] += vpls[i].flux[c];
    }
}

/* Every lit texel once, in raster order from the bottom row, bit by bit. */
static void test_all(void **state)
{
    (void)state;
    const int resolutions[] = {1, 2, 33, 100};
    for (int k = 0; k < 4; k++) {
        const int n = resolutions[k];
        struct fixture_frame f;
        make_cornell(&f, n);
        struct irb_vpl_set *set = sample(f.rsm, IRB_VPL_ALL, 1, 0);
        struct vpl *vpls = read_lights(set);
        struct irb_image flux = fixture_read(f.rsm->flux, 4);
        struct irb_image position = fixture_read(f.rsm->position, 4);
        struct irb_image normal = fixture_read(f.rsm->normal, 4);
        int next = 0;
        for (int y = n - 1; y >= 0; y--)
            for (int x = 0; x < n; x++) {
                if (!(luminance(irb_image_at(&flux, x, y)) > 0))
                    continue;
                REQUIRE_CMP(next, <, set->count);
                assert_memory_equal(vpls[next].flux, irb_image_at(&flux, x, y), 12);
                assert_memory_equal(vpls[next].position, irb_image_at(&position, x, y), 12);
                assert_memory_equal(vpls[next].normal, irb_image_at(&normal, x, y), 12);
                next++;
            }
        REQUIRE_NEAR(set->count, next, 0);
        REQUIRE_CMP(next, >, 0);
        irb_image_destroy(&flux);
        irb_image_destroy(&position);
        irb_image_destroy(&normal);
        free(vpls);
        irb_vpl_set_destroy(set);
        fixture_frame_destroy(&f);
    }
}

/* The sum of the drawn flux approaches the RSM's as the samples grow. */
static void test_flux_converges(void **state)
{
    (void)state;
    struct fixture_frame f;
    make_cornell(&f, 100);
    struct irb_image flux = fixture_read(f.rsm->flux, 4);
    /* Halton points: O(log^2 N / N) for the smooth part, and the rims of colour and cone */
    const int samples[] = {64, 1024, 16384};
    const double allowed[] = {0.15, 0.03, 0.005};
    for (int sampling = IRB_VPL_UNIFORM; sampling <= IRB_VPL_IMPORTANCE; sampling++)
        for (int k = 0; k < 3; k++) {
            struct irb_vpl_set *set = sample(f.rsm, (enum irb_vpl_sampling)sampling, samples[k], 0);
            struct vpl *vpls = read_lights(set);
            double sum[3];
            sum_flux(vpls, set->count, sum);
            for (int c = 0; c < 3; c++)
                REQUIRE_REL(sum[c], fixture_sum(&flux, c), allowed[k]);
            free(vpls);
            irb_vpl_set_destroy(set);
        }
    irb_image_destroy(&flux);
    fixture_frame_destroy(&f);
}

/* Index of the texel that a light stands on, by its position. */
static size_t texel_of(const struct irb_image *position, const float at[3])
{
    for (size_t i = 0; i < irb_image_pixels(position); i++)
        if (!memcmp(position->data + 4 * i, at, 12))
            return i;
    fail_msg("a light stands on no texel: %g %g %g", at[0], at[1], at[2]);
    return 0;
}

/* Importance: Phi = Phi_p/(N p_p) with p_p = Phi_p/sum by luminance, texel by texel, and as many
 * lights on each region as chi^2 allows (8 x 8 regions; Halton points are more even than random
 * ones, so the statistic must not exceed its mean by 5 standard deviations). */
static void test_importance(void **state)
{
    (void)state;
    enum { N = 48, SAMPLES = 4096, CELLS = 8 };
    struct fixture_frame f;
    make_cornell(&f, N); /* no power of two: the pyramid is padded */
    struct irb_image flux = fixture_read(f.rsm->flux, 4);
    struct irb_image position = fixture_read(f.rsm->position, 4);
    struct irb_vpl_set *set = sample(f.rsm, IRB_VPL_IMPORTANCE, SAMPLES, 0);
    struct vpl *vpls = read_lights(set);
    double total = 0, expected[CELLS * CELLS] = {0}, found[CELLS * CELLS] = {0};
    for (size_t i = 0; i < N * N; i++)
        total += luminance(flux.data + 4 * i);
    for (size_t i = 0; i < N * N; i++)
        expected[i / N * CELLS / N * CELLS + i % N * CELLS / N] +=
            SAMPLES * luminance(flux.data + 4 * i) / total;
    REQUIRE_NEAR(set->count, SAMPLES, 0);
    for (int i = 0; i < SAMPLES; i++) {
        size_t p = texel_of(&position, vpls[i].position);
        for (size_t c = 0; c < 3; c++)
            REQUIRE_REL(vpls[i].flux[c],
                        flux.data[4 * p + c] * total / (SAMPLES * luminance(flux.data + 4 * p)),
                        1e-5);
        found[p / N * CELLS / N * CELLS + p % N * CELLS / N]++;
    }
    double chi2 = 0;
    int degrees = -1;
    for (int i = 0; i < CELLS * CELLS; i++) {
        if (expected[i] < 5)
            continue;
        chi2 += (found[i] - expected[i]) * (found[i] - expected[i]) / expected[i];
        degrees++;
    }
    REQUIRE_CMP(degrees, >, 30);
    REQUIRE_CMP(chi2, <, degrees + 5 * sqrt(2.0 * degrees));
    irb_image_destroy(&flux);
    irb_image_destroy(&position);
    free(vpls);
    irb_vpl_set_destroy(set);
    fixture_frame_destroy(&f);
}

/* Two stretches of the sequence are the lights of one stretch of twice the length. */
static void test_sequence_goes_on(void **state)
{
    (void)state;
    struct fixture_frame f;
    make_cornell(&f, 64);
    for (int sampling = IRB_VPL_UNIFORM; sampling <= IRB_VPL_IMPORTANCE; sampling++) {
        enum irb_vpl_sampling s = (enum irb_vpl_sampling)sampling;
        struct irb_vpl_set *whole = sample(f.rsm, s, 200, 0), *one = sample(f.rsm, s, 100, 0);
        struct irb_vpl_set *two = sample(f.rsm, s, 100, 100);
        struct vpl *all = read_lights(whole), *first = read_lights(one), *rest = read_lights(two);
        REQUIRE_NEAR(whole->count, one->count + two->count, 0);
        for (int i = 0; i < whole->count; i++) {
            const struct vpl *part = i < one->count ? &first[i] : &rest[i - one->count];
            assert_memory_equal(all[i].position, part->position, 12);
            REQUIRE_REL(part->flux[0], 2 * all[i].flux[0], 1e-6);
        }
        free(all);
        free(first);
        free(rest);
        irb_vpl_set_destroy(whole);
        irb_vpl_set_destroy(one);
        irb_vpl_set_destroy(two);
    }
    fixture_frame_destroy(&f);
}

/* Interleaved sampling's tiles: the same lights in another order, light l of tile l mod 9 being the
 * next of that tile's stretch; and every tile's lights reach over a third of the map's rows at
 * least, while the sequence's own order gives each about a ninth of the flux. */
static void test_tiles(void **state)
{
    (void)state;
    enum { SAMPLES = 100, TILES = 9, N = 64 };
    struct irb_error err = {0};
    struct fixture_frame f;
    make_cornell(&f, N);
    struct irb_image position = fixture_read(f.rsm->position, 4);
    struct irb_vpl_set *set = sample(f.rsm, IRB_VPL_IMPORTANCE, SAMPLES, 3);
    struct vpl *in_order = read_lights(set);
    set->tiles = TILES;
    REQUIRE_OK(irb_vpl_set_sample(set, f.rsm, SAMPLES, 3, &err));
    struct vpl *tiled = read_lights(set);
    REQUIRE_NEAR(set->count, SAMPLES, 0);
    int next = 0;
    for (int tile = 0; tile < TILES; tile++) {
        size_t low[2] = {N, N}, high[2] = {0, 0};
        for (int l = tile; l < SAMPLES; l += TILES) {
            const struct vpl *both[2] = {&tiled[l], &in_order[l]};
            assert_memory_equal(&tiled[l], &in_order[next++], sizeof *tiled);
            for (int k = 0; k < 2; k++) {
                size_t row = texel_of(&position, both[k]->position) / N;
                low[k] = row < low[k] ? row : low[k];
                high[k] = row > high[k] ? row : high[k];
            }
        }
        REQUIRE_CMP(high[0] - low[0], >, N / 3);
        REQUIRE_CMP(high[1] - low[1], <, N / 4);
    }
    free(in_order);
    free(tiled);
    irb_image_destroy(&position);
    irb_vpl_set_destroy(set);
    fixture_frame_destroy(&f);
}

/* A map of the caller's: Phi = Phi_p/(N p_p) with p_p = map_p/sum, lights on unlit texels dropped,
 * and the sum of the flux that of the RSM, since the map is positive. A map of zeros gives no
 * lights. */
static void test_map(void **state)
{
    (void)state;
    enum { N = 48, SAMPLES = 4096 };
    struct irb_error err = {0};
    struct fixture_frame f;
    make_cornell(&f, N);
    const struct irb_texture_desc desc = {
        .name = "map", .format = GL_R32F, .width = N, .height = N};
    struct irb_texture *texture = irb_texture_create(gl, &desc, &err);
    struct irb_pyramid *pyramid = irb_pyramid_create(gl, N, &err);
    struct irb_vpl_set *set = irb_vpl_set_create(gl, IRB_VPL_MAP, N, SAMPLES, &err);
    struct irb_image map, flux = fixture_read(f.rsm->flux, 4);
    struct irb_image position = fixture_read(f.rsm->position, 4);
    REQUIRE_OK(texture && pyramid && set && irb_image_create(&map, N, N, 1, &err));
    double total = 0, sum[3];
    for (size_t i = 0; i < N * N; i++)
        total += map.data[i] = 0.1f + (float)(i % N) / N;
    REQUIRE_OK(irb_texture_write(texture, &map, &err));
    REQUIRE_OK(irb_pyramid_build(pyramid, texture, &err));
    REQUIRE_OK(irb_vpl_set_sample_map(set, f.rsm, pyramid, SAMPLES, 0, &err));
    struct vpl *vpls = read_lights(set);
    REQUIRE_CMP(set->count, <, SAMPLES); /* the image's corners are unlit */
    for (int i = 0; i < set->count; i++) {
        size_t p = texel_of(&position, vpls[i].position);
        for (size_t c = 0; c < 3; c++)
            REQUIRE_REL(vpls[i].flux[c],
                        flux.data[4 * p + c] * total / ((double)SAMPLES * map.data[p]), 1e-5);
        REQUIRE_NEAR(vpls[i].position[3], 0, 0); /* a point has no area */
    }
    sum_flux(vpls, set->count, sum);
    for (int c = 0; c < 3; c++)
        REQUIRE_REL(sum[c], fixture_sum(&flux, c), 0.01);
    assert_int_equal(irb_vpl_set_view(set).count, set->count);
    assert_false(irb_vpl_set_sample(set, f.rsm, SAMPLES, 0, &err));
    assert_int_equal(err.code, IRB_E_INTERNAL);
    memset(map.data, 0, N * N * sizeof *map.data);
    REQUIRE_OK(irb_texture_write(texture, &map, &err));
    REQUIRE_OK(irb_pyramid_build(pyramid, texture, &err));
    REQUIRE_OK(irb_vpl_set_sample_map(set, f.rsm, pyramid, SAMPLES, 0, &err));
    REQUIRE_NEAR(set->count, 0, 0);
    free(vpls);
    irb_image_destroy(&map);
    irb_image_destroy(&flux);
    irb_image_destroy(&position);
    irb_texture_destroy(texture);
    irb_pyramid_destroy(pyramid);
    irb_vpl_set_destroy(set);
    fixture_frame_destroy(&f);
}

/* An RSM of the given flux; positions are 0. */
static void fill_rsm(const struct irb_rsm *rsm, const struct irb_image *flux)
{
    struct irb_error err = {0};
    struct irb_image zero;
    REQUIRE_OK(irb_image_create(&zero, rsm->resolution, rsm->resolution, 4, &err));
    REQUIRE_OK(irb_texture_write(rsm->position, &zero, &err));
    REQUIRE_OK(irb_texture_write(rsm->normal, &zero, &err));
    REQUIRE_OK(irb_texture_write(rsm->flux, flux, &err));
    irb_image_destroy(&zero);
}

/* No texel lit, black surfaces (flux in, none out), one texel lit, the far corner's too, and one
 * that is brighter than all others by nine orders of magnitude. */
static void test_few_texels(void **state)
{
    (void)state;
    struct irb_error err = {0};
    const int resolutions[] = {1, 5, 64};
    for (int k = 0; k < 3; k++) {
        const int n = resolutions[k];
        struct irb_rsm *rsm = irb_rsm_create(gl, n, &err);
        REQUIRE_OK(rsm);
        for (int kind = 0; kind < 5; kind++) {
            struct irb_image flux;
            REQUIRE_OK(irb_image_create(&flux, n, n, 4, &err));
            size_t last = 4 * irb_image_pixels(&flux) - 4;
            for (size_t i = 0; i <= last; i += 4) {
                flux.data[i + 3] = kind == 1;
                flux.data[i] = kind == 4 ? 1e-9f : 0;
            }
            if (kind >= 2)
                flux.data[kind == 2 ? 1 : last + 1] = 2;
            fill_rsm(rsm, &flux);
            for (int sampling = 0; sampling <= IRB_VPL_IMPORTANCE; sampling++) {
                struct irb_vpl_set *set = sample(rsm, (enum irb_vpl_sampling)sampling, 100, 0);
                struct vpl *vpls = read_lights(set);
                double sum[3];
                sum_flux(vpls, set->count, sum);
                if (kind < 2)
                    REQUIRE_NEAR(set->count, 0, 0);
                else if (sampling != IRB_VPL_UNIFORM)
                    REQUIRE_REL(sum[1], 2, 1e-5);
                free(vpls);
                irb_vpl_set_destroy(set);
            }
            irb_image_destroy(&flux);
        }
        irb_rsm_destroy(rsm);
    }
}

static void test_refusals(void **state)
{
    (void)state;
    struct irb_error err = {0};
    assert_null(irb_vpl_set_create(gl, IRB_VPL_UNIFORM, 16, 1 << 30, &err));
    assert_int_equal(err.code, IRB_E_INPUT);
    REQUIRE_CONTAINS(err.message, "fewer samples");
    assert_null(irb_vpl_set_create(gl, IRB_VPL_ALL, 40000, 1, &err));
    assert_int_equal(err.code, IRB_E_INPUT);
    struct irb_rsm *rsm = irb_rsm_create(gl, 8, &err);
    struct irb_vpl_set *set = irb_vpl_set_create(gl, IRB_VPL_UNIFORM, 8, 10, &err);
    REQUIRE_OK(rsm && set);
    assert_false(irb_vpl_set_sample(set, rsm, 11, 0, &err));
    assert_int_equal(err.code, IRB_E_INTERNAL);
    irb_vpl_set_destroy(set);
    irb_rsm_destroy(rsm);
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_all),        cmocka_unit_test(test_flux_converges),
        cmocka_unit_test(test_importance), cmocka_unit_test(test_sequence_goes_on),
        cmocka_unit_test(test_tiles),      cmocka_unit_test(test_map),
        cmocka_unit_test(test_few_texels), cmocka_unit_test(test_refusals),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failed;
}
