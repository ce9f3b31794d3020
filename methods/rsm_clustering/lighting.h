/* SPDX-License-Identifier: MIT
 *
 * What lights the image with the area lights: core/lights/ism_lighting.h, or with
 * visibility=clustered VALs and their maps. Everything is made when a frame first needs it, and
 * anew when a parameter asks for another one.
 */
#ifndef IRB_METHODS_RSM_CLUSTERING_LIGHTING_H
#define IRB_METHODS_RSM_CLUSTERING_LIGHTING_H

#include "core/lights/ism_lighting.h"
#include "methods/rsm_clustering/params.h"

enum { RSC_MAP_SIZE = 128 }; /* of a shadow map, texels; Ritschel et al. 2008 */

struct rsc_lighting {
    struct irb_ism_lighting ism; /* of it only `interleave` with visibility=clustered */
    struct irb_vals *vals;       /* NULL until visibility=clustered is asked for */
    struct irb_val_lighting val_lighting;
};

/* All else may be zero. */
void rsc_lighting_init(struct rsc_lighting *lighting, struct irb_gl *gl);
void rsc_lighting_destroy(struct rsc_lighting *lighting); /* what it holds */

/* Before the stages of a frame: makes what is missing for images of width x height. */
bool rsc_lighting_prepare(struct rsc_lighting *lighting, const struct irb_scene_gl *scene,
                          const struct rsc_resolved *settings, int width, int height,
                          struct irb_error *err);

#endif
