/* SPDX-License-Identifier: MIT */
#include "methods/rsm_clustering/params.h"

#include "core/sampling/halton.h"

/* Weight that the view-independent importance keeps at least: without effect on where seeds fall,
 * but for a view that no lit texel faces, where they fall by it alone. Source: ours. */
static const float least_brdf_weight = 1e-6f;

enum { RESEED_SAME, RESEED_NEXT };
static const char *const reseeds[] = {"same", "next", NULL};
enum { UNIT_METRES, UNIT_BBOX };
static const char *const units[] = {"metres", "bbox", NULL};
enum { ASSIGN_GRID, ASSIGN_BRUTE };
static const char *const assignments[] = {"grid", "brute", NULL};
enum { SHAPE_DISC, SHAPE_POLYGON };
static const char *const shapes[] = {"disc", "polygon", NULL};
static const char *const corner_counts[] = {"8", "16", NULL};
/* Up to `clustered` in the order of enum irb_shade_visibility. */
enum { VISIBILITY_CLUSTERED = IRB_SHADE_PCSS + 1 };
static const char *const visibilities[] = {"none", "ism", "pcss", "clustered", NULL};

#define P struct rsc_params
const struct irb_option rsc_options[] = {
    IRB_OPTION_INT(
        P, clusters, 1024, 1, RSC_MOST_CLUSTERS, "",
        "k: clusters, and area lights but for empty ones; at most 1024 with imperfect shadow "
        "maps, 2048 with visibility=clustered",
        "Prutkin et al. 2012, table 1: 256, 1024"),
    IRB_OPTION_FLOAT(
        P, view_weight, 1, 0, 1, "",
        "importance by which seeds are drawn: share of the geometry terms with visible "
        "points (1: the paper's); the rest is the intensity that a texel reflects",
        "Prutkin et al. 2012, section 4"),
    IRB_OPTION_INT(P, view_samples, 256, 1, IRB_IMPORTANCE_MOST_VIEW_SAMPLES, "",
                   "Halton-distributed pixels of the G-buffer that geometry terms are taken with",
                   "Prutkin et al. 2012, section 4"),
    IRB_OPTION_FLOAT(P, view_nearest, 0.05, 1e-6, 10, "",
                     "distance, as a share of the scene's diagonal, below which a geometry term "
                     "does not grow any more: bounds the spikes of 1/r^2",
                     "ours"),
    IRB_OPTION_ENUM(P, reseed, RESEED_SAME, reseeds,
                    "an empty cluster's new seed: the same Halton point warped by the frame's "
                    "importance, or a next one of the sequence",
                    "Prutkin et al. 2012, algorithm 1: same; section 4: a new seed point"),
    IRB_OPTION_FLOAT(
        P, w_d, 1, 0, 1e6, "",
        "weight of the squared distance. The paper sets w_d, w_n, w_phi to 1, 10, 0 in "
        "the Cornell box, and to 1, 1, 10 elsewhere",
        "Prutkin et al. 2012, eq. 1, section 6"),
    IRB_OPTION_FLOAT(P, w_n, 1, 0, 1e6, "", "weight of the normals' difference 1 - n_p.n_c",
                     "Prutkin et al. 2012, eq. 1, section 6"),
    IRB_OPTION_FLOAT(P, w_phi, 10, 0, 1e6, "",
                     "weight of the squared difference of the normalised colours",
                     "Prutkin et al. 2012, eq. 1, section 6"),
    IRB_OPTION_ENUM(P, metric_unit, UNIT_METRES, units,
                    "unit of the distances in eq. 1: metres, or the diagonal of the scene at rest, "
                    "by which the clustering does not depend on the scene's scale",
                    "Prutkin et al. 2012: metres; bbox: ours"),
    IRB_OPTION_ENUM(
        P, assignment, ASSIGN_GRID, assignments,
        "clusters that a texel chooses from: those in near cells of a sqrt(k) x sqrt(k) "
        "grid over the RSM, or all",
        "Prutkin et al. 2012, section 4"),
    IRB_OPTION_INT(P, reach, 2, 0, 128, "cells",
                   "r: grid cells from the texel's up to which clusters are looked for",
                   "Prutkin et al. 2012, section 4: r = 2"),
    IRB_OPTION_ENUM(
        P, reduction, RSC_SORT, rsc_reduction_names,
        "how a cluster finds its texels: all sorted by cluster (bitonic) and reordered; "
        "in the window that the grid lets it have; in the whole map. Same sums",
        "Prutkin et al. 2012, section 4: sort, against direct; window: ours"),
    IRB_OPTION_ENUM(P, shape, SHAPE_DISC, shapes, "area lights: discs, or hulls of the clusters",
                    "Prutkin et al. 2012, section 5"),
    IRB_OPTION_ENUM(P, area, RSC_AREA_TEXELS, rsc_area_names,
                    "a disc's area: what its texels see of surfaces; of the disc with the same "
                    "second moment; of the disc that reaches its farthest texel",
                    "ours: Prutkin et al. 2012 does not say"),
    IRB_OPTION_ENUM(P, corners, 0, corner_counts,
                    "corners of a polygon: its extreme texels in so many directions", "ours"),
    IRB_OPTION_ENUM(
        P, visibility, IRB_SHADE_NONE, visibilities,
        "indirect shadows: none; from an imperfect shadow map a light: ism, one look-up, of the "
        "light's centre; or pcss, of its disc by percentage-closer soft shadows; clustered: from "
        "one rasterised convolution soft shadow map for each of few clusters of the lights (VALs), "
        "discs only",
        "Prutkin et al. 2012: none; section 7 proposes both; Dong et al. 2009: clustered"),
    IRB_OPTION_INT(P, point_count, 1000000, 1000, 16000000, "",
                   "shadow maps: points on the scene's surfaces that they are splatted from",
                   "Ritschel et al. 2008; value: ours"),
    IRB_OPTION_FLOAT(
        P, splat_factor, 4, 0.01, 64, "",
        "s_f: maps that each point is splatted into; below 1, share of the points that are",
        "thesis 5.3.2; value: ours"),
    IRB_OPTION_INT(P, splat_most, 16, 1, 128, "texels", "largest side of a splat", "ours"),
    IRB_OPTION_INT(P, pull_push, 2, 0, 5, "levels",
                   "j: levels of pull-push that fill holes of the shadow maps; 0 = off",
                   "Ritschel et al. 2008; value: ours"),
    IRB_OPTION_INT(P, taps, 16, 1, IRB_SHADOW_TAPS_MOST, "", "Poisson-disk taps of a soft shadow",
                   "thesis 5.3.3"),
    IRB_OPTION_INT(P, blocker_taps, 16, 1, IRB_SHADOW_TAPS_MOST, "",
                   "taps of the search for blockers", "thesis 5.3.3; value: ours"),
    IRB_OPTION_FLOAT(P, bias, 0.01, 0, 0.99, "",
                     "share of the distance by which what shadows must be nearer", "ours"),
    IRB_OPTION_FLOAT(P, slope, 2.5, 0, 64, "texels",
                     "the same for the slope of the receiver over so many texels of a shadow map",
                     "ours"),
    IRB_OPTION_FLOAT(P, offset, 1e-3, 0, 1, "",
                     "the same everywhere, as a share of the scene's diagonal", "ours"),
    IRB_OPTION_INT(P, vals, IRB_VALS_DEFAULT_COUNT, 1, IRB_VALS_MOST, "",
                   "clustered: clusters of the lights, with a shadow map each",
                   "Dong et al. 2009; value: as clustered-visibility"),
    IRB_OPTION_FLOAT(P, w_x, IRB_VALS_DEFAULT_W_X, 0, 1e6, "",
                     "clustered: weight of the distance from light to VAL, in diagonals of the "
                     "scene at rest",
                     "thesis eq. 3.7; value: as clustered-visibility"),
    IRB_OPTION_FLOAT(P, w_a, IRB_VALS_DEFAULT_W_A, 0, 1e6, "1/rad",
                     "clustered: weight of the angle between their normals",
                     "thesis eq. 3.7; value: as clustered-visibility"),
    IRB_OPTION_ENUM(P, map_size, IRB_VALS_DEFAULT_MAP_SIZE, irb_vals_map_size_names,
                    "clustered: texels a side of a VAL's shadow map",
                    "thesis 3.2.5; value: as clustered-visibility"),
    IRB_OPTION_INT(P, csm_order, IRB_CSM_DEFAULT_ORDER, 1, IRB_CSM_ORDER_MOST, "",
                   "clustered: M, order of the Fourier series of the shadow test",
                   "thesis eq. 3.5; value: as clustered-visibility"),
    IRB_OPTION_INT(
        P, interleave_n, 1, 1, IRB_INTERLEAVE_MOST, "",
        "n: tiles across of the interleaved shading: each pixel is lit by every nm-th light, and n "
        "x m pixels are averaged where they agree; 1 x 1 = all lights for every pixel",
        "Prutkin et al. 2012: 1; thesis 5.1.4"),
    IRB_OPTION_INT(P, interleave_m, 1, 1, IRB_INTERLEAVE_MOST, "",
                   "m: tiles up of the interleaved shading",
                   "Prutkin et al. 2012: 1; thesis 5.1.4"),
    IRB_OPTION_FLOAT(P, filter_depth, 0.02, 0, 10, "",
                     "alpha: largest difference of two pixels' distances to the camera that the "
                     "filter averages, as a share of the scene's diagonal",
                     "thesis 5.3.3; value: ours"),
    IRB_OPTION_FLOAT(
        P, filter_cosine, 0.9, -1, 1, "",
        "beta: least cosine between the normals of two pixels that the filter averages",
        "thesis 5.3.3; value: ours"),
    IRB_OPTION_END,
};
#undef P

static struct rsc_settings clustering_of(const struct rsc_params *p, float diagonal, uint64_t seed,
                                         unsigned frame)
{
    const float unit = p->metric_unit == UNIT_BBOX && diagonal > 0 ? diagonal : 1;
    return (struct rsc_settings){
        .clusters = p->clusters,
        .weight_distance = p->w_d / unit / unit,
        .weight_normal = p->w_n,
        .weight_colour = p->w_phi,
        .reach = p->assignment == ASSIGN_BRUTE ? -1 : p->reach,
        .reduction = (enum rsc_reduction)p->reduction,
        .first =
            irb_halton_stretch(seed, p->reseed == RESEED_NEXT ? frame : 0, (uint32_t)p->clusters),
    };
}

static struct irb_shade_settings shade_of(const struct rsc_params *p, float diagonal)
{
    return (struct irb_shade_settings){
        .visibility = p->visibility == VISIBILITY_CLUSTERED ? IRB_SHADE_NONE : p->visibility,
        .bias = p->bias,
        .slope = p->slope,
        .offset = p->offset * diagonal,
        .taps = p->taps,
        .blocker_taps = p->blocker_taps,
        .search_scale = 1,
        .penumbra_scale = 1,
    };
}

/* All that has no option is as clustered-visibility has it by default. */
static struct irb_vals_settings vals_of(const struct rsc_params *p, float diagonal)
{
    return (struct irb_vals_settings){
        .vals = p->vals,
        .weight_distance = p->w_x / (diagonal > 0 ? diagonal : 1),
        .weight_angle = p->w_a,
        .iterations = IRB_VALS_DEFAULT_ITERATIONS,
        .start = IRB_VALS_DEFAULT_START,
        .area = IRB_VALS_DEFAULT_AREA,
        .centre = IRB_VALS_DEFAULT_CENTRE,
        .tiles = 1, /* clusters come in the Halton sequence's order */
    };
}

static struct irb_val_lighting_settings val_lighting_of(const struct rsc_params *p, float diagonal)
{
    return (struct irb_val_lighting_settings){
        .visibility = true,
        .discs = true,
        .projection = IRB_VALS_DEFAULT_PROJECTION,
        .size = irb_vals_map_side(p->map_size),
        .near = (float)IRB_VALS_DEFAULT_NEAR * diagonal,
        .order = p->csm_order,
        .prefilter = IRB_CSM_DEFAULT_PREFILTER,
        .csm = {.offset = IRB_CSM_DEFAULT_OFFSET,
                .scale = IRB_CSM_DEFAULT_SCALE,
                .search_offset = (float)IRB_CSM_DEFAULT_SEARCH_OFFSET,
                .damping = IRB_CSM_DEFAULT_DAMPING,
                .search_scale = IRB_CSM_DEFAULT_SEARCH_SCALE,
                .penumbra_scale = IRB_CSM_DEFAULT_PENUMBRA_SCALE},
    };
}

/* Of what shadows take. */
static bool check_shadows(const struct rsc_params *p, struct irb_error *err)
{
    const bool is_clustered = p->visibility == VISIBILITY_CLUSTERED;
    const int most = is_clustered ? IRB_VALS_MOST_LIGHTS : IRB_VPL_BLOCK;
    if (is_clustered && p->shape == SHAPE_POLYGON)
        return irb_fail(err, IRB_E_INPUT,
                        "visibility=clustered takes discs only; use shape=disc or "
                        "visibility=pcss");
    if (p->visibility != IRB_SHADE_NONE && p->clusters > most)
        return irb_fail(err, IRB_E_INPUT,
                        "visibility=%s takes at most %d clusters, found %d; use "
                        "fewer clusters or visibility=none",
                        visibilities[p->visibility], most, p->clusters);
    return true;
}

bool rsc_params_check(const struct rsc_params *p, int rsm_resolution, struct irb_error *err)
{
    if (!check_shadows(p, err))
        return false;
    if (p->reduction == RSC_SORT && p->clusters > rsc_most_sorted(rsm_resolution))
        return irb_fail(err, IRB_E_INPUT,
                        "reduction=sort: expected at most %lld clusters of an RSM of %d x %d "
                        "texels, found %d; use reduction=window",
                        (long long)rsc_most_sorted(rsm_resolution), rsm_resolution, rsm_resolution,
                        p->clusters);
    return true;
}

bool rsc_params_resolve(const struct rsc_params *p, float diagonal, uint64_t seed, unsigned frame,
                        struct rsc_resolved *out, struct irb_error *err)
{
    if (!check_shadows(p, err))
        return false;
    *out = (struct rsc_resolved){
        .importance = {.diffuse_weight = 1,
                       .view_weight = p->view_weight < 1 ? p->view_weight : 1 - least_brdf_weight,
                       .view_samples = p->view_samples,
                       .norm = IRB_IMPORTANCE_NORM_MAX,
                       .first = irb_halton_stretch(seed, 0, (uint32_t)p->view_samples),
                       .view_form = IRB_IMPORTANCE_GEOMETRY,
                       .view_nearest = p->view_nearest * (diagonal > 0 ? diagonal : 1)},
        .clustering = clustering_of(p, diagonal, seed, frame),
        .area = (enum rsc_area)p->area,
        .corners = p->shape == SHAPE_POLYGON ? (p->corners ? 16 : 8) : 0,
        .points = {.kind = IRB_POINTS_AREA, .count = p->point_count, .seed = seed},
        .ism = {.splatter = IRB_ISM_ATOMIC,
                .splat_factor = p->splat_factor,
                .splat_scale = 1,
                .splat_most = p->splat_most,
                .near = 1e-3f,
                .near_radii = 1,
                .pull_push = p->pull_push,
                .pull = IRB_ISM_MEDIAN},
        .shade = shade_of(p, diagonal),
        .is_clustered = p->visibility == VISIBILITY_CLUSTERED,
        .vals = vals_of(p, diagonal),
        .val_lighting = val_lighting_of(p, diagonal),
        .interleave_n = p->interleave_n,
        .interleave_m = p->interleave_m,
        .filter_depth = p->filter_depth * diagonal,
        .filter_cosine = p->filter_cosine,
    };
    return true;
}
