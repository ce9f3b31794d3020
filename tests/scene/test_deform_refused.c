/* SPDX-License-Identifier: MIT
 *
 * Morph targets and skins that are malformed: each is refused with one line that names the file and
 * the cause; and files with random bytes in them, which must load or be refused.
 */
#include "tests/support/compare.h"

#include "core/scene/deform.h"
#include "tests/scene/gltf_files.h"

#define COUNT(array) ((int)(sizeof(array) / sizeof *(array)))

/* A triangle with two morph targets, a skin of two joints and an animation of both, that may be
 * changed before it is written. Accessors: 0 positions; 1 and 2 targets; 3 joints; 4 shares;
 * 5 inverse bind matrices; 6 times; 7 weights; 8 rotations. */
struct sample {
    float targets[2][9], shares[3][4], binds[2][16], times[2], weights[2][2], turns[2][4];
    uint8_t joints[3][4];
    struct test_array extra[8];
    struct test_gltf gltf;
};

static void make_sample(struct sample *s)
{
    const struct sample values = {.targets = {{[5] = 1}, {[8] = 1}},
                                  .shares = {{1}, {1, 1}, {0, 1}},
                                  .joints = {{0, 1}, {0, 1}, {0, 1}},
                                  .times = {0, 1},
                                  .weights = {{0, 0}, {1, 2}},
                                  .turns = {{0, 0, 0, 1}, {0, 0, 1, 0}}};

    *s = values;
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < 4; i++)
            s->binds[k][5 * i] = 1;
    s->extra[0] = (struct test_array){s->targets[0], 36, 5126, "VEC3", 3};
    s->extra[1] = (struct test_array){s->targets[1], 36, 5126, "VEC3", 3};
    s->extra[2] = (struct test_array){s->joints, sizeof s->joints, 5121, "VEC4", 3};
    s->extra[3] = (struct test_array){s->shares, sizeof s->shares, 5126, "VEC4", 3};
    s->extra[4] = (struct test_array){s->binds, sizeof s->binds, 5126, "MAT4", 2};
    s->extra[5] = (struct test_array){s->times, sizeof s->times, 5126, "SCALAR", 2};
    s->extra[6] = (struct test_array){s->weights, sizeof s->weights, 5126, "SCALAR", 4};
    s->extra[7] = (struct test_array){s->turns, sizeof s->turns, 5126, "VEC4", 2};
    s->gltf = (struct test_gltf){
        .attributes = ",\"JOINTS_0\":3,\"WEIGHTS_0\":4",
        .primitive = ",\"targets\":[{\"POSITION\":1},{\"POSITION\":2}]",
        .roots = "0,1",
        .nodes = "{\"mesh\":0,\"skin\":0,\"name\":\"thing\"},{\"children\":[2]},{}",
        .top = ",\"skins\":[{\"joints\":[1,2],\"inverseBindMatrices\":5}],\"animations\":["
               "{\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,\"path\":\"weights\"}},"
               "{\"sampler\":1,\"target\":{\"node\":2,\"path\":\"rotation\"}}],"
               "\"samplers\":[{\"input\":6,\"output\":7},{\"input\":6,\"output\":8}]}]",
        .extra = s->extra,
        .extra_count = COUNT(s->extra)};
}

static void require_refused(const char *folder, const struct sample *s, const char *expected)
{
    char *path = write_gltf(folder, &s->gltf);
    struct irb_error err = {0};
    struct irb_scene *scene = irb_scene_load(path, NULL, &err);

    if (scene)
        fail_msg("%s loaded, expected a message with \"%s\"", path, expected);
    REQUIRE_CMP(err.code, ==, IRB_E_INPUT);
    if (!strstr(err.message, path) || !strstr(err.message, expected) || strchr(err.message, '\n'))
        fail_msg("message \"%s\", expected one line with \"%s\"", err.message, expected);
    free(path);
}

static void the_sample_itself_is_fine(void **state)
{
    struct irb_error err = {0};
    struct irb_scene *scene;
    struct sample s;
    char *path;

    make_sample(&s);
    path = write_gltf(*state, &s.gltf);
    scene = irb_scene_load(path, NULL, &err);
    REQUIRE_OK(scene);
    assert_non_null(scene->deform);
    REQUIRE_OK(irb_scene_animate(scene, 1, &err));
    /* vertex 2 by joint 1 alone: (0, 1, 0), lifted by 2, half turned about z */
    for (int i = 0; i < 3; i++)
        REQUIRE_NEAR(irb_scene_current_positions(scene)[6 + i], ((double[]){0, -1, 2})[i], 1e-6);
    irb_scene_destroy(scene);
    free(path);
}

/* ---- Morph targets ---- */

static void targets_that_do_not_fit_the_vertices(void **state)
{
    struct sample s;

    make_sample(&s);
    s.extra[1].count = 2;
    require_refused(*state, &s,
                    "primitive 0: morph target 1: POSITION has 2 entries but POSITION "
                    "has 3");
    make_sample(&s);
    s.extra[1].count = 4; /* beyond its bytes */
    require_refused(*state, &s, "morph target 1: POSITION: accessor 2");
    make_sample(&s);
    s.extra[0].type = "VEC2";
    require_refused(*state, &s,
                    "morph target 0: POSITION: accessor 1 has 2 components, expected 3");
    make_sample(&s);
    s.gltf.primitive = ",\"targets\":[{\"POSITION\":1},{\"POSITION\":99}]";
    require_refused(*state, &s, "accessor 99 does not exist");
    make_sample(&s);
    s.targets[1][7] = NAN;
    require_refused(*state, &s, "morph target 1: POSITION of vertex 2 is not finite");
}

static void sparse_targets(void **state)
{
    struct sample s;

    make_sample(&s);
    s.extra[0].type = "VEC3\",\"sparse\":{\"count\":1,\"indices\":{\"bufferView\":3,"
                      "\"componentType\":5121},\"values\":{\"bufferView\":2}},\"name\":\"";
    require_refused(*state, &s, "accessor 1 is sparse, which is not supported");
}

static void wrong_numbers_of_targets_and_weights(void **state)
{
    struct sample s;

    make_sample(&s);
    s.gltf.mesh = ",\"weights\":[1]";
    require_refused(*state, &s, "its mesh has 1 weights for 2 morph targets");
    make_sample(&s);
    s.gltf.nodes = "{\"mesh\":0,\"skin\":0,\"weights\":[0,0,0]},{\"children\":[2]},{}";
    require_refused(*state, &s, "its node has 3 weights for 2 morph targets");
    make_sample(&s);
    s.gltf.mesh = ",\"weights\":[0,1e30]";
    require_refused(*state, &s, "object 'thing': vertex 2 is moved to");
    make_sample(&s);
    s.gltf.primitive = ",\"targets\":[{\"POSITION\":1},{\"POSITION\":2}]},{\"attributes\":"
                       "{\"POSITION\":0},\"targets\":[{\"POSITION\":1}]";
    require_refused(*state, &s,
                    "primitive 1: has 1 morph targets, but the mesh's first primitive "
                    "has 2");
    make_sample(&s);
    s.extra[6].count = 3;
    require_refused(*state, &s, "animation channel 0: has 2 times and 3 values, expected 2 a time");
    make_sample(&s);
    s.weights[1][0] = INFINITY;
    require_refused(*state, &s, "animation channel 0: value 2 is not finite");
}

/* Targets that share their bytes would need 1.1 GB. */
static void too_many_targets(void **state)
{
    enum { VERTICES = 30000, TARGETS = 3100 };
    float(*positions)[3] = calloc(VERTICES, sizeof *positions);
    struct irb_str targets = {0};
    struct sample s;

    for (int v = 0; v < VERTICES; v++) {
        positions[v][0] = v % 3 == 1;
        positions[v][1] = v % 3 == 2;
    }
    make_sample(&s);
    s.gltf = (struct test_gltf){.positions = positions[0], .vertices = VERTICES};
    irb_str_printf(&targets, ",\"targets\":[{\"POSITION\":0}");
    for (int k = 1; k < TARGETS; k++)
        irb_str_printf(&targets, ",{\"POSITION\":0}");
    irb_str_printf(&targets, "]");
    s.gltf.primitive = targets.text;
    require_refused(*state, &s,
                    "3100 morph targets of 30000 vertices: with these the file has more "
                    "than");
    irb_str_free(&targets);
    free(positions);
}

/* What the animation does is found out when it is played; the vertices then rest. */
static void an_animation_that_moves_vertices_too_far(void **state)
{
    struct irb_error err = {0};
    struct irb_scene *scene;
    struct sample s;
    char *path;

    make_sample(&s);
    s.weights[1][1] = 3e38f;
    path = write_gltf(*state, &s.gltf);
    scene = irb_scene_load(path, NULL, &err);
    REQUIRE_OK(scene);
    assert_false(irb_scene_animate(scene, 1, &err));
    REQUIRE_CMP(err.code, ==, IRB_E_INPUT);
    if (!strstr(err.message, "animation at 1 s: object 'thing': vertex 2 is moved to 3e+38 m"))
        fail_msg("%s", err.message);
    assert_true(irb_deform_at_rest(scene));
    assert_memory_equal(irb_scene_current_positions(scene), scene->positions, 36);
    irb_scene_destroy(scene);
    free(path);
}

/* ---- Skins ---- */

static void skins_without_their_parts(void **state)
{
    static const char *const nodes =
        "{\"mesh\":0,\"skin\":7,\"name\":\"thing\"},{\"children\":[2]},{}";
    const struct {
        const char *top, *expected;
    } cases[] = {
        {",\"skins\":[{\"joints\":[],\"inverseBindMatrices\":5}]", "skin 0: has 0 joints"},
        {",\"skins\":[{\"joints\":[1,8]}]", "skin 0: joint 1: node 8 does not exist"},
        {",\"skins\":[{\"joints\":[1,-8]}]", "skin 0: joint 1: node -8 does not exist"},
        {",\"skins\":[{\"joints\":[1,2,2],\"inverseBindMatrices\":5}]",
         "inverseBindMatrices has 2 entries for 3 joints"},
        {",\"skins\":[{\"joints\":[1,2],\"inverseBindMatrices\":8}]",
         "inverseBindMatrices: accessor 8 has 4 components, expected 16"},
    };
    struct sample s;

    for (int i = 0; i < COUNT(cases); i++) {
        make_sample(&s);
        s.gltf.top = cases[i].top;
        require_refused(*state, &s, cases[i].expected);
    }
    make_sample(&s);
    s.gltf.nodes = nodes;
    require_refused(*state, &s, "skin 7 does not exist (the file has 1)");
    make_sample(&s);
    s.gltf.roots = "0";
    require_refused(*state, &s, "joint 0, node 1 '', is not in the scene");
    make_sample(&s);
    s.binds[1][12] = NAN;
    require_refused(*state, &s, "that of joint 1 is not finite");
}

static void joints_and_shares_of_vertices(void **state)
{
    struct sample s;

    make_sample(&s);
    s.joints[1][1] = 2;
    require_refused(*state, &s, "vertex 1: joint 2 is out of range (the skin has 2)");
    make_sample(&s);
    s.shares[2][3] = -0.1f;
    require_refused(*state, &s, "vertex 2 has weight -0.1, expected 0 or more");
    make_sample(&s);
    s.shares[2][3] = NAN;
    require_refused(*state, &s, "vertex 2 has weight nan");
    make_sample(&s);
    s.gltf.attributes = ",\"JOINTS_0\":3";
    require_refused(*state, &s, "WEIGHTS_0: accessor -1 does not exist");
    make_sample(&s);
    s.gltf.attributes = ",\"JOINTS_0\":4,\"WEIGHTS_0\":4";
    require_refused(*state, &s,
                    "JOINTS_0 has component type 5126, expected unsigned byte or short");
    make_sample(&s);
    s.extra[3].count = 2;
    require_refused(*state, &s, "WEIGHTS_0 has 2 entries but POSITION has 3");
}

/* ---- Random bytes ---- */

static uint32_t next_random(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return *seed >> 8;
}

/* One to four bytes of the data are changed, or of the whole file to digits. Whatever loads has
 * finite vertices. */
static void random_bytes(void **state)
{
    enum { ROUNDS = 1500 };
    struct irb_error err = {0};
    struct sample s;
    uint32_t seed = 1;
    char *path, *data, *changed;
    size_t size, start;
    int loaded = 0;

    make_sample(&s);
    path = write_glb(*state, &s.gltf, 0);
    REQUIRE_OK(irb_fs_read(path, 100000, &data, &size, &err));
    changed = malloc(size);
    start = size - 36 * 3 - sizeof s.joints - sizeof s.shares - sizeof s.binds - sizeof s.times -
            sizeof s.weights - sizeof s.turns;
    for (int round = 0; round < ROUNDS; round++) {
        struct irb_scene *scene;

        memcpy(changed, data, size);
        for (uint32_t i = 0; i <= next_random(&seed) % 4; i++)
            if (round % 2)
                changed[20 + next_random(&seed) % (size - 20)] =
                    (char)('0' + next_random(&seed) % 10);
            else
                changed[start + next_random(&seed) % (size - start)] = (char)next_random(&seed);
        write_file(path, changed, size);
        err = (struct irb_error){0};
        scene = irb_scene_load(path, NULL, &err);
        loaded += scene != NULL;
        for (int step = 0; scene && step < 3; step++)
            if (irb_scene_animate(scene, 0.5 * step, &err))
                for (size_t i = 0; i < 3 * (size_t)scene->vertex_count; i++) {
                    REQUIRE_CMP(fabsf(irb_scene_current_positions(scene)[i]), <=, 1e9f);
                    REQUIRE_CMP(fabsf(irb_scene_current_normals(scene)[i]), <=, 1.000001f);
                }
        irb_scene_destroy(scene);
    }
    print_message("%d of %d loaded\n", loaded, ROUNDS);
    free(changed);
    free(data);
    free(path);
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
        cmocka_unit_test(the_sample_itself_is_fine),
        cmocka_unit_test(targets_that_do_not_fit_the_vertices),
        cmocka_unit_test(sparse_targets),
        cmocka_unit_test(wrong_numbers_of_targets_and_weights),
        cmocka_unit_test(too_many_targets),
        cmocka_unit_test(an_animation_that_moves_vertices_too_far),
        cmocka_unit_test(skins_without_their_parts),
        cmocka_unit_test(joints_and_shares_of_vertices),
        cmocka_unit_test(random_bytes),
    };

    return cmocka_run_group_tests(tests, make_folder, drop_folder);
}
