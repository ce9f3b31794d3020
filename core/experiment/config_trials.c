/* SPDX-License-Identifier: MIT
 *
 * `trials:`: a list of "method:option=value" texts and {method: {option: value}} maps.
 */
#include "core/base/str.h"
#include "core/experiment/config_parts.h"

#include <stdlib.h>
#include <string.h>

/* Far above what a study runs; bounds the time that the search for duplicates takes. */
enum { MOST_TRIALS = 4096 };

/* One parameter of a trial written as a map. */
static bool set_param(struct irb_trial *trial, struct irb_yaml *yaml, irb_yaml_node params,
                      int index, struct irb_error *err)
{
    irb_yaml_node key = irb_yaml_key(yaml, params, index);
    irb_yaml_node value = irb_yaml_value(yaml, params, index);
    const char *name = (const char *)key->data.scalar.value;
    if (!irb_option_find(trial->method->params, name)) {
        irb_trial_set(trial, name, "", err); /* names the nearest */
        irb_error_prefix(err, "%s", trial->method->name);
        return irb_yaml_prefix(yaml, key, err);
    }
    if (value->type == YAML_SEQUENCE_NODE)
        return irb_yaml_fail(yaml, value, err,
                             "%s.%s: expected a single value, found a list; write one trial for "
                             "each value",
                             trial->method->name, name);
    const char *text = irb_yaml_text(yaml, value, name, err);
    if (!text)
        return false;
    if (irb_trial_set(trial, name, text, err))
        return true;
    irb_error_prefix(err, "%s", trial->method->name);
    return irb_yaml_prefix(yaml, value, err);
}

static bool read_map(struct irb_trial *trial, struct irb_yaml *yaml, irb_yaml_node node,
                     const struct irb_registry *registry, struct irb_error *err)
{
    if (!irb_yaml_check_map(yaml, node, "trial", NULL, err))
        return false;
    if (irb_yaml_pairs(node) != 1)
        return irb_yaml_fail(yaml, node, err,
                             "trial: expected one key, the method, found %d keys; indent its "
                             "parameters below it",
                             irb_yaml_pairs(node));
    irb_yaml_node key = irb_yaml_key(yaml, node, 0), params = irb_yaml_value(yaml, node, 0);
    const struct irb_method *method =
        irb_registry_find(registry, (const char *)key->data.scalar.value, err);
    if (!method)
        return irb_yaml_prefix(yaml, key, err);
    if (!irb_trial_begin(trial, method, err))
        return irb_yaml_prefix(yaml, key, err);
    if (irb_yaml_is_null(params))
        return true;
    if (!irb_yaml_check_map(yaml, params, method->name, NULL, err))
        return false;
    for (int i = 0; i < irb_yaml_pairs(params); i++)
        if (!set_param(trial, yaml, params, i, err))
            return false;
    irb_trial_rename(trial);
    return true;
}

/* One item of the list; it may come to stand for several trials once a value may be a list. */
static bool read_trial(struct irb_config *config, struct irb_yaml *yaml, irb_yaml_node node,
                       const struct irb_registry *registry, struct irb_error *err)
{
    struct irb_trial trial = {0};
    bool ok;
    if (node->type == YAML_MAPPING_NODE) {
        ok = read_map(&trial, yaml, node, registry, err);
    } else {
        const char *text = irb_yaml_text(yaml, node, "trial", err);
        ok = text &&
             (irb_trial_parse(&trial, text, registry, err) || irb_yaml_prefix(yaml, node, err));
    }
    for (int i = 0; ok && i < config->trial_count; i++)
        if (!strcmp(config->trials[i].name, trial.name))
            ok = irb_yaml_fail(yaml, node, err, "trial '%.128s' stands here twice", trial.name);
    if (!ok) {
        irb_trial_destroy(&trial);
        return false;
    }
    config->trials[config->trial_count++] = trial;
    return true;
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
    if (count > MOST_TRIALS)
        return irb_yaml_fail(yaml, list, err, "trials: expected at most %d, found %d", MOST_TRIALS,
                             count);
    config->trials = calloc((size_t)count, sizeof *config->trials);
    if (!config->trials)
        return irb_fail(err, IRB_E_MEMORY, "%s: out of memory", yaml->path);
    for (int i = 0; i < count; i++)
        if (!read_trial(config, yaml, irb_yaml_item(yaml, list, i), registry, err))
            return false;
    return true;
}
