/* SPDX-License-Identifier: MIT
 *
 * How much of the gathered irradiance the clamp took.
 */
#ifndef IRB_METHODS_RSM_ENERGY_H
#define IRB_METHODS_RSM_ENERGY_H

#include "core/gl/objects.h"
#include "core/gl/program.h"

struct rsm_energy {
    struct irb_gl *gl; /* borrowed */
    struct irb_program *program;
    struct irb_buffer *rows; /* sums, one vec2 a row */
};

struct rsm_energy *rsm_energy_create(struct irb_gl *gl, int height, struct irb_error *err);
void rsm_energy_destroy(struct rsm_energy *energy);

/* Share of the irradiance (alpha: what was taken) that the bound took, in [0,1]; 0 where there is
 * none at all. The image is of the height that was given. Waits for the GPU. */
bool rsm_energy_lost(struct rsm_energy *energy, const struct irb_texture *irradiance, double *share,
                     struct irb_error *err);

#endif
