/* SPDX-License-Identifier: MIT
 *
 * `regions:` of a scene: named boxes of the image that are scored on their own.
 *
 *     regions:
 *       - {name: corner, box: [0, 0.5, 0.25, 1]}
 *       - {name: door, box: [120, 40, 160, 128]}
 */
#include "core/base/str.h"
#include "core/config/keys.h"
#include "core/config/parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool read_box(struct irb_region *region, struct irb_yaml *yaml, irb_yaml_node node,
                     struct irb_error *err)
{
    float *box = region->box;
    if (!irb_yaml_floats(yaml, node, "box", box, 4, err))
        return false;
    region->fractions = true;
    bool whole = true;
    for (int i = 0; i < 4; i++) {
        if (box[i] < 0)
            return irb_yaml_fail(yaml, node, err, "box: expected 0 or more, found %g",
                                 (double)box[i]);
        region->fractions = region->fractions && box[i] <= 1;
        whole = whole && box[i] == floorf(box[i]);
    }
    if (!region->fractions && !whole)
        return irb_yaml_fail(yaml, node, err,
                             "box: expected whole pixels, or fractions of the image that are all "
                             "at most 1, found [%g, %g, %g, %g]",
                             (double)box[0], (double)box[1], (double)box[2], (double)box[3]);
    if (!(box[0] < box[2] && box[1] < box[3]))
        return irb_yaml_fail(yaml, node, err,
                             "box: expected [x0, y0, x1, y1] with x0 < x1 and y0 < y1, found [%g, "
                             "%g, %g, %g]",
                             (double)box[0], (double)box[1], (double)box[2], (double)box[3]);
    return true;
}

static bool read_name(struct irb_scene_entry *entry, struct irb_region *region,
                      struct irb_yaml *yaml, irb_yaml_node node, struct irb_error *err)
{
    const char *text = irb_yaml_text(yaml, node, "name", err);
    if (!text)
        return false;
    if (!irb_config_name_is_valid(text))
        return irb_yaml_fail(yaml, node, err,
                             "name: expected 1 to %d letters, digits, '.', '_' or '-', found "
                             "'%.64s'",
                             IRB_LONGEST_NAME, text);
    for (int i = 0; i < entry->region_count; i++)
        if (!strcmp(entry->regions[i].name, text))
            return irb_yaml_fail(yaml, node, err, "two regions of the scene are called '%s'", text);
    region->name = irb_strdup(text);
    return true;
}

static bool read_region(struct irb_scene_entry *entry, struct irb_yaml *yaml, irb_yaml_node node,
                        struct irb_error *err)
{
    static const char *const keys[] = {IRB_CONFIG_REGION_KEYS(IRB_CONFIG_KEY_NAME) NULL};
    if (!irb_yaml_check_map(yaml, node, "region", keys, err))
        return false;
    irb_yaml_node name = irb_yaml_find(yaml, node, "name"), box = irb_yaml_find(yaml, node, "box");
    if (!name || !box)
        return irb_yaml_fail(yaml, node, err,
                             "%s: missing; expected {name: NAME, box: [x0, y0, "
                             "x1, y1]}",
                             name ? "box" : "name");
    struct irb_region *region = &entry->regions[entry->region_count];
    if (!read_name(entry, region, yaml, name, err))
        return false;
    entry->region_count++;
    return read_box(region, yaml, box, err);
}

bool irb_config_read_regions(struct irb_scene_entry *entry, struct irb_yaml *yaml,
                             irb_yaml_node scene, struct irb_error *err)
{
    irb_yaml_node list = irb_yaml_find(yaml, scene, "regions");
    if (!list)
        return true;
    int count = irb_yaml_count(list);
    if (list->type != YAML_SEQUENCE_NODE)
        return irb_yaml_fail(yaml, list, err, "regions: expected a list of regions, found %s",
                             irb_yaml_kind(list));
    if (count > IRB_MOST_REGIONS)
        return irb_yaml_fail(yaml, list, err, "regions: expected at most %d, found %d",
                             IRB_MOST_REGIONS, count);
    entry->regions = calloc((size_t)count + 1, sizeof *entry->regions);
    if (!entry->regions)
        return irb_fail(err, IRB_E_MEMORY, "%s: out of memory", yaml->path);
    for (int i = 0; i < count; i++)
        if (!read_region(entry, yaml, irb_yaml_item(yaml, list, i), err))
            return false;
    return true;
}

bool irb_region_pixels(const struct irb_region *region, int width, int height, int box[4])
{
    const int size[4] = {width, height, width, height};
    for (int i = 0; i < 4; i++) {
        double edge = region->fractions ? round((double)region->box[i] * size[i]) : region->box[i];
        if (!(edge <= size[i]))
            return false;
        box[i] = (int)edge;
    }
    return box[0] < box[2] && box[1] < box[3];
}

bool irb_config_check_regions(const struct irb_config *config, struct irb_error *err)
{
    for (int s = 0; s < config->scene_count; s++) {
        const struct irb_scene_entry *entry = &config->scenes[s];
        for (int i = 0; i < entry->region_count; i++) {
            const struct irb_region *region = &entry->regions[i];
            const float *b = region->box;
            int box[4];
            if (!irb_region_pixels(region, config->render.width, config->render.height, box))
                return irb_fail(err, IRB_E_INPUT,
                                "%s: scene %s: region %s: expected a box with at least one pixel "
                                "inside the image of %d x %d, found [%g, %g, %g, %g]",
                                config->path, entry->name, region->name, config->render.width,
                                config->render.height, (double)b[0], (double)b[1], (double)b[2],
                                (double)b[3]);
        }
    }
    return true;
}

/* Adds nothing where there are none: the keys of configs without regions are what they were. */
void irb_config_hash_regions(const struct irb_scene_entry *entry, struct irb_hash *hash)
{
    for (int i = 0; i < entry->region_count; i++) {
        irb_hash_string(hash, "region");
        irb_hash_string(hash, entry->regions[i].name);
        irb_hash_floats(hash, entry->regions[i].box, 4);
    }
}

void irb_config_destroy_regions(struct irb_scene_entry *entry)
{
    for (int i = 0; i < entry->region_count; i++)
        free(entry->regions[i].name);
    free(entry->regions);
}
