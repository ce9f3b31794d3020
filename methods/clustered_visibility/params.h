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
    int metric_unit, iterations, start, area, centre;
    int visibility, projection, map_size;
    float near;
    int csm_order, csm_prefilter;
    float csm_offset, csm_scale, csm_search_offset, csm_damping;
    float search_scale, penumbra_scale;
    float clamp;
    int interleave_n, interleave_m;
    float filter_depth, filter_cosine;
};

extern const struct irb_option cv_options[];

struct cv_resolved {
    int vpls;
    unsigned first; /* index of the first Halton point */
    struct irb_vals_settings clustering;
    struct irb_val_lighting_settings lighting;
    int interleave_n, interleave_m;    /* tiles across, up */
    float filter_depth, filter_cosine; /* m, 1 */
};

/* diagonal: of the scene at rest, m, 0 for a scene without extent; seed: of the sequence. The
 * number of tiles is still to be set. */
void cv_params_resolve(const struct cv_params *params, float diagonal, uint64_t seed,
                       struct cv_resolved *out);

/* As methods/method.h asks for; the parameters are a struct cv_params. */
bool cv_claims_visibility(const void *params);
unsigned cv_needs(const void *params);

#endif
