/* SPDX-License-Identifier: MIT
 *
 * Clustering of an RSM, one iteration of k-means a frame (Prutkin et al. 2012, section 4). A frame
 * is seed, grid, assign, sort, update, in this order; the clusters stay for the next one.
 *
 * Clusters are numbered 0.. and keep their numbers. Texels without flux belong to none.
 */
#ifndef IRB_METHODS_RSM_CLUSTERING_CLUSTERS_H
#define IRB_METHODS_RSM_CLUSTERING_CLUSTERS_H

#include "core/gl/sort.h"
#include "core/lights/cluster_census.h"
#include "core/lights/cluster_map.h"
#include "core/lights/pyramid.h"

#include <stdint.h>

/* RSC_CLUSTER_BITS: of a cluster's number in the keys. */
enum { RSC_CLUSTER_BITS = 14, RSC_MOST_CLUSTERS = 1 << RSC_CLUSTER_BITS };

/* How a cluster finds its texels. All walk over them in raster order. */
enum rsc_reduction {
    RSC_SORT,   /* texels sorted by cluster and reordered, a range each (the paper) */
    RSC_WINDOW, /* each cluster looks through the texels that the grid lets it have */
    RSC_DIRECT, /* each cluster looks through the whole map */
};
extern const char *const rsc_reduction_names[]; /* "sort", "window", "direct", NULL */

struct rsc_settings {
    int clusters;          /* k, 1..RSC_MOST_CLUSTERS */
    float weight_distance; /* w_d, 1/m2 */
    float weight_normal;   /* w_n */
    float weight_colour;   /* w_phi */
    int reach; /* r: candidates are the clusters in grid cells that far from a texel's; -1:
                  all clusters are */
    enum rsc_reduction reduction;
    unsigned first; /* index of the Halton point by which cluster 0 is seeded */
};

/* As shaders/methods/rsm_clustering/cluster.glsl has it. */
struct rsc_cluster {
    float centre[3], texels;   /* m; how many, 0 where it is empty */
    float normal[3], area;     /* unit; m2, of its texels */
    float flux[3], texel_area; /* W; m2, mean */
    float cell[2], seeded, unused;
};

struct rsc_clusters {
    int resolution;              /* of the RSM */
    int count;                   /* k of the last seeding; 0: no history */
    struct irb_buffer *clusters; /* struct rsc_cluster each */
    struct irb_texture *map;     /* core/lights/cluster_map.h, resolution^2 */
    struct rsc_passes *passes;   /* private */
    struct irb_gl *gl;           /* borrowed */
};

struct rsc_clusters *rsc_clusters_create(struct irb_gl *gl, int resolution, struct irb_error *err);
void rsc_clusters_destroy(struct rsc_clusters *clusters);
/* The next frame seeds all clusters. */
void rsc_clusters_forget(struct rsc_clusters *clusters);

/* The most clusters that RSC_SORT takes of an RSM of that many texels a side: cluster and texel in
 * one key of 32 bits. */
int64_t rsc_most_sorted(int resolution);

/* Makes room for what the settings ask for; before the stages below. IRB_E_INPUT where RSC_SORT's
 * copy of the RSM does not fit into one of the driver's buffers. */
bool rsc_clusters_prepare(struct rsc_clusters *clusters, const struct rsc_settings *settings,
                          struct irb_error *err);

/* New clusters, empty ones and those whose centre has left the light's image are put on texels
 * drawn by the pyramid's map; where all of it is 0 they take no part. */
bool rsc_clusters_seed(struct rsc_clusters *clusters, const struct irb_rsm *rsm,
                       const struct irb_pyramid *pyramid, const struct rsc_settings *settings,
                       struct irb_error *err);
/* Lists the clusters by grid cell. */
bool rsc_clusters_grid(struct rsc_clusters *clusters, const struct rsc_settings *settings,
                       struct irb_error *err);
/* Fills the map. */
bool rsc_clusters_assign(struct rsc_clusters *clusters, const struct irb_rsm *rsm,
                         const struct rsc_settings *settings, struct irb_error *err);
/* RSC_SORT: sorts and reorders the RSM's texels; else nothing. */
bool rsc_clusters_sort(struct rsc_clusters *clusters, const struct irb_rsm *rsm,
                       const struct rsc_settings *settings, struct irb_error *err);
bool rsc_clusters_update(struct rsc_clusters *clusters, const struct irb_rsm *rsm,
                         const struct rsc_settings *settings, struct irb_error *err);

/* For passes that walk over the clusters' texels (shaders/methods/rsm_clustering/members.glsl):
 * the define to compile with, what to bind, and the dispatches over `width` invocations in groups
 * of `group`: as many as the longest walk may take where each texel costs `rounds` rounds of loops
 * (core/gl/context.h). */
const char *rsc_members_define(const struct rsc_settings *settings);
void rsc_members_bind(const struct rsc_clusters *clusters, const struct irb_program *program,
                      const struct irb_rsm *rsm, const struct rsc_settings *settings);
void rsc_members_dispatch(const struct rsc_clusters *clusters, const struct irb_program *program,
                          const struct rsc_settings *settings, int rounds, int width, int group);

/* What a frame's clustering did. */
struct rsc_census {
    int in_use; /* clusters with texels */
    int seeded; /* clusters that were put on a new texel */
    struct irb_cluster_census texels;
};
/* Waits for the GPU. */
bool rsc_clusters_count(struct rsc_clusters *clusters, const struct irb_rsm *rsm,
                        struct rsc_census *census, struct irb_error *err);

#endif
