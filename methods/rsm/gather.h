/* SPDX-License-Identifier: MIT
 *
 * The gather from one set of virtual lights, the same for all pixels; no visibility.
 */
#ifndef IRB_METHODS_RSM_GATHER_H
#define IRB_METHODS_RSM_GATHER_H

#include "core/lights/vpl.h"
#include "methods/rsm/pixels.h"

/* Adds up all lights of the set; alpha: mean irradiance that the bound took. bound: largest
 * geometry term cos cos/r^2 (1/m2), 0 for none. Same input, same bits. */
bool rsm_gather_run(struct rsm_programs *programs, const struct rsm_pixels *pixels,
                    const struct irb_vpl_set *lights, float bound, struct irb_error *err);

extern const char rsm_gather_shader[]; /* for rsm_programs_init() */
/* Side of the square of pixels that an invocation gathers for on software rasterisers. */
enum { RSM_GATHER_TILE = 4 };

#endif
