/* SPDX-License-Identifier: MIT
 *
 * `profile:` of a scene: the row of the image that its profiles show over the sequence. It changes
 * no number, and is not in the config's key.
 */
#include "core/config/parts.h"

#include <math.h>

bool irb_config_read_profile(struct irb_scene_entry *entry, struct irb_yaml *yaml,
                             irb_yaml_node scene, struct irb_error *err)
{
    irb_yaml_node node = irb_yaml_find(yaml, scene, "profile");
    entry->profile = -1;
    if (!node)
        return true;
    if (!irb_yaml_float(yaml, node, "profile", 0, 16384, &entry->profile, err))
        return false;
    if (entry->profile >= 1 && entry->profile != floorf(entry->profile))
        return irb_yaml_fail(yaml, node, err,
                             "profile: expected a row in whole pixels, or a fraction of the height "
                             "between 0 and 1, found %g",
                             (double)entry->profile);
    entry->profile_place = irb_yaml_place(yaml, node);
    return true;
}

bool irb_profile_row(const struct irb_scene_entry *entry, int height, int *row)
{
    double at = entry->profile;
    if (!(at >= 0))
        return false;
    at = at < 1 ? floor(at * height) : at;
    if (!(at < height))
        return false;
    *row = (int)at;
    return true;
}

bool irb_config_check_profiles(const struct irb_config *config, struct irb_error *err)
{
    for (int i = 0; i < config->scene_count; i++) {
        const struct irb_scene_entry *entry = &config->scenes[i];
        int row;
        if (entry->profile >= 0 && !irb_profile_row(entry, config->render.height, &row))
            return irb_fail(err, IRB_E_INPUT,
                            "%s: profile: expected a row below %d, the height of the image, found "
                            "%g",
                            entry->profile_place, config->render.height, (double)entry->profile);
    }
    return true;
}
