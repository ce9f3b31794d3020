/* SPDX-License-Identifier: MIT
 *
 * `seed:` and `seeds:`: one seed, a list of them, or how many (5 means 1, 2, 3, 4, 5). And
 * `repeats:` of each.
 */
#include "core/base/str.h"
#include "core/config/parts.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

struct numbers {
    int seed, seeds, repeats;
};

static const struct irb_option options[] = {
    IRB_OPTION_INT(struct numbers, seed, 1, 0, INT_MAX, "", "seed of every random choice", "ours"),
    IRB_OPTION_INT(struct numbers, seeds, IRB_USUAL_SEEDS, 1, IRB_MOST_SEEDS, "", "number of seeds",
                   "ours"),
    IRB_OPTION_INT(struct numbers, repeats, 1, 1, IRB_MOST_REPEATS, "", "of each seed", "ours"),
    IRB_OPTION_END,
};

void irb_config_usual_seeds(struct irb_config *config)
{
    config->repeats = 1;
    config->seed_count = IRB_USUAL_SEEDS;
    for (int i = 0; i < IRB_USUAL_SEEDS; i++)
        config->seeds[i] = i + 1;
}

bool irb_config_set_repeats(struct irb_config *config, const char *text, struct irb_error *err)
{
    struct numbers value;
    if (!irb_option_set(options, &value, "repeats", text, err))
        return false;
    config->repeats = value.repeats;
    return true;
}

bool irb_config_set_seed(struct irb_config *config, const char *text, struct irb_error *err)
{
    struct numbers value;
    if (!irb_option_set(options, &value, "seed", text, err))
        return false;
    config->seeds[0] = value.seed;
    config->seed_count = 1;
    return true;
}

static bool set_count(struct irb_config *config, const char *text, struct irb_error *err)
{
    struct numbers value;
    if (!irb_option_set(options, &value, "seeds", text, err))
        return false;
    config->seed_count = value.seeds;
    for (int i = 0; i < value.seeds; i++)
        config->seeds[i] = i + 1;
    return true;
}

/* One more seed of a list. */
static bool add_seed(struct irb_config *config, const char *text, struct irb_error *err)
{
    struct numbers value;
    if (!irb_option_set(options, &value, "seed", text, err))
        return irb_error_prefix(err, "seeds");
    if (config->seed_count == IRB_MOST_SEEDS)
        return irb_fail(err, IRB_E_INPUT, "seeds: expected at most %d, found more", IRB_MOST_SEEDS);
    for (int i = 0; i < config->seed_count; i++)
        if (config->seeds[i] == value.seed)
            return irb_fail(err, IRB_E_INPUT, "seeds: %d stands here twice", value.seed);
    config->seeds[config->seed_count++] = value.seed;
    return true;
}

bool irb_config_set_seeds(struct irb_config *config, const char *text, struct irb_error *err)
{
    if (!strchr(text, ','))
        return set_count(config, text, err);
    char *copy = irb_strdup(text);
    bool ok = true;
    config->seed_count = 0;
    for (char *item = copy; ok && item;) {
        char *next = strchr(item, ',');
        if (next)
            *next++ = 0;
        ok = add_seed(config, item, err);
        item = next;
    }
    free(copy);
    return ok;
}

bool irb_config_read_seeds(struct irb_config *config, struct irb_yaml *yaml, irb_yaml_node node,
                           struct irb_error *err)
{
    if (irb_yaml_find(yaml, irb_yaml_root(yaml), "seed"))
        return irb_yaml_fail(yaml, node, err, "seeds: expected seed: or seeds:, found both");
    if (node->type == YAML_SCALAR_NODE) {
        const char *count = irb_yaml_text(yaml, node, "seeds", err);
        return count && (set_count(config, count, err) || irb_yaml_prefix(yaml, node, err));
    }
    if (!irb_yaml_count(node))
        return irb_yaml_fail(
            yaml, node, err, "seeds: expected a number or a list of seeds, found %s",
            node->type == YAML_SEQUENCE_NODE ? "an empty list" : irb_yaml_kind(node));
    config->seed_count = 0;
    for (int i = 0; i < irb_yaml_count(node); i++) {
        irb_yaml_node item = irb_yaml_item(yaml, node, i);
        const char *text = irb_yaml_text(yaml, item, "seeds", err);
        if (!text || !(add_seed(config, text, err) || irb_yaml_prefix(yaml, item, err)))
            return false;
    }
    return true;
}

void irb_config_hash_seeds(const struct irb_config *config, struct irb_hash *hash)
{
    for (int i = 1; i < config->seed_count; i++) {
        irb_hash_string(hash, "seed");
        irb_hash_u64(hash, (uint64_t)config->seeds[i]);
    }
}
