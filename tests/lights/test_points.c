/* SPDX-License-Identifier: MIT
 *
 * Point sets: random points against their distribution, tessellation points against a transcription
 * of the thesis, both on the GPU against the scene's triangles.
 *
 *     test_points BACKEND SHADERS     SHADERS: tests/lights/shaders
 */
#include "tests/support/compare.h"
#include "core/lights/points.h"
#include "core/lights/tessellation.h"
#include "core/lights/world_triangles.h"
#include "tests/lights/points_fixture.h"
#include "tests/lights/raster_fixture.h"

static struct irb_gl *gl;

static const float grey[3] = {0.5f, 0.5f, 0.5f};

static struct irb_points_desc area_desc(int count, uint64_t seed)
{
    return (struct irb_points_desc){.kind = IRB_POINTS_AREA, .count = count, .seed = seed};
}

static struct irb_points_desc tessellation_desc(float f_min, float f_max, int order)
{
    return (struct irb_points_desc){
        .kind = IRB_POINTS_TESSELLATION, .f_min = f_min, .f_max = f_max, .smoothstep = order};
}

static struct irb_point_list generate(const struct irb_scene *scene,
                                      const struct irb_points_desc *desc)
{
    struct irb_error err = {0};
    struct irb_point_list list;
    uint64_t count;
    REQUIRE_OK(irb_points_count(scene, desc, &count, &err));
    REQUIRE_OK(irb_points_generate(scene, desc, &list, &err));
    REQUIRE_NEAR((double)list.count, (double)count, 0);
    return list;
}

/* Triangles with the given corners, each an object of its own. */
static struct irb_scene *make_triangles(const double (*corners)[3][3], int count)
{
    struct irb_error err = {0};
    struct irb_builder builder;
    const double up[3] = {0, 1, 0};
    irb_builder_begin(&builder, "triangles");
    int material = irb_builder_material(&builder, "grey", grey);
    for (int t = 0; t < count; t++) {
        char name[16];
        snprintf(name, sizeof name, "%d", t);
        irb_builder_object(&builder, name, material);
        uint32_t v[3];
        for (int i = 0; i < 3; i++)
            v[i] = irb_builder_vertex(&builder, corners[t][i], up, NULL);
        irb_builder_triangle(&builder, v[0], v[1], v[2]);
    }
    struct irb_scene *scene = irb_builder_finish(&builder, &err);
    REQUIRE_OK(scene);
    return scene;
}

static struct irb_scene *make_random_triangles(int count, uint64_t *random)
{
    double(*corners)[3][3] = malloc((size_t)count * sizeof *corners);
    for (int t = 0; t < count; t++)
        for (int i = 0; i < 9; i++)
            corners[t][i / 3][i % 3] = fixture_random(random) * (t % 3 ? 1 : 0.1);
    struct irb_scene *scene = make_triangles((const double(*)[3][3])corners, count);
    free(corners);
    return scene;
}

/* chi^2 of counts against expectations must be within 4.5 standard deviations of its mean. */
static void require_chi2(const double *found, const double *expected, int count)
{
    double chi2 = 0;
    for (int i = 0; i < count; i++) {
        REQUIRE_CMP(expected[i], >=, 5);
        chi2 += (found[i] - expected[i]) * (found[i] - expected[i]) / expected[i];
    }
    REQUIRE_CMP(fabs(chi2 - (count - 1)), <, 4.5 * sqrt(2.0 * (count - 1)));
}

/* ---- Random points ---- */

/* As many on each triangle as its area, and in each of its four quarters a fourth. */
static void test_area_distribution(void **state)
{
    (void)state;
    enum { COUNT = 200000, MOST = 64 };
    struct irb_scene *scene = fixture_scene("cornell");
    struct irb_points_desc desc = area_desc(COUNT, 5);
    struct irb_point_list list = generate(scene, &desc);
    const int triangles = (int)scene->triangle_count;
    double found[MOST] = {0}, expected[MOST], quarters[4] = {0}, total = 0, unused[3];
    assert_in_range(triangles, 1, MOST);
    REQUIRE_NEAR((double)list.count, COUNT, 0);
    for (uint64_t i = 0; i < list.count; i++) {
        const struct irb_point *p = &list.points[i];
        assert_true(p->triangle < scene->triangle_count && p->u + p->v <= 65535);
        found[p->triangle]++;
        quarters[p->u >= 32768 ? 1 : p->v >= 32768 ? 2 : p->u + p->v < 32768 ? 0 : 3]++;
    }
    for (int t = 0; t < triangles; t++)
        total += irb_triangle_size(scene, (uint32_t)t, unused);
    REQUIRE_REL(list.area, total, 1e-12);
    for (int t = 0; t < triangles; t++) {
        expected[t] = COUNT * irb_triangle_size(scene, (uint32_t)t, unused) / total;
        REQUIRE_REL(list.density[t], expected[t], 1e-6);
    }
    require_chi2(found, expected, triangles);
    require_chi2(quarters, (double[]){COUNT / 4.0, COUNT / 4.0, COUNT / 4.0, COUNT / 4.0}, 4);
    irb_point_list_destroy(&list);
    irb_scene_destroy(scene);
}

/* Point i in map i mod N: in every map as many of each triangle as in any other, up to one; and
 * those of one map are as uniform as all. */
static void test_area_maps(void **state)
{
    (void)state;
    enum { COUNT = 100000, MAPS = 37, CELLS = 16 };
    struct irb_scene *scene = fixture_floor(1, grey);
    struct irb_points_desc desc = area_desc(COUNT, 1);
    struct irb_point_list list = generate(scene, &desc);
    static double found[MAPS][CELLS], expected[CELLS];
    double of_triangle[MAPS] = {0};
    for (uint64_t i = 0; i < list.count; i++) {
        const struct irb_point *p = &list.points[i];
        found[i % MAPS][4 * (p->u / 16384) + p->v / 16384]++; /* ten whole or half cells */
        of_triangle[i % MAPS] += p->triangle == 0;
    }
    for (int cell = 0; cell < CELLS; cell++) {
        int sum = cell / 4 + cell % 4;
        expected[cell] = COUNT / (double)MAPS / 16 * (sum < 3 ? 2 : sum == 3 ? 1 : 0);
    }
    for (int map = 0; map < MAPS; map++) {
        double packed[2][10];
        int cells = 0;
        for (int cell = 0; cell < CELLS; cell++) {
            if (expected[cell] > 0) {
                packed[0][cells] = found[map][cell];
                packed[1][cells++] = expected[cell];
            } else {
                REQUIRE_NEAR(found[map][cell], 0, 0);
            }
        }
        require_chi2(packed[0], packed[1], cells);
        REQUIRE_NEAR(of_triangle[map], of_triangle[0], 1);
    }
    irb_point_list_destroy(&list);
    irb_scene_destroy(scene);
}

static void test_seeds(void **state)
{
    (void)state;
    struct irb_scene *scene = fixture_scene("cornell");
    struct irb_points_desc one = area_desc(1000, 1), two = area_desc(1000, 2);
    struct irb_point_list a = generate(scene, &one), b = generate(scene, &one),
                          c = generate(scene, &two);
    assert_memory_equal(a.points, b.points, 1000 * sizeof *a.points);
    assert_true(memcmp(a.points, c.points, 1000 * sizeof *a.points));
    irb_point_list_destroy(&a);
    irb_point_list_destroy(&b);
    irb_point_list_destroy(&c);
    irb_scene_destroy(scene);
}

/* ---- Algorithm 5.2 ---- */

/* A plain transcription of eqs 5.3, 5.4 and of algorithm 5.2: weights of all points of a triangle
 * into `out` (if not NULL), their number. */
static double plain_smoothstep(double l, double u, double t, int order)
{
    double x = u > l ? (t - l) / (u - l) : 0;
    return order == 3 ? 3 * pow(x, 2) - 2 * pow(x, 3)
                      : 6 * pow(x, 5) - 15 * pow(x, 4) + 10 * pow(x, 3);
}

static long plain_algorithm(double t_A, double t_a, double t_b, double t_c, double (*out)[2])
{
    double s_a = 1.0 / (t_a + t_A), s_b = 1.0 / (t_b + t_A), s_c = 1.0 / (t_c + t_A);
    long count = 0;
    for (double gamma = 0.0; gamma <= 1.0; gamma += s_c) {
        double alpha = 1.0 - gamma;
        double beta = 0.0;
        while (alpha > 0.0) {
            if (out) {
                out[count][0] = beta;
                out[count][1] = gamma;
            }
            count++;
            alpha = alpha - ((1.0 - alpha) * s_a + (1.0 - beta) * s_b + (1.0 - gamma) * s_c);
            beta = 1.0 - alpha - gamma;
        }
    }
    return count;
}

struct plain_scene {
    double area_min, area_max, edge_min, edge_max;
};

static double plain_size(const struct irb_scene *scene, uint32_t triangle, double edges[3])
{
    double p[3][3], s;
    for (int i = 0; i < 3; i++)
        for (int c = 0; c < 3; c++)
            p[i][c] =
                scene->positions[3 * scene->indices[3 * triangle + (uint32_t)i] + (uint32_t)c];
    for (int i = 0; i < 3; i++) { /* a is opposite of A */
        const double *from = p[(i + 1) % 3], *to = p[(i + 2) % 3];
        edges[i] =
            sqrt(pow(to[0] - from[0], 2) + pow(to[1] - from[1], 2) + pow(to[2] - from[2], 2));
    }
    s = 0;
    for (int c = 0; c < 3; c++) {
        int d = (c + 1) % 3, e = (c + 2) % 3;
        s += pow((p[1][d] - p[0][d]) * (p[2][e] - p[0][e]) -
                     (p[1][e] - p[0][e]) * (p[2][d] - p[0][d]),
                 2);
    }
    return sqrt(s) / 2;
}

static void plain_measure(const struct irb_scene *scene, struct plain_scene *plain)
{
    *plain = (struct plain_scene){INFINITY, 0, INFINITY, 0};
    for (uint32_t t = 0; t < scene->triangle_count; t++) {
        double edges[3], area = plain_size(scene, t, edges);
        if (area == 0)
            continue;
        plain->area_min = fmin(plain->area_min, area);
        plain->area_max = fmax(plain->area_max, area);
        for (int i = 0; i < 3; i++) {
            plain->edge_min = fmin(plain->edge_min, edges[i]);
            plain->edge_max = fmax(plain->edge_max, edges[i]);
        }
    }
}

static long plain_triangle(const struct irb_scene *scene, const struct plain_scene *plain,
                           uint32_t triangle, const struct irb_points_desc *d, double (*out)[2])
{
    double edges[3], area = plain_size(scene, triangle, edges), t[4];
    if (area == 0)
        return 0;
    t[0] = plain_smoothstep(plain->area_min, plain->area_max, area, d->smoothstep);
    for (int i = 0; i < 3; i++)
        t[i + 1] = plain_smoothstep(plain->edge_min, plain->edge_max, edges[i], d->smoothstep);
    for (int i = 0; i < 4; i++)
        t[i] = fmax(ceil(t[i] * (double)d->f_max), (double)d->f_min);
    return plain_algorithm(t[0], t[1], t[2], t[3], out);
}

/* Every point of random triangles, and the number of points of a built-in of 30,000. */
static void test_algorithm(void **state)
{
    (void)state;
    const struct irb_points_desc descs[] = {
        tessellation_desc(5, 32, 3), tessellation_desc(5, 32, 5),  tessellation_desc(16, 64, 3),
        tessellation_desc(1, 1, 3),  tessellation_desc(1, 100, 5), tessellation_desc(2.5f, 7, 3)};
    uint64_t random = 3;
    static double weights[100000][2];
    for (int k = 0; k < 6; k++) {
        struct irb_scene *scene = make_random_triangles(40, &random);
        struct irb_point_list list = generate(scene, &descs[k]);
        struct plain_scene plain;
        uint64_t next = 0;
        plain_measure(scene, &plain);
        for (uint32_t t = 0; t < scene->triangle_count; t++) {
            long count = plain_triangle(scene, &plain, t, &descs[k], weights);
            REQUIRE_NEAR(list.density[t], count, 0);
            for (long i = 0; i < count; i++, next++) {
                REQUIRE_NEAR(list.points[next].triangle, t, 0);
                REQUIRE_NEAR(list.points[next].u / 65535.0, weights[i][0], 1 / 65535.0);
                REQUIRE_NEAR(list.points[next].v / 65535.0, weights[i][1], 0.51 / 65535);
            }
        }
        REQUIRE_NEAR((double)next, (double)list.count, 0);
        irb_point_list_destroy(&list);
        irb_scene_destroy(scene);
    }
    struct irb_scene *scene = fixture_scene("cornell-objects");
    struct irb_point_list list = generate(scene, &descs[0]);
    struct plain_scene plain;
    double sum = 0;
    plain_measure(scene, &plain);
    for (uint32_t t = 0; t < scene->triangle_count; t++)
        sum += (double)plain_triangle(scene, &plain, t, &descs[0], NULL);
    REQUIRE_NEAR((double)list.count, sum, 0);
    irb_point_list_destroy(&list);
    irb_scene_destroy(scene);
}

/* By hand: the points of factors 2, with the steps 1/4, which are exact. */
static void test_few_points(void **state)
{
    (void)state;
    const double corners[1][3][3] = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
    struct irb_scene *scene = make_triangles(corners, 1);
    struct irb_points_desc desc = tessellation_desc(2, 2, 3);
    struct irb_point_list list = generate(scene, &desc);
    /* gamma 0: alpha 1, 1/2; 1/4: 3/4, 1/4; 1/2: 1/2; 3/4: 1/4 */
    const int u[6] = {0, 32768, 0, 32768, 0, 0}, v[6] = {0, 0, 16384, 16384, 32768, 49151};
    REQUIRE_NEAR((double)list.count, 6, 0);
    for (int i = 0; i < 6; i++) {
        REQUIRE_NEAR(list.points[i].u, u[i], 1);
        REQUIRE_NEAR(list.points[i].v, v[i], 1);
    }
    irb_point_list_destroy(&list);
    irb_scene_destroy(scene);
}

/* A_min = A_max, e_min = e_max: f_min. Triangles without area count for nothing. */
static void test_degenerate(void **state)
{
    (void)state;
    const double corners[][3][3] = {
        {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, /* all edges sqrt(2), exactly */
        {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}},
        {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}},
        {{2, 1, 1}, {1, 2, 1}, {1, 1, 2}},
    };
    struct irb_points_desc desc = tessellation_desc(4, 64, 3), random = area_desc(1000, 1);
    struct irb_scene *scene = make_triangles(corners, 4);
    struct irb_point_list list = generate(scene, &desc);
    struct irb_tessellation_range range;
    irb_tessellation_measure(scene, &range);
    REQUIRE_NEAR(range.area[0], range.area[1], 0);
    REQUIRE_NEAR(range.edge[0], range.edge[1], 0);
    REQUIRE_REL(range.edge[0], sqrt(2), 1e-7);
    REQUIRE_NEAR((double)list.count, 2.0 * (double)plain_algorithm(4, 4, 4, 4, NULL), 0);
    REQUIRE_NEAR(list.density[1], 0, 0);
    REQUIRE_NEAR(list.density[2], 0, 0);
    assert_int_equal(list.run_count, 2);
    irb_point_list_destroy(&list);
    list = generate(scene, &random);
    for (int i = 0; i < 1000; i++)
        assert_true(list.points[i].triangle == 0 || list.points[i].triangle == 3);
    irb_point_list_destroy(&list);
    irb_scene_destroy(scene);

    const double right[2][3][3] = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                   {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}};
    scene = make_triangles(right, 2); /* all areas equal, edges 1 and sqrt(2) */
    list = generate(scene, &desc);
    REQUIRE_NEAR((double)list.count, 2 * (double)plain_algorithm(4, 64, 4, 4, NULL), 0);
    irb_point_list_destroy(&list);
    irb_scene_destroy(scene);

    scene = make_triangles(corners + 1, 2); /* no area at all */
    for (int kind = 0; kind < 2; kind++) {
        list = generate(scene, kind ? &desc : &random);
        REQUIRE_NEAR((double)list.count, 0, 0);
        REQUIRE_NEAR(list.area, 0, 0);
        irb_point_list_destroy(&list);
    }
    irb_scene_destroy(scene);
}

static void require_refused(const struct irb_points_desc *desc, enum irb_error_code code,
                            const char *part)
{
    struct irb_error err = {0};
    struct irb_scene *scene = fixture_scene("cornell");
    struct irb_point_list list;
    assert_false(irb_points_generate(scene, desc, &list, &err));
    assert_int_equal(err.code, code);
    REQUIRE_CONTAINS(err.message, part);
    assert_null(list.points);
    irb_scene_destroy(scene);
}

static void test_refusals(void **state)
{
    (void)state;
    struct irb_points_desc desc = area_desc(-1, 0);
    require_refused(&desc, IRB_E_INPUT, "found -1");
    desc = area_desc(150000000, 0);
    require_refused(&desc, IRB_E_MEMORY, "150000000 points take 1144.4 MiB");
    desc = tessellation_desc(0.5f, 4, 3);
    require_refused(&desc, IRB_E_INPUT, "f[0.5,4]");
    desc = tessellation_desc(5, 4, 3);
    require_refused(&desc, IRB_E_INPUT, "f[5,4]");
    desc = tessellation_desc(5, NAN, 3);
    require_refused(&desc, IRB_E_INPUT, "f[5,nan]");
    desc = tessellation_desc(5, 32, 4);
    require_refused(&desc, IRB_E_INPUT, "found 4");
    desc = tessellation_desc(16, 64, 3);
    desc.most_bytes = 100000;
    require_refused(&desc, IRB_E_MEMORY, "smaller factors");
    /* the estimate against the number that would have come out, 40195 */
    struct irb_error err = {0};
    struct irb_scene *scene = fixture_scene("cornell");
    uint64_t count, unused;
    double about = 0;
    desc.most_bytes = 0;
    REQUIRE_OK(irb_points_count(scene, &desc, &count, &err));
    desc.most_bytes = 100000;
    assert_false(irb_points_count(scene, &desc, &unused, &err));
    assert_int_equal(sscanf(err.message, "points: about %lf points", &about), 1);
    REQUIRE_REL(about, (double)count, 0.1);
    irb_scene_destroy(scene);
}

/* The most points that the thesis asks for, in the built-in scene that has most: below the stated
 * bound, counted without making them; above half a GiB, which says so. */
static void test_most_memory(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct irb_scene *scene = fixture_scene("atrium");
    struct irb_points_desc desc = tessellation_desc(16, 64, 3);
    uint64_t count;
    REQUIRE_OK(irb_points_count(scene, &desc, &count, &err));
    const double mib =
        ((double)count * sizeof(struct irb_point) + 4.0 * scene->triangle_count) / (1 << 20);
    print_message("atrium f[16,64]: %llu points, %.1f MiB\n", (unsigned long long)count, mib);
    REQUIRE_CMP(mib, <, 600);
    REQUIRE_CMP(mib, >, 512);
    desc.most_bytes = 512 << 20;
    assert_false(irb_points_count(scene, &desc, &count, &err));
    assert_int_equal(err.code, IRB_E_MEMORY);
    REQUIRE_CONTAINS(err.message, "above the bound of 512.0 MiB");
    irb_scene_destroy(scene);
}

/* ---- Alpha masks ---- */

/* A quad whose texture lets the left half through: texels of alpha 0 and 255, four columns. */
static void test_masked(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct irb_builder builder;
    const double at[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, up[3] = {0, 0, 1};
    unsigned char *rgba = calloc(8, 4);
    for (int i = 0; i < 8; i++)
        rgba[4 * i + 3] = i % 4 < 2 ? 0 : 255;
    irb_builder_begin(&builder, "masked");
    int material = irb_builder_material(&builder, "m", grey);
    builder.scene->materials[material].diffuse_texture =
        irb_builder_texture(&builder, "t", 4, 2, rgba);
    builder.scene->materials[material].alpha_cutoff = 0.5f;
    irb_builder_object(&builder, "quad", material);
    for (int i = 0; i < 4; i++)
        irb_builder_vertex(&builder, at[i], up, at[i]);
    irb_builder_triangle(&builder, 0, 1, 2);
    irb_builder_triangle(&builder, 0, 2, 3);
    struct irb_scene *scene = irb_builder_finish(&builder, &err);
    REQUIRE_OK(scene);
    for (int kind = 0; kind < 2; kind++) {
        struct irb_points_desc desc = kind ? tessellation_desc(40, 40, 3) : area_desc(20000, 1);
        struct irb_point_list list;
        uint64_t count;
        double most = 0, least = 1;
        REQUIRE_OK(irb_points_count(scene, &desc, &count, &err));
        REQUIRE_OK(irb_points_generate(scene, &desc, &list, &err));
        REQUIRE_REL((double)list.count, 0.5 * (double)count, 0.05);
        REQUIRE_REL((double)(list.density[0] + list.density[1]), (double)count, 1e-6);
        for (uint64_t i = 0; i < list.count; i++) {
            const struct irb_point *p = &list.points[i];
            double x = (p->triangle ? p->u : p->u + p->v) / 65535.0;
            if (x > 0)
                least = fmin(least, x);
            most = fmax(most, x);
        }
        /* repeated, interpolated between texel centres: one half at x = 1/2, and at 0 and 1 */
        REQUIRE_NEAR(least, 0.5, 0.03);
        REQUIRE_NEAR(most, 1, 0.03);
        irb_point_list_destroy(&list);
    }
    irb_scene_destroy(scene);
}

/* ---- On the GPU ---- */

static double (*read_points(const struct irb_points *points,
                            const struct irb_scene_gl *scene_gl))[2][3]
{
    struct irb_error err = {0};
    const int64_t bytes = (int64_t)points->count * 32;
    struct irb_world_triangles *triangles = irb_world_triangles_create(gl, &err);
    struct irb_program *program = irb_program_create(
        gl, &(struct irb_program_desc){.name = "points", .compute = "test_points.comp"}, &err);
    struct irb_buffer *out = irb_buffer_create(gl, "out", bytes, NULL, &err);
    float *values = malloc((size_t)bytes);
    double(*found)[2][3] = malloc(points->count * sizeof *found);
    REQUIRE_OK(triangles && program && out);
    REQUIRE_OK(irb_world_triangles_update(triangles, scene_gl, points->density, &err));
    irb_program_use(program);
    irb_world_triangles_bind(triangles, program, 0);
    gl->api.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, out->id);
    for (int i = 0; i < points->chunk_count; i++) {
        gl->api.BindTextureUnit(1, points->chunks[i].texture);
        irb_program_int(program, "points", 1);
        irb_program_int(program, "first_point", (int)points->chunks[i].first);
        irb_program_int(program, "point_count", (int)points->chunks[i].count);
        gl->api.DispatchCompute((points->chunks[i].count + 63) / 64, 1, 1);
    }
    REQUIRE_OK(irb_buffer_read(out, 0, bytes, values, &err));
    for (uint64_t i = 0; i < points->count; i++)
        for (int k = 0; k < 6; k++)
            found[i][k / 3][k % 3] = values[8 * i + (uint64_t)(4 * (k / 3) + k % 3)];
    free(values);
    irb_buffer_destroy(out);
    irb_program_destroy(program);
    irb_world_triangles_destroy(triangles);
    return found;
}

static void require_points(const struct irb_points *points, const struct irb_scene_gl *scene_gl,
                           const struct irb_point_list *list, const float *positions)
{
    const struct irb_scene *scene = scene_gl->scene;
    double(*found)[2][3] = read_points(points, scene_gl);
    fixture_corners *corners = fixture_place_corners(scene, positions);
    for (uint64_t i = 0; i < points->count; i++) {
        const struct irb_point *p = &list->points[i];
        double at[3], area[3];
        fixture_place_point((const fixture_corners *)corners, p, at);
        fixture_area_vector((const double(*)[3])corners[p->triangle], area);
        for (int k = 0; k < 3; k++) {
            REQUIRE_NEAR(found[i][0][k], at[k], 1e-5);
            REQUIRE_NEAR(found[i][1][k], area[k] / (double)list->density[p->triangle], 1e-6);
        }
    }
    free(found);
    free(corners);
}

/* Chunks of 1000 bytes; objects turned, stretched and moved; then other vertices in the buffer. */
static void test_follow(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct irb_scene *scene = fixture_scene("cornell");
    struct irb_scene_gl *scene_gl = irb_scene_gl_create(gl, scene, &err);
    REQUIRE_OK(scene_gl);
    for (int kind = 0; kind < 2; kind++) {
        struct irb_points_desc desc = kind ? tessellation_desc(2, 9, 5) : area_desc(3000, 9);
        struct irb_point_list list = generate(scene, &desc);
        desc.chunk_bytes = 1000;
        struct irb_points *points = irb_points_create(gl, scene_gl, &desc, &err);
        REQUIRE_OK(points);
        assert_int_equal(points->chunk_count, (int)((list.count + 124) / 125));
        REQUIRE_CMP(points->chunk_count, >, 4);
        for (int i = 0; i < points->chunk_count; i++) {
            REQUIRE_CMP(points->chunks[i].points->bytes, <=, 1000);
            REQUIRE_NEAR(points->chunks[i].first, 125 * i, 0);
        }
        REQUIRE_NEAR((double)points->bytes, 8.0 * (double)list.count + 4 * scene->triangle_count,
                     0);
        require_points(points, scene_gl, &list, scene->positions);

        float *last = scene->objects[scene->object_count - 1].transform;
        float *first = scene->objects[0].transform, before[2][16];
        memcpy(before[0], first, sizeof before[0]);
        memcpy(before[1], last, sizeof before[1]);
        const float moved[16] = {0, 2, 0, 0, -1, 0, 0, 0, 0, 0, 0.5f, 0, 0.3f, -0.2f, 0.1f, 1};
        memcpy(last, moved, sizeof moved);
        first[12] = -0.5f;
        require_points(points, scene_gl, &list, scene->positions);

        float *bent = malloc(scene->vertex_count * 12);
        for (uint32_t i = 0; i < 3 * scene->vertex_count; i++)
            bent[i] = scene->positions[i] + 0.1f * sinf(5 * scene->positions[i]);
        REQUIRE_OK(irb_buffer_write(scene_gl->positions, 0, scene->vertex_count * 12, bent, &err));
        require_points(points, scene_gl, &list, bent);
        REQUIRE_OK(irb_buffer_write(scene_gl->positions, 0, scene->vertex_count * 12,
                                    scene->positions, &err));
        memcpy(first, before[0], sizeof before[0]);
        memcpy(last, before[1], sizeof before[1]);
        free(bent);
        irb_points_destroy(points);
        irb_point_list_destroy(&list);
    }
    irb_scene_gl_destroy(scene_gl);
    irb_scene_destroy(scene);
}

/* Runs: one an object, in order, without gaps. */
static void test_runs(void **state)
{
    (void)state;
    struct irb_scene *scene = fixture_scene("cornell");
    for (int kind = 0; kind < 2; kind++) {
        struct irb_points_desc desc = kind ? tessellation_desc(5, 32, 3) : area_desc(10000, 9);
        struct irb_point_list list = generate(scene, &desc);
        uint32_t next = 0;
        assert_int_equal(list.run_count, scene->object_count);
        for (int r = 0; r < list.run_count; r++) {
            const struct irb_object *object = &scene->objects[list.runs[r].object];
            REQUIRE_NEAR(list.runs[r].first, next, 0);
            next += list.runs[r].count;
            for (uint32_t i = list.runs[r].first; i < next; i++)
                assert_true(list.points[i].triangle - object->first_triangle <
                            object->triangle_count);
        }
        REQUIRE_NEAR(next, (double)list.count, 0);
        irb_point_list_destroy(&list);
    }
    irb_scene_destroy(scene);
}

/* Points are kept while they would be the same, known by an area of -1. */
static void test_prepare(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct irb_scene *scene = fixture_scene("cornell");
    struct irb_scene_gl *scene_gl = irb_scene_gl_create(gl, scene, &err);
    float *weights = malloc(scene->triangle_count * sizeof *weights);
    REQUIRE_OK(scene_gl && weights);
    for (uint32_t t = 0; t < scene->triangle_count; t++)
        weights[t] = 1;
    struct irb_points_desc weighted = area_desc(200, 9);
    weighted.weights = weights;
    const struct {
        struct irb_points_desc desc;
        bool kept;
    } steps[] = {
        {area_desc(100, 9), false},
        {area_desc(100, 9), true},
        {area_desc(200, 9), false},
        {area_desc(200, 8), false},
        {weighted, false},
        {weighted, false},
        {area_desc(200, 9), false},
        {tessellation_desc(2, 4, 3), false},
        {tessellation_desc(2, 4, 3), true},
        {tessellation_desc(2, 4, 5), false},
    };
    struct irb_points *points = NULL;
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
        REQUIRE_OK(irb_points_prepare(&points, gl, scene_gl, &steps[i].desc, &err));
        assert_int_equal(points->area < 0, steps[i].kept);
        points->area = -1;
    }
    const struct irb_points_desc bad = {.kind = IRB_POINTS_AREA, .count = -1};
    assert_false(irb_points_prepare(&points, gl, scene_gl, &bad, &err));
    assert_null(points);
    free(weights);
    irb_scene_gl_destroy(scene_gl);
    irb_scene_destroy(scene);
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), argc > 2 ? argv[2] : NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_area_distribution),
        cmocka_unit_test(test_area_maps),
        cmocka_unit_test(test_seeds),
        cmocka_unit_test(test_algorithm),
        cmocka_unit_test(test_few_points),
        cmocka_unit_test(test_degenerate),
        cmocka_unit_test(test_refusals),
        cmocka_unit_test(test_most_memory),
        cmocka_unit_test(test_masked),
        cmocka_unit_test(test_follow),
        cmocka_unit_test(test_runs),
        cmocka_unit_test(test_prepare),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failed;
}
