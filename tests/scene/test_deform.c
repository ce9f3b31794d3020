/* SPDX-License-Identifier: MIT
 *
 * Morph targets and skins of glTF files, and the built-in cloth: every vertex and normal against
 * its closed form in double precision.
 */
#include "core/scene/builtin.h"
#include "core/scene/deform.h"
#include "core/scene/gltf/write.h"
#include "core/scene/pose.h"

#include "tests/support/compare.h"
#include "tests/scene/gltf_files.h"

#define COUNT(array) ((int)(sizeof(array) / sizeof *(array)))

static struct irb_scene *load(const char *path)
{
    struct irb_error err = {0};
    struct irb_scene *scene = irb_scene_load(path, NULL, &err);

    if (!scene)
        fail_msg("%s: %s", path, err.message);
    return scene;
}

static void animate(struct irb_scene *scene, double seconds)
{
    struct irb_error err = {0};

    if (!irb_scene_animate(scene, seconds, &err))
        fail_msg("at %g s: %s", seconds, err.message);
}

static bool same_key(const struct irb_key *a, const struct irb_key *b)
{
    return !strcmp(a->hex, b->hex);
}

static void require_vector(const float *found, const double expected[3], double tolerance)
{
    for (int i = 0; i < 3; i++)
        REQUIRE_NEAR(found[i], expected[i], tolerance);
}

static void normalize(double v[3])
{
    double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);

    for (int i = 0; i < 3; i++)
        v[i] /= length;
}

/* ---- A grid with two morph targets ---- */

enum {
    COLUMNS = 5,
    ROWS = 4,
    GRID = COLUMNS * ROWS,
    GRID_TRIANGLES = 2 * (COLUMNS - 1) * (ROWS - 1)
};

/* x in 0..4, z in 0..3, y = 0. Target 0 bends it to y = x^2/10, target 1 shears it and lifts it. */
struct grid {
    float positions[GRID][3], normals[GRID][3], deltas[2][GRID][3], normal_deltas[GRID][3];
    uint16_t indices[GRID_TRIANGLES][3];
};

static const double lift = 0.5, shear = 0.25;

/* The node's: scaled by 2 along x, 1 up. */
static const char *const grid_node =
    "{\"mesh\":0,\"name\":\"sheet\",\"scale\":[2,1,1],\"translation\":[0,1,0]%s}";

static void make_grid(struct grid *grid)
{
    *grid = (struct grid){0};
    for (int v = 0; v < GRID; v++) {
        const float x = (float)(v % COLUMNS), z = (float)(v / COLUMNS);

        grid->positions[v][0] = x;
        grid->positions[v][2] = z;
        grid->normals[v][1] = 1;
        grid->deltas[0][v][1] = x * x / 10;
        grid->normal_deltas[v][0] = -x / 5;
        grid->deltas[1][v][0] = (float)shear * z;
        grid->deltas[1][v][1] = (float)lift;
    }
    for (int t = 0; t < GRID_TRIANGLES; t++) {
        const int cell = t / 2, a = cell / (COLUMNS - 1) * COLUMNS + cell % (COLUMNS - 1);
        const int corners[2][3] = {{a, a + COLUMNS + 1, a + 1}, {a, a + COLUMNS, a + COLUMNS + 1}};

        for (int i = 0; i < 3; i++)
            grid->indices[t][i] = (uint16_t)corners[t % 2][i];
    }
}

/* In the world, at weights w. */
static void grid_point(double x, double z, const double w[2], double out[3])
{
    out[0] = 2 * (x + w[1] * shear * z);
    out[1] = 1 + w[0] * (float)(x * x / 10) + w[1] * lift;
    out[2] = z;
}

/* n0 + w dn by the inverse transpose: x over 2. Target 1 has no normals in the file. */
static void grid_normal(double x, const double w[2], double out[3])
{
    out[0] = -w[0] * x / 5 / 2;
    out[1] = 1;
    out[2] = 0;
    normalize(out);
}

static void require_grid(const struct irb_scene *scene, const double w[2])
{
    const float *positions = irb_scene_current_positions(scene);
    const float *normals = irb_scene_current_normals(scene);

    REQUIRE_CMP(scene->vertex_count, ==, GRID);
    for (int v = 0; v < GRID; v++) {
        double point[3], normal[3];

        grid_point(v % COLUMNS, v / COLUMNS, w, point);
        grid_normal(v % COLUMNS, w, normal);
        require_vector(positions + 3 * v, point, 1e-6);
        require_vector(normals + 3 * v, normal, 2e-7);
    }
}

/* Keys of both weights at 0, 1 and 3 s. */
static const float key_times[3] = {0, 1, 3};
static const float key_weights[3][2] = {{0, 0}, {1, 0.5f}, {-0.5f, 2}};
static const float key_tangents[3][2] = {{1, -1}, {0.5f, 0}, {0, 2}};

/* A file with the grid and an animation of that interpolation, NULL: without; the path. */
static char *write_grid(const char *folder, const struct grid *grid, bool normals,
                        const char *interpolation, const char *mesh, const char *node)
{
    float values[3][3][2];
    const bool cubic = interpolation && !strcmp(interpolation, "CUBICSPLINE");
    const int first = normals ? 3 : 2; /* accessors before: positions, normals, indices */
    /* without normals in the mesh the target's have no meaning, and no effect */
    char *targets = irb_asprintf(",\"targets\":[{\"POSITION\":%d,\"NORMAL\":%d},"
                                 "{\"POSITION\":%d}]",
                                 first, first + 2, first + 1);
    char *nodes = irb_asprintf(grid_node, node ? node : "");
    char *top =
        irb_asprintf(",\"animations\":[{\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,"
                     "\"path\":\"weights\"}}],\"samplers\":[{\"input\":%d,\"output\":%d,"
                     "\"interpolation\":\"%s\"}]}]",
                     first + 3, first + 4, interpolation ? interpolation : "");

    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 2; i++) {
            values[k][0][i] = values[k][2][i] = key_tangents[k][i];
            values[k][1][i] = key_weights[k][i];
        }
    const struct test_array extra[] = {
        {grid->deltas[0], sizeof grid->deltas[0], 5126, "VEC3", GRID},
        {grid->deltas[1], sizeof grid->deltas[1], 5126, "VEC3", GRID},
        {grid->normal_deltas, sizeof grid->normal_deltas, 5126, "VEC3", GRID},
        {key_times, sizeof key_times, 5126, "SCALAR", 3},
        {cubic ? (const void *)values : key_weights, cubic ? sizeof values : sizeof key_weights,
         5126, "SCALAR", cubic ? 18 : 6}};
    const struct test_gltf gltf = {.positions = grid->positions[0],
                                   .normals = normals ? grid->normals[0] : NULL,
                                   .vertices = GRID,
                                   .indices = grid->indices,
                                   .index_count = 3 * GRID_TRIANGLES,
                                   .index_component = 5123,
                                   .primitive = targets,
                                   .nodes = nodes,
                                   .mesh = mesh,
                                   .top = interpolation ? top : NULL,
                                   .extra = extra,
                                   .extra_count = COUNT(extra)};
    char *path = write_gltf(folder, &gltf);

    free(targets);
    free(nodes);
    free(top);
    return path;
}

/* glTF 2.0, appendix C, from the keys. */
static void expected_weights(const char *interpolation, double seconds, double w[2])
{
    const int k = seconds < 1 ? 0 : 1;
    const double length = (double)key_times[k + 1] - key_times[k];
    const double s = fmin(fmax((seconds - key_times[k]) / length, 0), 1), s2 = s * s, s3 = s2 * s;

    for (int i = 0; i < 2; i++) {
        const double a = key_weights[k][i], b = key_weights[k + 1][i];

        if (!strcmp(interpolation, "STEP"))
            w[i] = s < 1 ? a : b;
        else if (!strcmp(interpolation, "LINEAR"))
            w[i] = a + s * (b - a);
        else
            w[i] = (2 * s3 - 3 * s2 + 1) * a + (s3 - 2 * s2 + s) * length * key_tangents[k][i] +
                   (3 * s2 - 2 * s3) * b + (s3 - s2) * length * key_tangents[k + 1][i];
    }
}

static void vertices_are_rest_plus_weighted_targets(void **state)
{
    static const char *const kinds[] = {"LINEAR", "STEP", "CUBICSPLINE"};
    static const double times[] = {0, 0.25, 1, 1.5, 2.75, 3, 9, -1};
    struct grid grid;

    make_grid(&grid);
    for (int kind = 0; kind < COUNT(kinds); kind++) {
        char *path = write_grid(*state, &grid, true, kinds[kind], NULL, NULL);
        struct irb_scene *scene = load(path);
        double first, last;

        assert_true(irb_scene_duration(scene, &first, &last));
        REQUIRE_NEAR(first, 0, 0);
        REQUIRE_NEAR(last, 3, 0);
        for (int i = 0; i < COUNT(times); i++) {
            double w[2];

            animate(scene, times[i]);
            expected_weights(kinds[kind], times[i], w);
            require_grid(scene, w);
            for (int k = 0; k < 16; k++) /* the vertices move, not the object */
                REQUIRE_NEAR(scene->objects[0].transform[k], k % 5 == 0, 0);
        }
        irb_scene_destroy(scene);
        free(path);
    }
}

/* Of a surface without normals in the file: those of its triangles, whatever they have become. */
static void flat_surfaces_stay_flat(void **state)
{
    struct grid grid;
    struct irb_scene *scene;
    char *path;

    make_grid(&grid);
    path = write_grid(*state, &grid, false, "LINEAR", NULL, NULL);
    scene = load(path);
    REQUIRE_CMP(scene->vertex_count, ==, 3 * GRID_TRIANGLES);
    for (int step = 0; step < 4; step++) {
        double w[2];

        animate(scene, step);
        expected_weights("LINEAR", step, w);
        for (int t = 0; t < GRID_TRIANGLES; t++) {
            double p[3][3], n[3];

            for (int i = 0; i < 3; i++) {
                const int v = grid.indices[t][i];
                const size_t at = 3 * (size_t)scene->indices[3 * t + i];

                grid_point(v % COLUMNS, v / COLUMNS, w, p[i]);
                require_vector(irb_scene_current_positions(scene) + at, p[i], 1e-6);
            }
            for (int i = 0; i < 3; i++) {
                const int j = (i + 1) % 3, k = (i + 2) % 3;

                n[i] = (p[1][j] - p[0][j]) * (p[2][k] - p[0][k]) -
                       (p[1][k] - p[0][k]) * (p[2][j] - p[0][j]);
            }
            normalize(n);
            for (int i = 0; i < 3; i++)
                require_vector(irb_scene_current_normals(scene) +
                                   3 * (size_t)scene->indices[3 * t + i],
                               n, 1e-6);
        }
    }
    irb_scene_destroy(scene);
    free(path);
}

static void the_key_follows_the_weights_and_comes_back(void **state)
{
    struct grid grid;
    struct irb_key rest, still, bent, again;
    struct irb_scene *scene;
    char *path;

    make_grid(&grid);
    path = write_grid(*state, &grid, true, NULL, NULL, NULL);
    scene = load(path);
    assert_null(scene->deform); /* nothing animates it: nothing is kept */
    assert_ptr_equal(irb_scene_current_positions(scene), scene->positions);
    still = irb_scene_key(scene);
    irb_scene_destroy(scene);
    free(path);
    path = write_grid(*state, &grid, true, "LINEAR", NULL, NULL);
    scene = load(path);
    rest = irb_scene_key(scene);
    assert_true(same_key(&rest, &still));
    animate(scene, 1);
    bent = irb_scene_key(scene);
    assert_false(same_key(&bent, &rest));
    assert_false(irb_deform_at_rest(scene));
    animate(scene, 1.0001);
    again = irb_scene_key(scene);
    assert_false(same_key(&again, &bent));
    animate(scene, 1);
    again = irb_scene_key(scene);
    assert_true(same_key(&again, &bent));
    animate(scene, 0);
    again = irb_scene_key(scene);
    assert_true(same_key(&again, &rest));
    assert_true(irb_deform_at_rest(scene));
    assert_memory_equal(irb_scene_current_positions(scene), scene->positions, GRID * 12);
    irb_scene_destroy(scene);
    free(path);
}

static void bounds_are_those_of_the_vertices_now(void **state)
{
    struct grid grid;
    struct irb_scene *scene;
    float min[3], max[3];
    char *path;

    make_grid(&grid);
    path = write_grid(*state, &grid, true, "LINEAR", NULL, NULL);
    scene = load(path);
    irb_scene_current_bounds(scene, min, max);
    REQUIRE_NEAR(max[0], 8, 0);
    REQUIRE_NEAR(max[1], 1, 0);
    animate(scene, 1); /* w = (1, 1/2) */
    irb_scene_current_bounds(scene, min, max);
    require_vector(min, (const double[]){0, 1.25, 0}, 1e-6);
    require_vector(max, (const double[]){2 * (4 + 0.5 * shear * 3), 1 + 1.6 + 0.25, 3}, 1e-6);
    irb_object_current_bounds(scene, &scene->objects[0], min, max);
    REQUIRE_NEAR(max[1], 2.85, 1e-6);
    irb_object_rest_bounds(scene, &scene->objects[0], min, max);
    REQUIRE_NEAR(max[1], 1, 0);
    REQUIRE_NEAR(scene->bounds_max[1], 1, 0);
    irb_scene_destroy(scene);
    free(path);
}

/* Weights that the file gives pose it at rest: the node's before the mesh's. */
static void weights_at_rest(void **state)
{
    struct grid grid;

    make_grid(&grid);
    for (int i = 0; i < 4; i++) {
        const bool of_node = i % 2, animated = i / 2;
        const double w[2] = {of_node ? 0.25 : 2, of_node ? -1 : 0.5};
        char *path = write_grid(*state, &grid, true, animated ? "LINEAR" : NULL,
                                ",\"weights\":[2,0.5]", of_node ? ",\"weights\":[0.25,-1]" : NULL);
        struct irb_scene *scene = load(path);
        float min[3], max[3];

        require_grid(scene, w);
        assert_true(irb_deform_at_rest(scene));
        assert_int_equal(scene->deform != NULL, animated);
        irb_object_rest_bounds(scene, &scene->objects[0], min, max);
        REQUIRE_NEAR(scene->bounds_max[1], max[1], 0);
        if (animated) {
            struct irb_key rest = irb_scene_key(scene), now;

            animate(scene, 0); /* weights 0: not the pose at rest */
            require_grid(scene, (const double[]){0, 0});
            now = irb_scene_key(scene);
            assert_false(same_key(&now, &rest));
            irb_deform_reset(scene);
            require_grid(scene, w);
        }
        irb_scene_destroy(scene);
        free(path);
    }
}

/* Poses play it frame by frame; without it the vertices rest, and scripts move the object on top.
 */
static void poses_deform_and_reset(void **state)
{
    struct irb_pose_key keys[] = {{.frame = 0, .scale = {1, 1, 1}},
                                  {.frame = 4, .translate = {0, 3, 0}, .scale = {1, 1, 1}}};
    struct irb_object_script script = {.name = (char[]){"sheet"}, .keys = keys, .key_count = 2};
    struct irb_poses poses = {
        .plays = true, .fps = 2, .start = 1, .objects = &script, .object_count = 1};
    struct irb_error err = {0};
    struct irb_scene *scene;
    struct grid grid;
    char *path;

    make_grid(&grid);
    path = write_grid(*state, &grid, true, "LINEAR", NULL, NULL);
    scene = load(path);
    REQUIRE_OK(irb_poses_check(&poses, scene, &err));
    for (int frame = -2; frame < 4; frame++) {
        const double seconds = 1 + fmax(frame, 0) / 2;
        double w[2];

        REQUIRE_OK(irb_poses_apply(&poses, scene, (float)frame, &err));
        expected_weights("LINEAR", seconds, w);
        require_grid(scene, w);
        REQUIRE_NEAR(scene->objects[0].transform[13], 3 * fmax(frame, 0) / 4, 1e-6);
    }
    poses.plays = false;
    REQUIRE_OK(irb_poses_apply(&poses, scene, 2, &err));
    require_grid(scene, (const double[]){0, 0});
    REQUIRE_NEAR(scene->objects[0].transform[13], 1.5, 1e-6);
    irb_scene_destroy(scene);
    free(path);
}

static void export_writes_the_pose(void **state)
{
    struct irb_error err = {0};
    struct irb_scene *scene, *again;
    struct grid grid;
    float min[3], max[3];
    char *path, *out = irb_asprintf("%s/out.glb", (char *)*state);

    make_grid(&grid);
    path = write_grid(*state, &grid, true, "LINEAR", NULL, NULL);
    scene = load(path);
    animate(scene, 1);
    REQUIRE_OK(irb_scene_export(scene, NULL, NULL, out, &err));
    again = load(out);
    irb_scene_current_bounds(scene, min, max);
    for (int i = 0; i < 3; i++) {
        REQUIRE_NEAR(again->bounds_min[i], min[i], 0);
        REQUIRE_NEAR(again->bounds_max[i], max[i], 0);
    }
    irb_scene_destroy(scene);
    irb_scene_destroy(again);
    free(path);
    free(out);
}

/* ---- A strip of two bones ---- */

enum { STRIP_ROWS = 9, STRIP = 2 * STRIP_ROWS, STRIP_TRIANGLES = 2 * (STRIP_ROWS - 1) };

/* Upright, y in 0..2, x = -0.1 and 0.1; bone 1 takes over between y = 0.5 and 1.5. It has a morph
 * target that moves it by 0.3 along z. The last vertex is held by no bone. */
struct strip {
    float positions[STRIP][3], normals[STRIP][3], delta[STRIP][3], shares[STRIP][4];
    uint8_t joints[STRIP][4];
};

static double upper_share(double y)
{
    return fmin(fmax(y - 0.5, 0), 1);
}

static void make_strip(struct strip *strip)
{
    *strip = (struct strip){0};
    for (int v = 0; v < STRIP; v++) {
        const double y = 0.25 * (v / 2);
        const float total = v % 3 ? 1 : 4; /* of any sum */

        strip->positions[v][0] = v % 2 ? 0.1f : -0.1f;
        strip->positions[v][1] = (float)y;
        strip->normals[v][0] = v % 2 ? 1 : -1;
        strip->delta[v][2] = 0.3f;
        strip->joints[v][0] = 1; /* joints in any order, and any number where the share is 0 */
        strip->joints[v][1] = 0;
        strip->joints[v][2] = 200;
        strip->shares[v][0] = total * (float)upper_share(y);
        strip->shares[v][1] = total * (float)(1 - upper_share(y));
    }
    memset(strip->shares[STRIP - 1], 0, sizeof strip->shares[0]);
}

/* Bone 0 stands at the origin, bone 1 at (0, 1, 0) and turns by 90 degrees about z in a second;
 * meanwhile the weight goes from 0 to 1. */
static char *write_strip(const char *folder, const struct strip *strip, bool skinned)
{
    static const float binds[2][16] = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
                                       {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1}};
    static const float times[2] = {0, 1}, weights[2] = {0, 1};
    static const float turns[2][4] = {{0, 0, 0, 1}, {0, 0, 0.70710678f, 0.70710678f}};
    const struct test_array extra[] = {{strip->joints, sizeof strip->joints, 5121, "VEC4", STRIP},
                                       {strip->shares, sizeof strip->shares, 5126, "VEC4", STRIP},
                                       {strip->delta, sizeof strip->delta, 5126, "VEC3", STRIP},
                                       {binds, sizeof binds, 5126, "MAT4", 2},
                                       {times, sizeof times, 5126, "SCALAR", 2},
                                       {weights, sizeof weights, 5126, "SCALAR", 2},
                                       {turns, sizeof turns, 5126, "VEC4", 2}};
    const struct test_gltf gltf = {
        .positions = strip->positions[0],
        .normals = strip->normals[0],
        .vertices = STRIP,
        .mode = 5, /* TRIANGLE_STRIP */
        .attributes = ",\"JOINTS_0\":2,\"WEIGHTS_0\":3",
        .primitive = ",\"targets\":[{\"POSITION\":4}]",
        .roots = "0,1",
        .nodes = skinned ? "{\"mesh\":0,\"skin\":0,\"name\":\"strip\",\"translation\":[5,0,0]},"
                           "{\"name\":\"lower\",\"children\":[2]},"
                           "{\"name\":\"upper\",\"translation\":[0,1,0]}"
                         : "{\"mesh\":0,\"name\":\"strip\",\"translation\":[5,0,0]},"
                           "{\"name\":\"lower\",\"children\":[2]},{\"translation\":[0,1,0]}",
        .top = ",\"skins\":[{\"joints\":[1,2],\"inverseBindMatrices\":5}],"
               "\"animations\":[{\"channels\":["
               "{\"sampler\":0,\"target\":{\"node\":0,\"path\":\"weights\"}},"
               "{\"sampler\":1,\"target\":{\"node\":2,\"path\":\"rotation\"}}],"
               "\"samplers\":[{\"input\":6,\"output\":7},{\"input\":6,\"output\":8}]}]",
        .extra = extra,
        .extra_count = COUNT(extra)};

    return write_gltf(folder, &gltf);
}

/* Linear blend skinning of vertex v, the bone turned by `angle`, the target added by `w`. */
static void strip_vertex(const struct strip *strip, int v, double angle, double w, double point[3],
                         double normal[3])
{
    const float *p = strip->positions[v];
    const double x = p[0], y = p[1], upper = upper_share(y), lower = 1 - upper;
    const double a = lower + upper * cos(angle), b = upper * sin(angle); /* a -b / b a */
    const double side = strip->normals[v][0];

    point[0] = lower * x + upper * (cos(angle) * x - sin(angle) * (y - 1));
    point[1] = lower * y + upper * (1 + sin(angle) * x + cos(angle) * (y - 1));
    point[2] = w * (double)0.3f;
    normal[0] = side * a; /* the cofactors of a -b / b a are a -b / b a */
    normal[1] = side * b;
    normal[2] = 0;
    normalize(normal);
    if (v == STRIP - 1) { /* stays with its node */
        point[0] = x + 5;
        point[1] = y;
        normal[0] = side;
        normal[1] = 0;
    }
}

static void a_skin_follows_its_bones(void **state)
{
    static const double times[] = {0, 0.3, 0.5, 1, 7};
    struct irb_scene *scene;
    struct strip strip;
    struct irb_key rest, now;
    char *path;

    make_strip(&strip);
    path = write_strip(*state, &strip, true);
    scene = load(path);
    rest = irb_scene_key(scene);
    REQUIRE_CMP(scene->vertex_count, ==, STRIP);
    REQUIRE_CMP(scene->triangle_count, ==, STRIP_TRIANGLES);
    for (int i = 0; i < COUNT(times); i++) {
        const double s = fmin(times[i], 1);

        animate(scene, times[i]);
        for (int v = 0; v < STRIP; v++) {
            double point[3], normal[3];

            strip_vertex(&strip, v, s * M_PI / 2, s, point, normal);
            require_vector(irb_scene_current_positions(scene) + 3 * v, point, 3e-7);
            require_vector(irb_scene_current_normals(scene) + 3 * v, normal, 2e-7);
        }
        for (int k = 0; k < 16; k++) /* the bones move it, not its node */
            REQUIRE_NEAR(scene->objects[0].transform[k], k % 5 == 0, 0);
        now = irb_scene_key(scene);
        assert_int_equal(same_key(&now, &rest), i == 0);
    }
    irb_scene_destroy(scene);
    free(path);
}

/* The same mesh where the node names no skin: it stands where the node is, and morphs alone. */
static void joints_without_a_skin_do_nothing(void **state)
{
    struct irb_scene *scene;
    struct strip strip;
    char *path;

    make_strip(&strip);
    path = write_strip(*state, &strip, false);
    scene = load(path);
    animate(scene, 1);
    for (int v = 0; v < STRIP; v++) {
        const float *p = strip.positions[v];
        const double point[3] = {p[0] + 5.0, p[1], 0.3};

        require_vector(irb_scene_current_positions(scene) + 3 * v, point, 1e-6);
    }
    irb_scene_destroy(scene);
    free(path);
}

/* ---- The built-in cloth ---- */

/* core/scene/builtin/cloth.c: 49 x 49 vertices; the wave is sin and cos but for 0.1 %, the error of
 * eight cubic keys a period ((pi/4)^4/384). */
static void require_cloth(const struct irb_scene *scene, double seconds)
{
    static const double corner[3] = {0.1, 0.36, 0.44}, width = 0.36, length = 0.38;
    const double lean = 40 * M_PI / 180, amplitude = 0.04, wave_error = 1.05e-3;
    const double down[3] = {0, -sin(lean), -cos(lean)}, up[3] = {0, cos(lean), -sin(lean)};
    const double u = 2 * M_PI * 1.25, v = 2 * M_PI * 0.75;
    const uint32_t first = scene->vertex_count - 49 * 49;

    for (int k = 0; k < 49 * 49; k++) {
        const double s = k % 49 / 48.0, t = k / 49 / 48.0;
        const double p = u * s + v * t - M_PI * seconds;
        const double h = amplitude * t * sin(p), h_s = amplitude * t * cos(p) * u / width;
        const double h_t = amplitude * (sin(p) + t * cos(p) * v) / length;
        double point[3], normal[3];

        for (int i = 0; i < 3; i++) {
            point[i] = corner[i] + (i == 0 ? s * width : 0) + t * length * down[i] + h * up[i];
            normal[i] = up[i] - (i == 0 ? h_s : 0) - h_t * down[i];
        }
        normalize(normal);
        require_vector(irb_scene_current_positions(scene) + 3 * (first + (size_t)k), point,
                       amplitude * wave_error + 1e-7);
        require_vector(irb_scene_current_normals(scene) + 3 * (first + (size_t)k), normal,
                       2 * wave_error);
    }
}

static void the_cloth_waves(void **state)
{
    struct irb_scene *scene = load("cornell-cloth");
    struct irb_key rest = irb_scene_key(scene), now;
    double first, last;
    (void)state;

    assert_true(irb_builtin_find("cornell-cloth")->animated);
    assert_true(irb_scene_duration(scene, &first, &last));
    REQUIRE_NEAR(last, 120, 0);
    require_cloth(scene, 0); /* at rest */
    for (int i = 0; i <= 12; i++) {
        animate(scene, 0.3 * i);
        require_cloth(scene, 0.3 * i);
        now = irb_scene_key(scene);
        assert_int_equal(same_key(&now, &rest), i == 0);
    }
    animate(scene, 60);
    now = irb_scene_key(scene);
    assert_true(same_key(&now, &rest)); /* a whole number of periods */
    irb_scene_destroy(scene);
}

static int make_folder(void **state)
{
    *state = test_folder();
    return 0;
}

static int drop_folder(void **state)
{
    remove_folder(*state);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(vertices_are_rest_plus_weighted_targets),
        cmocka_unit_test(flat_surfaces_stay_flat),
        cmocka_unit_test(the_key_follows_the_weights_and_comes_back),
        cmocka_unit_test(bounds_are_those_of_the_vertices_now),
        cmocka_unit_test(weights_at_rest),
        cmocka_unit_test(poses_deform_and_reset),
        cmocka_unit_test(export_writes_the_pose),
        cmocka_unit_test(a_skin_follows_its_bones),
        cmocka_unit_test(joints_without_a_skin_do_nothing),
        cmocka_unit_test(the_cloth_waves),
    };

    return cmocka_run_group_tests(tests, make_folder, drop_folder);
}
