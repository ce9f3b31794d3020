/* SPDX-License-Identifier: MIT
 *
 * The gather of plain RSM: irradiance at every pixel from one set of virtual lights, no visibility.
 */
#ifndef IRB_METHODS_RSM_GATHER_H
#define IRB_METHODS_RSM_GATHER_H

#include "core/frame/gbuffer.h"
#include "core/lights/vpl.h"

struct rsm_gather {
    struct irb_texture *irradiance; /* RGBA32F, W/m2; alpha: mean irradiance that the clamp took */
    struct irb_program *plain, *clamped, *energy;
    struct irb_buffer *rows; /* sums for rsm_gather_lost(), one vec2 a row */
    int tile;                /* one invocation gathers for tile x tile pixels */
    struct irb_gl *gl;       /* borrowed */
};

struct rsm_gather *rsm_gather_create(struct irb_gl *gl, int width, int height,
                                     struct irb_error *err);
void rsm_gather_destroy(struct rsm_gather *gather);

/* Fills `irradiance` from all lights of the set. bound: largest geometry term cos cos/r^2 (1/m2),
 * 0 for none. Same input, same bits. */
bool rsm_gather_run(struct rsm_gather *gather, const struct irb_gbuffer *gbuffer,
                    const struct irb_vpl_set *lights, float bound, struct irb_error *err);

/* Share of the visible pixels' irradiance that the bound took in the last run, in [0,1]; 0 where
 * there is none at all. Waits for the GPU. */
bool rsm_gather_lost(struct rsm_gather *gather, double *share, struct irb_error *err);

#endif
