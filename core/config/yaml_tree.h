/* SPDX-License-Identifier: MIT
 *
 * A YAML file as a tree whose nodes know where they stand, read through libyaml's document API.
 * Aliases (&a, *a) work for whole values; tags are ignored. Messages are
 * "PATH:LINE:COLUMN: what was expected, what was found".
 *
 * Does not: know what a key means.
 */
#ifndef IRB_YAML_TREE_H
#define IRB_YAML_TREE_H

#include "core/base/error.h"

#include <stddef.h>
#include <yaml.h>

struct irb_yaml {
    char *path; /* owned */
    yaml_document_t document;
};

typedef const yaml_node_t *irb_yaml_node; /* borrowed from its irb_yaml */

/* Reads one document from a file of at most 1 MiB. On failure nothing has to be destroyed. */
bool irb_yaml_load(struct irb_yaml *yaml, const char *path, struct irb_error *err);
void irb_yaml_destroy(struct irb_yaml *yaml);

/* NULL where the file is empty. */
irb_yaml_node irb_yaml_root(struct irb_yaml *yaml);

/* IRB_E_INPUT at the node's place; returns false. */
bool irb_yaml_fail(const struct irb_yaml *yaml, irb_yaml_node node, struct irb_error *err,
                   const char *format, ...) __attribute__((format(printf, 4, 5)));
/* Puts the node's place before the message that is already in *err; returns false. */
bool irb_yaml_prefix(const struct irb_yaml *yaml, irb_yaml_node node, struct irb_error *err);

/* "PATH:LINE:COLUMN" of a node, for messages that are made once the file is closed. Malloc'ed. */
char *irb_yaml_place(const struct irb_yaml *yaml, irb_yaml_node node);

/* "a map", "a list", "a value"; for messages. */
const char *irb_yaml_kind(irb_yaml_node node);

/* The text of a scalar: of `what`, for messages. NULL, with a message, for anything else. */
const char *irb_yaml_text(const struct irb_yaml *yaml, irb_yaml_node node, const char *what,
                          struct irb_error *err);

/* Items of a list, 0 for anything else; and the item at `index` in [0, count). */
int irb_yaml_count(irb_yaml_node list);
irb_yaml_node irb_yaml_item(struct irb_yaml *yaml, irb_yaml_node list, int index);

/* Whether an empty value ("light:" with nothing behind it), "~" or "null" stands there. */
bool irb_yaml_is_null(irb_yaml_node node);

/* Key and value of a map at `index` in [0, irb_yaml_pairs). */
int irb_yaml_pairs(irb_yaml_node map);
irb_yaml_node irb_yaml_key(struct irb_yaml *yaml, irb_yaml_node map, int index);
irb_yaml_node irb_yaml_value(struct irb_yaml *yaml, irb_yaml_node map, int index);

/* The value of a key, or NULL. */
irb_yaml_node irb_yaml_find(struct irb_yaml *yaml, irb_yaml_node map, const char *key);

/* Checks that `map` is a map, that its keys are texts out of `allowed` (NULL-terminated; NULL =
 * any) and that none is there twice. `what` names the map in messages. */
bool irb_yaml_check_map(struct irb_yaml *yaml, irb_yaml_node map, const char *what,
                        const char *const *allowed, struct irb_error *err);

/* A list of exactly `count` finite numbers. */
bool irb_yaml_floats(struct irb_yaml *yaml, irb_yaml_node list, const char *what, float *out,
                     int count, struct irb_error *err);
/* One finite number in [min, max]. */
bool irb_yaml_float(struct irb_yaml *yaml, irb_yaml_node node, const char *what, double min,
                    double max, float *out, struct irb_error *err);

#endif
