/* SPDX-License-Identifier: MIT
 *
 * Runs an experiment: prepare (scene, G-buffers, references) -> render -> score -> keep. Every
 * stage is resumable: what a killed run had finished is found by its key and not done again.
 */
#ifndef IRB_EXPERIMENT_RUN_H
#define IRB_EXPERIMENT_RUN_H

#include "core/experiment/stage.h"

#include <stdio.h>

/* Runs options->stages. *run_dir (malloc'ed) is set as soon as the folder exists. On failure or
 * interruption what was computed stays. */
bool irb_run_experiment(const struct irb_config *config, const struct irb_run_options *options,
                        char **run_dir, struct irb_error *err);

/* Only the references: renders G-buffers, then traces what the cache lacks. With `keys` set
 * nothing is traced and a line "KEY SCENE FRAME cached|missing" is printed for each frame. */
bool irb_run_references(const struct irb_config *config, const struct irb_run_options *options,
                        FILE *keys, struct irb_error *err);

#endif
