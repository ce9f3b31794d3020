/* SPDX-License-Identifier: MIT
 *
 * Pictures of a clustering for people, as in the figures of Prutkin et al. 2012. All RGBA32F,
 * display-referred, in [0,1].
 */
#ifndef IRB_METHODS_RSM_CLUSTERING_PICTURES_H
#define IRB_METHODS_RSM_CLUSTERING_PICTURES_H

#include "core/frame/gbuffer.h"
#include "methods/rsm_clustering/area_lights.h"

struct rsc_pictures {
    struct irb_texture *map;       /* of the RSM's size: a colour a cluster; white: lit, but no
                                      cluster within reach */
    struct irb_texture *flux;      /* likewise: reflected flux (figure 2, left) */
    struct irb_texture *clustered; /* likewise: mean flux of the cluster (figure 2, middle) */
    struct irb_texture *centres;   /* likewise: `clustered` and the clusters' centres (figure 2,
                                      below) */
    struct irb_texture *lights;    /* of the G-buffer's size: the area lights in the scene (figures
                                      1 and 3, above) */
    struct rsc_picture_passes *passes; /* private */
    struct irb_gl *gl;                 /* borrowed */
};

struct rsc_pictures *rsc_pictures_create(struct irb_gl *gl, int resolution, int width, int height,
                                         struct irb_error *err);
void rsc_pictures_destroy(struct rsc_pictures *pictures);

/* After the frame's area lights have been made. */
bool rsc_pictures_draw(struct rsc_pictures *pictures, const struct rsc_clusters *clusters,
                       const struct rsc_area_lights *lights, const struct irb_rsm *rsm,
                       const struct irb_gbuffer *gbuffer, struct irb_error *err);

#endif
