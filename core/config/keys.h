/* SPDX-License-Identifier: MIT
 *
 * Every key of a config that is in no option table. The readers accept just what stands here, and
 * `irbench docs config` prints it: a key without documentation can't be read.
 *
 * X(key, value that is expected, one line)
 */
#ifndef IRB_CONFIG_KEYS_H
#define IRB_CONFIG_KEYS_H

#define IRB_CONFIG_TOP_KEYS(X)                                                                     \
    X("name", "text", "name of the run's folder and of its reports; the file's name by default")   \
    X("seed", "whole number", "seed of every random choice, the only one")                         \
    X("seeds", "list of numbers, or how many",                                                     \
      "instead of seed: every trial is run with each of these seeds; 5, the default, means 1, 2, " \
      "3, 4, 5")                                                                                   \
    X("repeats", "whole number, 1 to 100",                                                         \
      "how often each seed is rendered; 1 by default. Images and scores are the first time's, "    \
      "times those of all")                                                                        \
    X("resolution", "[width, height]", "of the images, pixels")                                    \
    X("reference", "map", "how the ray-traced reference is made")                                  \
    X("scenes", "list of maps", "scenes, each with its view and script")                           \
    X("scene", "text",                                                                             \
      "instead of scenes, with camera, light and regions beside it: the only one")                 \
    X("camera", "map", "of the only scene")                                                        \
    X("light", "map", "of the only scene")                                                         \
    X("animation", "map", "of the only scene")                                                     \
    X("objects", "list of maps", "of the only scene")                                              \
    X("regions", "list of maps", "of the only scene")                                              \
    X("profile", "number", "of the only scene")                                                    \
    X("trials", "list", "methods with their parameters")

#define IRB_CONFIG_SCENE_KEYS(X)                                                                   \
    X("scene", "text",                                                                             \
      "name of a built-in scene, or path of a glTF file, relative to the config; ${NAME} is an "   \
      "environment variable")                                                                      \
    X("name", "text",                                                                              \
      "what tables and folders call it; the built-in's or the file's name by "                     \
      "default")                                                                                   \
    X("camera", "map", "a built-in scene has its own; so may a glTF file")                         \
    X("light", "map", "a built-in scene has its own; so may a glTF file")                          \
    X("animation", "map",                                                                          \
      "plays the scene's own animation: a glTF file's first one (transforms, morph weights, "      \
      "joints), or that of a built-in scene that has one")                                         \
    X("objects", "list of maps", "moves objects of the scene")                                     \
    X("regions", "list of maps", "boxes of the image that are scored on their own")                \
    X("profile", "row, or fraction of the height",                                                 \
      "row of the image that the profiles show over the sequence; by default the one where the "   \
      "reference changes most")

#define IRB_CONFIG_REGION_KEYS(X)                                                                  \
    X("name", "text", "what tables call it")                                                       \
    X("box", "[x0, y0, x1, y1]",                                                                   \
      "upper left corner and the one below right of it (exclusive): pixels, or fractions of the "  \
      "image where all four are at most 1")

/* What is said once of a camera, and what each of its keys may say. */
#define IRB_CONFIG_CAMERA_SETTINGS(X)                                                              \
    X("interpolation", "linear|catmull-rom", "between keys; linear by default")                    \
    X("near", "number, m", "near plane; 0, the default, takes it from the scene's size")           \
    X("far", "number, m", "far plane; 0, the default, takes it from the scene's size")             \
    X("keys", "list of maps", "keyframes; a single one may stand in camera itself")
#define IRB_CONFIG_CAMERA_KEY(X)                                                                   \
    X("position", "[x, y, z], m", "of the eye")                                                    \
    X("target", "[x, y, z], m", "point that is looked at")                                         \
    X("up", "[x, y, z]", "direction that is up in the image; [0, 1, 0] by default")                \
    X("fov", "degrees, 0 to 180", "vertical angle of view; 45 by default")

#define IRB_CONFIG_LIGHT_SETTINGS(X)                                                               \
    X("type", "spot|directional", "spot by default")                                               \
    X("falloff", "constant|smooth|cosine",                                                         \
      "of a spot light's intensity towards the rim of its cone")                                   \
    X("beam_half_width", "number, m",                                                              \
      "of a directional light's square beam; 0, the default, takes in the whole scene")            \
    X("interpolation", "linear|catmull-rom", "between keys; linear by default")                    \
    X("keys", "list of maps", "keyframes; a single one may stand in light itself")
#define IRB_CONFIG_LIGHT_KEY(X)                                                                    \
    X("position", "[x, y, z], m", "of the light")                                                  \
    X("target", "[x, y, z], m", "point on the light's axis")                                       \
    X("intensity", "number or [r, g, b]", "W/sr; of a directional light W/m2 across the beam")     \
    X("cone", "degrees, 0 to 90", "half-angle of the cone; 45 by default")                         \
    X("inner", "degrees, 0 to 90", "smooth falloff: half-angle of full intensity; 0 by default")

/* Instead of keys: what the scene's glTF file brings. */
#define IRB_CONFIG_CAMERA_OF_FILE(X)                                                               \
    X("name", "text",                                                                              \
      "camera of the glTF file that is taken, where it is at rest; near and far "                  \
      "alone may stand beside it; the file's first one by default")
#define IRB_CONFIG_LIGHT_OF_FILE(X)                                                                \
    X("name", "text",                                                                              \
      "light of the glTF file that is taken, where it is at rest; "                                \
      "beam_half_width alone may stand beside it; the file's first one by default")

#define IRB_CONFIG_ANIMATION_KEYS(X)                                                               \
    X("fps", "number, 1/s",                                                                        \
      "frames a second: frame i shows the animation at start + i/fps; 24 by "                      \
      "default")                                                                                   \
    X("start", "number, s", "where frame 0 and the settle frames are; 0 by default")

/* What is said once of an object, and what each of its keys may say. */
#define IRB_CONFIG_OBJECT_SETTINGS(X)                                                              \
    X("name", "text", "of the object; all objects of that name move")                              \
    X("pivot", "[x, y, z], m", "is turned and scaled about; the centre of its bounds by default")  \
    X("interpolation", "linear|catmull-rom", "between keys; linear by default")                    \
    X("keys", "list of maps", "keyframes, each relative to the pose at rest")
#define IRB_CONFIG_OBJECT_KEY(X)                                                                   \
    X("translate", "[x, y, z], m", "shift; [0, 0, 0] by default")                                  \
    X("rotate", "[x, y, z, degrees]", "axis and angle, counter-clockwise seen from its tip")       \
    X("scale", "number or [x, y, z]", "along the world's axes, before it is turned; 1 by default")

/* Instead of a parameter's value: values over the sequence. */
#define IRB_CONFIG_TRACK_KEYS(X)                                                                   \
    X("keys", "list of [frame, value]",                                                            \
      "whole frames that rise from key to key; before the first and behind the last key its "      \
      "value holds")                                                                               \
    X("interpolation", "step|linear",                                                              \
      "step, the default: each value holds until the next key; linear: of numbers, whole ones "    \
      "are rounded")

/* Of camera, light and objects. */
#define IRB_CONFIG_KEY_TIME(X)                                                                     \
    X("frame", "number", "time of the key in frames; rises from key to key")

/* Every section in the order of the documentation: S(title, its list). The key of a keyframe is
 * what stands here with its time before it. */
#define IRB_CONFIG_CAMERA_KEYFRAME(X) IRB_CONFIG_KEY_TIME(X) IRB_CONFIG_CAMERA_KEY(X)
#define IRB_CONFIG_LIGHT_KEYFRAME(X) IRB_CONFIG_KEY_TIME(X) IRB_CONFIG_LIGHT_KEY(X)
#define IRB_CONFIG_OBJECT_KEYFRAME(X) IRB_CONFIG_KEY_TIME(X) IRB_CONFIG_OBJECT_KEY(X)
#define IRB_CONFIG_SECTIONS(S)                                                                     \
    S("At the top", IRB_CONFIG_TOP_KEYS)                                                           \
    S("An item of `scenes`", IRB_CONFIG_SCENE_KEYS)                                                \
    S("`camera`", IRB_CONFIG_CAMERA_SETTINGS)                                                      \
    S("An item of `camera: keys`", IRB_CONFIG_CAMERA_KEYFRAME)                                     \
    S("`light`", IRB_CONFIG_LIGHT_SETTINGS)                                                        \
    S("An item of `light: keys`", IRB_CONFIG_LIGHT_KEYFRAME)                                       \
    S("`camera` of a glTF file", IRB_CONFIG_CAMERA_OF_FILE)                                        \
    S("`light` of a glTF file", IRB_CONFIG_LIGHT_OF_FILE)                                          \
    S("`animation`", IRB_CONFIG_ANIMATION_KEYS)                                                    \
    S("An item of `objects`", IRB_CONFIG_OBJECT_SETTINGS)                                          \
    S("An item of `objects: keys`", IRB_CONFIG_OBJECT_KEYFRAME)                                    \
    S("An item of `regions`", IRB_CONFIG_REGION_KEYS)                                              \
    S("A parameter with keys", IRB_CONFIG_TRACK_KEYS)

/* The names alone, for lists of what is allowed. */
#define IRB_CONFIG_KEY_NAME(name, value, doc) name,

#endif
