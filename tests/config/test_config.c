/* SPDX-License-Identifier: MIT
 *
 * Configs that are right: every value arrives where it belongs.
 */
#include "core/base/fs.h"
#include "core/config/config.h"
#include "tests/support/compare.h"

#include "tests/config/mock_methods.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char folder[] = "/tmp/irb_config_XXXXXX";

static int set_up(void **state)
{
    (void)state;
    struct irb_error err;
    if (!mkdtemp(folder))
        return -1;
    char *scene = irb_asprintf("%s/my hall.v2.glb", folder);
    bool ok = irb_fs_write(scene, "x", 1, &err);
    free(scene);
    return ok ? 0 : -1;
}

static int tear_down(void **state)
{
    (void)state;
    char *command = irb_asprintf("rm -rf '%s'", folder);
    int status = system(command);
    free(command);
    return status;
}

static void load(struct irb_config *config, const char *text, const char *const *overrides)
{
    struct irb_error err = {0};
    char *path = irb_asprintf("%s/some.study.yaml", folder);
    REQUIRE_OK(irb_fs_write(path, text, strlen(text), &err));
    REQUIRE_OK(irb_config_load(config, path, overrides, &mock_registry, &err));
    assert_string_equal(config->path, path);
    free(path);
}

static void expect_vector(const float v[3], double x, double y, double z)
{
    REQUIRE_NEAR(v[0], x, 1e-6);
    REQUIRE_NEAR(v[1], y, 1e-6);
    REQUIRE_NEAR(v[2], z, 1e-6);
}

static const char full_text[] =
    "# every key there is\n"
    "name: quick\n"
    "seed: 7\n"
    "resolution: [256, 192]\n"
    "frames: 9\n"
    "settle: 0\n"
    "rsm_resolution: 128\n"
    "exposure: 0.5\n"
    "reference: {min_samples: 16, max_samples: 128, noise: 0.02, bounces: 4, unoccluded: true}\n"
    "scenes:\n"
    "  - scene: cornell\n"
    "    name: corner\n"
    "    camera:\n"
    "      interpolation: catmull-rom\n"
    "      near: 0.01\n"
    "      far: 50\n"
    "      keys:\n"
    "        - {frame: 0, position: [0, 1, 2], target: [0, 1, 0], up: [0, 2, 0], fov: 40}\n"
    "        - {frame: 4.5, position: [1, 1, 2]}\n"
    "    light:\n"
    "      type: spot\n"
    "      falloff: cosine\n"
    "      interpolation: catmull-rom\n"
    "      keys:\n"
    "        - {frame: 0, position: [1, 2, 3], target: [0, 0, 0], intensity: [1, 2, 3],"
    " cone: 30, inner: 5}\n"
    "        - {frame: 8, position: [1, 2, 4], intensity: 6}\n"
    "  - scene: my hall.v2.glb\n"
    "    camera: {position: [0, 1, 2], target: [0, 1, 0]}\n"
    "    light: {type: directional, position: [0, 5, 0], target: [0, 0, 1], intensity: 2,"
    " beam_half_width: 3}\n"
    "trials:\n"
    "  - rsm: {mode: all, samples: 9}\n"
    "  - rsm:mode=importance\n"
    "  - rsm\n"
    "  - plain:\n";

static void test_every_key(void **state)
{
    (void)state;
    struct irb_config c;
    load(&c, full_text, NULL);
    assert_string_equal(c.name, "quick");
    assert_int_equal(c.seed_count, 1);
    assert_int_equal(c.seeds[0], 7);
    assert_int_equal(c.render.width, 256);
    assert_int_equal(c.render.height, 192);
    assert_int_equal(c.render.frames, 9);
    assert_int_equal(c.render.settle, 0);
    assert_int_equal(c.render.rsm_resolution, 128);
    REQUIRE_NEAR(c.render.exposure, 0.5, 0);
    assert_int_equal(c.reference.min_samples, 16);
    assert_int_equal(c.reference.max_samples, 128);
    REQUIRE_NEAR(c.reference.noise, 0.02, 1e-8);
    assert_int_equal(c.reference.bounces, 4);
    assert_true(c.reference.unoccluded);

    assert_int_equal(c.trial_count, 4);
    assert_string_equal(c.trials[0].name, "rsm:mode=all:samples=9");
    assert_string_equal(c.trials[1].name, "rsm:mode=importance");
    assert_string_equal(c.trials[2].name, "rsm");
    assert_string_equal(c.trials[3].name, "plain");
    assert_int_equal(((const struct mock_params *)c.trials[0].params)->samples, 9);
    assert_int_equal(((const struct mock_params *)c.trials[1].params)->mode, 2);
    irb_config_destroy(&c);
}

static void test_scripts(void **state)
{
    (void)state;
    struct irb_config c;
    load(&c, full_text, NULL);
    assert_int_equal(c.scene_count, 2);
    assert_string_equal(c.scenes[0].name, "corner");
    assert_string_equal(c.scenes[0].source, "cornell");
    const struct irb_animation *a = &c.scenes[0].animation;
    assert_int_equal(a->camera_interpolation, IRB_CATMULL_ROM);
    REQUIRE_NEAR(a->z_near, 0.01, 1e-8);
    REQUIRE_NEAR(a->z_far, 50, 0);
    assert_int_equal(a->camera_key_count, 2);
    expect_vector(a->camera_keys[0].position, 0, 1, 2);
    expect_vector(a->camera_keys[0].up, 0, 2, 0);
    REQUIRE_NEAR(a->camera_keys[0].fov, 40, 0);
    REQUIRE_NEAR(a->camera_keys[1].frame, 4.5, 0);
    expect_vector(a->camera_keys[1].position, 1, 1, 2);
    expect_vector(a->camera_keys[1].target, 0, 1, 0); /* from the key before */
    REQUIRE_NEAR(a->camera_keys[1].fov, 40, 0);

    assert_int_equal(a->light_type, IRB_LIGHT_SPOT);
    assert_int_equal(a->falloff, IRB_FALLOFF_COSINE);
    assert_int_equal(a->light_interpolation, IRB_CATMULL_ROM);
    assert_int_equal(a->light_key_count, 2);
    expect_vector(a->light_keys[0].intensity, 1, 2, 3);
    REQUIRE_NEAR(a->light_keys[0].inner, 5, 0);
    expect_vector(a->light_keys[1].position, 1, 2, 4);
    expect_vector(a->light_keys[1].intensity, 6, 6, 6);
    REQUIRE_NEAR(a->light_keys[1].cone, 30, 0);

    char *source = irb_asprintf("%s/my hall.v2.glb", folder);
    assert_string_equal(c.scenes[1].source, source);
    free(source);
    assert_string_equal(c.scenes[1].name, "my-hall.v2");
    a = &c.scenes[1].animation;
    assert_int_equal(a->light_type, IRB_LIGHT_DIRECTIONAL);
    REQUIRE_NEAR(a->beam_half_width, 3, 0);
    assert_int_equal(a->light_key_count, 1);
    expect_vector(a->light_keys[0].target, 0, 0, 1);
    expect_vector(a->camera_keys[0].up, 0, 1, 0);
    assert_int_equal(a->camera_interpolation, IRB_LINEAR);
    irb_config_destroy(&c);
}

static void test_shortest(void **state)
{
    (void)state;
    struct irb_config c;
    load(&c, "scene: cornell\ntrials: [rsm]\n", NULL);
    assert_string_equal(c.name, "some.study");
    assert_int_equal(c.seed_count, 5);
    assert_int_equal(c.seeds[4], 5);
    assert_int_equal(c.repeats, 1);
    assert_int_equal(c.render.settle, 16);
    assert_string_equal(c.scenes[0].name, "cornell");
    assert_int_equal(c.scenes[0].animation.light_key_count, 1);
    assert_int_equal(c.scenes[0].animation.camera_key_count, 1);
    irb_config_destroy(&c);
}

/* One setting of a built-in's light changes, the rest stays as the built-in has it. */
static void test_built_in_view_is_kept(void **state)
{
    (void)state;
    struct irb_config plain, brighter;
    load(&plain, "scene: cornell\ntrials: [rsm]\n", NULL);
    load(&brighter,
         "scene: cornell\n"
         "light: {intensity: 77}\n"
         "trials: [rsm]\n",
         NULL);
    const struct irb_light_key *a = &plain.scenes[0].animation.light_keys[0];
    const struct irb_light_key *b = &brighter.scenes[0].animation.light_keys[0];
    expect_vector(b->intensity, 77, 77, 77);
    expect_vector(b->position, a->position[0], a->position[1], a->position[2]);
    REQUIRE_NEAR(b->cone, a->cone, 0);
    assert_int_equal(brighter.scenes[0].animation.falloff, plain.scenes[0].animation.falloff);
    irb_config_destroy(&plain);
    irb_config_destroy(&brighter);
}

static void test_aliases(void **state)
{
    (void)state;
    struct irb_config c;
    load(&c,
         "scenes:\n"
         "  - scene: cornell\n"
         "    light: &moving {keys: [{frame: 0, intensity: 1}, {frame: 3, intensity: 2}]}\n"
         "  - scene: cornell\n"
         "    name: again\n"
         "    light: *moving\n"
         "trials: [rsm]\n",
         NULL);
    assert_int_equal(c.scenes[1].animation.light_key_count, 2);
    expect_vector(c.scenes[1].animation.light_keys[1].intensity, 2, 2, 2);
    irb_config_destroy(&c);
}

static void test_environment(void **state)
{
    (void)state;
    struct irb_config c;
    setenv("IRB_TEST_FOLDER", folder, 1);
    load(&c,
         "scene: ${IRB_TEST_FOLDER}/my hall.v2.glb\n"
         "camera: {position: [0, 1, 2], target: [0, 1, 0]}\n"
         "light: {position: [0, 5, 0], target: [0, 0, 1], intensity: 2}\n"
         "trials: [rsm]\n",
         NULL);
    char *source = irb_asprintf("%s/my hall.v2.glb", folder);
    assert_string_equal(c.scenes[0].source, source);
    free(source);
    unsetenv("IRB_TEST_FOLDER");
    irb_config_destroy(&c);
}

static void test_overrides(void **state)
{
    (void)state;
    struct irb_config c;
    load(&c, full_text,
         (const char *const[]){"seed=8", "frames=2", "resolution=64x48", "reference.noise=0.5",
                               "reference.unoccluded=false", "name=slow", "frames=3", NULL});
    assert_int_equal(c.seed_count, 1);
    assert_int_equal(c.seeds[0], 8);
    assert_int_equal(c.render.frames, 3); /* the last one wins */
    assert_int_equal(c.render.width, 64);
    assert_int_equal(c.render.height, 48);
    REQUIRE_NEAR(c.reference.noise, 0.5, 0);
    assert_false(c.reference.unoccluded);
    assert_int_equal(c.reference.bounces, 4);
    assert_string_equal(c.name, "slow");
    irb_config_destroy(&c);
    load(&c, full_text, (const char *const[]){"resolution=32,16", "width=33", NULL});
    assert_int_equal(c.render.width, 33);
    assert_int_equal(c.render.height, 16);
    irb_config_destroy(&c);
}

static void expect_box(const struct irb_region *region, int width, int height, int x0, int y0,
                       int x1, int y1)
{
    int box[4];
    assert_true(irb_region_pixels(region, width, height, box));
    assert_int_equal(box[0], x0);
    assert_int_equal(box[1], y0);
    assert_int_equal(box[2], x1);
    assert_int_equal(box[3], y1);
}

static void expect_row(const struct irb_scene_entry *entry, int height, int expected)
{
    int row = -1;
    assert_true(irb_profile_row(entry, height, &row));
    assert_int_equal(row, expected);
}

static void test_profile(void **state)
{
    (void)state;
    struct irb_config c;
    int row;
    load(&c,
         "scenes:\n"
         "  - {scene: cornell, profile: 17}\n"
         "  - {scene: cornell, name: b, profile: 0.5}\n"
         "  - {scene: cornell, name: c, profile: 0}\n"
         "  - {scene: cornell, name: d}\n"
         "trials: [rsm]\n",
         NULL);
    expect_row(&c.scenes[0], 18, 17);
    assert_false(irb_profile_row(&c.scenes[0], 17, &row));
    expect_row(&c.scenes[1], 18, 9);
    expect_row(&c.scenes[1], 1, 0);
    expect_row(&c.scenes[2], 18, 0);
    assert_false(irb_profile_row(&c.scenes[3], 18, &row));
    irb_config_destroy(&c);
    load(&c, "scene: cornell\nprofile: 0.999\ntrials: [rsm]\n", NULL);
    expect_row(&c.scenes[0], 384, 383);
    irb_config_destroy(&c);
}

static void test_regions(void **state)
{
    (void)state;
    struct irb_config c;
    load(&c,
         "resolution: [200, 100]\n"
         "scenes:\n"
         "  - scene: cornell\n"
         "    regions:\n"
         "      - {name: left, box: [0, 0, 0.5, 1]}\n"
         "      - {name: door, box: [10, 20, 200, 100]}\n"
         "  - {scene: cornell, name: other, regions: []}\n"
         "trials: [rsm]\n",
         NULL);
    assert_int_equal(c.scenes[0].region_count, 2);
    assert_int_equal(c.scenes[1].region_count, 0);
    assert_string_equal(c.scenes[0].regions[1].name, "door");
    expect_box(&c.scenes[0].regions[0], 200, 100, 0, 0, 100, 100);
    expect_box(&c.scenes[0].regions[0], 33, 7, 0, 0, 17, 7); /* to the nearest edge */
    expect_box(&c.scenes[0].regions[1], 200, 100, 10, 20, 200, 100);
    int box[4];
    assert_false(irb_region_pixels(&c.scenes[0].regions[1], 199, 100, box));
    irb_config_destroy(&c);
    load(&c, "scene: cornell\nregions: [{name: a, box: [1, 0, 2, 1]}]\ntrials: [rsm]\n", NULL);
    expect_box(&c.scenes[0].regions[0], 512, 384, 1, 0, 2, 1);
    irb_config_destroy(&c);
}

/* The trials of `list`, in order. */
static void expect_trials(const char *list, const char *const *names)
{
    struct irb_config c;
    char *text = irb_asprintf("scene: cornell\ntrials:\n%s", list);
    load(&c, text, NULL);
    int count = 0;
    for (; names[count]; count++)
        assert_string_equal(count < c.trial_count ? c.trials[count].name : "(none)", names[count]);
    assert_int_equal(c.trial_count, count);
    irb_config_destroy(&c);
    free(text);
}

static void test_sweeps(void **state)
{
    (void)state;
    expect_trials("  - rsm: {samples: [3, 1, 2]}\n",
                  (const char *const[]){"rsm:samples=3", "rsm:samples=1", "rsm:samples=2", NULL});
    expect_trials("  - rsm: {samples: [7]}\n", (const char *const[]){"rsm:samples=7", NULL});
    /* in the order of the method's table, whatever the map's; the last one changes fastest */
    expect_trials("  - plain\n  - rsm: {samples: [1, 2], shared: false, mode: [importance, all]}\n",
                  (const char *const[]){"plain", "rsm:mode=importance:samples=1:shared=false",
                                        "rsm:mode=importance:samples=2:shared=false",
                                        "rsm:mode=all:samples=1:shared=false",
                                        "rsm:mode=all:samples=2:shared=false", NULL});
}

static void test_matrix(void **state)
{
    (void)state;
    expect_trials(
        "  - rsm: {matrix: [{mode: all, samples: 9}, {mode: importance}, {}], clamp: 5}\n",
        (const char *const[]){"rsm:mode=all:samples=9:clamp=5", "rsm:mode=importance:clamp=5",
                              "rsm:clamp=5", NULL});
    /* an entry wins over what stands beside it; lists go on meaning one trial each */
    expect_trials("  - rsm: {samples: [1, 2], matrix: [{mode: all}, {samples: [3, 4]}]}\n",
                  (const char *const[]){"rsm:mode=all:samples=1", "rsm:mode=all:samples=2",
                                        "rsm:samples=3", "rsm:samples=4", NULL});
}

static void test_tracks(void **state)
{
    (void)state;
    expect_trials("  - rsm: {samples: {keys: [[0, 32], [4, 64]]}}\n"
                  "  - rsm: {clamp: {interpolation: linear, keys: [[1, 0.5], [4, 2]]}, mode: all}\n"
                  "  - rsm: {shared: {keys: [[0, yes], [3, no]], interpolation: step}}\n"
                  "  - rsm: {samples: 5@0+7@1}\n",
                  (const char *const[]){"rsm:samples=32@0+64@4", "rsm:mode=all:clamp=0.5@1..2@4",
                                        "rsm:shared=true@0+false@3", "rsm:samples=5@0+7@1", NULL});
    /* as an item of a list, and in a matrix; a plain value after it has no keys */
    expect_trials(
        "  - plain: {rsm_resolution: [64, 32]}\n"
        "  - rsm: {rsm_resolution: [64, 32], samples: [8, 9], shared: false}\n"
        "  - rsm: {samples: [{keys: [[0, 1], [2, 3]]}, 9], mode: all}\n"
        "  - rsm: {samples: {keys: [[0, 4], [2, 3]]}, matrix: [{clamp: 1}, {samples: 8}]}\n",
        (const char *const[]){"plain:rsm_resolution=64", "plain:rsm_resolution=32",
                              "rsm:samples=8:shared=false:rsm_resolution=64",
                              "rsm:samples=8:shared=false:rsm_resolution=32",
                              "rsm:samples=9:shared=false:rsm_resolution=64",
                              "rsm:samples=9:shared=false:rsm_resolution=32",
                              "rsm:mode=all:samples=1@0+3@2", "rsm:mode=all:samples=9",
                              "rsm:samples=4@0+3@2:clamp=1", "rsm:samples=8", NULL});
}

static void expect_seeds(const char *line, const char *override, int count, const int *seeds)
{
    struct irb_config c;
    char *text = irb_asprintf("scene: cornell\n%s\ntrials: [rsm]\n", line);
    load(&c, text, (const char *const[]){override, NULL});
    assert_int_equal(c.seed_count, count);
    for (int i = 0; i < count; i++)
        assert_int_equal(c.seeds[i], seeds[i]);
    irb_config_destroy(&c);
    free(text);
}

static void test_seeds(void **state)
{
    (void)state;
    expect_seeds("", NULL, 5, (const int[]){1, 2, 3, 4, 5});
    expect_seeds("seed: 0", NULL, 1, (const int[]){0});
    expect_seeds("seeds: 3", NULL, 3, (const int[]){1, 2, 3});
    expect_seeds("seeds: [7, 0, 5]", NULL, 3, (const int[]){7, 0, 5});
    expect_seeds("seeds: [7, 0, 5]", "seed=4", 1, (const int[]){4});
    expect_seeds("seed: 9", "seeds=2", 2, (const int[]){1, 2});
    expect_seeds("seed: 9", "seeds=8,6", 2, (const int[]){8, 6});
}

static void test_repeats(void **state)
{
    (void)state;
    struct irb_config c;
    load(&c, "scene: cornell\nrepeats: 3\ntrials: [rsm]\n", NULL);
    assert_int_equal(c.repeats, 3);
    irb_config_destroy(&c);
    load(&c, "scene: cornell\nrepeats: 3\ntrials: [rsm]\n",
         (const char *const[]){"repeats=100", NULL});
    assert_int_equal(c.repeats, 100);
    irb_config_destroy(&c);
}

static struct irb_key key_with(const char *text, const char *override)
{
    struct irb_config c;
    load(&c, text, (const char *const[]){override, NULL});
    struct irb_key key = irb_config_key(&c);
    irb_config_destroy(&c);
    return key;
}

static struct irb_key key_of_samples(const char *samples)
{
    char *text = irb_asprintf("scene: cornell\ntrials: ['rsm:samples=%s']", samples);
    struct irb_key key = key_with(text, NULL);
    free(text);
    return key;
}

static void test_key(void **state)
{
    (void)state;
    struct irb_key key = key_with(full_text, NULL);
    assert_string_equal(key_with(full_text, NULL).hex, key.hex);
    /* not what a name, a comment or the notation says */
    assert_string_equal(key_with(full_text, "name=other").hex, key.hex);
    assert_string_equal(key_with(full_text, "debug_layers=true").hex, key.hex);
    assert_string_equal(key_with(full_text, "repeats=2").hex, key.hex); /* times alone */
    assert_string_equal(key_with(full_text, "film=false").hex, key.hex);
    assert_string_equal(key_with("scene: cornell\nprofile: 3\ntrials: [rsm]", NULL).hex,
                        key_with("scene: cornell\ntrials: [rsm]", NULL).hex);
    assert_string_equal(key_with(full_text, "frames=9").hex, key.hex);
    assert_string_equal(
        key_with("scene: cornell\ntrials: ['rsm:mode=all']", NULL).hex,
        key_with("trials: [{rsm: {mode: all}}]\nscenes: [{scene: cornell}]", NULL).hex);
    assert_string_equal(
        key_with("scene: cornell\ntrials: [{rsm: {samples: {keys: [[0, 1], [2, 3]]}}}]", NULL).hex,
        key_with("scene: cornell\ntrials: ['rsm:samples=1@0+3@2']", NULL).hex);
    static const char *const tracks[] = {"1@0+3@2", "1@0..3@2", "1@0+4@2", "1@0+3@1", "1"};
    for (int i = 0; i < 5; i++)
        for (int j = 0; j < i; j++)
            assert_string_not_equal(key_of_samples(tracks[i]).hex, key_of_samples(tracks[j]).hex);
    assert_string_equal(key_with("scene: cornell\nseeds: [1]\ntrials: [rsm]", NULL).hex,
                        key_with("scene: cornell\nseed: 1\ntrials: [rsm]", NULL).hex);
    assert_string_equal(key_with("scene: cornell\nseeds: 5\ntrials: [rsm]", NULL).hex,
                        key_with("scene: cornell\ntrials: [rsm]", NULL).hex);
    assert_string_equal(
        key_with("scene: cornell\ntrials: [{rsm: {samples: [1, 2]}}]", NULL).hex,
        key_with("scene: cornell\ntrials: ['rsm:samples=1', 'rsm:samples=2']", NULL).hex);
    /* but everything that changes a result */
    static const char *const changes[] = {
        "seed=8",   "frames=10",           "resolution=64x48",    "rsm_resolution=64",
        "settle=1", "reference.noise=0.5", "reference.bounces=3", "exposure=1",
    };
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++)
        if (!strcmp(key_with(full_text, changes[i]).hex, key.hex))
            fail_msg("%s does not change the key", changes[i]);
    static const char *const texts[] = {
        "scene: cornell\ntrials: [rsm]",
        "scene: cornell\nseeds: 2\ntrials: [rsm]",
        "scene: cornell\nseeds: [1, 3]\ntrials: [rsm]",
        "scene: cornell\ntrials: ['rsm:samples=1']",
        "scene: cornell\ntrials: [rsm, 'rsm:samples=1']",
        "scene: cornell\ntrials: [plain]",
        "scene: cornell\ntrials: ['plain:rsm_resolution=64']",
        "scene: cornell\ntrials: ['plain:rsm_resolution=512']",
        "scene: sphere\ntrials: [rsm]",
        "scenes: [{scene: cornell, name: x}]\ntrials: [rsm]",
        "scene: cornell\nlight: {intensity: 9}\ntrials: [rsm]",
        "scene: cornell\nlight: {interpolation: catmull-rom}\ntrials: [rsm]",
        "scene: cornell\nlight: {falloff: smooth}\ntrials: [rsm]",
        "scene: cornell\nlight: {keys: [{frame: 0}, {frame: 1}]}\ntrials: [rsm]",
        "scene: cornell\nlight: {keys: [{frame: 0}, {frame: 2}]}\ntrials: [rsm]",
        "scene: cornell\ncamera: {fov: 11}\ntrials: [rsm]",
        "scene: cornell\ncamera: {near: 0.1}\ntrials: [rsm]",
        "scene: cornell\nregions: [{name: a, box: [0, 0, 1, 1]}]\ntrials: [rsm]",
        "scene: cornell\nregions: [{name: b, box: [0, 0, 1, 1]}]\ntrials: [rsm]",
        "scene: cornell\nregions: [{name: a, box: [0, 0, 1, 0.5]}]\ntrials: [rsm]",
    };
    enum { TEXTS = sizeof texts / sizeof *texts };
    struct irb_key keys[TEXTS];
    for (int i = 0; i < TEXTS; i++) {
        keys[i] = key_with(texts[i], NULL);
        for (int j = 0; j < i; j++)
            if (!strcmp(keys[i].hex, keys[j].hex))
                fail_msg("one key for '%s' and '%s'", texts[i], texts[j]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_key), cmocka_unit_test(test_scripts),
        cmocka_unit_test(test_shortest),  cmocka_unit_test(test_built_in_view_is_kept),
        cmocka_unit_test(test_aliases),   cmocka_unit_test(test_environment),
        cmocka_unit_test(test_overrides), cmocka_unit_test(test_key),
        cmocka_unit_test(test_sweeps),    cmocka_unit_test(test_matrix),
        cmocka_unit_test(test_tracks),    cmocka_unit_test(test_seeds),
        cmocka_unit_test(test_repeats),   cmocka_unit_test(test_regions),
        cmocka_unit_test(test_profile),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
