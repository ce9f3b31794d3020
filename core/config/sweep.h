/* SPDX-License-Identifier: MIT
 *
 * The trials that one parameter map stands for. A list where a single value may stand gives one
 * trial for each value; several lists give every combination, in the order of the method's
 * parameter table, the core's parameters behind it, with the last one changing fastest. `matrix:`
 * lists the combinations instead: each of its maps is merged over what stands beside it, and may
 * hold lists itself. A value may be a map of its keys over the sequence (tracks.c).
 *
 *     - rsm: {mode: uniform, samples: [100, 400, 1600]}
 *     - rsm: {clamp: 10, matrix: [{mode: uniform, samples: 100}, {mode: all}]}
 */
#ifndef IRB_SWEEP_H
#define IRB_SWEEP_H

#include "core/config/parts.h"

/* Gets each trial in turn and owns it from then on, also where it fails. */
typedef bool (*irb_sweep_fn)(void *user, struct irb_trial *trial, struct irb_error *err);

/* `params` is the method's map, or empty for its defaults. At most IRB_MOST_TRIALS trials. */
bool irb_sweep(struct irb_yaml *yaml, const struct irb_method *method, irb_yaml_node params,
               irb_sweep_fn fn, void *user, struct irb_error *err);

#endif
