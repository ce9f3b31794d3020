/* SPDX-License-Identifier: MIT
 *
 * Adaptive clustering of a reflective shadow map (thesis chapter 4, 5.1.2, 5.3.1): k clusters that
 * live from frame to frame, one k-means iteration a frame, on the GPU throughout. A frame is
 *
 *     acrsm_evaluate   merges and splits clusters by last frame's state      (4.8, eqs 4.6-4.8)
 *     acrsm_carry      brings them along with the light
 *     acrsm_seed       (re-)seeds and warps those without texels             (4.4, 4.5)
 *     acrsm_map        gives each lit texel to a cluster                     (4.6, eqs 4.4, 4.5)
 *     acrsm_average    new centres, flux and areas; the area lights          (4.7)
 *
 * in this order, so that what was split or seeded is mapped and averaged before it lights. Same
 * inputs, same bits: sums are ordered, atomics are on bits of integers. Nothing is read back.
 *
 * A texel is lit where its reflected flux is not 0 in some channel.
 */
#ifndef IRB_METHODS_ACRSM_CLUSTERS_H
#define IRB_METHODS_ACRSM_CLUSTERS_H

#include "core/lights/cluster_census.h"
#include "core/lights/cluster_map.h"
#include "core/lights/importance.h"
#include "core/lights/pyramid.h"
#include "core/lights/virtual_light.h"

/* Thesis 5.1.2: k lies in [m, M]. */
enum { ACRSM_CLUSTERS_LEAST = 16, ACRSM_CLUSTERS_MOST = 512 };

enum acrsm_cover { ACRSM_COVER_SQUARE, ACRSM_COVER_NEAREST };
enum acrsm_area { ACRSM_AREA_MAX, ACRSM_AREA_MOMENT };
enum acrsm_flux { ACRSM_FLUX_SUM, ACRSM_FLUX_CENTER, ACRSM_FLUX_CENTER_AREA };
enum acrsm_normals { ACRSM_NORMALS_ABS, ACRSM_NORMALS_SIGNED };
enum acrsm_neighbours { ACRSM_NEIGHBOURS_LIST, ACRSM_NEIGHBOURS_MAP };
enum acrsm_space { ACRSM_SPACE_LIGHT, ACRSM_SPACE_WORLD };

struct acrsm_settings {
    int clusters;  /* k */
    int square;    /* i: side of the region that a cluster can take, texels of this RSM, >= 1 */
    bool adaptive; /* evaluation */
    bool reseed;   /* of vanished clusters */
    float merge, split;  /* epsilon_m, epsilon_s, >= 0 */
    float share;         /* of the clusters that are evaluated in a frame, [0,1] */
    float neighbourhood; /* side of the evaluated square, in sides of a cluster's */
    float split_radius;  /* share of a cluster's radius in which a split's seed lies, [0,1] */
    int neighbours;      /* enum acrsm_neighbours: how they are found; the same ones */
    float w_position, w_normal, w_importance; /* of eq. 4.4, >= 0 */
    float extent;                             /* m: b_max of eq. 4.4, > 0 */
    int normals;                              /* enum acrsm_normals: metric */
    int cover;       /* enum acrsm_cover: of texels outside of all squares */
    int area;        /* enum acrsm_area */
    int flux;        /* enum acrsm_flux: of the lights */
    int space;       /* enum acrsm_space: in which clusters rest while the light moves */
    int warp_levels; /* of the importance pyramid, from the 2 x 2 level down */
    int tiles;       /* >= 1: of the interleaved shading (core/frame/interleave.h): seeds of the
                        clusters i with the same i mod tiles are consecutive Halton points */
};

/* The state of a cluster as GPU buffers hold it (shaders/methods/acrsm/cluster.glsl; thesis table
 * 5.2). What is not in use has flux, area and irradiance 0. */
struct acrsm_cluster {
    float position[3], area;     /* m, world; m2 */
    float normal[3], importance; /* unit; rho */
    float flux[3], irradiance;   /* W, sum over its texels; W/m2 at its centre, mean of channels */
    float uv[2], unused[2];      /* of its centre in the RSM, [0,1], from the lower left */
    float centre_flux[3];        /* W, of the texel at its centre */
    int count;                   /* texels; <= 0 not in use */
};

/* Of the last evaluation, for each cluster: sums over its neighbours (thesis table 5.2), and its
 * own delta (eq. 4.6). */
struct acrsm_verification {
    float sum_squares, sum, delta, unused;
};

enum acrsm_program {
    ACRSM_EVALUATE,
    ACRSM_EVALUATE_MAP,
    ACRSM_MERGE_SPLIT,
    ACRSM_CARRY_LIGHT,
    ACRSM_CARRY_WORLD,
    ACRSM_RESEED,
    ACRSM_SEED,
    ACRSM_BIN,
    ACRSM_MAP, /* + 2 cover + normals: 4 variants */
    ACRSM_AVERAGE = ACRSM_MAP + 4,
    ACRSM_CENTRES,
    ACRSM_LIGHTS,                     /* + flux: 3 variants */
    ACRSM_PICTURE = ACRSM_LIGHTS + 3, /* + enum acrsm_picture */
    ACRSM_PROGRAMS = ACRSM_PICTURE + 2
};

/* Where a light stands, world. */
struct acrsm_light_pose {
    float position[3], right[3], up[3], direction[3];
};

struct acrsm_clusters {
    struct irb_texture *map;       /* RG32UI, resolution^2: cluster of each texel; cluster that has
                                      its centre here (core/lights/cluster_map.h) */
    struct irb_buffer *state;      /* ACRSM_CLUSTERS_MOST struct acrsm_cluster */
    struct irb_buffer *evaluation; /* as many struct acrsm_verification; a random order, uint32 */
    struct irb_buffer *lights;     /* IRB_VPL_BLOCK virtual lights */
    struct irb_buffer *lists;      /* private, as the rest */
    struct irb_buffer *candidates, *presence;
    struct irb_cluster_counter counter;
    struct irb_buffer *carry; /* sums that go on in another dispatch; when first asked for */
    struct irb_program *program[ACRSM_PROGRAMS]; /* each made when first asked for */
    enum irb_layout layout;                      /* of the RSM that they read */
    int resolution;
    int active;     /* k of the last frame; 0 before the first */
    uint32_t seed;  /* of the sequence */
    uint32_t frame; /* frames since begin */
    bool lit_once;  /* `pose` is that of the last frame */
    struct acrsm_light_pose pose;
    struct irb_gl *gl; /* borrowed */
};

struct acrsm_clusters *acrsm_clusters_create(struct irb_gl *gl, int rsm_resolution,
                                             struct irb_error *err);
void acrsm_clusters_destroy(struct acrsm_clusters *clusters);

/* Forgets all clusters. Seeds differ in the Halton points and in what evaluation draws. */
bool acrsm_clusters_begin(struct acrsm_clusters *clusters, uint64_t seed, struct irb_error *err);

/* Starts a frame: k becomes settings->clusters; further clusters are new, surplus ones (the highest
 * numbers) end. The RSM is of the clusters' resolution. */
bool acrsm_clusters_frame(struct acrsm_clusters *clusters, const struct irb_rsm *rsm,
                          const struct acrsm_settings *settings, struct irb_error *err);

bool acrsm_evaluate(struct acrsm_clusters *clusters, const struct irb_rsm *rsm,
                    const struct acrsm_settings *settings, struct irb_error *err);
bool acrsm_carry(struct acrsm_clusters *clusters, const struct irb_rsm *rsm,
                 const struct acrsm_settings *settings, struct irb_error *err);
/* `importance`: R32F of the RSM's size, with its pyramid. */
bool acrsm_seed(struct acrsm_clusters *clusters, const struct irb_rsm *rsm,
                const struct irb_texture *importance, const struct irb_pyramid *pyramid,
                const struct acrsm_settings *settings, struct irb_error *err);
bool acrsm_map(struct acrsm_clusters *clusters, const struct irb_rsm *rsm,
               const struct irb_texture *importance, const struct acrsm_settings *settings,
               struct irb_error *err);
bool acrsm_average(struct acrsm_clusters *clusters, const struct irb_rsm *rsm,
                   const struct irb_light *light, const struct irb_texture *importance,
                   const struct acrsm_settings *settings, struct irb_error *err);

/* k lights, of which those of clusters that are not in use are dark. */
static inline struct irb_virtual_lights acrsm_clusters_lights(const struct acrsm_clusters *c)
{
    return (struct irb_virtual_lights){.buffer = c->lights, .count = c->active};
}

/* What a frame's report says; waits for the GPU. Shares are of the RSM's reflected flux (mean of
 * the channels), 0 where there is none. */
struct acrsm_report {
    int in_use, seeded, merged, split;
    double uncovered; /* share of the flux of lit texels that no cluster has */
    double gain;      /* flux of the lights minus that of the clusters' texels, as a share; 0 but
                         for rounding with ACRSM_FLUX_SUM */
    double spread;    /* coefficient of variation of delta_c (eq. 4.6) over the clusters in use */
    double count_spread; /* the same of the numbers of texels */
};
bool acrsm_clusters_report(struct acrsm_clusters *clusters, const struct irb_rsm *rsm,
                           struct acrsm_report *report, struct irb_error *err);

/* Pictures (RGBA32F, resolution^2) for debugging: the clusters in colours that stay, and with their
 * centres marked. */
enum acrsm_picture { ACRSM_PICTURE_MAP, ACRSM_PICTURE_CENTRES };
bool acrsm_clusters_picture(struct acrsm_clusters *clusters, enum acrsm_picture kind,
                            const struct irb_texture *picture, struct irb_error *err);

/* Private: a program for RSMs of the clusters' layout; the bindings of shaders/methods/acrsm/; a
 * number of invocations in groups of 64, and a barrier for all that the next pass may read. */
const struct irb_program *acrsm_program(struct acrsm_clusters *clusters, enum acrsm_program which,
                                        struct irb_error *err);
void acrsm_bind_buffers(const struct acrsm_clusters *clusters);
void acrsm_dispatch(const struct acrsm_clusters *clusters, int64_t invocations);
void acrsm_barrier(const struct acrsm_clusters *clusters);
/* A work group of ACRSM_GROUP for each active cluster, in as many dispatches as `parts` parts of
 * its loops take, at_once in each (core/gl/context.h, IRB_LOOP_ROUNDS_MOST): uniforms first_part
 * and end_part; sums that go on lie in the shader's buffer `carry`. */
bool acrsm_dispatch_parts(struct acrsm_clusters *clusters, const struct irb_program *program,
                          int parts, int at_once, struct irb_error *err);
enum { ACRSM_GROUP = 64 };
enum { ACRSM_MERGED_OFFSET = 4 }; /* bytes, in `lists`: merged, split, re-seeded; uint32 */
uint32_t acrsm_frame_seed(const struct acrsm_clusters *clusters);

#endif
