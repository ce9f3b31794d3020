/* SPDX-License-Identifier: MIT
 *
 * Configs that are wrong: one line each that says where, what was expected and what was found.
 */
#include "core/base/fs.h"
#include "core/base/str.h"
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
    return mkdtemp(folder) ? 0 : -1;
}

static int tear_down(void **state)
{
    (void)state;
    char *command = irb_asprintf("rm -rf '%s'", folder);
    int status = system(command);
    free(command);
    return status;
}

static char *config_path(void)
{
    return irb_asprintf("%s/c.yaml", folder);
}

/* Loads `size` bytes of text as a config; the message must be exactly `expected`, in which "@" at
 * the start stands for the config's path. */
static void expect_bytes(const char *text, size_t size, const char *const *overrides,
                         const char *expected)
{
    struct irb_error err = {0};
    struct irb_config config;
    char *path = config_path();
    REQUIRE_OK(irb_fs_write(path, text, size, &err));
    if (irb_config_load(&config, path, overrides, &mock_registry, &err))
        fail_msg("accepted: %.1000s", text);
    assert_int_equal(err.code, IRB_E_INPUT);
    assert_int_equal(config.scene_count, 0);
    char *whole =
        *expected == '@' ? irb_asprintf("%s%s", path, expected + 1) : irb_strdup(expected);
    if (strcmp(err.message, whole))
        fail_msg("found    %s\nexpected %s\nfor\n%.1000s", err.message, whole, text);
    free(whole);
    free(path);
}

static void expect(const char *text, const char *expected)
{
    expect_bytes(text, strlen(text), NULL, expected);
}

/* `text` between a scene and the trials: its first line is line 2 of the file. */
static void expect_top(const char *text, const char *expected)
{
    char *whole = irb_asprintf("scene: cornell\n%s\ntrials: [rsm]\n", text);
    expect(whole, expected);
    free(whole);
}

static void expect_trial(const char *text, const char *expected)
{
    char *whole = irb_asprintf("scene: cornell\ntrials:\n  - %s\n", text);
    expect(whole, expected);
    free(whole);
}

static void test_files(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct irb_config config;
    assert_false(irb_config_load(&config, "/nowhere/c.yaml", NULL, &mock_registry, &err));
    assert_string_equal(err.message, "/nowhere/c.yaml: cannot open: No such file or directory");
    assert_false(irb_config_load(&config, folder, NULL, &mock_registry, &err));
    assert_non_null(strstr(err.message, "expected a file"));
    enum { HUGE_SIZE = (1 << 20) + 1 };
    char *huge = calloc(1, HUGE_SIZE);
    memset(huge, '\n', HUGE_SIZE);
    expect_bytes(huge, HUGE_SIZE, NULL, "@: expected at most 1048576 bytes, found 1048577");
    free(huge);
}

static void test_syntax(void **state)
{
    (void)state;
    expect("", "@:1:1: expected scenes: and trials:, found an empty file");
    expect("# nothing\n", "@:1:1: expected scenes: and trials:, found an empty file");
    expect("scene: [cornell\ntrials: 3\n",
           "@:2:7: not valid YAML: did not find expected ',' or ']' (while parsing a flow sequence "
           "that begins at line 1)");
    expect("scene: cornell\n  frames: 3\n",
           "@:2:9: not valid YAML: mapping values are not allowed in this context");
    expect("scene: \"cornell\n", "@:2:1: not valid YAML: found unexpected end of stream (while "
                                 "scanning a quoted scalar that begins at line 1)");
    expect(
        "scene:\tcornell\n\ttrials: 3\n",
        "@:2:1: not valid YAML: found a tab character that violates indentation (while scanning a "
        "plain scalar that begins at line 1)");
    expect("scene: *nothing\n", "@:1:8: not valid YAML: found undefined alias");
    expect("scene: corn\xff\n", "@:1:12: not valid YAML: invalid leading UTF-8 octet");
    expect("- a\n- b\n", "@:1:1: config: expected a map of keys, found a list");
    expect("cornell\n", "@:1:1: config: expected a map of keys, found a single value");
    expect("scene: cornell\ntrials: [rsm]\n---\nscene: cornell\n",
           "@:4:1: expected one YAML document, found another");
    expect("? [a]\n: b\n", "@:1:3: a key: expected a single value, found a list");
    expect("scene: \"corn\\0ell\"\n", "@:1:8: scene: expected text, found a zero byte in it");
    expect("scene: cornell\n<<: {frames: 3}\n",
           "@:2:1: config: merge keys (<<) are not supported; use an alias for a whole value");
}

/* Refused at once: libyaml alone would need minutes. */
static void test_deep_nesting(void **state)
{
    (void)state;
    enum { DEPTH = 500000 };
    char *text = malloc(DEPTH + 8);
    memcpy(text, "scene: ", 7);
    memset(text + 7, '[', DEPTH);
    text[DEPTH + 7] = 0;
    /* the 32nd bracket is inside the map and 31 lists */
    expect(text, "@:1:39: expected at most 32 lists and maps inside one another");
    free(text);
}

static void test_top(void **state)
{
    (void)state;
    expect_top("frame: 3", "@:2:1: config: unknown key 'frame'; did you mean 'frames'?");
    expect_top("a-key-like-nothing-else: 3",
               "@:2:1: config: unknown key 'a-key-like-nothing-else'; expected one of: name, seed, "
               "seeds, repeats, resolution, reference, scenes, scene, camera, light, animation, "
               "objects, regions, profile, trials, width, height, frames, settle, rsm_resolution, "
               "gbuffer_layout, rsm_layout, exposure, "
               "debug_layers, film");
    expect_top("frames: 3\nframes: 4",
               "@:3:1: config: 'frames' stands here twice, first in line 2");
    expect_top("frames: 0", "@:2:9: frames: expected a whole number in [1, 100000]; found '0'");
    expect_top("frames: many",
               "@:2:9: frames: expected a whole number in [1, 100000]; found 'many'");
    expect_top("frames: 2.5", "@:2:9: frames: expected a whole number in [1, 100000]; found '2.5'");
    expect_top("frames:", "@:2:8: frames: expected a whole number in [1, 100000]; found ''");
    expect_top("frames: [3, 4]", "@:2:9: frames: expected a single value, found a list");
    expect_top("frames: {a: 4}", "@:2:9: frames: expected a single value, found a map");
    expect_top("settle: -1", "@:2:9: settle: expected a whole number in [0, 10000]; found '-1'");
    expect_top("exposure: .nan", "@:2:11: exposure: expected a number in [0, 1e+09]; found '.nan'");
    expect_top("exposure: nan", "@:2:11: exposure: expected a number in [0, 1e+09]; found 'nan'");
    expect_top("seed: -1", "@:2:7: seed: expected a whole number in [0, 2.14748e+09]; found '-1'");
    expect_top("name: a/b", "@:2:7: name: expected 1 to 64 letters, digits, '.', '_' or '-', found "
                            "'a/b'");
    expect_top("name: ..", "@:2:7: name: expected 1 to 64 letters, digits, '.', '_' or '-', found "
                           "'..'");
    expect_top("resolution: 256", "@:2:13: resolution: expected [width, height], found a single "
                                  "value");
    expect_top("resolution: [256]",
               "@:2:13: resolution: expected [width, height], found too few numbers");
    expect_top("resolution: [1, 2, 3]",
               "@:2:13: resolution: expected [width, height], found too many numbers");
    expect_top(
        "resolution: [256, 0]",
        "@:2:13: resolution: height: expected a whole number in [1, 8192] pixels; found '0'");
    expect_top("resolution: [256, [1]]",
               "@:2:19: resolution: expected a single value, found a list");
    expect_top("resolution: [256, 192]\nwidth: 3",
               "@:3:8: width: expected resolution: alone, found both");
}

static void test_reference(void **state)
{
    (void)state;
    expect_top("reference: 3", "@:2:12: reference: expected a map of keys, found a single value");
    expect_top("reference: {nois: 3}",
               "@:2:13: reference: unknown key 'nois'; did you mean 'noise'?");
    expect_top("reference:\n  noise: [1]", "@:3:10: noise: expected a single value, found a list");
    expect_top("reference:\n  unoccluded: maybe",
               "@:3:15: reference: unoccluded: expected true or false; found 'maybe'");
    expect_top("reference: {noise: 1, noise: 2}",
               "@:2:23: reference: 'noise' stands here twice, first in line 2");
    expect_top("reference: {min_samples: 64, max_samples: 32}",
               "@: reference: expected min_samples to be at most max_samples, found 64 and 32");
}

static void test_regions(void **state)
{
    (void)state;
    expect_top("regions: 3", "@:2:10: regions: expected a list of regions, found a single value");
    expect_top("regions: [corner]", "@:2:11: region: expected a map of keys, found a single value");
    expect_top("regions: [{name: a, bax: [0, 0, 1, 1]}]",
               "@:2:21: region: unknown key 'bax'; did you mean 'box'?");
    expect_top("regions: [{name: a}]",
               "@:2:11: box: missing; expected {name: NAME, box: [x0, y0, x1, y1]}");
    expect_top("regions: [{box: [0, 0, 1, 1]}]",
               "@:2:11: name: missing; expected {name: NAME, box: [x0, y0, x1, y1]}");
    expect_top("regions: [{name: a b, box: [0, 0, 1, 1]}]",
               "@:2:18: name: expected 1 to 64 letters, digits, '.', '_' or '-', found 'a b'");
    expect_top("regions:\n - {name: a, box: [0, 0, 1, 1]}\n - {name: a, box: [0, 0, 1, 1]}",
               "@:4:11: two regions of the scene are called 'a'");
    expect_top("regions: [{name: a, box: [-1, 0, 1, 1]}]",
               "@:2:26: box: expected 0 or more, found -1");
    expect_top("regions: [{name: a, box: [0, 0, 2.5, 3]}]",
               "@:2:26: box: expected whole pixels, or fractions of the image that are all at most "
               "1, found [0, 0, 2.5, 3]");
    expect_top("regions: [{name: a, box: [9, 0, 8, 3]}]",
               "@:2:26: box: expected [x0, y0, x1, y1] with x0 < x1 and y0 < y1, found [9, 0, 8, "
               "3]");
    expect_top(
        "regions: [{name: a, box: [0, 0, 513, 384]}]",
        "@: scene cornell: region a: expected a box with at least one pixel inside the image "
        "of 512 x 384, found [0, 0, 513, 384]");
    expect_top(
        "regions: [{name: a, box: [0, 0, 0.0001, 1]}]",
        "@: scene cornell: region a: expected a box with at least one pixel inside the image "
        "of 512 x 384, found [0, 0, 0.0001, 1]");
    expect_top("profile: middle", "@:2:10: profile: expected a number, found 'middle'");
    expect_top("profile: -1", "@:2:10: profile: expected a number in [0, 16384], found '-1'");
    expect_top("profile: 3.5", "@:2:10: profile: expected a row in whole pixels, or a fraction of "
                               "the height between 0 and 1, found 3.5");
    expect_top("profile: 384", "@:2:10: profile: expected a row below 384, the height of the "
                               "image, found 384");
    expect("scenes: [{scene: cornell}]\nregions: []\ntrials: [rsm]\n",
           "@:2:10: regions: expected inside the entries of scenes:, found beside it");
    struct irb_str many = {0};
    irb_str_printf(&many, "regions: [");
    for (int i = 0; i < 17; i++)
        irb_str_printf(&many, "%s{name: r%d, box: [0, 0, 1, 1]}", i ? ", " : "", i);
    irb_str_printf(&many, "]");
    expect_top(irb_str_text(&many), "@:2:10: regions: expected at most 16, found 17");
    irb_str_free(&many);
}

static void test_scenes(void **state)
{
    (void)state;
    expect("trials: [rsm]\n", "@:1:1: scenes: missing; expected a list of scenes, or one scene:");
    expect("scenes: []\ntrials: [rsm]\n",
           "@:1:9: scenes: expected a list of scenes, found an empty one");
    expect("scenes: cornell\ntrials: [rsm]\n",
           "@:1:9: scenes: expected a list of scenes, found a single value");
    expect("scenes: [cornell]\ntrials: [rsm]\n",
           "@:1:10: scene: expected a map of keys, found a single value");
    expect("scenes: [{name: a}]\ntrials: [rsm]\n",
           "@:1:10: scene: missing; expected a built-in's name or a path");
    expect("scenes: [{scene: cornell, lamp: 3}]\ntrials: [rsm]\n",
           "@:1:27: scene: unknown key 'lamp'; did you mean 'name'?");
    expect("scenes: [{scene: cornell}, {scene: cornell}]\ntrials: [rsm]\n",
           "@:1:28: two scenes are called 'cornell'; give one of them another name:");
    expect("scenes: [{scene: cornell}, {scene: sphere, name: cornell}]\ntrials: [rsm]\n",
           "@:1:50: two scenes are called 'cornell'; give one of them another name:");
    expect("scenes: [{scene: cornell, name: a b}]\ntrials: [rsm]\n",
           "@:1:33: name: expected 1 to 64 letters, digits, '.', '_' or '-', found 'a b'");
    expect("scene: cornell\nscenes: [{scene: sphere}]\ntrials: [rsm]\n",
           "@:1:8: scene: expected inside the entries of scenes:, found beside it");
    expect("light: {cone: 3}\nscenes: [{scene: sphere}]\ntrials: [rsm]\n",
           "@:1:8: light: expected inside the entries of scenes:, found beside it");
    expect(
        "scene: cornel\ntrials: [rsm]\n",
        "@:1:8: scene: there is no built-in scene and no file 'cornel'; did you mean 'cornell'?");
    expect("scene: [cornell]\ntrials: [rsm]\n",
           "@:1:8: scene: expected a single value, found a list");
    expect("scene:\ntrials: [rsm]\n",
           "@:1:7: scene: expected a built-in's name or a path, found nothing");
    expect("scene: /nowhere/hall.glb\ntrials: [rsm]\n",
           "@:1:8: scene: there is no file '/nowhere/hall.glb'");
    char *relative = irb_asprintf("@:1:8: scene: there is no file '%s/sub/hall.glb'", folder);
    expect("scene: sub/hall.glb\ntrials: [rsm]\n", relative);
    free(relative);
}

static void test_environment(void **state)
{
    (void)state;
    unsetenv("IRB_TEST_NOTHING");
    expect("trials: [rsm]\nscenes:\n  - scene: ${IRB_TEST_NOTHING}/a.glb\n",
           "@:3:12: scene: the environment variable IRB_TEST_NOTHING is not set; it should name a "
           "folder");
    setenv("IRB_TEST_NOTHING", "", 1);
    expect("scene: ${IRB_TEST_NOTHING}/a.glb\n",
           "@:1:8: scene: the environment variable IRB_TEST_NOTHING is not set; it should name a "
           "folder");
    expect("scene: a${IRB_TEST\n", "@:1:8: scene: expected ${NAME}, found '${IRB_TEST'");
    expect("scene: ${}/a.glb\n", "@:1:8: scene: expected ${NAME}, found '${}/a.glb'");
}

/* A scene from a file, which has no view of its own, with `script` from line 2 on. */
static void expect_file_scene(const char *script, const char *expected)
{
    struct irb_error err = {0};
    char *path = irb_asprintf("%s/a.glb", folder);
    REQUIRE_OK(irb_fs_write(path, "x", 1, &err));
    free(path);
    char *whole = irb_asprintf("scene: a.glb\n%s\ntrials: [rsm]\n", script);
    expect(whole, expected);
    free(whole);
}

static void test_file_scenes(void **state)
{
    (void)state;
    const char *const light = "light: {position: [0, 1, 0], target: [0, 0, 0], intensity: 1}";
    const char *const camera = "camera: {position: [0, 1, 0], target: [0, 0, 1]}";
    char *text = irb_asprintf("%s\nlight: {position: [0, 1, 0], target: [0, 0, 0]}", camera);
    expect_file_scene(text,
                      "@:3:8: light: intensity: missing; expected all of it, or the name: of one "
                      "that the glTF file brings");
    free(text);
    text = irb_asprintf("%s\ncamera: {keys: [{frame: 0, position: [0, 1, 0]}]}", light);
    expect_file_scene(text,
                      "@:3:17: camera: target: missing; expected all of it, or the name: of one "
                      "that the glTF file brings");
    free(text);
}

/* What the file may bring is named; the rest of the section is then the file's. */
static void test_of_file(void **state)
{
    (void)state;
    expect_file_scene("light: {name: Sun, cone: 3}",
                      "@:2:20: light: unknown key 'cone'; expected one of: name, beam_half_width");
    expect_file_scene("camera: {name: Main, near: 2, far: 1}",
                      "@:2:9: camera: near must be below far, found 2 and 1");
    expect_top("light: {name: Sun}",
               "@:2:15: light: name: expected for a glTF file alone; a built-in scene has no named "
               "ones");
    expect_file_scene("animation: {fps: 0}",
                      "@:2:18: fps: expected frames a second above 0, found 0");
    expect_file_scene("animation: {fps: fast}", "@:2:18: fps: expected a number, found 'fast'");
    expect_file_scene("animation: {frames: 3}",
                      "@:2:13: animation: unknown key 'frames'; expected one of: fps, start");
    expect_top("animation: {fps: 24}",
               "@:2:12: animation: this built-in scene has none of its own (objects: moves its "
               "objects)");
}

static void test_objects(void **state)
{
    (void)state;
    expect_top("objects: sphere",
               "@:2:10: objects: expected a list of 1 to 1024 maps, found a single value");
    expect_top("objects: [{keys: [{frame: 0}]}]", "@:2:11: object: name: missing");
    expect_top("objects: [{name: a}]",
               "@:2:11: object: keys: expected a list of 1 to 4096 keys, found none");
    expect_top("objects: [{name: a, keys: [{translate: [0, 0, 1]}]}]",
               "@:2:28: object: frame: missing in a list of keys");
    expect_top("objects: [{name: a, keys: [{frame: 1}, {frame: 1}]}]",
               "@:2:48: frame: expected above 1, the key before it, found 1");
    expect_top("objects: [{name: a, keys: [{frame: 0, rotate: [0, 0, 0, 90]}]}]",
               "@:2:47: rotate: expected [x, y, z, degrees] about an axis that is not zero");
    expect_top("objects: [{name: a, keys: [{frame: 0, scale: [1, 0, 1]}]}]",
               "@:2:50: scale: expected 1e-06 to 1e+06, found 0");
    expect_top("objects: [{name: a, keys: [{frame: 0}]}, {name: a, keys: [{frame: 0}]}]",
               "@:2:49: objects: 'a' is there twice");
}

static void test_light(void **state)
{
    (void)state;
    expect_top("light: sun", "@:2:8: light: expected a map of keys, found a single value");
    expect_top("light:", "@:2:7: light: expected a map of keys, found nothing");
    expect_top("light: {colour: 3}",
               "@:2:9: light: unknown key 'colour'; expected one of: type, falloff, "
               "beam_half_width, interpolation, keys, position, target, intensity, cone, inner");
    expect_top("light: {type: spt}",
               "@:2:15: type: expected one of spot, directional; found 'spt'");
    expect_top("light: {falloff: cubic}",
               "@:2:18: falloff: expected one of constant, smooth, cosine; found 'cubic'");
    expect_top("light: {interpolation: bezier}",
               "@:2:24: interpolation: expected one of linear, catmull-rom; found 'bezier'");
    expect_top("light: {position: [1, 2]}",
               "@:2:19: position: expected a list of 3 numbers, found 2");
    expect_top("light: {position: 1}",
               "@:2:19: position: expected a list of 3 numbers, found a single value");
    expect_top("light: {position: [1, 2, x]}", "@:2:26: position: expected a number, found 'x'");
    expect_top("light: {position: [1, 2, nan]}",
               "@:2:26: position: expected a number, found 'nan'");
    expect_top("light: {position: [1, 2, 1e39]}",
               "@:2:26: position: expected a number, found '1e39'");
    expect_top("light: {intensity: -1}",
               "@:2:20: intensity: expected a number in [0, 3.40282e+38], found '-1'");
    expect_top("light: {intensity: [1, -1, 1]}",
               "@:2:24: intensity: expected no negative number, found -1");
    expect_top("light: {cone: 0}", "@:2:15: cone: expected degrees between 0 and 90, found 0");
    expect_top("light: {cone: 90}", "@:2:15: cone: expected degrees between 0 and 90, found 90");
    expect_top("light: {cone: 20, inner: 20}",
               "@:2:26: inner: expected degrees below the cone's 20, found 20");
    expect_top("light:\n  position: [1, 2, 3]\n  target: [1, 2, 3]",
               "@:3:3: light key 0: position and target are the same point (1, 2, 3)");
    expect_top("light: {beam_half_width: -1}",
               "@:2:26: beam_half_width: expected a number in [0, 3.40282e+38], found '-1'");
}

static void test_keys(void **state)
{
    (void)state;
    expect_top("light: {keys: []}", "@:2:15: keys: expected a list of 1 to 4096 keys, found none");
    expect_top("light: {keys: 3}",
               "@:2:15: keys: expected a list of 1 to 4096 keys, found a single value");
    expect_top("light: {keys: [3]}", "@:2:16: light: expected a map of keys, found a single value");
    expect_top("light: {keys: [{cone: 3}]}", "@:2:16: light: frame: missing in a list of keys");
    expect_top("light: {keys: [{frame: -1}]}",
               "@:2:24: frame: expected a number in [0, 1e+06], found '-1'");
    expect_top("light:\n  keys:\n    - {frame: 3}\n    - {frame: 3}",
               "@:5:15: frame: expected above 3, the key before it, found 3");
    expect_top("light:\n  keys:\n    - {frame: 3}\n    - {frame: 2}",
               "@:5:15: frame: expected above 3, the key before it, found 2");
    expect_top("light: {keys: [{frame: 0, type: spot}]}",
               "@:2:27: light: unknown key 'type'; expected one of: frame, position, target, "
               "intensity, cone, inner");
    expect_top("light: {cone: 3, keys: [{frame: 0}]}",
               "@:2:15: light: cone: expected inside the items of keys:, found beside it");
    expect_top("light:\n  keys:\n    - {frame: 0}\n    - {frame: 1, position: [0, 0, 0], target: "
               "[0, 0, 0]}",
               "@:5:7: light key 0: position and target are the same point (0, 0, 0)");
}

static void test_camera(void **state)
{
    (void)state;
    expect_top("camera: {fov: 180}", "@:2:15: fov: expected degrees between 0 and 180, found 180");
    expect_top("camera: {cone: 3}",
               "@:2:10: camera: unknown key 'cone'; expected one of: interpolation, near, far, "
               "keys, position, target, up, fov");
    expect_top("camera: {position: [0, 0, 0], target: [0, 3, 0]}",
               "@:2:9: camera key 0: up (0, 1, 0) is parallel to the view; give another up");
    expect_top("camera: {up: [0, 0, 0]}",
               "@:2:9: camera key 0: up must be a finite vector and not zero");
    expect_top("camera: {near: 3, far: 2}", "@:2:9: camera: near must be below far, found 3 and 2");
}

static void test_trials(void **state)
{
    (void)state;
    expect("scene: cornell\n", "@:1:1: trials: missing; expected a list of methods to run");
    expect("scene: cornell\ntrials: []\n",
           "@:2:9: trials: expected a list of methods to run, found an empty one");
    expect("scene: cornell\ntrials: rsm\n",
           "@:2:9: trials: expected a list of methods to run, found a single value");
    expect_trial("rms", "@:3:5: trial 'rms': unknown method 'rms'; did you mean 'rsm'?");
    expect_trial("rms: {mode: all}", "@:3:5: unknown method 'rms'; did you mean 'rsm'?");
    expect_trial("rsm:mode=al", "@:3:5: trial 'rsm:mode=al': mode: expected one of all, uniform, "
                                "importance; found 'al'");
    expect_trial("rsm: {mod: all}", "@:3:11: rsm: unknown key 'mod'; did you mean 'mode'?");
    expect_trial("rsm: {mode: al}",
                 "@:3:17: rsm: mode: expected one of all, uniform, importance; found 'al'");
    expect_trial("rsm: {rsm_resolution: [64, 9000]}",
                 "@:3:32: rsm: rsm_resolution: expected a whole number in [0, 8192] texels; found "
                 "'9000'");
    expect_trial("rsm: {rsm_resolution: {keys: [[0, 64], [2, 32]]}}",
                 "@:3:27: rsm_resolution: expected one value, found keys; it stays the same over "
                 "the sequence");
    expect_trial("rsm: {clamp: 1e9}",
                 "@:3:18: rsm: clamp: expected a number in [0, 10] m; found '1e9'");
    expect_trial("rsm: {samples: [4, [9]]}",
                 "@:3:24: samples: expected a single value, found a list");
    expect_trial("rsm: {samples: {a: 4}}",
                 "@:3:21: samples: unknown key 'a'; expected one of: keys, interpolation");
    expect_trial("rsm: {samples: 4, samples: 4}",
                 "@:3:23: rsm: 'samples' stands here twice, first in line 3");
    expect_trial("rsm: mode", "@:3:10: rsm: expected a map of keys, found a single value");
    expect_trial("{rsm: {mode: all}, plain: }",
                 "@:3:5: trial: expected one key, the method, found 2 keys; indent its parameters "
                 "below it");
    expect_trial("[rsm]", "@:3:5: trial: expected a single value, found a list");
    expect_trial("plain: {samples: 3}",
                 "@:3:13: plain: unknown key 'samples'; plain has no parameters");
    expect_trial("rsm:mode=all\n  - rsm: {mode: all, samples: 400}",
                 "@:4:5: trial 'rsm:mode=all' stands here twice");
}

static void test_sweeps(void **state)
{
    (void)state;
    expect_trial("rsm: {samples: []}",
                 "@:3:20: rsm.samples: expected at least one value, found an empty list");
    expect_trial("rsm: {samples: [4, 0]}",
                 "@:3:24: rsm: samples: expected a whole number in [1, 4096]; found '0'");
    expect_trial("rsm: {samples: [4, {a: 3}]}",
                 "@:3:25: samples: unknown key 'a'; expected one of: keys, interpolation");
    expect_trial("rsm: {samples: [4, {keys: [[0, 4], [1, 4]]}]}",
                 "@:3:24: rsm.samples: 4 stands here twice");
    expect_trial("rsm: {mode: [all, al]}",
                 "@:3:23: rsm: mode: expected one of all, uniform, importance; found 'al'");
    expect_trial("rsm: {clamp: [1, 2, 1.0]}", "@:3:25: rsm.clamp: 1 stands here twice");
    expect_trial("rsm: {samples: [4, 9]}\n  - rsm:samples=9",
                 "@:4:5: trial 'rsm:samples=9' stands here twice");
    expect_trial("rsm:samples=9\n  - rsm: {samples: [4, 9]}",
                 "@:4:5: trial 'rsm:samples=9' stands here twice");
    expect_trial("plain: [1, 2]", "@:3:12: plain: expected a map of keys, found a list");
}

static void test_matrix(void **state)
{
    (void)state;
    expect_trial("rsm: {matrix: 3}",
                 "@:3:19: rsm.matrix: expected a list of maps, found a single value");
    expect_trial("rsm: {matrix: }", "@:3:19: rsm.matrix: expected a list of maps, found nothing");
    expect_trial("rsm: {matrix: []}",
                 "@:3:19: rsm.matrix: expected a list of maps, found an empty one");
    expect_trial("rsm: {matrix: [all]}",
                 "@:3:20: rsm: expected a map of keys, found a single value");
    expect_trial("rsm: {matrix: [{mod: all}]}",
                 "@:3:21: rsm: unknown key 'mod'; did you mean 'mode'?");
    expect_trial("rsm: {matrix: [{mode: al}]}",
                 "@:3:27: rsm: mode: expected one of all, uniform, importance; found 'al'");
    expect_trial("rsm: {matrix: [{mode: all}, {mode: all}]}",
                 "@:3:5: trial 'rsm:mode=all' stands here twice");
    expect_trial("rsm: {matrix: [{matrix: [{mode: all}]}]}",
                 "@:3:29: rsm.matrix: expected no matrix inside it");
    /* a value that every entry replaces is checked no less */
    expect_trial("rsm: {mode: al, matrix: [{mode: all}]}",
                 "@:3:17: rsm: mode: expected one of all, uniform, importance; found 'al'");
}

/* "[1, 2, ..., count]", malloc'ed. */
static char *numbers(int count)
{
    struct irb_str text = {0};
    for (int i = 1; i <= count; i++)
        irb_str_printf(&text, "%s%d", i > 1 ? ", " : "[", i);
    irb_str_printf(&text, "]");
    return text.text;
}

static void expect_keys(const char *map, const char *expected)
{
    char *text = irb_asprintf("rsm: {samples: {%s}}", map);
    expect_trial(text, expected);
    free(text);
}

static void test_tracks(void **state)
{
    (void)state;
    expect_keys("key: 3", "@:3:21: samples: unknown key 'key'; did you mean 'keys'?");
    expect_keys("interpolation: step",
                "@:3:20: samples: keys: expected a list of [frame, value], found nothing");
    expect_keys("keys: 32",
                "@:3:27: samples: keys: expected a list of [frame, value], found a single value");
    expect_keys("keys: []",
                "@:3:27: samples: keys: expected a list of [frame, value], found an empty one");
    expect_keys("keys: [0, 32]",
                "@:3:28: samples: keys: expected [frame, value], found a single value");
    expect_keys("keys: [[0, 32, 4]]",
                "@:3:28: samples: keys: expected [frame, value], found another list");
    expect_keys("keys: [[0, 32], [4, 9999]]",
                "@:3:41: rsm: samples: expected a whole number in [1, 4096]; found '9999'");
    expect_keys("keys: [[0, [32]]]", "@:3:32: samples: expected a single value, found a list");
    expect_keys("keys: [[-1, 32]]",
                "@:3:29: samples: frame: expected a whole number in [0, 1e+06]; found '-1'");
    expect_keys("keys: [[0.5, 32]]",
                "@:3:29: samples: frame: expected a whole number in [0, 1e+06]; found '0.5'");
    expect_keys("keys: [[4, 32], [4, 64]]",
                "@:3:38: samples: frame: expected above 4, the key before it, found 4");
    expect_keys("keys: [[0, 32]], interpolation: cubic",
                "@:3:53: samples: interpolation: expected one of step, linear; found 'cubic'");
    expect_trial("rsm: {mode: {keys: [[0, all], [4, uniform]], interpolation: linear}}",
                 "@:3:65: mode: expected steps between its values, found linear");
    expect_trial("rsm:samples=32@0+64@4\n  - rsm: {samples: {keys: [[0, 32], [4, 64]]}}",
                 "@:4:5: trial 'rsm:samples=32@0+64@4' stands here twice");
    struct irb_str keys = {0};
    for (int i = 0; i < 257; i++)
        irb_str_printf(&keys, "%s[%d, %d]", i ? ", " : "keys: [", i, i + 1);
    irb_str_printf(&keys, "]");
    char *text = irb_asprintf("rsm: {samples: {%s}}", irb_str_text(&keys));
    char *expected = irb_asprintf("@:3:%d: samples: expected at most 256 keys, found more",
                                  (int)(strstr(text, "[256,") - text) + 5);
    expect_trial(text, expected);
    free(expected);
    free(text);
    irb_str_free(&keys);
}

/* Parameters that are in range and do not go together, or not with the RSM's 8 x 8 texels. */
static void expect_together(const char *trials, const char *expected)
{
    char *text =
        irb_asprintf("scene: cornell\nrsm_resolution: 8\nframes: 8\ntrials:\n%s\n", trials);
    expect(text, expected);
    free(text);
}

static void test_parameters_together(void **state)
{
    (void)state;
    expect_together("  - rsm:mode=importance:samples=64\n  - rsm:mode=importance:samples=65",
                    "@:6:5: trial 'rsm:mode=importance:samples=65': samples: expected at most 64, "
                    "found 65");
    expect_together("  - rsm: {mode: [uniform, importance], samples: [9, 70]}",
                    "@:5:5: trial 'rsm:mode=importance:samples=70': samples: expected at most 64, "
                    "found 70");
    /* of two keyed parameters, where they meet; and between two keys */
    expect_together("  - rsm: {mode: {keys: [[0, all], [5, importance]]}, "
                    "samples: {keys: [[2, 64], [4, 80], [6, 9]]}}",
                    "@:5:5: trial 'rsm:mode=all@0+importance@5:samples=64@2+80@4+9@6': frame 5: "
                    "samples: expected at most 64, found 80");
    expect_together("  - rsm:mode=uniform@0+importance@1+all@3:samples=100@0..60@4",
                    "@:5:5: trial 'rsm:mode=uniform@0+importance@1+all@3:samples=100@0..60@4': "
                    "frame 1: samples: expected at most 64, found 90");
    /* keys behind the last frame too */
    expect_together("  - rsm:mode=importance:samples=9@0+70@20",
                    "@:5:5: trial 'rsm:mode=importance:samples=9@0+70@20': frame 20: samples: "
                    "expected at most 64, found 70");
    /* with the trial's own RSM */
    expect_together("  - rsm:mode=importance:samples=17:rsm_resolution=4",
                    "@:5:5: trial 'rsm:mode=importance:samples=17:rsm_resolution=4': samples: "
                    "expected at most 16, found 17");
    /* with what --set makes of it */
    static const char text[] = "scene: cornell\ntrials: ['rsm:mode=importance']\n";
    expect_bytes(text, sizeof text - 1, (const char *const[]){"rsm_resolution=16", NULL},
                 "@:2:10: trial 'rsm:mode=importance': samples: expected at most 256, found 400");
}

static void test_too_many(void **state)
{
    (void)state;
    char *many = numbers(1001), *some = numbers(100);
    char *text = irb_asprintf("rsm: {samples: %s}", many);
    expect_trial(text, "@:3:20: rsm.samples: expected at most 1000 trials, found 1001 with these "
                       "values");
    free(text);
    text = irb_asprintf("rsm: {clamp: [0, 1, 2, 3], mode: [all, uniform, importance], samples: %s}",
                        some);
    expect_trial(text, "@:3:18: rsm.clamp: expected at most 1000 trials, found 1200 with these "
                       "values");
    free(text);
    text = irb_asprintf("rsm: {clamp: 0.5, mode: [all, uniform, importance], samples: %s}\n"
                        "  - rsm: {clamp: 0.6, mode: [all, uniform, importance], samples: %s}\n"
                        "  - rsm: {clamp: 0.7, mode: [all, uniform, importance], samples: %s}\n"
                        "  - rsm: {clamp: 0.8, mode: [all, uniform, importance], samples: %s}",
                        some, some, some, some);
    expect_trial(text, "@:6:5: trials: expected at most 1000, found more");
    free(text);
    text = irb_asprintf("scene: cornell\nseeds: 11\ntrials: [{rsm: {samples: %s}}]\n", some);
    expect(text, "@: expected at most 1000 trials, each seed counted, found 100 with 11 seeds");
    free(text);
    free(some);
    free(many);
}

static void test_seeds(void **state)
{
    (void)state;
    expect_top("seeds: 0", "@:2:8: seeds: expected a whole number in [1, 100]; found '0'");
    expect_top("seeds: many", "@:2:8: seeds: expected a whole number in [1, 100]; found 'many'");
    expect_top("seeds:", "@:2:7: seeds: expected a whole number in [1, 100]; found ''");
    expect_top("seeds: []", "@:2:8: seeds: expected a number or a list of seeds, found an empty "
                            "list");
    expect_top("seeds: {a: 1}", "@:2:8: seeds: expected a number or a list of seeds, found a map");
    expect_top("seeds: [1, -1]",
               "@:2:12: seeds: seed: expected a whole number in [0, 2.14748e+09]; found '-1'");
    expect_top("seeds: [1, [2]]", "@:2:12: seeds: expected a single value, found a list");
    expect_top("seeds: [1, 2, 1]", "@:2:15: seeds: 1 stands here twice");
    expect_top("seeds: [1, 2]\nseed: 3", "@:2:8: seeds: expected seed: or seeds:, found both");
    expect_top("repeats: 0", "@:2:10: repeats: expected a whole number in [1, 100]; found '0'");
    expect_top("repeats: 101", "@:2:10: repeats: expected a whole number in [1, 100]; found '101'");
    expect_top("repeats: [1]", "@:2:10: repeats: expected a single value, found a list");
    char *many = numbers(101);
    char *text = irb_asprintf("seeds: %s", many);
    /* its 101st number: 9 of one digit, 90 of two, 1 of three before it, two characters between */
    char *message = irb_asprintf("@:2:%d: seeds: expected at most 100, found more",
                                 8 + 1 + 9 * 1 + 90 * 2 + 3 + 100 * 2);
    expect_top(text, message);
    free(message);
    free(text);
    free(many);
}

/* A sequence of control characters must not break the line, nor the terminal. */
static void test_one_line(void **state)
{
    (void)state;
    expect_top("frames: \"a\\nb\\e[31m\"",
               "@:2:9: frames: expected a whole number in [1, 100000]; found 'a b [31m'");
}

static void expect_override(const char *override, const char *expected)
{
    static const char text[] = "scene: cornell\ntrials: [rsm]\n";
    expect_bytes(text, sizeof text - 1, (const char *const[]){override, NULL}, expected);
}

static void test_overrides(void **state)
{
    (void)state;
    expect_override("frames", "--set frames: expected key=value");
    expect_override("frame=3", "--set frame=3: unknown key 'frame'; did you mean 'frames'?");
    expect_override("frames=x",
                    "--set frames=x: frames: expected a whole number in [1, 100000]; found 'x'");
    expect_override("reference.nois=1",
                    "--set reference.nois=1: reference: unknown key 'nois'; did you mean 'noise'?");
    expect_override("trials=rsm",
                    "--set trials=rsm: trials can't be set from the command line; only single "
                    "values can, such as frames or reference.noise");
    expect_override("light.cone=3",
                    "--set light.cone=3: light can't be set from the command line; only single "
                    "values can, such as frames or reference.noise");
    expect_override("seeds=1,x", "--set seeds=1,x: seeds: seed: expected a whole number in [0, "
                                 "2.14748e+09]; found 'x'");
    expect_override("seeds=1,1", "--set seeds=1,1: seeds: 1 stands here twice");
    expect_override("seeds=,", "--set seeds=,: seeds: seed: expected a whole number in [0, "
                               "2.14748e+09]; found ''");
    expect_override("resolution=3",
                    "--set resolution=3: resolution: expected WIDTHxHEIGHT, found '3'");
    expect_override("resolution=3x0",
                    "--set resolution=3x0: resolution: height: expected a whole number in [1, "
                    "8192] pixels; found '0'");
    expect_override("name=", "--set name=: name: expected 1 to 64 letters, digits, '.', '_' or "
                             "'-', found ''");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_files),
        cmocka_unit_test(test_syntax),
        cmocka_unit_test(test_deep_nesting),
        cmocka_unit_test(test_top),
        cmocka_unit_test(test_reference),
        cmocka_unit_test(test_scenes),
        cmocka_unit_test(test_regions),
        cmocka_unit_test(test_environment),
        cmocka_unit_test(test_file_scenes),
        cmocka_unit_test(test_of_file),
        cmocka_unit_test(test_objects),
        cmocka_unit_test(test_light),
        cmocka_unit_test(test_keys),
        cmocka_unit_test(test_camera),
        cmocka_unit_test(test_trials),
        cmocka_unit_test(test_one_line),
        cmocka_unit_test(test_parameters_together),
        cmocka_unit_test(test_overrides),
        cmocka_unit_test(test_sweeps),
        cmocka_unit_test(test_matrix),
        cmocka_unit_test(test_too_many),
        cmocka_unit_test(test_tracks),
        cmocka_unit_test(test_seeds),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
