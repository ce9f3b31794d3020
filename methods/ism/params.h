/* SPDX-License-Identifier: MIT
 *
 * Parameters of imperfect shadow maps.
 */
#ifndef IRB_METHODS_ISM_PARAMS_H
#define IRB_METHODS_ISM_PARAMS_H

#include "core/base/option.h"

enum ism_sequence { ISM_FIXED, ISM_RANDOM };
enum ism_importance { ISM_FLUX, ISM_BIDIRECTIONAL };
enum ism_visibility { ISM_UNOCCLUDED, ISM_IMPERFECT, ISM_EXACT_RASTER };
enum ism_points { ISM_AREA, ISM_STATIC, ISM_DYNAMIC };
enum ism_splatter { ISM_SPLAT_ATOMIC, ISM_SPLAT_RASTER };
enum ism_map_size { ISM_MAP_32, ISM_MAP_64, ISM_MAP_128, ISM_MAP_256, ISM_MAP_512 };

struct ism_params {
    int vpls;
    int sequence;   /* enum ism_sequence */
    int importance; /* enum ism_importance */
    float view_weight;
    int view_samples;
    int visibility; /* enum ism_visibility */
    int points;     /* enum ism_points */
    int point_count;
    bool redraw_points;
    float adaptive_points;
    float f_min, f_max;
    int smoothstep; /* enum irb_smoothstep */
    int splatter;   /* enum ism_splatter */
    float splat_factor, splat_scale;
    int splat_size; /* enum irb_ism_size */
    int splat_most;
    float near;
    int map_size; /* enum ism_map_size */
    int pull_push;
    int pull; /* enum irb_ism_pull */
    float bias, slope, offset;
    int interleave_n, interleave_m;
    float filter_depth, filter_cosine;
    float clamp;
};

extern const struct irb_option ism_options[];

/* Points are made in every frame, from its lights. */
static inline bool ism_adapts_points(const struct ism_params *params)
{
    return params->points == ISM_AREA && params->adaptive_points > 0;
}

/* Side of a map, texels. */
static inline int ism_map_side(const struct ism_params *params)
{
    return 32 << params->map_size;
}

#endif
