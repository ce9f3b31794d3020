/* SPDX-License-Identifier: MIT
 *
 * Discs and polygons of clusters: areas against surfaces of known size, hulls against the texels
 * they enclose.
 */
#include "tests/support/compare.h"
#include "methods/rsm_clustering/area_lights.h"
#include "tests/frame/fixture.h"

static struct irb_gl *gl;

enum { N = 96, MOST_CORNERS = 16 };

struct disc {
    float position[3], area, normal[3], unused, flux[3], unused_too;
};

struct polygon {
    float centre[3], area, normal[3], radius, flux[3], unused;
    float plane[MOST_CORNERS][2];  /* as many as there are */
    float corner[MOST_CORNERS][3]; /* from these, world */
};

/* A floor of 2 x 2 m under a spot light 3 m above, off its middle: all of it is lit. */
static void make_floor(struct fixture_frame *f, enum irb_layout layout)
{
    struct irb_error err = {0};
    const float grey[3] = {0.5f, 0.5f, 0.5f};
    fixture_frame_create(f, gl, fixture_floor(1, grey), 8, 8, N);
    irb_rsm_destroy(f->rsm);
    REQUIRE_OK(f->rsm = irb_rsm_create_layout(gl, layout, N, &err));
    f->light = fixture_spot((const float[3]){0.5f, 3, 0.2f}, (const float[3]){0, 0, 0}, 35);
    f->light.falloff = IRB_FALLOFF_CONSTANT;
    REQUIRE_OK(irb_rsm_render(f->rsm, f->scene_gl, &f->light, &err));
}

/* Clusters after two frames, seeded by flux. */
static struct rsc_clusters *cluster(const struct fixture_frame *f, const struct rsc_settings *s)
{
    struct irb_error err = {0};
    struct irb_pyramid *pyramid = irb_pyramid_create(gl, N, &err);
    struct rsc_clusters *c = rsc_clusters_create(gl, N, &err);
    REQUIRE_OK(pyramid && c);
    REQUIRE_OK(irb_pyramid_build_flux(pyramid, f->rsm, &err));
    REQUIRE_OK(rsc_clusters_prepare(c, s, &err));
    for (int i = 0; i < 2; i++)
        REQUIRE_OK(rsc_clusters_seed(c, f->rsm, pyramid, s, &err) &&
                   rsc_clusters_grid(c, s, &err) && rsc_clusters_assign(c, f->rsm, s, &err) &&
                   rsc_clusters_sort(c, f->rsm, s, &err) &&
                   rsc_clusters_update(c, f->rsm, s, &err));
    irb_pyramid_destroy(pyramid);
    return c;
}

static struct rsc_area_lights *make(const struct fixture_frame *f, const struct rsc_clusters *c,
                                    const struct rsc_settings *s, enum rsc_area area, int corners)
{
    struct irb_error err = {0};
    struct rsc_area_lights *lights = rsc_area_lights_create(gl, &err);
    REQUIRE_OK(lights);
    REQUIRE_OK(rsc_area_lights_prepare(lights, s->clusters, corners, &err));
    REQUIRE_OK(rsc_area_lights_make(lights, c, f->rsm, s, area, corners, &err));
    return lights;
}

static struct disc *read_discs(const struct rsc_area_lights *lights)
{
    struct irb_error err = {0};
    struct disc *discs = malloc((size_t)lights->discs->bytes);
    REQUIRE_OK(irb_buffer_read(lights->discs, 0, lights->discs->bytes, discs, &err));
    for (int i = lights->count; i < IRB_VPL_BLOCK; i++) /* dark to the end of the block */
        REQUIRE_NEAR(discs[i].flux[0] + discs[i].flux[1] + discs[i].flux[2] + discs[i].area, 0, 0);
    return discs;
}

static struct polygon read_polygon(const struct rsc_area_lights *lights, int i)
{
    struct irb_error err = {0};
    struct polygon p;
    const int64_t bytes = 48 + lights->corners * (int64_t)8;
    REQUIRE_OK(irb_buffer_read(lights->polygons, i * bytes, bytes, &p, &err));
    /* Duff et al. 2017, as shaders/lights/paraboloid.glsl */
    const float *n = p.normal, s = copysignf(1, n[2]), a = -1 / (s + n[2]), b = n[0] * n[1] * a;
    const float t[3] = {1 + s * n[0] * n[0] * a, s * b, -s * n[0]};
    const float u[3] = {b, s + n[1] * n[1] * a, -n[1]};
    for (int k = 0; k < lights->corners; k++)
        for (int m = 0; m < 3; m++)
            p.corner[k][m] = p.centre[m] + p.plane[k][0] * t[m] + p.plane[k][1] * u[m];
    return p;
}

static double sum_areas(const struct fixture_frame *f, const struct rsc_settings *s,
                        enum rsc_area area)
{
    struct rsc_clusters *c = cluster(f, s);
    struct rsc_area_lights *lights = make(f, c, s, area, 0);
    struct disc *discs = read_discs(lights);
    double sum = 0;
    for (int i = 0; i < s->clusters; i++) {
        REQUIRE_CMP(discs[i].area, >=, 0);
        sum += discs[i].area;
    }
    free(discs);
    rsc_area_lights_destroy(lights);
    rsc_clusters_destroy(c);
    return sum;
}

/* The texels' areas add up to the floor's 4 m2, however many clusters there are and whichever way
 * they find their texels. The second moment of a square is that of a disc of pi/3 its area; of
 * compact clusters the areas come out a little above the floor's. The farthest texel's disc is far
 * too large: for the square pi/2 of it at least. */
static void test_areas(void **state)
{
    (void)state;
    for (int layout = IRB_LAYOUT_FULL; layout <= IRB_LAYOUT_SLIM; layout++) {
        struct fixture_frame f;
        make_floor(&f, (enum irb_layout)layout);
        const int last = layout == IRB_LAYOUT_FULL ? RSC_DIRECT : RSC_SORT;
        for (int reduction = RSC_SORT; reduction <= last; reduction++) {
            const double texels = sum_areas(
                &f,
                &(struct rsc_settings){.clusters = 1, .weight_distance = 1, .reduction = reduction},
                RSC_AREA_TEXELS);
            REQUIRE_REL(texels, 4, 0.02); /* whole texels at the floor's rim */
            for (int k = 9; k <= 300; k += 291) {
                const struct rsc_settings s = {.clusters = k,
                                               .weight_distance = 1,
                                               .reach = 2,
                                               .reduction = (enum rsc_reduction)reduction};
                const double sum = sum_areas(&f, &s, RSC_AREA_TEXELS);
                const double moment = sum_areas(&f, &s, RSC_AREA_MOMENT);
                const double most = sum_areas(&f, &s, RSC_AREA_MAX);
                if (reduction == RSC_SORT)
                    print_message(
                        "%d clusters of 4 m2: %.3f by texels, %.3f by moment, %.3f by the "
                        "farthest texel\n",
                        k, sum, moment, most);
                REQUIRE_REL(sum, texels, 1e-4);
                REQUIRE_CMP(moment, >, 0.98 * texels);
                REQUIRE_CMP(moment, <, 1.25 * texels);
                REQUIRE_CMP(most, >, 1.2 * texels);
                REQUIRE_CMP(most, <, 4 * texels);
            }
        }
        const struct rsc_settings one = {.clusters = 1, .weight_distance = 1, .reach = 2};
        /* weighted by flux, which falls off a little towards the corners */
        REQUIRE_REL(sum_areas(&f, &one, RSC_AREA_MOMENT), M_PI / 3 * 4, 0.1);
        REQUIRE_CMP(sum_areas(&f, &one, RSC_AREA_MAX), >, M_PI / 2 * 4);
        fixture_frame_destroy(&f);
    }
}

static void sub(const float a[3], const float b[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = (double)a[i] - b[i];
}

static void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* Convex, counter-clockwise round the normal, in the plane; the stated area is the corners'. */
static void check_polygon(const struct polygon *p, int corners)
{
    double area[3] = {0};
    for (int i = 0; i < corners; i++) {
        double a[3], b[3], ab[3], bc[3], turn[3];
        sub(p->corner[i], p->centre, a);
        sub(p->corner[(i + 1) % corners], p->centre, b);
        sub(p->corner[(i + 1) % corners], p->corner[i], ab);
        sub(p->corner[(i + 2) % corners], p->corner[(i + 1) % corners], bc);
        cross(ab, bc, turn);
        REQUIRE_CMP(turn[0] * p->normal[0] + turn[1] * p->normal[1] + turn[2] * p->normal[2], >=,
                    -1e-6 * p->area);
        REQUIRE_NEAR(a[0] * p->normal[0] + a[1] * p->normal[1] + a[2] * p->normal[2], 0,
                     1e-5 * p->radius);
        REQUIRE_CMP(sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]), <=, p->radius * (1 + 1e-5));
        cross(a, b, turn);
        for (int m = 0; m < 3; m++)
            area[m] += 0.5 * turn[m];
    }
    REQUIRE_REL(area[0] * p->normal[0] + area[1] * p->normal[1] + area[2] * p->normal[2], p->area,
                1e-4);
}

/* Share of the cluster's texels that the polygon encloses. */
static double enclosed(const struct polygon *p, int corners, const int *map, int id,
                       const struct irb_image *position)
{
    int all = 0, inside = 0;
    for (int i = 0; i < N * N; i++) {
        if (map[i] != id)
            continue;
        const float *x = irb_image_at(position, i % N, N - 1 - i / N);
        bool in = true;
        for (int k = 0; k < corners; k++) {
            double edge[3], to[3], side[3];
            sub(p->corner[(k + 1) % corners], p->corner[k], edge);
            sub(x, p->corner[k], to);
            cross(edge, to, side);
            in = in && side[0] * p->normal[0] + side[1] * p->normal[1] + side[2] * p->normal[2] >
                           -1e-6 * p->area;
        }
        all++;
        inside += in;
    }
    return all ? (double)inside / all : 1;
}

/* Hulls are convex and enclose their texels, but for slivers between the 8 or 16 directions; their
 * areas add up to a little more than the floor, the more so the smaller they are, since hulls reach
 * over to texels of other clusters. Flux is the cluster's. */
static void test_polygons(void **state)
{
    (void)state;
    struct fixture_frame f;
    make_floor(&f, IRB_LAYOUT_FULL);
    struct irb_image position = fixture_read(f.rsm->position, 4);
    int *map = malloc(4 * N * N);
    for (int corners = 8; corners <= 16; corners += 8)
        for (int k = 1; k <= 64; k *= 8) {
            const struct rsc_settings s = {.clusters = k, .weight_distance = 1, .reach = 2};
            struct rsc_clusters *c = cluster(&f, &s);
            struct rsc_area_lights *lights = make(&f, c, &s, RSC_AREA_TEXELS, corners);
            struct disc *discs = read_discs(lights);
            double area = 0, inside = 0;
            gl->api.GetTextureImage(c->map->id, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, 4 * N * N, map);
            for (int i = 0; i < k; i++) {
                const struct polygon p = read_polygon(lights, i);
                if (discs[i].flux[0] == 0) {
                    REQUIRE_NEAR(p.flux[0], 0, 0);
                    continue;
                }
                check_polygon(&p, corners);
                assert_memory_equal(p.flux, discs[i].flux, 12);
                assert_memory_equal(p.centre, discs[i].position, 12);
                area += p.area;
                inside += enclosed(&p, corners, map, i, &position) / k;
            }
            print_message("%d polygons of %d corners: %.3f of 4 m2, %.2f %% of the texels inside\n",
                          k, corners, area, 100 * inside);
            REQUIRE_CMP(inside, >, corners == 8 ? 0.95 : 0.97);
            REQUIRE_CMP(area, >, 0.95 * 4);
            REQUIRE_CMP(area, <, 1.2 * 4);
            free(discs);
            rsc_area_lights_destroy(lights);
            rsc_clusters_destroy(c);
        }
    free(map);
    irb_image_destroy(&position);
    fixture_frame_destroy(&f);
}

/* One texel: all three areas are its own; its polygon is regular. Then none: dark, nothing NaN. */
static void test_one_texel(void **state)
{
    (void)state;
    struct fixture_frame f;
    make_floor(&f, IRB_LAYOUT_FULL);
    struct irb_image flux = fixture_read(f.rsm->flux, 4);
    for (int lit = 1; lit >= 0; lit--) {
        struct irb_error err = {0};
        for (int i = 0; i < N * N; i++)
            if (!lit || i != N / 2 * N + N / 2)
                memset(flux.data + 4 * i, 0, 12);
        REQUIRE_OK(irb_texture_write(f.rsm->flux, &flux, &err));
        const struct rsc_settings s = {.clusters = 4, .weight_distance = 1, .reach = 2};
        struct rsc_clusters *c = cluster(&f, &s);
        double areas[3] = {0};
        for (int area = 0; area < 3; area++) {
            struct rsc_area_lights *lights = make(&f, c, &s, (enum rsc_area)area, 8);
            struct disc *discs = read_discs(lights);
            for (int i = 0; i < 4; i++) {
                const struct polygon p = read_polygon(lights, i);
                const float *values = p.centre;
                for (int v = 0; v < 12 + 2 * 8; v++)
                    assert_true(isfinite(values[v]));
                areas[area] += discs[i].area;
                if (p.flux[0] > 0)
                    check_polygon(&p, 8);
                if (p.flux[0] > 0) /* a regular octagon in the disc */
                    REQUIRE_REL(p.area, discs[i].area * sqrt(8) / M_PI, 1e-4);
            }
            free(discs);
            rsc_area_lights_destroy(lights);
        }
        REQUIRE_NEAR(areas[0] > 0, lit, 0);
        REQUIRE_NEAR(areas[1], areas[0], 1e-5 * areas[0]);
        REQUIRE_NEAR(areas[2], areas[0], 1e-5 * areas[0]);
        rsc_clusters_destroy(c);
    }
    irb_image_destroy(&flux);
    fixture_frame_destroy(&f);
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_areas),
        cmocka_unit_test(test_polygons),
        cmocka_unit_test(test_one_texel),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failed;
}
