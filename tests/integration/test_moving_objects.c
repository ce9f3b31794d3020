/* SPDX-License-Identifier: MIT
 *
 * Objects that move or deform, and surfaces that are cut away by an alpha mask: where the G-buffer,
 * the RSM and the reference's shadows have them, against closed forms. A square plate hangs level
 * over a floor; the lamp at (0, 3, 0) shines straight down, so that a plate of half size a at
 * height y shades the square of half size 3 a/(3 - y) on the floor.
 */
#include "tests/support/compare.h"
#include "core/experiment/sequence.h"
#include "core/reference/reference.h"
#include "tests/frame/fixture.h"

enum { WIDTH = 96, HEIGHT = 96, RESOLUTION = 128, FRAMES = 3 };

static const float lamp_height = 3, plate_half = 0.5f;
static const double edge = 0.03; /* m: this near a shadow's edge either is right */
static const double cone = 3.5;  /* m: radius on the floor that the lamp's cone takes in */

static struct irb_gl *gl;
static char *folder;

/* ---- An animated file ---- */

/* What lifts the plate: its node, a morph target, or the joint of a skin. */
enum lift { BY_NODE, BY_MORPH, BY_SKIN, LIFTS };

/* The plate's node, its mesh's attributes and targets, and the animation's target and values. The
 * skinned plate's own node is away from where its joint is. */
static const struct lifted {
    const char *node, *attributes, *channel;
} lifted[LIFTS] = {
    {"\"translation\":[0,1,0],\"scale\":[0.5,0.5,0.5]", "}",
     "\"samplers\":[{\"input\":1,\"output\":2}],\"channels\":[{\"sampler\":0,\"target\":{\"node\":"
     "1,"
     "\"path\":\"translation\"}}]"},
    {"\"translation\":[0,1,0],\"scale\":[0.5,0.5,0.5]", "},\"targets\":[{\"POSITION\":3}]",
     "\"samplers\":[{\"input\":1,\"output\":4}],\"channels\":[{\"sampler\":0,\"target\":{\"node\":"
     "1,"
     "\"path\":\"weights\"}}]"},
    {"\"translation\":[3,3,3],\"skin\":0", ",\"JOINTS_0\":5,\"WEIGHTS_0\":6}",
     "\"samplers\":[{\"input\":1,\"output\":2}],\"channels\":[{\"sampler\":0,\"target\":{\"node\":"
     "4,"
     "\"path\":\"translation\"}}]"},
};

/* Square of half size 1; floor four times as large; the plate rises from y = 1 to 2 in 2 s. */
static void write_scene(enum lift lift)
{
    static const struct {
        float positions[18], times[2], translations[6], displacements[18], weights[2];
        uint8_t joints[24];
        float shares[24];
    } data = {
        {-1, 0, -1, -1, 0, 1, 1, 0, 1, -1, 0, -1, 1, 0, 1, 1, 0, -1},   {0, 2}, {0, 1, 0, 0, 2, 0},
        {0, 2, 0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 0, 2, 0},         {0, 1}, {0},
        {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}};
    static const char down[] = "\"rotation\":[-0.70710678,0,0,0.70710678]";
    struct irb_error err = {0};
    char *path = irb_asprintf("%s/plate.gltf", folder), *bin = irb_asprintf("%s/a.bin", folder);
    char *json = irb_asprintf(
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0,1,2,3,4]}],\"nodes\":["
        "{\"name\":\"floor\",\"mesh\":0,\"scale\":[4,4,4]},"
        "{\"name\":\"plate\",\"mesh\":1,%s},"
        "{\"translation\":[0,3,0],%s,\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}},"
        "{\"translation\":[0,5,0],%s,\"camera\":0},"
        "{\"name\":\"joint\",\"translation\":[0,1,0],\"scale\":[0.5,0.5,0.5]}],"
        "\"cameras\":[{\"name\":\"Eye\",\"type\":\"perspective\",\"perspective\":"
        "{\"yfov\":1,\"znear\":0.1}}],"
        "\"extensionsUsed\":[\"KHR_lights_punctual\"],\"extensions\":{\"KHR_lights_punctual\":"
        "{\"lights\":[{\"name\":\"Lamp\",\"type\":\"spot\",\"intensity\":7,"
        "\"spot\":{\"innerConeAngle\":0.8,\"outerConeAngle\":0.9}}]}},"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]},"
        "{\"primitives\":[{\"attributes\":{\"POSITION\":0%s}]}],\"skins\":[{\"joints\":[4]}],"
        "\"buffers\":[{\"uri\":\"a.bin\",\"byteLength\":304}],\"bufferViews\":["
        "{\"buffer\":0,\"byteOffset\":0,\"byteLength\":304}],\"accessors\":["
        "{\"bufferView\":0,\"componentType\":5126,\"count\":6,\"type\":\"VEC3\"},"
        "{\"bufferView\":0,\"byteOffset\":72,\"componentType\":5126,\"count\":2,\"type\":"
        "\"SCALAR\"},"
        "{\"bufferView\":0,\"byteOffset\":80,\"componentType\":5126,\"count\":2,\"type\":\"VEC3\"},"
        "{\"bufferView\":0,\"byteOffset\":104,\"componentType\":5126,\"count\":6,\"type\":\"VEC3\"}"
        ","
        "{\"bufferView\":0,\"byteOffset\":176,\"componentType\":5126,\"count\":2,\"type\":"
        "\"SCALAR\"},"
        "{\"bufferView\":0,\"byteOffset\":184,\"componentType\":5121,\"count\":6,\"type\":\"VEC4\"}"
        ","
        "{\"bufferView\":0,\"byteOffset\":208,\"componentType\":5126,\"count\":6,\"type\":\"VEC4\"}"
        "],"
        "\"animations\":[{%s}]}",
        lifted[lift].node, down, down, lifted[lift].attributes, lifted[lift].channel);
    REQUIRE_CMP(sizeof data, ==, 304);
    REQUIRE_OK(irb_fs_write(path, json, strlen(json), &err));
    REQUIRE_OK(irb_fs_write(bin, &data, sizeof data, &err));
    free(json);
    free(bin);
    free(path);
}

static void load_config(struct irb_config *config, const char *text)
{
    struct irb_error err = {0};
    struct irb_registry registry;
    char *path = irb_asprintf("%s/c.yaml", folder);
    REQUIRE_OK(irb_fs_write(path, text, strlen(text), &err));
    irb_registry_init(&registry);
    bool ok = irb_config_load(config, path, NULL, &registry, &err);
    if (!ok)
        fail_msg("%s", err.message);
    irb_registry_close(&registry);
    free(path);
}

/* Whether a floor point lies in the shadow of the rectangle x0..x1, -half..half of the plate's
 * plane; -1 near an edge and out of the lamp's cone. */
static int in_shadow(const float *p, double x0, double x1, double height)
{
    double grown = lamp_height / (lamp_height - height), x = p[0] / grown, z = p[2] / grown;
    double inside = fmin(fmin(x - x0, x1 - x), plate_half - fabs(z));
    if (fabs(inside) < edge || hypot((double)p[0], (double)p[2]) > cone)
        return -1;
    return inside > 0;
}

static void require_plate(const struct irb_image *position, double x0, double x1, double height,
                          bool from_lamp, const char *what)
{
    int on_plate = 0;
    for (size_t i = 0; i < irb_image_pixels(position); i++) {
        const float *p = position->data + 4 * i;
        if (p[3] <= 0)
            continue;
        if (p[1] > 0.1f) {
            on_plate++;
            REQUIRE_NEAR(p[1], height, 1e-5);
            REQUIRE_CMP(p[0], >=, x0 - edge);
            REQUIRE_CMP(p[0], <=, x1 + edge);
        } else {
            REQUIRE_NEAR(p[1], 0, 1e-5);
            if (from_lamp && in_shadow(p, x0, x1, height) == 1)
                fail_msg("%s: (%g, %g) on the floor is hidden from the lamp", what, (double)p[0],
                         (double)p[2]);
        }
    }
    REQUIRE_CMP(on_plate, >, 50);
}

static void render_reference(const struct fixture_frame *f, const struct irb_gbuffer_image *gbuffer,
                             struct irb_reference_image *out)
{
    struct irb_error err = {0};
    const struct irb_reference_settings settings = {
        .min_samples = 64, .max_samples = 64, .bounces = 1};
    struct irb_tracer *tracer = irb_tracer_create(f->scene, &err);
    REQUIRE_OK(tracer);
    const struct irb_reference_job job = {.tracer = tracer,
                                          .light = &f->light,
                                          .camera = &f->camera,
                                          .gbuffer = gbuffer,
                                          .settings = &settings};
    REQUIRE_OK(irb_reference_render(&job, out, &err));
    irb_tracer_destroy(tracer);
}

/* All three, with the plate's rectangle x0..x1 at `height`. */
static void require_all(struct fixture_frame *f, double x0, double x1, double height)
{
    struct irb_error err = {0};
    struct irb_gbuffer_image gbuffer;
    struct irb_reference_image reference;
    int shaded = 0, lit = 0;
    fixture_frame_render(f);
    REQUIRE_OK(irb_gbuffer_read(f->gbuffer, &gbuffer, &err));
    require_plate(&gbuffer.position, x0, x1, height, false, "G-buffer");
    struct irb_image seen = fixture_read(f->rsm->position, 4);
    require_plate(&seen, x0, x1, height, true, "RSM");
    render_reference(f, &gbuffer, &reference);
    for (size_t i = 0; i < irb_image_pixels(&reference.direct); i++) {
        const float *p = gbuffer.position.data + 4 * i;
        if (p[3] <= 0 || p[1] > 0.1f)
            continue;
        int dark = in_shadow(p, x0, x1, height);
        shaded += dark == 1;
        lit += dark == 0;
        if (dark >= 0 && (reference.direct.data[3 * i] > 0) == dark)
            fail_msg("reference: (%g, %g) on the floor should be %s", (double)p[0], (double)p[2],
                     dark ? "dark" : "lit");
    }
    REQUIRE_CMP(shaded, >, 20);
    REQUIRE_CMP(lit, >, 1000);
    irb_reference_image_destroy(&reference);
    irb_image_destroy(&seen);
    irb_gbuffer_image_destroy(&gbuffer);
}

/* The one object that moved, and the box of its vertices: at rest, or where they are the ones that
 * move, of those of both frames. */
static void require_moved(struct irb_sequence *sequence, int frame, bool by_node)
{
    struct irb_error err = {0};
    struct irb_moved_object *moved;
    int count;
    REQUIRE_OK(irb_sequence_moved(sequence, frame, &moved, &count, &err));
    REQUIRE_CMP(count, ==, 1);
    REQUIRE_NEAR(moved->low[1], by_node ? 1 : 1.25 + 0.25 * (frame - 1), 1e-6);
    REQUIRE_NEAR(moved->high[1], by_node ? 1 : 1.25 + 0.25 * frame, 1e-6);
    REQUIRE_NEAR(moved->high[0], plate_half, 1e-6);
    free(moved);
}

static void play(enum lift lift)
{
    struct irb_error err = {0};
    struct irb_config config;
    struct irb_sequence sequence;
    struct fixture_frame f = {0};
    write_scene(lift);
    load_config(&config, "scene: plate.gltf\nframes: 3\nanimation: {fps: 2, start: 0.5}\n"
                         "light: {name: Lamp}\ntrials: [rsm]\n");
    REQUIRE_OK(irb_sequence_open(&sequence, &config, &config.scenes[0], NULL, &err));
    assert_true(sequence.moves);
    fixture_frame_create(&f, gl, sequence.scene, WIDTH, HEIGHT, RESOLUTION);
    for (int i = -1; i < FRAMES; i++) {
        int frame = i < 0 ? 0 : i; /* a settle frame first */
        f.light = sequence.frames[frame].light;
        f.camera = sequence.frames[frame].camera;
        REQUIRE_OK(irb_sequence_pose(&sequence, i, &err));
        REQUIRE_OK(irb_scene_gl_update(f.scene_gl, &err));
        require_all(&f, -plate_half, plate_half, 1 + 0.5 * (0.5 + frame / 2.0));
        assert_false(irb_sequence_same_view(&sequence, frame));
        if (frame > 0)
            require_moved(&sequence, frame, lift == BY_NODE);
    }
    f.scene = NULL; /* the sequence's */
    irb_rsm_destroy(f.rsm);
    irb_gbuffer_destroy(f.gbuffer);
    irb_scene_gl_destroy(f.scene_gl);
    irb_sequence_close(&sequence);
    irb_config_destroy(&config);
}

static void the_files_animation_moves_everything(void **state)
{
    (void)state;
    play(BY_NODE);
}

static void morph_targets_move_everything(void **state)
{
    (void)state;
    play(BY_MORPH);
}

static void skins_move_everything(void **state)
{
    (void)state;
    play(BY_SKIN);
}

static void expect_refused(const char *text, const char *expected)
{
    struct irb_error err = {0};
    struct irb_config config;
    struct irb_sequence sequence;
    load_config(&config, text);
    assert_false(irb_sequence_open(&sequence, &config, &config.scenes[0], NULL, &err));
    if (!strstr(err.message, expected))
        fail_msg("expected %s, found %s", expected, err.message);
    irb_config_destroy(&config);
}

static void unknown_names_are_refused(void **state)
{
    (void)state;
    write_scene(BY_NODE);
    expect_refused("scene: plate.gltf\nlight: {name: Moon}\ntrials: [rsm]\n",
                   "c.yaml:2:8: light: the file of scene plate has none called 'Moon'; there are "
                   "'Lamp'");
    expect_refused("scene: plate.gltf\ncamera: {name: Ear}\ntrials: [rsm]\n",
                   "c.yaml:2:9: camera: the file of scene plate has none called 'Ear'; there are "
                   "'Eye'");
    expect_refused(
        "scene: plate.gltf\nobjects: [{name: plaet, keys: [{frame: 0}]}]\n"
        "trials: [rsm]\n",
        "c.yaml:2:18: objects: scene plate has no object 'plaet'; did you mean 'plate'?");
}

/* ---- Keyframed transforms ---- */

static void keys_turn_about_the_centre(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct irb_config config;
    struct irb_sequence sequence;
    struct irb_moved_object *moved;
    int count;
    load_config(&config, "scene: cornell-objects\nframes: 3\nobjects:\n"
                         "  - name: sphere\n    keys:\n      - {frame: 0}\n"
                         "      - {frame: 2, translate: [0.1, 0.2, 0], rotate: [0, 0, 2, 180], "
                         "scale: 3}\ntrials: [rsm]\n");
    REQUIRE_OK(irb_sequence_open(&sequence, &config, &config.scenes[0], NULL, &err));
    REQUIRE_OK(irb_sequence_pose(&sequence, 1, &err));
    for (int i = 0; i < sequence.scene->object_count; i++) {
        const struct irb_object *object = &sequence.scene->objects[i];
        const float *m = object->transform;
        /* half way: by 90 degrees about z, twice as large; centre (0.17, 0.1, 0.16), point a
         * radius to its right */
        const double p[3] = {0.27, 0.1, 0.16}, expected[3] = {0.22, 0.4, 0.16};
        bool moves = !strcmp(object->name, "sphere");
        for (int axis = 0; axis < 3; axis++) {
            double x = m[axis] * p[0] + m[4 + axis] * p[1] + m[8 + axis] * p[2] + m[12 + axis];
            REQUIRE_NEAR(x, moves ? expected[axis] : p[axis], moves ? 1e-4 : 0);
        }
    }
    REQUIRE_OK(irb_sequence_moved(&sequence, 2, &moved, &count, &err));
    REQUIRE_CMP(count, ==, 1);
    free(moved);
    irb_sequence_close(&sequence);
    irb_config_destroy(&config);
}

/* ---- Flicker ---- */

/* A wide floor that slides in its own plane shows the same points and normals, yet none of its
 * pixels may count; a box elsewhere leaves them alone. */
static void moved_surfaces_are_left_out(void **state)
{
    (void)state;
    static const float grey[3] = {0.5f, 0.5f, 0.5f}, low[3] = {-2, 0, -2}, high[3] = {2, 0, 2};
    static const float rest[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    static const float slid[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.001f, 0, 0, 1};
    static const float away[3] = {10, 10, 10}, farther[3] = {11, 11, 11};
    struct irb_error err = {0};
    struct fixture_frame f = {0};
    struct irb_gbuffer_image image;
    struct irb_moved_object moved;
    fixture_frame_create(&f, gl, fixture_floor(2, grey), 32, 32, 16);
    f.camera = fixture_camera((const float[]){0, 3, 0}, (const float[]){0, 0, 0},
                              (const float[]){0, 0, 1}, 40);
    REQUIRE_OK(irb_gbuffer_render(f.gbuffer, f.scene_gl, &f.camera, &err));
    REQUIRE_OK(irb_gbuffer_read(f.gbuffer, &image, &err));
    for (int pass = 0; pass < 2; pass++) {
        struct irb_reprojection motion;
        size_t kept = 0;
        irb_moved_object_set(&moved, rest, slid, pass ? away : low, pass ? farther : high);
        REQUIRE_OK(irb_reproject(&motion, &image, &image, &f.camera, &moved, 1, &err));
        for (size_t i = 0; i < irb_image_pixels(&image.position); i++)
            kept += motion.source[i] == (int32_t)i;
        REQUIRE_CMP(kept, ==, pass ? irb_image_pixels(&image.position) : 0);
        irb_reprojection_destroy(&motion);
    }
    irb_gbuffer_image_destroy(&image);
    fixture_frame_destroy(&f);
}

/* ---- Alpha masks ---- */

static void add_square(struct irb_builder *builder, double half, double y)
{
    static const double up[3] = {0, 1, 0};
    uint32_t v[4];
    for (int i = 0; i < 4; i++) {
        double u = i == 1 || i == 2, w = i >= 2;
        const double position[3] = {half * (2 * u - 1), y, half * (2 * w - 1)};
        v[i] = irb_builder_vertex(builder, position, up, (const double[]){u, w});
    }
    irb_builder_triangle(builder, v[0], v[2], v[1]);
    irb_builder_triangle(builder, v[0], v[3], v[2]);
}

/* Floor, and a red plate at height 1 with alpha `left` for x < 0, `right` for x > 0. */
static struct irb_scene *masked_scene(int left, int right, float cutoff)
{
    enum { SIDE = 64 };
    static const float grey[3] = {0.5f, 0.5f, 0.5f}, red[3] = {0.8f, 0, 0};
    struct irb_error err = {0};
    struct irb_builder builder;
    unsigned char *rgba = malloc(4 * SIDE * SIDE);
    assert_non_null(rgba);
    memset(rgba, 255, 4 * SIDE * SIDE);
    for (int i = 0; i < SIDE * SIDE; i++)
        rgba[4 * i + 3] = (unsigned char)(i % SIDE < SIDE / 2 ? left : right);
    irb_builder_begin(&builder, "masked");
    irb_builder_object(&builder, "floor", irb_builder_material(&builder, "grey", grey));
    add_square(&builder, 4, 0);
    int texture = irb_builder_texture(&builder, "mask", SIDE, SIDE, rgba);
    int material = irb_builder_material(&builder, "red", red);
    irb_builder_object(&builder, "plate", material);
    add_square(&builder, plate_half, 1);
    struct irb_scene *scene = irb_builder_finish(&builder, &err);
    REQUIRE_OK(scene);
    scene->materials[material].diffuse_texture = texture;
    scene->materials[material].alpha_cutoff = cutoff;
    return scene;
}

static void open_masked(struct fixture_frame *f, struct irb_scene *scene)
{
    fixture_frame_create(f, gl, scene, WIDTH, HEIGHT, RESOLUTION);
    f->light = fixture_spot((const float[]){0, lamp_height, 0}, (const float[]){0, 0, 0}, 50);
    f->camera = fixture_camera((const float[]){1, 5, 0}, (const float[]){1, 0, 0},
                               (const float[]){0, 0, 1}, 40);
}

/* Texels that are red and nothing else, which only the plate is. */
static size_t count_red(const struct irb_texture *texture)
{
    struct irb_image image = fixture_read(texture, 4);
    size_t count = 0;
    for (size_t i = 0; i < irb_image_pixels(&image); i++)
        count += image.data[4 * i] > 0 && image.data[4 * i + 1] == 0;
    irb_image_destroy(&image);
    return count;
}

/* The left half of the plate is there, the right half is not. */
static void masks_cut_camera_lamp_and_rays(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct fixture_frame f = {0};
    open_masked(&f, masked_scene(255, 0, 0.5f));
    require_all(&f, -plate_half, 0, 1);
    struct irb_gbuffer *slim = irb_gbuffer_create_layout(gl, IRB_LAYOUT_SLIM, WIDTH, HEIGHT, &err);
    REQUIRE_OK(slim);
    struct irb_rsm *slim_rsm = irb_rsm_create_layout(gl, IRB_LAYOUT_SLIM, RESOLUTION, &err);
    REQUIRE_OK(slim_rsm);
    REQUIRE_OK(irb_gbuffer_render(slim, f.scene_gl, &f.camera, &err));
    REQUIRE_OK(irb_rsm_render(slim_rsm, f.scene_gl, &f.light, &err));
    REQUIRE_CMP(count_red(slim->diffuse), ==, count_red(f.gbuffer->diffuse));
    REQUIRE_CMP(count_red(slim_rsm->flux), ==, count_red(f.rsm->flux));
    irb_rsm_destroy(slim_rsm);
    irb_gbuffer_destroy(slim);
    fixture_frame_destroy(&f);
}

/* A mask that leaves everything gives what no mask gives: the plate's lower side in the light that
 * the floor sends up, past the plate's own shadow. */
static void a_mask_without_holes_changes_nothing(void **state)
{
    (void)state;
    struct irb_error err = {0};
    double bounce[2];
    for (int i = 0; i < 2; i++) {
        struct fixture_frame f = {0};
        struct irb_gbuffer_image gbuffer;
        struct irb_reference_image reference;
        open_masked(&f, masked_scene(255, 255, i ? 0.5f : 0));
        f.camera = fixture_camera((const float[]){0, 0.2f, 0}, (const float[]){0, 1, 0},
                                  (const float[]){0, 0, 1}, 40);
        REQUIRE_OK(irb_gbuffer_render(f.gbuffer, f.scene_gl, &f.camera, &err));
        REQUIRE_OK(irb_gbuffer_read(f.gbuffer, &gbuffer, &err));
        render_reference(&f, &gbuffer, &reference);
        bounce[i] = fixture_sum(&reference.bounce1, 0);
        REQUIRE_CMP(fixture_sum(&reference.direct, 0), ==, 0);
        irb_reference_image_destroy(&reference);
        irb_gbuffer_image_destroy(&gbuffer);
        fixture_frame_destroy(&f);
    }
    REQUIRE_CMP(bounce[0], >, 0);
    REQUIRE_NEAR(bounce[1], bounce[0], 1e-5 * bounce[0]);
}

static int make_folder(void **state)
{
    (void)state;
    folder = fixture_folder();
    return 0;
}

static int drop_folder(void **state)
{
    (void)state;
    fixture_remove(folder);
    return 0;
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(the_files_animation_moves_everything, make_folder,
                                        drop_folder),
        cmocka_unit_test_setup_teardown(morph_targets_move_everything, make_folder, drop_folder),
        cmocka_unit_test_setup_teardown(skins_move_everything, make_folder, drop_folder),
        cmocka_unit_test_setup_teardown(unknown_names_are_refused, make_folder, drop_folder),
        cmocka_unit_test_setup_teardown(keys_turn_about_the_centre, make_folder, drop_folder),
        cmocka_unit_test(moved_surfaces_are_left_out),
        cmocka_unit_test(masks_cut_camera_lamp_and_rays),
        cmocka_unit_test(a_mask_without_holes_changes_nothing),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failed;
}
