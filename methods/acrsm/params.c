/* SPDX-License-Identifier: MIT */
#include "methods/acrsm/params.h"

#include "core/lights/tessellation.h"
#include "core/sampling/halton.h"

#include <math.h>

/* Of an RSM that the thesis's sizes in texels are for (5.1.1). */
enum { THESIS_RESOLUTION = 512 };

enum { PRESET_OURS, PRESET_THESIS };
static const char *const presets[] = {"ours", "thesis", NULL};
/* AUTO: what the preset says. The others in the order of the enums of clusters.h, importance.h and
 * ism.h. */
enum { AUTO };
static const char *const fluxes[] = {"auto", "sum", "center", "center-area", NULL};
static const char *const norms[] = {"auto", "max", "none", NULL};
static const char *const neighbour_searches[] = {"auto", "list", "map", NULL};
static const char *const splatters[] = {"auto", "atomic", "raster", NULL};
static const char *const normal_metrics[] = {"abs", "signed", NULL};
static const char *const covers[] = {"square", "nearest", NULL};
static const char *const areas[] = {"max", "moment", NULL};
static const char *const spaces[] = {"light", "world", NULL};
enum { FORM_VAL, FORM_VPL };
static const char *const form_factors[] = {"val", "vpl", NULL};
static const char *const visibilities[] = {"none", "ism", "pcss", NULL};
static const char *const point_kinds[] = {"static", "dynamic", NULL};

#define P struct acrsm_params
const struct irb_option acrsm_options[] = {
    IRB_OPTION_ENUM(P, preset, PRESET_OURS, presets,
                    "what `auto` means below: flux sum, importance_norm max, neighbours list, "
                    "splatter atomic; or the thesis's reading: center, none, map, raster. What is "
                    "not auto stands, whatever the preset",
                    "ours"),
    IRB_OPTION_INT(P, clusters, 128, ACRSM_CLUSTERS_LEAST, ACRSM_CLUSTERS_MOST, "",
                   "k: clusters, area lights and shadow maps", "thesis 5.1.2"),
    IRB_OPTION_INT(P, square, 128, 16, 512, "texels",
                   "i: side of the square round its centre in which a cluster takes texels, for an "
                   "RSM of 512; in proportion for others",
                   "thesis 4.6, 5.3.1: 64-256; 6.4: 128"),
    IRB_OPTION_BOOL(P, adaptive, true,
                    "evaluation: clusters that are too small for their neighbourhood are merged, "
                    "too large ones split",
                    "thesis 4.8"),
    IRB_OPTION_BOOL(P, reseed, true,
                    "clusters without texels are seeded anew; without it merged clusters that no "
                    "split takes stay as they are",
                    "thesis 4.4, 4.6"),
    IRB_OPTION_FLOAT(P, epsilon_merge, 0.4, 0, 1e6, "",
                     "epsilon_m: merged below delta - mean < -epsilon_m", "thesis 4.8: 0.35-0.5"),
    IRB_OPTION_FLOAT(P, epsilon_split, 0.15, 0, 1e6, "",
                     "epsilon_s: split above delta - mean > epsilon_s", "thesis 4.8: 0.1-0.2"),
    IRB_OPTION_FLOAT(P, evaluated, 1 / 3.0, 0, 1, "",
                     "share of the clusters, drawn anew in each frame, that is evaluated",
                     "thesis 5.3.1: k/3"),
    IRB_OPTION_FLOAT(P, neighbourhood, 2, 1, 16, "",
                     "side of the square in which neighbours are looked for, in sides of a "
                     "cluster's",
                     "thesis 5.3.1: 2i x 2i"),
    IRB_OPTION_ENUM(P, neighbours, AUTO, neighbour_searches,
                    "the same neighbours found in the list of clusters, or among the texels of the "
                    "cluster map at a cost that grows with the square",
                    "map: thesis 5.3.1; list: ours"),
    IRB_OPTION_FLOAT(P, split_radius, 1, 0, 1, "",
                     "a split's seed lies within this share of the cluster's radius, on a texel of "
                     "the cluster's",
                     "thesis 5.3.1: within the radius"),
    IRB_OPTION_FLOAT(P, w_x, 0.9, 0, 1e6, "",
                     "weight of the distance (over the diagonal of the scene at rest) from texel "
                     "to cluster",
                     "thesis eq. 4.4; value: ours"),
    IRB_OPTION_FLOAT(P, w_n, 0.08, 0, 1e6, "", "weight of the normals' difference",
                     "thesis eq. 4.4; value: ours"),
    IRB_OPTION_FLOAT(P, w_rho, 0.02, 0, 1e6, "", "weight of the importances' difference",
                     "thesis eq. 4.4; value: ours"),
    IRB_OPTION_ENUM(P, normal_metric, ACRSM_NORMALS_ABS, normal_metrics,
                    "normals' difference: 1 - |n.c|, which puts both sides of a wall together, or "
                    "1 - max(0, n.c)",
                    "thesis 4.6; signed: ours"),
    IRB_OPTION_ENUM(P, cover, ACRSM_COVER_SQUARE, covers,
                    "lit texels in no cluster's square: lost, or the nearest cluster's",
                    "thesis 4.6; nearest: ours"),
    IRB_OPTION_ENUM(P, area, ACRSM_AREA_MAX, areas,
                    "a cluster's area: of the disc through its farthest texel, or of the disc with "
                    "the same second moment",
                    "thesis 4.7; moment: ours"),
    IRB_OPTION_ENUM(P, flux, AUTO, fluxes,
                    "a cluster's flux: sum over its texels; its centre's times their number; its "
                    "centre's times the number of all texels times its share of the clusters' area",
                    "thesis 4.7, figure 6.1; sum: ours"),
    IRB_OPTION_ENUM(P, space, ACRSM_SPACE_LIGHT, spaces,
                    "what clusters rest in from frame to frame: the light's view, or the world",
                    "thesis 5.1.2: view space; world: ours"),
    IRB_OPTION_FLOAT(
        P, diffuse_weight, 0.5, 0, 1, "",
        "w_d: weight of the diffuse part of the importance; the rest is the specular's",
        "thesis eq. 4.1; value: ours"),
    IRB_OPTION_FLOAT(P, view_weight, 0, 0, 1, "",
                     "w_v: weight of the view-dependent part of the importance; 0 = off",
                     "thesis eq. 4.3; value: ours"),
    IRB_OPTION_INT(P, view_samples, 16, 1, IRB_IMPORTANCE_MOST_VIEW_SAMPLES, "",
                   "M: visible points that the view-dependent importance is a mean over",
                   "thesis eq. 4.2; value: ours"),
    IRB_OPTION_ENUM(
        P, importance_norm, AUTO, norms,
        "BRDF-derived importance divided by its maximum over the RSM, or as it is: then "
        "the thresholds depend on the light's unit",
        "thesis 4.5; max: ours"),
    IRB_OPTION_INT(P, warp_levels, 12, 0, 12, "",
                   "levels of the importance pyramid that a seed descends; 0 = no warping",
                   "thesis 4.5, algorithm 5.3; value: ours"),
    IRB_OPTION_ENUM(P, form_factor, FORM_VAL, form_factors,
                    "of an area light (bounded), or of a point light", "thesis eqs 5.5, 3.6"),
    IRB_OPTION_ENUM(
        P, visibility, IRB_SHADE_PCSS, visibilities,
        "indirect shadows: none; or from an imperfect shadow map a light: ism, one look-up, of the "
        "light's centre; or pcss, of its disc by percentage-closer soft shadows",
        "thesis 5.3.3"),
    IRB_OPTION_ENUM(P, points, ACRSM_POINTS_STATIC, point_kinds,
                    "of the scene, that shadow maps are splatted from: tessellated once by "
                    "algorithm 5.2, or by the tessellator in each frame",
                    "thesis 5.2, 5.3.2"),
    IRB_OPTION_FLOAT(P, f_min, 5, 1, 64, "", "least tessellation factor", "thesis 6.2: f[5,32]"),
    IRB_OPTION_FLOAT(P, f_max, 32, 1, 64, "", "largest tessellation factor", "thesis 6.2: f[5,32]"),
    IRB_OPTION_ENUM(P, smoothstep, IRB_SMOOTHSTEP_3, irb_smoothstep_names,
                    "order of the polynomial between the least and the largest factor",
                    "thesis eqs 5.3, 5.4"),
    IRB_OPTION_ENUM(P, splatter, AUTO, splatters,
                    "static points: the same maps by a compute shader, or by drawn points with a "
                    "depth test",
                    "raster: thesis 5.3.2; atomic: ours"),
    IRB_OPTION_FLOAT(
        P, splat_factor, 1, 0.01, 64, "",
        "s_f: maps that each point is splatted into; below 1, share of the points that "
        "are",
        "thesis 5.3.2; table 6.1: 1, 1, 0.3"),
    IRB_OPTION_ENUM(P, splat_size, IRB_ISM_SIZE_EVEN, irb_ism_size_names,
                    "splats as large as if all points stood for the same part of the surface and "
                    "faced the light, or as the part of its triangle that each stands for looks",
                    "even: thesis 5.3.2; surface: ours"),
    IRB_OPTION_FLOAT(P, splat_scale, 0.7, 0.05, 16, "",
                     "size of a splat; 1 = of the surface that one splat of a map stands for",
                     "thesis 5.3.2; value: ours"),
    IRB_OPTION_INT(P, splat_most, 16, 1, 128, "texels", "largest side of a splat", "ours"),
    IRB_OPTION_FLOAT(
        P, near, 1e-3, 0, 1, "",
        "points nearer to a light than this share of the scene's diagonal are left out "
        "of its map: those of its own surface",
        "ours"),
    IRB_OPTION_FLOAT(P, near_radii, 1, 0, 16, "",
                     "likewise, in radii of the area light, whose own surface lies before its "
                     "centre where it bends; 0 = off",
                     "ours"),
    IRB_OPTION_INT(P, pull_push, 0, 0, 5, "levels",
                   "j: levels of pull-push that fill holes of the shadow maps; 0 = off",
                   "thesis 5.3.2; table 6.1: 0-2"),
    IRB_OPTION_ENUM(P, pull, IRB_ISM_MEDIAN, irb_ism_pull_names,
                    "pull-push: median of four, or mean of what is close",
                    "thesis 5.3.2; mean: Ritschel et al. 2008"),
    IRB_OPTION_INT(P, taps, 16, 1, IRB_SHADOW_TAPS_MOST, "", "Poisson-disk taps of a soft shadow",
                   "thesis 5.3.3"),
    IRB_OPTION_INT(P, blocker_taps, 16, 1, IRB_SHADOW_TAPS_MOST, "",
                   "taps of the search for blockers", "thesis 5.3.3; value: ours"),
    IRB_OPTION_FLOAT(P, search_scale, 1, 0, 16, "",
                     "radius of the blocker search, in radii of the area light at the receiver's "
                     "distance",
                     "thesis 3.1.1; value: ours"),
    IRB_OPTION_FLOAT(P, penumbra_scale, 1, 0, 16, "", "factor of the penumbra's width",
                     "thesis eq. 3.2; value: ours"),
    IRB_OPTION_FLOAT(P, bias, 0.01, 0, 0.99, "",
                     "share of the distance by which what shadows must be nearer", "ours"),
    IRB_OPTION_FLOAT(P, slope, 2.5, 0, 64, "texels",
                     "the same for the slope of the receiver over so many texels of a shadow map",
                     "ours"),
    IRB_OPTION_FLOAT(P, offset, 1e-3, 0, 1, "",
                     "the same everywhere, as a share of the scene's diagonal", "ours"),
    IRB_OPTION_INT(P, interleave_n, 3, 1, IRB_INTERLEAVE_MOST, "",
                   "n: tiles across of the interleaved shading", "thesis 5.1.4"),
    IRB_OPTION_INT(P, interleave_m, 3, 1, IRB_INTERLEAVE_MOST, "",
                   "m: tiles up of the interleaved shading", "thesis 5.1.4"),
    IRB_OPTION_FLOAT(P, filter_depth, 0.05, 0, 10, "",
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

/* The value of a switch that has `auto` before its values. */
static int choose(const struct acrsm_params *p, int value, int ours, int thesis)
{
    if (value != AUTO)
        return value - 1;
    return p->preset == PRESET_THESIS ? thesis : ours;
}

static int square_of(const struct acrsm_params *p, int rsm_resolution)
{
    const double side = round((double)p->square * rsm_resolution / THESIS_RESOLUTION);
    return side > 1 ? (int)side : 1;
}

static struct acrsm_settings clustering_of(const struct acrsm_params *p, int rsm_resolution,
                                           float diagonal)
{
    return (struct acrsm_settings){
        .clusters = p->clusters,
        .square = square_of(p, rsm_resolution),
        .adaptive = p->adaptive,
        .reseed = p->reseed,
        .merge = p->epsilon_merge,
        .split = p->epsilon_split,
        .share = p->evaluated,
        .neighbourhood = p->neighbourhood,
        .split_radius = p->split_radius,
        .neighbours = choose(p, p->neighbours, ACRSM_NEIGHBOURS_LIST, ACRSM_NEIGHBOURS_MAP),
        .w_position = p->w_x,
        .w_normal = p->w_n,
        .w_importance = p->w_rho,
        .extent = diagonal > 0 ? diagonal : 1,
        .normals = p->normal_metric,
        .cover = p->cover,
        .area = p->area,
        .flux = choose(p, p->flux, ACRSM_FLUX_SUM, ACRSM_FLUX_CENTER),
        .space = p->space,
        .warp_levels = p->warp_levels,
        .tiles = p->interleave_n * p->interleave_m,
    };
}

static struct irb_ism_settings ism_of(const struct acrsm_params *p, bool dynamic, int smoothstep)
{
    const int splatter = choose(p, p->splatter, IRB_ISM_ATOMIC, IRB_ISM_RASTER);
    return (struct irb_ism_settings){
        .splatter = dynamic ? IRB_ISM_TESSELLATION : splatter,
        .splat_factor = p->splat_factor,
        .splat_scale = p->splat_scale,
        .splat_size = p->splat_size,
        .splat_most = p->splat_most,
        .near = p->near,
        .near_radii = p->near_radii,
        .pull_push = p->pull_push,
        .pull = p->pull,
        .f_min = p->f_min,
        .f_max = p->f_max,
        .smoothstep = smoothstep,
    };
}

void acrsm_params_resolve(const struct acrsm_params *p, int rsm_resolution, float diagonal,
                          uint64_t seed, struct acrsm_resolved *out)
{
    const int smoothstep = irb_smoothstep_order(p->smoothstep);
    *out = (struct acrsm_resolved){
        .clustering = clustering_of(p, rsm_resolution, diagonal),
        .importance = {.diffuse_weight = p->diffuse_weight,
                       .view_weight = p->view_weight,
                       .view_samples = p->view_samples,
                       .norm = choose(p, p->importance_norm, IRB_IMPORTANCE_NORM_MAX,
                                      IRB_IMPORTANCE_NORM_NONE),
                       .first = irb_halton_stretch(seed, 0, IRB_IMPORTANCE_MOST_VIEW_SAMPLES)},
        .points = {.kind = IRB_POINTS_TESSELLATION,
                   .f_min = p->f_min,
                   .f_max = p->f_max,
                   .smoothstep = smoothstep},
        .dynamic_points = p->points == ACRSM_POINTS_DYNAMIC,
        .shade = {.visibility = p->visibility,
                  .bias = p->bias,
                  .slope = p->slope,
                  .offset = p->offset * diagonal,
                  .taps = p->taps,
                  .blocker_taps = p->blocker_taps,
                  .search_scale = p->search_scale,
                  .penumbra_scale = p->penumbra_scale,
                  .point_form_factor = p->form_factor == FORM_VPL},
        .filter_depth = p->filter_depth * diagonal,
        .filter_cosine = p->filter_cosine,
    };
    out->ism = ism_of(p, out->dynamic_points, smoothstep);
}
