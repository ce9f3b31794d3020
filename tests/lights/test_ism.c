/* SPDX-License-Identifier: MIT
 *
 * Imperfect shadow maps against a point-by-point splatter on the CPU, and the splatters against one
 * another.
 *
 *     test_ism BACKEND SHADERS     SHADERS: tests/lights/shaders
 */
#include "tests/support/compare.h"
#include "core/lights/tessellation.h"
#include "tests/lights/ism_world.h"

static struct irb_gl *gl;

static const float grey[3] = {0.5f, 0.5f, 0.5f};

/* ---- Splatters ---- */

/* Sizes, factors and near cuts; numbers of lights that work groups do and do not divide. */
static const struct {
    int lights, most;
    float factor, scale, near;
    int size;
} cases[] = {
    {13, 1, 1, 1, 0.001f, IRB_ISM_SIZE_SURFACE},
    {64, 9, 1, 1, 0, IRB_ISM_SIZE_SURFACE},
    {1, 5, 1, 1, 0.1f, IRB_ISM_SIZE_SURFACE},
    {3, 40, 1, 2, 0.2f, IRB_ISM_SIZE_SURFACE},
    {13, 5, 3, 1, 0.001f, IRB_ISM_SIZE_SURFACE},
    {20, 5, 0.4f, 1, 0.001f, IRB_ISM_SIZE_SURFACE},
    {7, 5, 2.25f, 0.5f, 0.001f, IRB_ISM_SIZE_SURFACE},
    {13, 40, 1.5f, 1, 0.001f, IRB_ISM_SIZE_EVEN},
};

static void test_points(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        struct world w = {0};
        struct irb_ism_settings settings = default_settings();
        create_cornell(&w, gl, cases[k].lights);
        settings.splat_most = cases[k].most;
        settings.splat_factor = cases[k].factor;
        settings.splat_scale = cases[k].scale;
        settings.near = cases[k].near;
        settings.splat_size = cases[k].size;
        require_splat(&w, &settings);
        destroy_world(&w);
    }
}

/* Lights with areas: what is nearer than a share of their radii is left out. */
static void test_near_radii(void **state)
{
    (void)state;
    struct world w = {0};
    struct irb_ism_settings settings = default_settings();
    create_cornell(&w, gl, 13);
    for (int l = 0; l < 13; l++)
        w.lights[l].position[3] = 0.01f * (float)l;
    replace_lights(&w, 13);
    settings.near_radii = 1.5f;
    require_splat(&w, &settings);
    destroy_world(&w);
}

/* The same bits. */
static void test_raster(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        struct world w = {0};
        struct irb_ism_settings settings = default_settings();
        create_cornell(&w, gl, cases[k].lights);
        settings.splat_most = cases[k].most;
        settings.splat_factor = cases[k].factor;
        settings.splat_scale = cases[k].scale;
        settings.near = cases[k].near;
        settings.splat_size = cases[k].size;
        struct fixture_maps atomic = splat(&w, &settings);
        settings.splatter = IRB_ISM_RASTER;
        struct fixture_maps raster = splat(&w, &settings);
        require_equal(&atomic, &raster);
        fixture_maps_destroy(&atomic);
        fixture_maps_destroy(&raster);
        destroy_world(&w);
    }
}

/* Splats of so many texels that an invocation's points take more rounds than one dispatch may
 * (core/gl/context.h, IRB_LOOP_ROUNDS_MOST): the same bits as the rasteriser's. */
static void test_large_splats(void **state)
{
    (void)state;
    struct world w = {0};
    struct irb_ism_settings settings = default_settings();
    create_world(&w, gl, fixture_scene("cornell"),
                 (struct irb_points_desc){.kind = IRB_POINTS_AREA, .count = 4096, .seed = 3}, 1);
    settings.splat_most = 64;
    settings.splat_scale = 100;
    settings.near = 0;
    struct fixture_maps atomic = splat(&w, &settings);
    settings.splatter = IRB_ISM_RASTER;
    struct fixture_maps raster = splat(&w, &settings);
    require_equal(&atomic, &raster);
    fixture_maps_destroy(&atomic);
    fixture_maps_destroy(&raster);
    destroy_world(&w);
}

static void test_chunks(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct world w = {0};
    struct irb_ism_settings settings = default_settings();
    create_cornell(&w, gl, 13);
    settings.splat_factor = 1.5f;
    struct fixture_maps whole = splat(&w, &settings);
    irb_points_destroy(w.points);
    struct irb_points_desc desc = {
        .kind = IRB_POINTS_AREA, .count = 20000, .seed = 3, .chunk_bytes = 8 * 777};
    REQUIRE_OK(w.points = irb_points_create(gl, w.scene_gl, &desc, &err));
    REQUIRE_CMP(w.points->chunk_count, >, 20);
    for (int splatter = 0; splatter < 2; splatter++) {
        settings.splatter = splatter;
        struct fixture_maps chunks = splat(&w, &settings);
        require_equal(&whole, &chunks);
        fixture_maps_destroy(&chunks);
    }
    fixture_maps_destroy(&whole);
    destroy_world(&w);
}

/* Objects that moved, were turned and stretched; then other vertices. */
static void test_follow(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct world w = {0};
    struct irb_ism_settings settings = default_settings();
    create_cornell(&w, gl, 13);
    const float moved[16] = {0, 1.5f, 0, 0, -1, 0, 0, 0, 0, 0, 0.5f, 0, 0.3f, -0.1f, 0.1f, 1};
    struct irb_object *object = &w.scene->objects[w.scene->object_count - 1];
    memcpy(object->transform, moved, sizeof moved);
    w.scene->objects[0].transform[13] = 0.05f;
    require_splat(&w, &settings);
    for (uint32_t i = 0; i < 3 * w.scene->vertex_count; i++)
        w.scene->positions[i] += 0.05f * sinf(20 * w.scene->positions[i]);
    REQUIRE_OK(irb_buffer_write(w.scene_gl->positions, 0, w.scene->vertex_count * 12,
                                w.scene->positions, &err));
    require_splat(&w, &settings);
    destroy_world(&w);
}

/* A scene whose own animation moves vertices. */
static void test_deforming(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct world w = {0};
    struct irb_ism_settings settings = default_settings();
    create_world(&w, gl, fixture_scene("cornell-cloth"),
                 (struct irb_points_desc){
                     .kind = IRB_POINTS_TESSELLATION, .f_min = 1, .f_max = 32, .smoothstep = 3},
                 13);
    double first, last;
    assert_true(irb_scene_duration(w.scene, &first, &last));
    REQUIRE_OK(irb_scene_animate(w.scene, first + 0.3 * (last - first), &err));
    assert_ptr_not_equal(irb_scene_current_positions(w.scene), w.scene->positions);
    REQUIRE_OK(irb_scene_gl_update(w.scene_gl, &err));
    require_splat(&w, &settings);
    destroy_world(&w);
}

/* Points that the tessellator makes for factors 1 and 2: corners; and middles of edges and of the
 * triangle. Map 7u + 89v + 991w + the triangle's number. A driver's barycentrics may be fixed-point
 * numbers: Mesa's have 16 bits, on edges of at most 0.8 m. */
static void test_tessellation(void **state)
{
    (void)state;
    static const double weights[7][3] = {{1, 0, 0},
                                         {0, 1, 0},
                                         {0, 0, 1},
                                         {0.5, 0.5, 0},
                                         {0.5, 0, 0.5},
                                         {0, 0.5, 0.5},
                                         {1 / 3.0, 1 / 3.0, 1 / 3.0}};
    struct world w = {0};
    create_world(&w, gl, fixture_scene("cornell-objects"), (struct irb_points_desc){.count = 1},
                 13);
    for (int f = 1; f <= 2; f++) {
        const int points = f == 1 ? 3 : 7;
        struct irb_ism_settings settings = default_settings();
        const double slack = f == 1 ? 0 : 0.8 / 65536;
        const struct fixture_splat s = {w.scene, &settings, w.lights, slack};
        settings.splatter = IRB_ISM_TESSELLATION;
        settings.f_min = settings.f_max = (float)f;
        struct fixture_maps found = splat(&w, &settings);
        struct fixture_maps expected = fixture_maps_create(SIZE, w.view.count);
        fixture_corners *corners = fixture_place_corners(w.scene, w.scene->positions);
        for (uint32_t t = 0; t < w.scene->triangle_count; t++)
            for (int p = 0; p < points; p++) {
                double at[3], area[3];
                fixture_point_on((const double(*)[3])corners[t], weights[p], at);
                fixture_area_vector((const double(*)[3])corners[t], area);
                for (int k = 0; k < 3; k++)
                    area[k] /= points;
                double index = weights[p][0] * 7 + weights[p][1] * 89 + weights[p][2] * 991;
                fixture_splat_maps(&expected, &s, t + (uint32_t)(index + 1e-6), 0, at, area);
            }
        fixture_require_maps(&found, &expected, slack, 1e-4);
        REQUIRE_CMP((double)expected.splats, >, 10000);
        free(corners);
        fixture_maps_destroy(&found);
        fixture_maps_destroy(&expected);
    }
    destroy_world(&w);
}

/* A geometry shader that counts points and adds up their shares of the surface. */
static const char counting_geometry[] =
    "layout(points) in;\n"
    "layout(points, max_vertices = 1) out;\n"
    "#include \"lights/ism_splat.glsl\"\n"
    "in vec3 position[];\n"
    "in vec3 share_of_point[];\n"
    "flat in uint index[];\n"
    "flat in uint random[];\n"
    "flat out float distance_to_light;\n"
    "flat out ivec2 origin;\n"
    "layout(std430, binding = 7) buffer Sums { uint point_sum; uint area_sum; };\n"
    "void main()\n"
    "{\n"
    "    atomicAdd(point_sum, 1u);\n"
    "    atomicAdd(area_sum, uint(length(share_of_point[0]) * 1e8 + 0.5));\n"
    "}\n";

/* However the factors mix, the points' shares add up to the surface. */
static void test_tessellation_shares(void **state)
{
    (void)state;
    struct irb_error err = {0};
    char *folder = fixture_folder();
    const char *const before = gl->shader_dir;
    fixture_write(folder, "lights/ism_splat.geom", counting_geometry);
    gl->shader_dir = folder;
    uint64_t random = 5;
    double corners[12][3][3], total = 0, unused[3];
    for (int i = 0; i < 12 * 9; i++)
        corners[i / 9][i / 3 % 3][i % 3] = fixture_random(&random) * (i < 50 ? 1 : 0.2);
    struct irb_builder builder;
    irb_builder_begin(&builder, "triangles");
    irb_builder_object(&builder, "t", irb_builder_material(&builder, "m", grey));
    for (int t = 0; t < 12; t++)
        for (uint32_t i = 0; i < 3; i++)
            irb_builder_vertex(&builder, corners[t][i], corners[0][0], NULL);
    for (uint32_t t = 0; t < 12; t++)
        irb_builder_triangle(&builder, 3 * t, 3 * t + 1, 3 * t + 2);
    struct world w = {0};
    create_world(&w, gl, irb_builder_finish(&builder, &err), (struct irb_points_desc){.count = 1},
                 1);
    struct irb_buffer *sums = irb_buffer_create(gl, "sums", 8, (uint32_t[2]){0, 0}, &err);
    for (uint32_t t = 0; t < 12; t++)
        total += irb_triangle_size(w.scene, t, unused);
    struct irb_tessellation_range range;
    irb_tessellation_measure(w.scene, &range);
    const float factors[][2] = {{1, 1}, {1, 2}, {1, 7}, {3, 16}, {2, 64}, {64, 64}};
    for (int k = 0; k < 6; k++) {
        uint32_t found[2] = {0, 0};
        struct irb_ism_settings settings = default_settings();
        settings.splatter = IRB_ISM_TESSELLATION;
        settings.f_min = factors[k][0];
        settings.f_max = factors[k][1];
        REQUIRE_OK(irb_buffer_write(sums, 0, 8, found, &err));
        gl->api.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 7, sums->id);
        REQUIRE_OK(irb_ism_splat(w.ism, w.scene_gl, NULL, &w.view, &settings, &err));
        REQUIRE_OK(irb_buffer_read(sums, 0, 8, found, &err));
        REQUIRE_REL(found[1] * 1e-8, total, 1e-5);
        REQUIRE_NEAR(found[0],
                     irb_tessellation_points(w.scene, &range, 3, (double)factors[k][0],
                                             (double)factors[k][1]),
                     0);
    }
    irb_buffer_destroy(sums);
    destroy_world(&w);
    gl->shader_dir = before;
    fixture_remove(folder);
}

/* ---- Borders, dark lights, no lights ---- */

/* One bright light among dark ones: all other maps stay empty, whatever the splatter and with
 * pull-push, though hundreds of large splats are cut at its map's border. */
static void test_borders(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct world w = {0};
    struct irb_ism_settings settings = default_settings();
    const int bright = 9 + 8; /* not at the atlas's rim */
    create_cornell(&w, gl, MOST_LIGHTS);
    for (int l = 0; l < MOST_LIGHTS; l++)
        for (int c = 0; c < 3; c++)
            w.lights[l].flux[c] = l == bright && c == 1 ? 1e-20f : 0;
    replace_lights(&w, MOST_LIGHTS);
    settings.splat_most = 41;
    settings.splat_scale = 10;
    settings.splat_factor = 20;
    settings.pull_push = 6;
    struct fixture_maps expected = expect(&w, &settings);
    REQUIRE_CMP((double)expected.cut, >, 200);
    for (int splatter = 0; splatter < 3; splatter++) {
        settings.splatter = splatter;
        struct fixture_maps found = splat(&w, &settings);
        if (splatter != IRB_ISM_TESSELLATION)
            fixture_require_maps(&found, &expected, 0, 1e-4);
        fixture_maps_destroy(&found);
        for (int pull = 0; pull < 2; pull++) {
            settings.pull = pull;
            REQUIRE_OK(irb_ism_pull_push(w.ism, &settings, &err));
            found = fixture_maps_read(w.ism);
            for (size_t i = 0; i < fixture_map_texel(&found, MOST_LIGHTS, 0, 0); i++)
                if ((int)(i / (SIZE * SIZE)) == bright)
                    assert_true(found.distance[i] > 0 && isfinite(found.distance[i]));
                else
                    assert_true(isinf(found.distance[i]));
            fixture_maps_destroy(&found);
        }
        double share;
        REQUIRE_OK(irb_ism_coverage(w.ism, &share, &err));
        REQUIRE_NEAR(share, 1, 0); /* dark maps do not count */
    }
    fixture_maps_destroy(&expected);
    destroy_world(&w);
}

/* From many to fewer lights, to none and back; no points. */
static void test_no_lights(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct world w = {0};
    struct irb_ism_settings settings = default_settings();
    settings.pull_push = 2;
    create_cornell(&w, gl, 64);
    double share;
    for (int splatter = 0; splatter < 3; splatter++) {
        const int counts[] = {64, 9, 0, 3};
        settings.splatter = splatter;
        for (int k = 0; k < 4; k++) {
            w.view.count = counts[k];
            REQUIRE_OK(irb_ism_build(w.ism, w.scene_gl, splatter == 2 ? NULL : w.points, &w.view,
                                     &settings, &err));
            assert_int_equal(w.ism->count, counts[k]);
            struct fixture_maps found = fixture_maps_read(w.ism); /* the rest is empty */
            fixture_maps_destroy(&found);
            REQUIRE_OK(irb_ism_coverage(w.ism, &share, &err));
            assert_true(counts[k] ? share > 0 && share <= 1 : share == 0);
        }
    }
    irb_points_destroy(w.points);
    REQUIRE_OK(w.points = irb_points_create(gl, w.scene_gl, &(struct irb_points_desc){0}, &err));
    for (int splatter = 0; splatter < 2; splatter++) {
        settings.splatter = splatter;
        REQUIRE_OK(irb_ism_build(w.ism, w.scene_gl, w.points, &w.view, &settings, &err));
        REQUIRE_OK(irb_ism_coverage(w.ism, &share, &err));
        REQUIRE_NEAR(share, 0, 0);
    }
    destroy_world(&w);
}

/* ---- Refusals ---- */

static void require_refused(struct world *w, struct irb_ism_settings settings, const char *part)
{
    struct irb_error err = {0};
    assert_false(irb_ism_build(w->ism, w->scene_gl, w->points, &w->view, &settings, &err));
    assert_int_equal(err.code, IRB_E_INPUT);
    REQUIRE_CONTAINS(err.message, part);
}

static void test_refusals(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct world w = {0};
    create_cornell(&w, gl, 3);
    struct irb_ism_settings s = default_settings();
    assert_null(irb_ism_create(gl, 4, 1, &err));
    assert_int_equal(err.code, IRB_E_INPUT);
    assert_null(irb_ism_create(gl, 128, 1025, &err));
    assert_null(irb_ism_create(gl, 128, 0, &err));
    for (int k = 0; k < 4; k++) {
        s.splat_factor = (float[]){0, -1, 65, NAN}[k];
        require_refused(&w, s, "splat factor");
    }
    s = default_settings();
    s.splat_scale = INFINITY;
    require_refused(&w, s, "splat scale");
    s = default_settings();
    s.splat_most = 0;
    require_refused(&w, s, "1 texel");
    s = default_settings();
    s.near = -1;
    require_refused(&w, s, "near");
    s = default_settings();
    s.pull_push = 7; /* 64 = 2^6 */
    require_refused(&w, s, "multiple of 2^7");
    s = default_settings();
    s.splatter = IRB_ISM_TESSELLATION;
    s.f_max = 65;
    require_refused(&w, s, "64 levels");
    s = default_settings();
    s.splatter = IRB_ISM_RASTER;
    s.splat_most = 100000;
    require_refused(&w, s, "driver's points");
    w.view.count = MOST_LIGHTS + 1;
    require_refused(&w, default_settings(), "65 lights for 64 maps");
    destroy_world(&w);
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), argc > 2 ? argv[2] : NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_points),       cmocka_unit_test(test_near_radii),
        cmocka_unit_test(test_raster),       cmocka_unit_test(test_chunks),
        cmocka_unit_test(test_follow),       cmocka_unit_test(test_deforming),
        cmocka_unit_test(test_tessellation), cmocka_unit_test(test_tessellation_shares),
        cmocka_unit_test(test_borders),      cmocka_unit_test(test_no_lights),
        cmocka_unit_test(test_refusals),     cmocka_unit_test(test_large_splats),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failed;
}
