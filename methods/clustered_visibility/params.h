/* SPDX-License-Identifier: MIT
 *
 * The parameters of the method clustered-visibility, and the settings of its parts that they come
 * to.
 */
#ifndef IRB_METHODS_CLUSTERED_VISIBILITY_PARAMS_H
#define IRB_METHODS_CLUSTERED_VISIBILITY_PARAMS_H

#include "core/base/option.h"
#include "core/frame/interleave.h"
#include "core/lights/val_lighting.h"
#include "core/lights/vals.h"

struct cv_params {
    int vpls, vals;
    float w_x, w_a;
    int metric_unit, iterations, start, extent, centre;
    int visibility, projection, map_size;
    float near;
    int order, prefilter;
    float offset, scale, search_offset, search_scale, penumbra_scale, damping;
    float clamp;
    int interleave;
    float alpha, beta;
};

extern const struct irb_option cv_options[];

struct cv_resolved {
    int vpls;
    unsigned first; /* index of the first Halton point */
    struct irb_vals_settings clustering;
    struct irb_val_lighting_settings lighting;
    int interleave;      /* tiles a side */
    float depth, cosine; /* thresholds of the filter: m, 1 */
};

/* diagonal: of the scene at rest, m, 0 for a scene without extent; seed: of the sequence. The
 * number of tiles is still to be set. */
void cv_params_resolve(const struct cv_params *params, float diagonal, uint64_t seed,
                       struct cv_resolved *out);

/* As methods/method.h asks for; the parameters are a struct cv_params. */
bool cv_claims_visibility(const void *params);
unsigned cv_needs(const void *params);

#endif
