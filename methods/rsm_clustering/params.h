/* SPDX-License-Identifier: MIT
 *
 * The parameters of the method rsm-clustering, and the settings of its parts that they come to.
 */
#ifndef IRB_METHODS_RSM_CLUSTERING_PARAMS_H
#define IRB_METHODS_RSM_CLUSTERING_PARAMS_H

#include "core/lights/importance.h"
#include "core/lights/ism.h"
#include "core/lights/shade.h"
#include "core/lights/val_lighting.h"
#include "methods/rsm_clustering/area_lights.h"

struct rsc_params {
    int clusters;
    float view_weight;
    int view_samples;
    float view_nearest;
    int reseed;
    float w_d, w_n, w_phi;
    int metric_unit, assignment, reach, reduction;
    int shape, area, corners;
    int visibility, point_count;
    float splat_factor;
    int splat_most, pull_push;
    int taps, blocker_taps;
    float bias, slope, offset;
    int vals;
    float w_x, w_a;
    int map_size, csm_order;
    int interleave_n, interleave_m;
    float filter_depth, filter_cosine;
};

extern const struct irb_option rsc_options[];

struct rsc_resolved {
    struct irb_importance_settings importance;
    struct rsc_settings clustering;
    enum rsc_area area;
    int corners; /* of polygons; 0: discs */
    struct irb_points_desc points;
    struct irb_ism_settings ism;
    struct irb_shade_settings shade;
    bool is_clustered; /* shadows from the lights' VALs, whose settings follow */
    struct irb_vals_settings vals;
    struct irb_val_lighting_settings val_lighting;
    int interleave_n, interleave_m;    /* tiles across, up */
    float filter_depth, filter_cosine; /* m, 1 */
};

/* diagonal: of the scene at rest, m, 0 for a scene without extent; seed: of the sequence; frame:
 * how many came before it. IRB_E_INPUT for shadows of what has none, which
 * rsc_params_check() refuses too. */
bool rsc_params_resolve(const struct rsc_params *params, float diagonal, uint64_t seed,
                        unsigned frame, struct rsc_resolved *out, struct irb_error *err);

/* IRB_E_INPUT for settings that do not go together, with an RSM of that many texels a side. */
bool rsc_params_check(const struct rsc_params *params, int rsm_resolution, struct irb_error *err);

/* Whether each light has an imperfect shadow map. */
static inline bool rsc_has_ism(const struct rsc_resolved *r)
{
    return r->shade.visibility != IRB_SHADE_NONE;
}

#endif
