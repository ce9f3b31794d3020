/* SPDX-License-Identifier: MIT
 *
 * The stage prepare: what the reference is made for, and the reference, into the cache. What
 * the cache has is not traced or written again.
 */
#ifndef IRB_EXPERIMENT_PREPARE_H
#define IRB_EXPERIMENT_PREPARE_H

#include "core/experiment/stage.h"

/* Sets the keys of every frame and writes the full-precision G-buffers to the cache. */
bool irb_prepare_gbuffers(struct irb_run *run, struct irb_sequence *sequence,
                          struct irb_error *err);

/* Traces the references that the cache lacks; after irb_prepare_gbuffers. */
bool irb_prepare_references(struct irb_run *run, struct irb_sequence *sequence,
                            struct irb_error *err);

#endif
