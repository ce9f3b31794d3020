/* SPDX-License-Identifier: MIT
 *
 * Private to the room: the low-discrepancy points of a run of samples, made together, so that the
 * compiler makes vectors of them. Half of the integrator's own time went into points made singly.
 */
#ifndef IRB_REFERENCE_SAMPLE_BLOCK_H
#define IRB_REFERENCE_SAMPLE_BLOCK_H

#include "core/reference/vec3.h"
#include "core/sampling/sobol.h"

enum { SAMPLE_BLOCK = 16 };

struct point_block {
    float x[SAMPLE_BLOCK], y[SAMPLE_BLOCK], z[SAMPLE_BLOCK];
};

/* Points first..first+SAMPLE_BLOCK-1 of a set. All of these give the same bits on every
 * processor. */
typedef void (*point_block_fn)(const struct irb_sobol_set *set, uint32_t first,
                               struct point_block *out);

struct point_makers {
    point_block_fn square;    /* in the unit square; z is not set */
    point_block_fn disc;      /* uniform in the unit disc; z is not set */
    point_block_fn direction; /* with density cos/pi about (0,0,1) */
};

/* Those for the processor that this runs on. */
struct point_makers point_makers_choose(void);

#endif
