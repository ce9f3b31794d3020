/* SPDX-License-Identifier: MIT
 *
 * `camera:` and `light:` of a scene: settings and keyframes. A key that leaves something out takes
 * it from the key before it; the first key takes it from the built-in scene's own view.
 */
#include "core/base/str.h"
#include "core/config/keys.h"
#include "core/config/parts.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_KEYS = 4096 };

static const float default_up[3] = {0, 1, 0};
static const float default_fov = 45;  /* degrees, vertical */
static const float default_cone = 45; /* degrees, half-angle */

#define SETTINGS_OF_CAMERA IRB_CONFIG_CAMERA_SETTINGS(IRB_CONFIG_KEY_NAME)
#define KEY_OF_CAMERA IRB_CONFIG_CAMERA_KEY(IRB_CONFIG_KEY_NAME)
#define SETTINGS_OF_LIGHT IRB_CONFIG_LIGHT_SETTINGS(IRB_CONFIG_KEY_NAME)
#define KEY_OF_LIGHT IRB_CONFIG_LIGHT_KEY(IRB_CONFIG_KEY_NAME)
#define TIME_OF_KEY IRB_CONFIG_KEY_TIME(IRB_CONFIG_KEY_NAME)

/* The section that is being read, and what its two kinds of keys have in common. */
struct section {
    struct irb_yaml *yaml;
    struct irb_animation *animation;
    const char *name;                 /* "camera", "light" */
    const char *const *key_names;     /* allowed in an item of keys: */
    const char *const *section_names; /* allowed in the section where keys: is given */
    const char *const *single_names;  /* where its only key stands in the section itself */
    const char *const *required;      /* of the first key, unless there is a built-in view */
    size_t key_size;
    bool (*read_key)(struct section *, irb_yaml_node, void *key, struct irb_error *);
    bool (*validate_key)(const struct section *, const void *key, struct irb_error *);
};

/* ---- values ---- */

static bool read_vector(struct section *s, irb_yaml_node map, const char *name, float out[3],
                        struct irb_error *err)
{
    irb_yaml_node node = irb_yaml_find(s->yaml, map, name);
    return !node || irb_yaml_floats(s->yaml, node, name, out, 3, err);
}

static bool read_number(struct section *s, irb_yaml_node map, const char *name, double min,
                        double max, float *out, struct irb_error *err)
{
    irb_yaml_node node = irb_yaml_find(s->yaml, map, name);
    return !node || irb_yaml_float(s->yaml, node, name, min, max, out, err);
}

static bool read_choice(struct section *s, irb_yaml_node map, const char *name,
                        const char *const *choices, int *out, struct irb_error *err)
{
    irb_yaml_node node = irb_yaml_find(s->yaml, map, name);
    if (!node)
        return true;
    const char *text = irb_yaml_text(s->yaml, node, name, err);
    if (!text)
        return false;
    struct irb_str list = {0};
    for (int i = 0; choices[i]; i++) {
        if (!strcmp(choices[i], text)) {
            *out = i;
            irb_str_free(&list);
            return true;
        }
        irb_str_printf(&list, "%s%s", i ? ", " : "", choices[i]);
    }
    irb_yaml_fail(s->yaml, node, err, "%s: expected one of %s; found '%.64s'", name,
                  irb_str_text(&list), text);
    irb_str_free(&list);
    return false;
}

/* An angle strictly between two bounds, degrees. */
static bool read_angle(struct section *s, irb_yaml_node map, const char *name, double above,
                       double below, float *out, struct irb_error *err)
{
    irb_yaml_node node = irb_yaml_find(s->yaml, map, name);
    if (!node)
        return true;
    if (!irb_yaml_float(s->yaml, node, name, -FLT_MAX, FLT_MAX, out, err))
        return false;
    if (*out > above && *out < below)
        return true;
    return irb_yaml_fail(s->yaml, node, err, "%s: expected degrees between %g and %g, found %g",
                         name, above, below, (double)*out);
}

/* Three channels, or one number for all of them; not negative. */
static bool read_intensity(struct section *s, irb_yaml_node map, float out[3],
                           struct irb_error *err)
{
    irb_yaml_node node = irb_yaml_find(s->yaml, map, "intensity");
    if (!node)
        return true;
    if (node->type == YAML_SCALAR_NODE) {
        if (!irb_yaml_float(s->yaml, node, "intensity", 0, FLT_MAX, out, err))
            return false;
        out[1] = out[2] = out[0];
        return true;
    }
    if (!irb_yaml_floats(s->yaml, node, "intensity", out, 3, err))
        return false;
    for (int i = 0; i < 3; i++)
        if (out[i] < 0)
            return irb_yaml_fail(s->yaml, irb_yaml_item(s->yaml, node, i), err,
                                 "intensity: expected no negative number, found %g",
                                 (double)out[i]);
    return true;
}

/* ---- keys ---- */

static bool read_camera_key(struct section *s, irb_yaml_node node, void *out, struct irb_error *err)
{
    struct irb_camera_key *key = out;
    return read_vector(s, node, "position", key->position, err) &&
           read_vector(s, node, "target", key->target, err) &&
           read_vector(s, node, "up", key->up, err) &&
           read_angle(s, node, "fov", 0, 180, &key->fov, err);
}

static bool read_light_key(struct section *s, irb_yaml_node node, void *out, struct irb_error *err)
{
    struct irb_light_key *key = out;
    if (!read_vector(s, node, "position", key->position, err) ||
        !read_vector(s, node, "target", key->target, err) ||
        !read_intensity(s, node, key->intensity, err) ||
        !read_angle(s, node, "cone", 0, 90, &key->cone, err) ||
        !read_number(s, node, "inner", 0, 90, &key->inner, err))
        return false;
    if (key->inner < key->cone)
        return true;
    irb_yaml_node inner = irb_yaml_find(s->yaml, node, "inner");
    return irb_yaml_fail(s->yaml, inner ? inner : node, err,
                         "inner: expected degrees below the cone's %g, found %g", (double)key->cone,
                         (double)key->inner);
}

/* What only the whole key shows (target at the position, up along the view) is checked with an
 * animation of this key alone, so that the message can name its line. */
static bool validate_camera_key(const struct section *s, const void *key, struct irb_error *err)
{
    struct irb_light_key light = {
        .target = {0, -1, 0}, .intensity = {1, 1, 1}, .cone = default_cone};
    struct irb_camera_key camera = *(const struct irb_camera_key *)key;
    struct irb_animation alone = *s->animation;
    alone.camera_keys = &camera;
    alone.light_keys = &light;
    alone.camera_key_count = alone.light_key_count = 1;
    return irb_animation_validate(&alone, err);
}

static bool validate_light_key(const struct section *s, const void *key, struct irb_error *err)
{
    struct irb_camera_key camera = {.target = {0, 0, -1}, .up = {0, 1, 0}, .fov = default_fov};
    struct irb_light_key light = *(const struct irb_light_key *)key;
    struct irb_animation alone = *s->animation;
    alone.z_near = alone.z_far = 0;
    alone.camera_keys = &camera;
    alone.light_keys = &light;
    alone.camera_key_count = alone.light_key_count = 1;
    return irb_animation_validate(&alone, err);
}

static bool check_required(const struct section *s, irb_yaml_node node, struct irb_error *err)
{
    for (int i = 0; s->required[i]; i++)
        if (!irb_yaml_find(s->yaml, node, s->required[i]))
            return irb_yaml_fail(
                s->yaml, node, err,
                "%s: %s: missing; expected all of it, or the name: of one that the "
                "glTF file brings",
                s->name, s->required[i]);
    return true;
}

/* The key's time, which must rise. Both kinds of key begin with it. */
static bool read_frame(struct section *s, irb_yaml_node node, bool first, float *frame,
                       struct irb_error *err)
{
    irb_yaml_node time = irb_yaml_find(s->yaml, node, "frame");
    float before = *frame;
    if (!time)
        return irb_yaml_fail(s->yaml, node, err, "%s: frame: missing in a list of keys", s->name);
    if (!irb_yaml_float(s->yaml, time, "frame", 0, 1e6, frame, err))
        return false;
    if (!first && !(*frame > before))
        return irb_yaml_fail(s->yaml, time, err,
                             "frame: expected above %g, the key before it, found %g",
                             (double)before, (double)*frame);
    return true;
}

_Static_assert(offsetof(struct irb_light_key, frame) == 0 &&
                   offsetof(struct irb_camera_key, frame) == 0,
               "read_frame() writes the first field of either key");

/* Reads `list`, or the one key that `node` itself is. *key_count keys, malloc'ed; NULL on failure.
 * `first` holds what the first key may leave out. */
static void *read_keys(struct section *s, irb_yaml_node node, irb_yaml_node list, bool builtin,
                       const void *first, int *key_count, struct irb_error *err)
{
    int count = list ? irb_yaml_count(list) : 1;
    if (!count || count > MOST_KEYS) {
        irb_yaml_fail(s->yaml, list, err, "keys: expected a list of 1 to %d keys, found %s",
                      MOST_KEYS,
                      count                              ? "more"
                      : list->type == YAML_SEQUENCE_NODE ? "none"
                                                         : irb_yaml_kind(list));
        return NULL;
    }
    char *keys = calloc((size_t)count, s->key_size);
    bool ok = keys || irb_fail(err, IRB_E_MEMORY, "%s: out of memory", s->yaml->path);
    for (int i = 0; ok && i < count; i++) {
        irb_yaml_node item = list ? irb_yaml_item(s->yaml, list, i) : node;
        char *key = keys + (size_t)i * s->key_size;
        memcpy(key, i ? key - s->key_size : (const char *)first, s->key_size);
        ok = (!list || irb_yaml_check_map(s->yaml, item, s->name, s->key_names, err)) &&
             (i || builtin || check_required(s, item, err)) &&
             (!list || read_frame(s, item, i == 0, (float *)(void *)key, err)) &&
             s->read_key(s, item, key, err) &&
             (s->validate_key(s, key, err) || irb_yaml_prefix(s->yaml, item, err));
    }
    if (!ok) {
        free(keys);
        return NULL;
    }
    *key_count = count;
    return keys;
}

/* Checks the section's own keys; *list is its keys:, or NULL where its one key stands in it. */
static bool open_section(const struct section *s, irb_yaml_node node, irb_yaml_node *list,
                         struct irb_error *err)
{
    *list = NULL;
    if (!node || node->type != YAML_MAPPING_NODE)
        return irb_yaml_fail(s->yaml, node, err, "%s: expected a map of keys, found %s", s->name,
                             irb_yaml_kind(node));
    *list = irb_yaml_find(s->yaml, node, "keys");
    for (int i = 0; *list && s->key_names[i]; i++) {
        irb_yaml_node stray = irb_yaml_find(s->yaml, node, s->key_names[i]);
        if (stray)
            return irb_yaml_fail(s->yaml, stray, err,
                                 "%s: %s: expected inside the items of keys:, found beside it",
                                 s->name, s->key_names[i]);
    }
    return irb_yaml_check_map(s->yaml, node, s->name, *list ? s->section_names : s->single_names,
                              err);
}

/* ---- sections ---- */

static bool read_camera(struct irb_animation *animation, struct irb_yaml *yaml, irb_yaml_node node,
                        bool builtin, struct irb_error *err)
{
    static const char *const key_names[] = {TIME_OF_KEY KEY_OF_CAMERA NULL};
    static const char *const section_names[] = {SETTINGS_OF_CAMERA NULL};
    static const char *const single_names[] = {SETTINGS_OF_CAMERA KEY_OF_CAMERA NULL};
    static const char *const required[] = {"position", "target", NULL};
    struct section s = {yaml,
                        animation,
                        "camera",
                        key_names,
                        section_names,
                        single_names,
                        required,
                        sizeof(struct irb_camera_key),
                        read_camera_key,
                        validate_camera_key};
    irb_yaml_node list;
    int interpolation = (int)animation->camera_interpolation;
    if (!open_section(&s, node, &list, err) ||
        !read_choice(&s, node, "interpolation", irb_interpolation_names, &interpolation, err) ||
        !read_number(&s, node, "near", 0, FLT_MAX, &animation->z_near, err) ||
        !read_number(&s, node, "far", 0, FLT_MAX, &animation->z_far, err))
        return false;
    animation->camera_interpolation = (enum irb_interpolation)interpolation;
    struct irb_camera_key first = {.fov = default_fov};
    memcpy(first.up, default_up, sizeof first.up);
    if (animation->camera_key_count)
        first = animation->camera_keys[0];
    first.frame = 0;
    int count = 0;
    void *keys = read_keys(&s, node, list, builtin, &first, &count, err);
    if (!keys)
        return false;
    free(animation->camera_keys);
    animation->camera_keys = keys;
    animation->camera_key_count = count;
    return true;
}

static bool read_light_settings(struct section *s, irb_yaml_node node, struct irb_error *err)
{
    struct irb_animation *a = s->animation;
    int type = (int)a->light_type, falloff = (int)a->falloff;
    int interpolation = (int)a->light_interpolation;
    if (!read_choice(s, node, "type", irb_light_type_names, &type, err) ||
        !read_choice(s, node, "falloff", irb_falloff_names, &falloff, err) ||
        !read_choice(s, node, "interpolation", irb_interpolation_names, &interpolation, err) ||
        !read_number(s, node, "beam_half_width", 0, FLT_MAX, &a->beam_half_width, err))
        return false;
    a->light_type = (enum irb_light_type)type;
    a->falloff = (enum irb_falloff)falloff;
    a->light_interpolation = (enum irb_interpolation)interpolation;
    return true;
}

static bool read_light(struct irb_animation *animation, struct irb_yaml *yaml, irb_yaml_node node,
                       bool builtin, struct irb_error *err)
{
    static const char *const key_names[] = {TIME_OF_KEY KEY_OF_LIGHT NULL};
    static const char *const section_names[] = {SETTINGS_OF_LIGHT NULL};
    static const char *const single_names[] = {SETTINGS_OF_LIGHT KEY_OF_LIGHT NULL};
    static const char *const required[] = {"position", "target", "intensity", NULL};
    struct section s = {yaml,           animation,         "light",  key_names,
                        section_names,  single_names,      required, sizeof(struct irb_light_key),
                        read_light_key, validate_light_key};
    irb_yaml_node list;
    if (!open_section(&s, node, &list, err) || !read_light_settings(&s, node, err))
        return false;
    struct irb_light_key first = {.cone = default_cone};
    if (animation->light_key_count)
        first = animation->light_keys[0];
    first.frame = 0;
    int count = 0;
    void *keys = read_keys(&s, node, list, builtin, &first, &count, err);
    if (!keys)
        return false;
    free(animation->light_keys);
    animation->light_keys = keys;
    animation->light_key_count = count;
    return true;
}

/* ---- the file's own ---- */

static bool read_file_name(struct irb_yaml *yaml, irb_yaml_node node, const char *const *allowed,
                           const char *section, char **name, struct irb_error *err)
{
    irb_yaml_node text_node = irb_yaml_find(yaml, node, "name");
    const char *text = text_node ? irb_yaml_text(yaml, text_node, "name", err) : NULL;
    if (!text || !irb_yaml_check_map(yaml, node, section, allowed, err))
        return false;
    *name = irb_strdup(text);
    return true;
}

/* Whether the section picks one of the file's, which sets it aside from keyframes. */
static bool names_one(struct irb_yaml *yaml, irb_yaml_node node)
{
    return node && node->type == YAML_MAPPING_NODE && irb_yaml_find(yaml, node, "name");
}

static bool no_names(struct irb_yaml *yaml, irb_yaml_node node, const char *section,
                     struct irb_error *err)
{
    return irb_yaml_fail(yaml, irb_yaml_find(yaml, node, "name"), err,
                         "%s: name: expected for a glTF file alone; a built-in scene has no named "
                         "ones",
                         section);
}

static bool read_camera_of_file(struct irb_scene_entry *entry, struct irb_yaml *yaml,
                                irb_yaml_node node, struct irb_error *err)
{
    static const char *const allowed[] = {IRB_CONFIG_CAMERA_OF_FILE(IRB_CONFIG_KEY_NAME) "near",
                                          "far", NULL};
    struct section s = {.yaml = yaml, .animation = &entry->animation, .name = "camera"};
    struct irb_animation *a = &entry->animation;
    if (!read_file_name(yaml, node, allowed, "camera", &entry->camera_name, err) ||
        !read_number(&s, node, "near", 0, FLT_MAX, &a->z_near, err) ||
        !read_number(&s, node, "far", 0, FLT_MAX, &a->z_far, err))
        return false;
    return !(a->z_near > 0 && a->z_far > 0 && a->z_near >= a->z_far) ||
           irb_yaml_fail(yaml, node, err, "camera: near must be below far, found %g and %g",
                         (double)a->z_near, (double)a->z_far);
}

static bool read_light_of_file(struct irb_scene_entry *entry, struct irb_yaml *yaml,
                               irb_yaml_node node, struct irb_error *err)
{
    static const char *const allowed[] = {
        IRB_CONFIG_LIGHT_OF_FILE(IRB_CONFIG_KEY_NAME) "beam_half_width", NULL};
    struct section s = {.yaml = yaml, .animation = &entry->animation, .name = "light"};
    return read_file_name(yaml, node, allowed, "light", &entry->light_name, err) &&
           read_number(&s, node, "beam_half_width", 0, FLT_MAX, &entry->animation.beam_half_width,
                       err);
}

bool irb_config_read_script(struct irb_scene_entry *entry, struct irb_yaml *yaml,
                            irb_yaml_node scene, bool builtin, struct irb_error *err)
{
    struct irb_animation *animation = &entry->animation;
    irb_yaml_node camera = irb_yaml_find(yaml, scene, "camera");
    irb_yaml_node light = irb_yaml_find(yaml, scene, "light");
    entry->camera_place = irb_yaml_place(yaml, camera ? camera : scene);
    entry->light_place = irb_yaml_place(yaml, light ? light : scene);
    if (names_one(yaml, camera)) {
        if (builtin ? !no_names(yaml, camera, "camera", err)
                    : !read_camera_of_file(entry, yaml, camera, err))
            return false;
    } else if (camera && !read_camera(animation, yaml, camera, builtin, err)) {
        return false;
    }
    if (names_one(yaml, light)) {
        if (builtin ? !no_names(yaml, light, "light", err)
                    : !read_light_of_file(entry, yaml, light, err))
            return false;
    } else if (light && !read_light(animation, yaml, light, builtin, err)) {
        return false;
    }
    /* what comes from the file is checked when that is loaded */
    return !animation->camera_key_count || !animation->light_key_count ||
           irb_animation_validate(animation, err) || irb_yaml_prefix(yaml, scene, err);
}
