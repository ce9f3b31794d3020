/* SPDX-License-Identifier: MIT
 *
 * Clusters as area lights (Prutkin et al. 2012, section 5): discs, and polygons if asked for. Light
 * l is cluster l; that of an empty cluster is dark.
 */
#ifndef IRB_METHODS_RSM_CLUSTERING_AREA_LIGHTS_H
#define IRB_METHODS_RSM_CLUSTERING_AREA_LIGHTS_H

#include "core/lights/virtual_light.h"
#include "methods/rsm_clustering/clusters.h"

/* A disc's area, which the paper leaves open (shaders/methods/rsm_clustering/area_lights.comp). */
enum rsc_area {
    RSC_AREA_TEXELS, /* what its texels see of surfaces */
    RSC_AREA_MOMENT, /* of the disc with the same second moment */
    RSC_AREA_MAX,    /* of the disc that reaches its farthest texel */
};
extern const char *const rsc_area_names[]; /* "texels", "moment", "max", NULL */

struct rsc_area_lights {
    struct irb_buffer *discs;    /* as core/lights/virtual_light.h has them */
    struct irb_buffer *polygons; /* as shaders/lights/polygon_light.glsl has them; NULL until asked
                                    for */
    int count;                   /* of the last run */
    int corners;                 /* of its polygons: 0, 8 or 16 */
    struct irb_program *programs[2][2][3]; /* private: by layout, reduction, corners */
    struct irb_gl *gl;                     /* borrowed */
};

struct rsc_area_lights *rsc_area_lights_create(struct irb_gl *gl, struct irb_error *err);
void rsc_area_lights_destroy(struct rsc_area_lights *lights);

/* Makes room. Before the timed stage. */
bool rsc_area_lights_prepare(struct rsc_area_lights *lights, int clusters, int corners,
                             struct irb_error *err);
/* From updated clusters. corners: of the polygons, 8 or 16; 0 for none. */
bool rsc_area_lights_make(struct rsc_area_lights *lights, const struct rsc_clusters *clusters,
                          const struct irb_rsm *rsm, const struct rsc_settings *settings,
                          enum rsc_area area, int corners, struct irb_error *err);

/* Of the last run: discs, or what is to light the scene, polygons where there are any. */
struct irb_virtual_lights rsc_area_lights_discs(const struct rsc_area_lights *lights);
struct irb_virtual_lights rsc_area_lights_view(const struct rsc_area_lights *lights);

#endif
