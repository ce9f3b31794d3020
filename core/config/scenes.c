/* SPDX-License-Identifier: MIT
 *
 * `scenes:`: what each entry is called, which built-in or file it means, and its script.
 */
#include "core/base/fs.h"
#include "core/base/str.h"
#include "core/config/keys.h"
#include "core/config/parts.h"
#include "core/scene/builtin.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_SCENES = 256 };

bool irb_config_name_is_valid(const char *name)
{
    size_t length = strlen(name);
    if (!length || length > IRB_LONGEST_NAME || *name == '.')
        return false;
    for (const char *c = name; *c; c++)
        if (!isalnum((unsigned char)*c) && !strchr("._-", *c))
            return false;
    return true;
}

char *irb_config_stem(const char *path)
{
    const char *slash = strrchr(path, '/');
    char *stem = irb_strdup(slash ? slash + 1 : path);
    char *dot = strrchr(stem, '.');
    if (dot && dot != stem)
        *dot = 0;
    if (strlen(stem) > IRB_LONGEST_NAME)
        stem[IRB_LONGEST_NAME] = 0;
    for (char *c = stem; *c; c++)
        if (!isalnum((unsigned char)*c) && !strchr("._-", *c))
            *c = '-';
    if (*stem == '.')
        *stem = '-';
    return stem;
}

/* Appends the value of the ${NAME} that `text` begins with; returns what is behind it, or NULL. */
static const char *expand_one(const char *text, struct irb_str *out, const struct irb_yaml *yaml,
                              irb_yaml_node node, struct irb_error *err)
{
    const char *end = strchr(text, '}');
    if (!end || end == text + 2) {
        irb_yaml_fail(yaml, node, err, "scene: expected ${NAME}, found '%.64s'", text);
        return NULL;
    }
    char *name = irb_asprintf("%.*s", (int)(end - text - 2), text + 2);
    const char *value = getenv(name);
    bool set = value && *value;
    if (set)
        irb_str_printf(out, "%s", value);
    else
        irb_yaml_fail(yaml, node, err,
                      "scene: the environment variable %.64s is not set; it should name a folder",
                      name);
    free(name);
    return set ? end + 1 : NULL;
}

/* `text` with ${VARIABLES} expanded, and relative to the config's folder; malloc'ed or NULL. */
static char *expand_path(const char *text, const struct irb_yaml *yaml, irb_yaml_node node,
                         struct irb_error *err)
{
    struct irb_str out = {0};
    while (text && *text) {
        if (text[0] == '$' && text[1] == '{') {
            text = expand_one(text, &out, yaml, node, err);
        } else {
            irb_str_append(&out, text, 1);
            text++;
        }
    }
    if (!text) {
        irb_str_free(&out);
        return NULL;
    }
    const char *slash = strrchr(yaml->path, '/');
    if (*irb_str_text(&out) == '/' || !slash)
        return out.text ? out.text : irb_strdup("");
    char *path = irb_asprintf("%.*s/%s", (int)(slash - yaml->path), yaml->path, irb_str_text(&out));
    irb_str_free(&out);
    return path;
}

/* Neither a path nor a file of that name: a built-in that is misspelt. */
static bool unknown_builtin(const char *text, const struct irb_yaml *yaml, irb_yaml_node node,
                            struct irb_error *err)
{
    enum { MOST = 64 };
    const char *names[MOST] = {0};
    size_t count = 0;
    for (const struct irb_builtin *b = irb_builtins; b->name && count < MOST; b++)
        names[count++] = b->name;
    const char *near = irb_nearest(text, names, count);
    if (near)
        return irb_yaml_fail(yaml, node, err,
                             "scene: there is no built-in scene and no file '%.64s'; did you mean "
                             "'%s'?",
                             text, near);
    struct irb_str list = {0};
    for (size_t i = 0; i < count; i++)
        irb_str_printf(&list, "%s%s", i ? ", " : "", names[i]);
    irb_yaml_fail(yaml, node, err,
                  "scene: there is no built-in scene and no file '%.64s'; built in are %s", text,
                  irb_str_text(&list));
    irb_str_free(&list);
    return false;
}

/* Sets entry->source, and *builtin where it is one (else NULL). */
static bool read_source(struct irb_scene_entry *entry, const struct irb_builtin **builtin,
                        struct irb_yaml *yaml, irb_yaml_node node, struct irb_error *err)
{
    const char *text = irb_yaml_text(yaml, node, "scene", err);
    if (!text)
        return false;
    if (!*text)
        return irb_yaml_fail(yaml, node, err,
                             "scene: expected a built-in's name or a path, found "
                             "nothing");
    *builtin = irb_builtin_find(text);
    if (*builtin) {
        entry->source = irb_strdup(text);
        return true;
    }
    entry->source = expand_path(text, yaml, node, err);
    if (!entry->source)
        return false;
    if (irb_fs_exists(entry->source))
        return true;
    if (!strchr(text, '/') && !strchr(text, '.'))
        return unknown_builtin(text, yaml, node, err);
    return irb_yaml_fail(yaml, node, err, "scene: there is no file '%.400s'", entry->source);
}

static bool read_name(struct irb_config *config, struct irb_scene_entry *entry,
                      struct irb_yaml *yaml, irb_yaml_node node, irb_yaml_node name,
                      struct irb_error *err)
{
    if (name) {
        const char *text = irb_yaml_text(yaml, name, "name", err);
        if (!text)
            return false;
        if (!irb_config_name_is_valid(text))
            return irb_yaml_fail(yaml, name, err,
                                 "name: expected 1 to %d letters, digits, '.', '_' or '-', found "
                                 "'%.64s'",
                                 IRB_LONGEST_NAME, text);
        entry->name = irb_strdup(text);
    } else {
        entry->name = irb_config_stem(entry->source);
    }
    for (int i = 0; i < config->scene_count; i++)
        if (!strcmp(config->scenes[i].name, entry->name))
            return irb_yaml_fail(
                yaml, name ? name : node, err,
                "two scenes are called '%s'; give one of them another name:", entry->name);
    return true;
}

/* `node` holds the keys of a scene but its name; `name` may be NULL. */
static bool read_entry(struct irb_config *config, struct irb_yaml *yaml, irb_yaml_node node,
                       irb_yaml_node name, struct irb_error *err)
{
    struct irb_scene_entry *entry = &config->scenes[config->scene_count];
    irb_yaml_node source = irb_yaml_find(yaml, node, "scene");
    if (!source)
        return irb_yaml_fail(yaml, node, err,
                             "scene: missing; expected a built-in's name or a path");
    const struct irb_builtin *builtin = NULL;
    bool ok = read_source(entry, &builtin, yaml, source, err) &&
              read_name(config, entry, yaml, node, name, err);
    config->scene_count++; /* from here on the config frees it */
    if (!ok)
        return false;
    if (builtin)
        builtin->view(&entry->animation);
    return irb_config_read_script(entry, yaml, node, builtin != NULL, err) &&
           irb_config_read_poses(entry, yaml, node, builtin && !builtin->animated, err) &&
           irb_config_read_regions(entry, yaml, node, err) &&
           irb_config_read_profile(entry, yaml, node, err);
}

static bool read_list(struct irb_config *config, struct irb_yaml *yaml, irb_yaml_node list,
                      struct irb_error *err)
{
    static const char *const keys[] = {IRB_CONFIG_SCENE_KEYS(IRB_CONFIG_KEY_NAME) NULL};
    for (int i = 0; i < irb_yaml_count(list); i++) {
        irb_yaml_node node = irb_yaml_item(yaml, list, i);
        if (!irb_yaml_check_map(yaml, node, "scene", keys, err) ||
            !read_entry(config, yaml, node, irb_yaml_find(yaml, node, "name"), err))
            return false;
    }
    return true;
}

bool irb_config_read_scenes(struct irb_config *config, struct irb_yaml *yaml, struct irb_error *err)
{
    static const char *const single_keys[] = {"scene",   "camera",  "light",  "animation",
                                              "objects", "regions", "profile"};
    irb_yaml_node root = irb_yaml_root(yaml);
    irb_yaml_node list = irb_yaml_find(yaml, root, "scenes");
    if (!list && !irb_yaml_find(yaml, root, "scene"))
        return irb_yaml_fail(yaml, root, err,
                             "scenes: missing; expected a list of scenes, or one scene:");
    for (size_t i = 0; list && i < sizeof single_keys / sizeof *single_keys; i++) {
        irb_yaml_node other = irb_yaml_find(yaml, root, single_keys[i]);
        if (other)
            return irb_yaml_fail(yaml, other, err,
                                 "%s: expected inside the entries of scenes:, found beside it",
                                 single_keys[i]);
    }
    int count = list ? irb_yaml_count(list) : 1;
    if (!count)
        return irb_yaml_fail(yaml, list, err, "scenes: expected a list of scenes, found %s",
                             list->type == YAML_SEQUENCE_NODE ? "an empty one"
                                                              : irb_yaml_kind(list));
    if (count > MOST_SCENES)
        return irb_yaml_fail(yaml, list, err, "scenes: expected at most %d, found %d", MOST_SCENES,
                             count);
    config->scenes = calloc((size_t)count, sizeof *config->scenes);
    if (!config->scenes)
        return irb_fail(err, IRB_E_MEMORY, "%s: out of memory", yaml->path);
    return list ? read_list(config, yaml, list, err) : read_entry(config, yaml, root, NULL, err);
}
