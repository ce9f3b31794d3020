/* SPDX-License-Identifier: MIT
 *
 * The config file as a whole: the scalar settings at its top, its sections, the overrides of the
 * command line, and the key of all of it.
 */
#include "core/base/str.h"
#include "core/config/keys.h"
#include "core/config/parts.h"
#include "core/frame/layout.h"

#include <stdlib.h>
#include <string.h>

const struct irb_option irb_render_options[] = {
    IRB_OPTION_INT(struct irb_render_settings, width, 512, 1, 8192, "pixels",
                   "width of the images; see resolution", "ours"),
    IRB_OPTION_INT(struct irb_render_settings, height, 384, 1, 8192, "pixels",
                   "height of the images; see resolution", "ours"),
    IRB_OPTION_INT(struct irb_render_settings, frames, 8, 1, 100000, "", "scored frames", "ours"),
    IRB_OPTION_INT(struct irb_render_settings, settle, 16, 0, 10000, "",
                   "unscored frames at the first pose, for methods that keep a history", "ours"),
    IRB_OPTION_INT(struct irb_render_settings, rsm_resolution, 512, 1, IRB_MOST_RSM_RESOLUTION,
                   "texels", "side of the reflective shadow map", "ACRSM thesis, 5.1.1"),
    IRB_OPTION_ENUM(struct irb_render_settings, gbuffer_layout, IRB_LAYOUT_FULL, irb_layout_names,
                    "G-buffer that methods are given: 32-bit floats, or the thesis's 16 bytes a "
                    "pixel; the reference and the direct light keep the full one",
                    "ACRSM thesis, table 5.1a"),
    IRB_OPTION_ENUM(struct irb_render_settings, rsm_layout, IRB_LAYOUT_FULL, irb_layout_names,
                    "RSM that methods are given: 32-bit floats, or the thesis's 16 bytes a texel",
                    "ACRSM thesis, table 5.1b"),
    IRB_OPTION_FLOAT(struct irb_render_settings, exposure, 0, 0, 1e9, "",
                     "factor on radiance before previews are tone-mapped; 0 = from the reference",
                     "ours"),
    IRB_OPTION_END,
};

const struct irb_option irb_output_options[] = {
    IRB_OPTION_BOOL(struct irb_output_settings, debug_layers, 0,
                    "keep what methods show of their insides (cluster maps, shadow maps, ...) with "
                    "each kept frame that is rendered from now on",
                    "ours"),
    IRB_OPTION_BOOL(struct irb_output_settings, film, 1,
                    "keep small pictures (JPEG) of every frame that is scored from now on, of each "
                    "trial's first seed: result, reference, HDR-FLIP, temporal residual",
                    "ours"),
    IRB_OPTION_END,
};

/* Keys of the file's top that are no render option. */
static const char *const top_keys[] = {IRB_CONFIG_TOP_KEYS(IRB_CONFIG_KEY_NAME)};
enum { TOP_KEYS = sizeof top_keys / sizeof *top_keys };

/* ---- single settings, from the file and from --set alike ---- */

static bool set_name(struct irb_config *config, const char *text, struct irb_error *err)
{
    if (!irb_config_name_is_valid(text))
        return irb_fail(err, IRB_E_INPUT,
                        "name: expected 1 to %d letters, digits, '.', '_' or '-', found '%.64s'",
                        IRB_LONGEST_NAME, text);
    free(config->name);
    config->name = irb_strdup(text);
    return true;
}

static bool set_top(struct irb_config *config, const char *key, const char *text,
                    struct irb_error *err)
{
    if (!strcmp(key, "seed"))
        return irb_config_set_seed(config, text, err);
    if (!strcmp(key, "seeds"))
        return irb_config_set_seeds(config, text, err);
    if (!strcmp(key, "repeats"))
        return irb_config_set_repeats(config, text, err);
    if (!strcmp(key, "name"))
        return set_name(config, text, err);
    if (irb_option_find(irb_output_options, key))
        return irb_option_set(irb_output_options, &config->output, key, text, err);
    return irb_option_set(irb_render_options, &config->render, key, text, err);
}

static bool set_resolution(struct irb_config *config, const char *width, const char *height,
                           struct irb_error *err)
{
    return (irb_option_set(irb_render_options, &config->render, "width", width, err) &&
            irb_option_set(irb_render_options, &config->render, "height", height, err)) ||
           irb_error_prefix(err, "resolution");
}

/* ---- the file ---- */

static bool check_top(struct irb_yaml *yaml, irb_yaml_node root, struct irb_error *err)
{
    enum { MOST = 64 };
    const char *allowed[MOST + 1] = {0};
    int count = 0;
    for (; count < TOP_KEYS; count++)
        allowed[count] = top_keys[count];
    for (const struct irb_option *o = irb_render_options; o->name && count < MOST; o++)
        allowed[count++] = o->name;
    for (const struct irb_option *o = irb_output_options; o->name && count < MOST; o++)
        allowed[count++] = o->name;
    return irb_yaml_check_map(yaml, root, "config", allowed, err);
}

static bool read_resolution(struct irb_config *config, struct irb_yaml *yaml, irb_yaml_node list,
                            struct irb_error *err)
{
    if (irb_yaml_count(list) != 2)
        return irb_yaml_fail(yaml, list, err, "resolution: expected [width, height], found %s",
                             list->type != YAML_SEQUENCE_NODE ? irb_yaml_kind(list)
                             : irb_yaml_count(list) < 2       ? "too few numbers"
                                                              : "too many numbers");
    const char *text[2];
    for (int i = 0; i < 2; i++) {
        text[i] = irb_yaml_text(yaml, irb_yaml_item(yaml, list, i), "resolution", err);
        if (!text[i])
            return false;
    }
    return set_resolution(config, text[0], text[1], err) || irb_yaml_prefix(yaml, list, err);
}

static bool read_reference(struct irb_config *config, struct irb_yaml *yaml, irb_yaml_node map,
                           struct irb_error *err)
{
    if (!irb_yaml_check_map(yaml, map, "reference", NULL, err))
        return false;
    for (int i = 0; i < irb_yaml_pairs(map); i++) {
        irb_yaml_node key = irb_yaml_key(yaml, map, i), value = irb_yaml_value(yaml, map, i);
        const char *name = (const char *)key->data.scalar.value;
        bool known = irb_option_find(irb_reference_options, name) != NULL;
        const char *text = known ? irb_yaml_text(yaml, value, name, err) : "";
        if (!text)
            return false;
        if (!irb_option_set(irb_reference_options, &config->reference, name, text, err)) {
            irb_error_prefix(err, "reference");
            return irb_yaml_prefix(yaml, known ? value : key, err);
        }
    }
    return true;
}

/* The settings of the file's top; sections that have files of their own are passed over. */
static bool read_settings(struct irb_config *config, struct irb_yaml *yaml, irb_yaml_node root,
                          struct irb_error *err)
{
    static const char *const elsewhere[] = {"scenes",  "scene",   "camera",  "light", "animation",
                                            "objects", "regions", "profile", "trials"};
    irb_yaml_node resolution = irb_yaml_find(yaml, root, "resolution");
    for (int i = 0; i < irb_yaml_pairs(root); i++) {
        irb_yaml_node value = irb_yaml_value(yaml, root, i);
        const char *key = (const char *)irb_yaml_key(yaml, root, i)->data.scalar.value;
        bool passed = false;
        for (size_t j = 0; j < sizeof elsewhere / sizeof *elsewhere; j++)
            passed = passed || !strcmp(key, elsewhere[j]);
        if (passed)
            continue;
        if (resolution && (!strcmp(key, "width") || !strcmp(key, "height")))
            return irb_yaml_fail(yaml, value, err, "%s: expected resolution: alone, found both",
                                 key);
        bool ok;
        if (!strcmp(key, "resolution")) {
            ok = read_resolution(config, yaml, value, err);
        } else if (!strcmp(key, "seeds")) {
            ok = irb_config_read_seeds(config, yaml, value, err);
        } else if (!strcmp(key, "reference")) {
            ok = read_reference(config, yaml, value, err);
        } else {
            const char *text = irb_yaml_text(yaml, value, key, err);
            ok = text && (set_top(config, key, text, err) || irb_yaml_prefix(yaml, value, err));
        }
        if (!ok)
            return false;
    }
    return true;
}

/* ---- --set ---- */

static bool override_resolution(struct irb_config *config, const char *value, struct irb_error *err)
{
    size_t length = strspn(value, "0123456789");
    if (!length || !value[length] || !strchr("x,", value[length]))
        return irb_fail(err, IRB_E_INPUT, "resolution: expected WIDTHxHEIGHT, found '%.64s'",
                        value);
    char *width = irb_asprintf("%.*s", (int)length, value);
    bool ok = set_resolution(config, width, value + length + 1, err);
    free(width);
    return ok;
}

static bool override_one(struct irb_config *config, const char *key, const char *value,
                         struct irb_error *err)
{
    static const char reference[] = "reference.";
    static const char *const fixed[] = {"scenes",  "scene",   "camera",  "light",  "animation",
                                        "objects", "regions", "profile", "trials", "reference"};
    if (!strncmp(key, reference, sizeof reference - 1))
        return irb_option_set(irb_reference_options, &config->reference, key + sizeof reference - 1,
                              value, err) ||
               irb_error_prefix(err, "reference");
    for (size_t i = 0; i < sizeof fixed / sizeof *fixed; i++) {
        size_t length = strlen(fixed[i]);
        if (!strncmp(key, fixed[i], length) && (!key[length] || key[length] == '.'))
            return irb_fail(err, IRB_E_INPUT,
                            "%s can't be set from the command line; only single values can, such "
                            "as frames or reference.noise",
                            fixed[i]);
    }
    if (!strcmp(key, "resolution"))
        return override_resolution(config, value, err);
    return set_top(config, key, value, err);
}

static bool apply_overrides(struct irb_config *config, const char *const *overrides,
                            struct irb_error *err)
{
    for (; overrides && *overrides; overrides++) {
        const char *equals = strchr(*overrides, '=');
        bool ok;
        if (equals) {
            char *key = irb_asprintf("%.*s", (int)(equals - *overrides), *overrides);
            ok = override_one(config, key, equals + 1, err);
            free(key);
        } else {
            ok = irb_fail(err, IRB_E_INPUT, "expected key=value");
        }
        if (!ok)
            return irb_error_prefix(err, "--set %.200s", *overrides);
    }
    return true;
}

/* ---- the whole ---- */

static bool read_all(struct irb_config *config, struct irb_yaml *yaml,
                     const struct irb_registry *registry, struct irb_error *err)
{
    irb_yaml_node root = irb_yaml_root(yaml);
    if (!root)
        return irb_fail(err, IRB_E_INPUT,
                        "%s:1:1: expected scenes: and trials:, found an empty "
                        "file",
                        yaml->path);
    return check_top(yaml, root, err) && read_settings(config, yaml, root, err) &&
           irb_config_read_scenes(config, yaml, err) &&
           irb_config_read_trials(config, yaml, registry, err);
}

/* Between settings that are each in range. */
static bool check_together(const struct irb_config *config, struct irb_error *err)
{
    const struct irb_reference_settings *reference = &config->reference;
    if (reference->min_samples > reference->max_samples)
        return irb_fail(err, IRB_E_INPUT,
                        "%s: reference: expected min_samples to be at most max_samples, found %d "
                        "and %d",
                        config->path, reference->min_samples, reference->max_samples);
    if ((long long)config->trial_count * config->seed_count > IRB_MOST_TRIALS)
        return irb_fail(err, IRB_E_INPUT,
                        "%s: expected at most %d trials, each seed counted, found %d with %d seeds",
                        config->path, IRB_MOST_TRIALS, config->trial_count, config->seed_count);
    return irb_config_check_trials(config, err) && irb_config_check_regions(config, err) &&
           irb_config_check_profiles(config, err);
}

bool irb_config_load(struct irb_config *config, const char *path, const char *const *overrides,
                     const struct irb_registry *registry, struct irb_error *err)
{
    *config = (struct irb_config){0};
    irb_config_usual_seeds(config);
    struct irb_yaml yaml;
    if (!irb_yaml_load(&yaml, path, err))
        return false;
    config->path = irb_strdup(path);
    config->name = irb_config_stem(path);
    irb_options_default(irb_render_options, &config->render);
    irb_options_default(irb_output_options, &config->output);
    irb_options_default(irb_reference_options, &config->reference);
    bool ok = read_all(config, &yaml, registry, err) && apply_overrides(config, overrides, err) &&
              check_together(config, err);
    irb_yaml_destroy(&yaml);
    if (!ok)
        irb_config_destroy(config);
    return ok;
}

void irb_config_destroy(struct irb_config *config)
{
    for (int i = 0; i < config->scene_count; i++) {
        free(config->scenes[i].name);
        free(config->scenes[i].source);
        free(config->scenes[i].light_name);
        free(config->scenes[i].light_place);
        free(config->scenes[i].camera_name);
        free(config->scenes[i].camera_place);
        free(config->scenes[i].profile_place);
        irb_animation_destroy(&config->scenes[i].animation);
        irb_poses_destroy(&config->scenes[i].poses);
        irb_config_destroy_regions(&config->scenes[i]);
    }
    for (int i = 0; i < config->trial_count; i++)
        irb_trial_destroy(&config->trials[i]);
    free(config->scenes);
    free(config->trials);
    free(config->path);
    free(config->name);
    *config = (struct irb_config){0};
}

static void hash_animation(const struct irb_animation *a, struct irb_hash *hash)
{
    irb_hash_string(hash, irb_interpolation_names[a->light_interpolation]);
    irb_hash_string(hash, irb_interpolation_names[a->camera_interpolation]);
    irb_hash_string(hash, irb_light_type_names[a->light_type]);
    irb_hash_string(hash, irb_falloff_names[a->falloff]);
    irb_hash_floats(hash, (const float[]){a->beam_half_width, a->z_near, a->z_far}, 3);
    /* field by field: keys may have padding, and the hash must not depend on it */
    irb_hash_u64(hash, (uint64_t)a->light_key_count);
    for (int i = 0; i < a->light_key_count; i++) {
        const struct irb_light_key *k = &a->light_keys[i];
        irb_hash_floats(hash, &k->frame, 1);
        irb_hash_floats(hash, k->position, 3);
        irb_hash_floats(hash, k->target, 3);
        irb_hash_floats(hash, k->intensity, 3);
        irb_hash_floats(hash, (const float[]){k->cone, k->inner}, 2);
    }
    irb_hash_u64(hash, (uint64_t)a->camera_key_count);
    for (int i = 0; i < a->camera_key_count; i++) {
        const struct irb_camera_key *k = &a->camera_keys[i];
        irb_hash_floats(hash, &k->frame, 1);
        irb_hash_floats(hash, k->position, 3);
        irb_hash_floats(hash, k->target, 3);
        irb_hash_floats(hash, k->up, 3);
        irb_hash_floats(hash, &k->fov, 1);
    }
}

struct irb_key irb_config_key(const struct irb_config *config)
{
    struct irb_hash *hash = irb_hash_create();
    irb_options_hash(irb_render_options, &config->render, hash);
    irb_options_hash(irb_reference_options, &config->reference, hash);
    irb_hash_u64(hash, (uint64_t)config->seeds[0]);
    irb_hash_u64(hash, (uint64_t)config->scene_count);
    for (int i = 0; i < config->scene_count; i++) {
        const struct irb_scene_entry *scene = &config->scenes[i];
        /* the folder of a file may differ from one machine to the next */
        const char *slash = strrchr(scene->source, '/');
        irb_hash_string(hash, scene->name);
        irb_hash_string(hash, slash ? slash + 1 : scene->source);
        hash_animation(&scene->animation, hash);
        if (scene->light_name || scene->camera_name) {
            irb_hash_string(hash, scene->light_name ? scene->light_name : "");
            irb_hash_string(hash, scene->camera_name ? scene->camera_name : "");
        }
        irb_config_hash_poses(&scene->poses, hash);
        irb_config_hash_regions(scene, hash);
    }
    irb_hash_u64(hash, (uint64_t)config->trial_count);
    for (int i = 0; i < config->trial_count; i++) {
        irb_hash_string(hash, config->trials[i].method->name);
        irb_options_hash(config->trials[i].method->params, config->trials[i].params, hash);
        irb_trial_hash_tracks(&config->trials[i], hash);
        irb_trial_hash_core(&config->trials[i], hash);
    }
    irb_config_hash_seeds(config, hash);
    return irb_hash_finish(hash);
}
