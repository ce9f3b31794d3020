/* SPDX-License-Identifier: MIT
 *
 * Private to the room: the light-transport estimate at one point.
 */
#ifndef IRB_REFERENCE_ESTIMATOR_H
#define IRB_REFERENCE_ESTIMATOR_H

#include "core/reference/kernels.h"
#include "core/reference/tracer.h"

enum { MAX_BOUNCES = 16 };

/* Irradiance layers of a point, W/m2. Sums over samples in the estimator, and what a pixel keeps
 * from pass to pass. Floats only: it is written to the checkpoint as it is. */
struct point_layers {
    float bounce1[3], bounce2[3], rest[3], unoccluded[3];
    float bounce1_batch[IRB_REFERENCE_BATCHES]; /* luminance, a batch of samples each */
    float unoccluded_batch[IRB_REFERENCE_BATCHES];
};

struct estimator {
    struct trace_context trace;
    const struct light_source *light;
    int bounces;
    bool unoccluded;
    const struct kernels *kernels;
    double luminance[MAX_BOUNCES]; /* of each bounce, summed over all that was estimated */
};

/* Adds the sums over samples first..last-1 of each batch. `seed` belongs to the point; sample i of
 * a batch is the same whatever range it is asked in. */
void estimator_add(struct estimator *estimator, const struct surface_point *point, uint64_t seed,
                   uint32_t first, uint32_t last, struct point_layers *sums);

/* Direct radiance towards `eye`: Lambert + Blinn (thesis 5.3.4),
 * L = (k_d n.l + k_s (n.h)^alpha) I/(pi r^2), with exact visibility of the light. */
struct vec3 estimator_direct(struct estimator *estimator, const struct surface_point *point,
                             struct vec3 specular, float exponent, struct vec3 eye);

#endif
