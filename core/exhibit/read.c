/* SPDX-License-Identifier: MIT */
#include "core/exhibit/read.h"
#include "core/base/str.h"
#include "core/config/config.h"

#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

const char *const irb_exhibit_plot_names[] = {"none", "bars", "lines", "stacked", NULL};
const char *const irb_claim_kind_names[] = {"exponent", "ratio",   "spread", "largest",
                                            "reaches",  "speedup", NULL};

/* ---- what the readers share ---- */

bool irb_exhibit_text(struct irb_yaml *yaml, irb_yaml_node map, const char *key,
                      const char *otherwise, char **out, struct irb_error *err)
{
    irb_yaml_node node = irb_yaml_find(yaml, map, key);
    const char *text = node ? irb_yaml_text(yaml, node, key, err) : otherwise;
    if (node && !text)
        return false;
    *out = text ? irb_strdup(text) : NULL;
    return true;
}

bool irb_exhibit_number(struct irb_yaml *yaml, irb_yaml_node map, const char *key, double min,
                        double max, double *out, struct irb_error *err)
{
    irb_yaml_node node = irb_yaml_find(yaml, map, key);
    if (!node)
        return true;
    const char *text = irb_yaml_text(yaml, node, key, err);
    if (!text)
        return false;
    char *end;
    double value = strtod(text, &end);
    if (end == text || *end || !(value >= min && value <= max))
        return irb_yaml_fail(yaml, node, err, "%s: expected a number from %g to %g, found '%.64s'",
                             key, min, max, text);
    *out = value;
    return true;
}

bool irb_exhibit_int(struct irb_yaml *yaml, irb_yaml_node map, const char *key, int min, int max,
                     int *out, struct irb_error *err)
{
    double value = *out;
    if (!irb_exhibit_number(yaml, map, key, min, max, &value, err))
        return false;
    if (value != (int)value)
        return irb_yaml_fail(yaml, irb_yaml_find(yaml, map, key), err,
                             "%s: expected a whole number, found %g", key, value);
    *out = (int)value;
    return true;
}

bool irb_exhibit_flag(struct irb_yaml *yaml, irb_yaml_node map, const char *key, bool *out,
                      struct irb_error *err)
{
    irb_yaml_node node = irb_yaml_find(yaml, map, key);
    if (!node)
        return true;
    const char *text = irb_yaml_text(yaml, node, key, err);
    if (!text)
        return false;
    *out = !strcmp(text, "true");
    return *out || !strcmp(text, "false") ||
           irb_yaml_fail(yaml, node, err, "%s: expected true or false, found '%.64s'", key, text);
}

void *irb_exhibit_array(struct irb_yaml *yaml, irb_yaml_node node, const char *what, size_t size,
                        int *count, struct irb_error *err)
{
    *count = node ? irb_yaml_count(node) : 0;
    if (!*count) {
        irb_yaml_fail(yaml, node, err, "%s: expected a list, found %s", what,
                      node && node->type == YAML_SEQUENCE_NODE ? "an empty one"
                                                               : irb_yaml_kind(node));
        return NULL;
    }
    void *list = calloc((size_t)*count, size);
    if (!list)
        irb_fail(err, IRB_E_MEMORY, "%s: out of memory", yaml->path);
    return list;
}

/* ---- the section ---- */

static bool read_id(struct irb_exhibit *e, struct irb_yaml *yaml, irb_yaml_node map,
                    struct irb_error *err)
{
    if (!irb_exhibit_text(yaml, map, "id", NULL, &e->id, err))
        return false;
    if (!e->id)
        return irb_yaml_fail(yaml, map, err, "exhibit: id: missing; expected a name");
    bool valid = *e->id && *e->id != '.' && strlen(e->id) <= 64;
    for (const char *c = e->id; *c; c++)
        valid = valid && (isalnum((unsigned char)*c) || strchr(".-", *c));
    return valid ||
           irb_yaml_fail(yaml, irb_yaml_find(yaml, map, "id"), err,
                         "id: expected 1 to 64 letters, digits, '.' or '-', found '%.64s'", e->id);
}

static bool read_errors(struct irb_exhibit *e, struct irb_yaml *yaml, irb_yaml_node list,
                        struct irb_error *err)
{
    if (!list)
        return true;
    e->errors = irb_exhibit_array(yaml, list, "errors", sizeof *e->errors, &e->error_count, err);
    if (!e->errors)
        return false;
    for (int i = 0; i < e->error_count; i++) {
        const char *text = irb_yaml_text(yaml, irb_yaml_item(yaml, list, i), "errors", err);
        if (!text)
            return false;
        e->errors[i] = irb_strdup(text);
    }
    return true;
}

static bool read_section(struct irb_exhibit *e, struct irb_yaml *yaml, irb_yaml_node map,
                         struct irb_error *err)
{
    static const char *const keys[] = {"id",     "title",  "source",  "notes",  "errors",
                                       "tables", "images", "layouts", "claims", NULL};
    if (!irb_yaml_check_map(yaml, map, "exhibit", keys, err) || !read_id(e, yaml, map, err) ||
        !irb_exhibit_text(yaml, map, "title", "", &e->title, err) ||
        !irb_exhibit_text(yaml, map, "source", "", &e->source, err) ||
        !irb_exhibit_text(yaml, map, "notes", "", &e->notes, err) ||
        !read_errors(e, yaml, irb_yaml_find(yaml, map, "errors"), err))
        return false;
    static const struct {
        const char *key;
        bool (*read)(struct irb_exhibit *, struct irb_yaml *, irb_yaml_node, struct irb_error *);
    } parts[] = {{"tables", irb_exhibit_read_tables},
                 {"images", irb_exhibit_read_grids},
                 {"layouts", irb_exhibit_read_layouts},
                 {"claims", irb_exhibit_read_claims}};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        irb_yaml_node node = irb_yaml_find(yaml, map, parts[i].key);
        if (node && !parts[i].read(e, yaml, node, err))
            return irb_error_prefix(err, "exhibit");
    }
    return true;
}

bool irb_exhibit_load(struct irb_exhibit *exhibit, const char *config_path, const char *variant,
                      bool *there, struct irb_error *err)
{
    struct irb_yaml yaml;
    *exhibit = (struct irb_exhibit){0};
    *there = false;
    if (!irb_yaml_load(&yaml, config_path, err))
        return false;
    (void)variant;
    irb_yaml_node map = irb_yaml_find(&yaml, irb_yaml_root(&yaml), "exhibit");
    bool ok = !map || read_section(exhibit, &yaml, map, err);
    irb_yaml_destroy(&yaml);
    *there = ok && map;
    if (!ok)
        irb_exhibit_destroy(exhibit);
    return ok;
}

void irb_exhibit_destroy(struct irb_exhibit *exhibit)
{
    irb_exhibit_destroy_tables(exhibit);
    irb_exhibit_destroy_grids(exhibit);
    irb_exhibit_destroy_layouts(exhibit);
    irb_exhibit_destroy_claims(exhibit);
    for (int i = 0; i < exhibit->error_count; i++)
        free(exhibit->errors[i]);
    free(exhibit->errors);
    free(exhibit->id);
    free(exhibit->title);
    free(exhibit->source);
    free(exhibit->notes);
    *exhibit = (struct irb_exhibit){0};
}
