/* SPDX-License-Identifier: MIT
 *
 * `trials:`: a list of "method:option=value" texts and {method: {option: value}} maps. A map may
 * stand for many trials: see sweep.h.
 */
#include "core/base/str.h"
#include "core/config/parts.h"
#include "core/config/sweep.h"

#include <stdlib.h>
#include <string.h>

/* What the trials of the list are added to. */
struct reader {
    struct irb_config *config;
    struct irb_yaml *yaml;
    irb_yaml_node node; /* the item of the list that is being read */
};

/* Takes over the trial, also on failure. */
static bool add_trial(void *user, struct irb_trial *trial, struct irb_error *err)
{
    struct reader *r = user;
    struct irb_config *config = r->config;
    bool ok = config->trial_count < IRB_MOST_TRIALS ||
              irb_yaml_fail(r->yaml, r->node, err, "trials: expected at most %d, found more",
                            IRB_MOST_TRIALS);
    for (int i = 0; ok && i < config->trial_count; i++)
        if (!strcmp(config->trials[i].name, trial->name))
            ok = irb_yaml_fail(r->yaml, r->node, err, "trial '%.128s' stands here twice",
                               trial->name);
    if (!ok) {
        irb_trial_destroy(trial);
        return false;
    }
    trial->place = irb_yaml_place(r->yaml, r->node);
    config->trials[config->trial_count++] = *trial;
    return true;
}

static bool read_map(struct reader *r, const struct irb_registry *registry, struct irb_error *err)
{
    struct irb_yaml *yaml = r->yaml;
    if (!irb_yaml_check_map(yaml, r->node, "trial", NULL, err))
        return false;
    if (irb_yaml_pairs(r->node) != 1)
        return irb_yaml_fail(yaml, r->node, err,
                             "trial: expected one key, the method, found %d keys; indent its "
                             "parameters below it",
                             irb_yaml_pairs(r->node));
    irb_yaml_node key = irb_yaml_key(yaml, r->node, 0);
    const struct irb_method *method =
        irb_registry_find(registry, (const char *)key->data.scalar.value, err);
    if (!method)
        return irb_yaml_prefix(yaml, key, err);
    return irb_sweep(yaml, method, irb_yaml_value(yaml, r->node, 0), add_trial, r, err);
}

static bool read_text(struct reader *r, const struct irb_registry *registry, struct irb_error *err)
{
    struct irb_trial trial;
    const char *text = irb_yaml_text(r->yaml, r->node, "trial", err);
    if (!text)
        return false;
    if (!irb_trial_parse(&trial, text, registry, err))
        return irb_yaml_prefix(r->yaml, r->node, err);
    return add_trial(r, &trial, err);
}

bool irb_config_read_trials(struct irb_config *config, struct irb_yaml *yaml,
                            const struct irb_registry *registry, struct irb_error *err)
{
    irb_yaml_node root = irb_yaml_root(yaml);
    irb_yaml_node list = irb_yaml_find(yaml, root, "trials");
    if (!list)
        return irb_yaml_fail(yaml, root, err, "trials: missing; expected a list of methods to run");
    int count = irb_yaml_count(list);
    if (!count)
        return irb_yaml_fail(yaml, list, err, "trials: expected a list of methods to run, found %s",
                             list->type == YAML_SEQUENCE_NODE ? "an empty one"
                                                              : irb_yaml_kind(list));
    config->trials = calloc(IRB_MOST_TRIALS, sizeof *config->trials);
    if (!config->trials)
        return irb_fail(err, IRB_E_MEMORY, "%s: out of memory", yaml->path);
    struct reader reader = {.config = config, .yaml = yaml};
    for (int i = 0; i < count; i++) {
        reader.node = irb_yaml_item(yaml, list, i);
        bool ok = reader.node->type == YAML_MAPPING_NODE ? read_map(&reader, registry, err)
                                                         : read_text(&reader, registry, err);
        if (!ok)
            return false;
    }
    return true;
}
