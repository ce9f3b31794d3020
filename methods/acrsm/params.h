/* SPDX-License-Identifier: MIT
 *
 * The parameters of the method acrsm, and the settings of its parts that they come to.
 *
 * `preset` decides the switches that are `auto`: where the thesis's reading is not what is built by
 * default. A switch that is set to anything else stands, whatever the preset; all other parameters
 * are the thesis's by default and not touched by it.
 */
#ifndef IRB_METHODS_ACRSM_PARAMS_H
#define IRB_METHODS_ACRSM_PARAMS_H

#include "core/lights/ism.h"
#include "core/lights/shade.h"
#include "methods/acrsm/clusters.h"

struct acrsm_params {
    int preset;
    int clusters, square;
    bool adaptive, reseed;
    float epsilon_merge, epsilon_split, evaluated, neighbourhood, split_radius;
    int neighbours;
    float w_x, w_n, w_rho;
    int normal_metric, cover, area, flux, space;
    float diffuse_weight, view_weight;
    int view_samples, importance_norm, warp_levels;
    int form_factor, visibility;
    int points;
    float f_min, f_max;
    int smoothstep, splatter;
    float splat_factor, splat_scale;
    int splat_size; /* enum irb_ism_size */
    float near_radii;
    int splat_most;
    float near;
    int pull_push, pull;
    int taps, blocker_taps;
    float search_scale, penumbra_scale, bias, slope, offset;
    int interleave_n, interleave_m;
    float filter_depth, filter_cosine;
};

extern const struct irb_option acrsm_options[];

enum acrsm_points { ACRSM_POINTS_STATIC, ACRSM_POINTS_DYNAMIC };

struct acrsm_resolved {
    struct acrsm_settings clustering;
    struct irb_importance_settings importance;
    struct irb_points_desc points;
    bool dynamic_points; /* no point set: tessellation at every frame */
    struct irb_ism_settings ism;
    struct irb_shade_settings shade;
    float filter_depth, filter_cosine; /* m, 1 */
};

/* diagonal: of the scene at rest, m, 0 for a scene without extent; seed: of the sequence. */
void acrsm_params_resolve(const struct acrsm_params *params, int rsm_resolution, float diagonal,
                          uint64_t seed, struct acrsm_resolved *out);

/* Whether the lights have shadow maps. */
static inline bool acrsm_has_shadows(const struct acrsm_resolved *r)
{
    return r->shade.visibility != IRB_SHADE_NONE;
}

#endif
