/* SPDX-License-Identifier: MIT
 *
 * acrsm's clustering where sums vanish: few or no lit texels, black surfaces, both sides of a thin
 * wall; lights of any intensity; the same bits twice.
 */
#include "tests/support/compare.h"
#include "tests/methods/acrsm_fixture.h"

static struct irb_gl *gl;

enum { N = 64 };

/* An RSM of the floor's light whose texels are written by hand. */
struct hand {
    struct acrsm_fixture a;
    struct irb_image position, normal, flux, importance;
};

static struct irb_image new_image(int channels)
{
    struct irb_error err = {0};
    struct irb_image image;
    REQUIRE_OK(irb_image_create(&image, N, N, channels, &err));
    memset(image.data, 0, irb_image_pixels(&image) * (size_t)channels * sizeof(float));
    return image;
}

static void hand_create(struct hand *h, int clusters)
{
    static const float white[3] = {1, 1, 1}, above[3] = {0, 1, 0}, origin[3] = {0};
    acrsm_fixture_create(&h->a, gl, fixture_floor(1, white), N, clusters);
    struct irb_light light = fixture_spot(above, origin, 40);
    acrsm_fixture_rsm(&h->a, &light);
    h->position = fixture_read(h->a.f.rsm->position, 4);
    h->normal = fixture_read(h->a.f.rsm->normal, 4);
    h->flux = new_image(4);
    h->importance = new_image(1);
}

static void hand_write(struct hand *h)
{
    struct irb_error err = {0};
    struct irb_rsm *rsm = h->a.f.rsm;
    REQUIRE_OK(irb_texture_write(rsm->position, &h->position, &err) &&
               irb_texture_write(rsm->normal, &h->normal, &err) &&
               irb_texture_write(rsm->flux, &h->flux, &err) &&
               irb_texture_write(h->a.importance->map, &h->importance, &err));
    REQUIRE_OK(irb_pyramid_build(h->a.pyramid, h->a.importance->map, &err));
}

static void hand_destroy(struct hand *h)
{
    irb_image_destroy(&h->position);
    irb_image_destroy(&h->normal);
    irb_image_destroy(&h->flux);
    irb_image_destroy(&h->importance);
    acrsm_fixture_destroy(&h->a);
}

/* The i-th of some texels that are strewn over the map; in the order of images. */
static size_t strewn(int i)
{
    return (size_t)i * 1999 % (N * N);
}

static void require_finite(const struct acrsm_fixture *a)
{
    struct irb_error err = {0};
    struct acrsm_cluster state[ACRSM_CLUSTERS_MOST];
    float lights[12 * ACRSM_CLUSTERS_MOST];
    float evaluation[4 * ACRSM_CLUSTERS_MOST];
    acrsm_fixture_state(a, state);
    REQUIRE_OK(irb_buffer_read(a->clusters->lights, 0, sizeof lights, lights, &err));
    REQUIRE_OK(irb_buffer_read(a->clusters->evaluation, 0, sizeof evaluation, evaluation, &err));
    for (int i = 0; i < 12 * ACRSM_CLUSTERS_MOST; i++)
        assert_true(isfinite(lights[i]));
    for (int i = 0; i < 4 * ACRSM_CLUSTERS_MOST; i++)
        assert_true(isfinite(evaluation[i]));
    for (int i = 0; i < ACRSM_CLUSTERS_MOST; i++) {
        const float *values = (const float *)&state[i];
        for (size_t k = 0; k < offsetof(struct acrsm_cluster, count) / sizeof(float); k++)
            assert_true(isfinite(values[k]));
        if (state[i].count <= 0)
            continue;
        REQUIRE_NEAR(fixture_dot(state[i].normal, state[i].normal), 1, 1e-4);
        REQUIRE_CMP(state[i].area, >, 0);
    }
}

/* Frames with every switch that has formulas of its own. */
static void run_all_switches(struct acrsm_fixture *a)
{
    for (int flux = ACRSM_FLUX_SUM; flux <= ACRSM_FLUX_CENTER_AREA; flux++)
        for (int area = ACRSM_AREA_MAX; area <= ACRSM_AREA_MOMENT; area++) {
            a->settings.flux = flux;
            a->settings.area = area;
            a->settings.cover = area;
            a->settings.normals = flux & 1;
            a->settings.neighbours = area;
            a->settings.merge = a->settings.split = 0.01f;
            acrsm_fixture_frame(a);
            require_finite(a);
            struct acrsm_report report = acrsm_fixture_report(a);
            assert_true(isfinite(report.spread) && isfinite(report.uncovered) &&
                        isfinite(report.gain));
        }
}

static void test_few_texels(void **state)
{
    (void)state;
    const int counts[] = {ACRSM_CLUSTERS_LEAST, ACRSM_CLUSTERS_MOST};
    for (int k = 0; k < 2; k++) {
        const int lit[] = {0, 1, counts[k] - 1};
        for (int l = 0; l < 3; l++)
            for (int important = 0; important < 2; important++) {
                struct hand h;
                hand_create(&h, counts[k]);
                h.a.settings.extent = 1;
                for (int i = 0; i < lit[l]; i++) {
                    h.flux.data[4 * strewn(i) + 1] = 1e-3f;
                    h.importance.data[strewn(i)] = important ? 0.5f : 0;
                }
                hand_write(&h);
                run_all_switches(&h.a);
                struct acrsm_report report = acrsm_fixture_report(&h.a);
                REQUIRE_CMP(report.in_use, <=, lit[l]);
                /* with importance, seeds find what light there is */
                if (important && lit[l])
                    REQUIRE_CMP(report.in_use, >=, 1);
                hand_destroy(&h);
            }
    }
}

/* Flux comes in, none goes out: there is nothing to cluster. */
static void test_black(void **state)
{
    (void)state;
    static const float black[3] = {0}, above[3] = {0, 1, 0}, origin[3] = {0};
    struct acrsm_fixture a;
    acrsm_fixture_create(&a, gl, fixture_floor(1, black), N, 32);
    struct irb_light light = fixture_spot(above, origin, 40);
    acrsm_fixture_rsm(&a, &light);
    run_all_switches(&a);
    REQUIRE_NEAR(acrsm_fixture_report(&a).in_use, 0, 0);
    acrsm_fixture_destroy(&a);
}

/* Light goes out for some frames and comes back: the clusters do, too. */
static void test_light_returns(void **state)
{
    (void)state;
    struct hand h;
    hand_create(&h, 64);
    for (int round = 0; round < 4; round++) {
        for (size_t i = 0; i < N * N; i++)
            h.flux.data[4 * i] = h.importance.data[i] = round % 2 ? 0 : 0.01f;
        hand_write(&h);
        for (int frame = 0; frame < 3; frame++)
            acrsm_fixture_frame(&h.a);
        require_finite(&h.a);
        REQUIRE_NEAR(acrsm_fixture_report(&h.a).in_use, round % 2 ? 0 : 64, round % 2 ? 0 : 1);
    }
    hand_destroy(&h);
}

/* A wall of no thickness, lit from both sides in turn from texel to texel: |n_c.n| puts both into
 * one cluster, whose mean normal vanishes. It takes that of the texel at its centre. */
static void test_thin_wall(void **state)
{
    (void)state;
    for (int normals = ACRSM_NORMALS_ABS; normals <= ACRSM_NORMALS_SIGNED; normals++) {
        struct hand h;
        struct acrsm_cluster clusters[ACRSM_CLUSTERS_MOST];
        hand_create(&h, 16);
        for (size_t i = 0; i < N * N; i++) {
            h.flux.data[4 * i] = h.importance.data[i] = 0.5f;
            h.normal.data[4 * i + 1] = (i + i / N) % 2 ? 1 : -1;
        }
        hand_write(&h);
        h.a.settings.normals = normals;
        run_all_switches(&h.a);
        h.a.settings.normals = normals;
        for (int frame = 0; frame < 4; frame++)
            acrsm_fixture_frame(&h.a);
        require_finite(&h.a);
        acrsm_fixture_state(&h.a, clusters);
        for (int i = 0; i < 16; i++) {
            if (clusters[i].count <= 0)
                continue;
            int p = acrsm_centre_y(&clusters[i], N) * N + acrsm_centre_x(&clusters[i], N);
            REQUIRE_NEAR(fabs(clusters[i].normal[1]), 1, 1e-5);
            if (normals == ACRSM_NORMALS_ABS && clusters[i].count > 64)
                REQUIRE_NEAR(fabs(acrsm_texel(&h.normal, p)[1]), 1, 1e-5);
        }
        hand_destroy(&h);
    }
}

/* The clustering does not know the light's unit: a power of two changes no bit, any other factor
 * no more than rounding does. */
static void test_intensity(void **state)
{
    (void)state;
    const double factors[] = {1, 0x1p-10, 0x1p10, 1e-3, 1e3};
    const int frames = 6;
    int32_t *first[6];
    for (int k = 0; k < 5; k++) {
        struct acrsm_fixture a;
        acrsm_fixture_create(&a, gl, fixture_scene("cornell"), 96, 64);
        for (int frame = 0; frame < frames; frame++) {
            struct irb_light light = acrsm_fixture_light(0.05 * frame);
            for (int c = 0; c < 3; c++)
                light.intensity[c] *= (float)factors[k];
            acrsm_fixture_rsm(&a, &light);
            acrsm_fixture_frame(&a);
            int32_t *map = acrsm_fixture_map(&a);
            int others = 0;
            for (int p = 0; k > 0 && p < 96 * 96; p++)
                others += map[2 * p] != first[frame][2 * p];
            REQUIRE_CMP(others, <=, k < 3 ? 0 : 96 * 96 * 1e-3);
            if (k == 0)
                first[frame] = map;
            else
                free(map);
        }
        acrsm_fixture_destroy(&a);
    }
    for (int frame = 0; frame < frames; frame++)
        free(first[frame]);
}

/* Kilometres off the origin, where single precision resolves a tenth of a millimetre: sums are
 * taken from the cluster's centre, so that the means stay on the surface. */
static void test_far_off(void **state)
{
    (void)state;
    const float offset = 1024;
    struct hand h;
    struct acrsm_cluster clusters[ACRSM_CLUSTERS_MOST];
    hand_create(&h, 16);
    for (size_t i = 0; i < N * N; i++) {
        h.flux.data[4 * i] = h.importance.data[i] = 0.5f;
        for (size_t c = 0; c < 3; c++)
            h.position.data[4 * i + c] += offset;
    }
    hand_write(&h);
    for (int frame = 0; frame < 3; frame++)
        acrsm_fixture_frame(&h.a);
    acrsm_fixture_state(&h.a, clusters);
    for (int i = 0; i < 16; i++)
        REQUIRE_NEAR(clusters[i].position[1], offset, 2e-4);
    hand_destroy(&h);
}

/* Two runs in contexts of their own. */
static void test_same_bits(void **state)
{
    (void)state;
    struct acrsm_cluster found[2][ACRSM_CLUSTERS_MOST];
    int32_t *maps[2];
    for (int run = 0; run < 2; run++) {
        struct acrsm_fixture a;
        acrsm_fixture_create(&a, gl, fixture_scene("cornell-objects"), 128, 100);
        a.settings.merge = 0.1f;
        a.settings.split = 0.02f;
        for (int frame = 0; frame < 8; frame++) {
            struct irb_light light = acrsm_fixture_light(0.1 * frame);
            acrsm_fixture_rsm(&a, &light);
            acrsm_fixture_frame(&a);
        }
        acrsm_fixture_state(&a, found[run]);
        maps[run] = acrsm_fixture_map(&a);
        acrsm_fixture_destroy(&a);
    }
    assert_memory_equal(found[0], found[1], sizeof found[0]);
    assert_memory_equal(maps[0], maps[1], 128 * 128 * 8);
    free(maps[0]);
    free(maps[1]);
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_few_texels),    cmocka_unit_test(test_black),
        cmocka_unit_test(test_light_returns), cmocka_unit_test(test_thin_wall),
        cmocka_unit_test(test_intensity),     cmocka_unit_test(test_far_off),
        cmocka_unit_test(test_same_bits),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failed;
}
