/* SPDX-License-Identifier: MIT */
#include "methods/ism/params.h"
#include "core/frame/interleave.h"
#include "core/lights/importance.h"
#include "core/lights/ism.h"
#include "core/lights/tessellation.h"

static const char *const sequences[] = {"fixed", "random", NULL};
static const char *const importances[] = {"flux", "bidirectional", NULL};
static const char *const visibilities[] = {"none", "ism", "exact-raster", NULL};
static const char *const point_kinds[] = {"area", "tessellation", "dynamic", NULL};
static const char *const splatters[] = {"atomic", "raster", NULL};
static const char *const map_sizes[] = {"32", "64", "128", "256", "512", NULL};

#define RITSCHEL_2008 "Ritschel et al. 2008"
#define RITSCHEL_2011 "Ritschel et al. 2011"

const struct irb_option ism_options[] = {
    IRB_OPTION_INT(struct ism_params, vpls, 512, 1, IRB_VPL_BLOCK, "",
                   "virtual point lights, each with a shadow map of its own", "thesis 6.1.2"),
    IRB_OPTION_ENUM(struct ism_params, sequence, ISM_FIXED, sequences,
                    "Halton points of the lights: the same in every frame, or another stretch of "
                    "the sequence in each (the seed chooses which)",
                    RITSCHEL_2008 "; thesis 4.4"),
    IRB_OPTION_ENUM(struct ism_params, importance, ISM_FLUX, importances,
                    "lights are drawn in proportion to the flux of the RSM's texels, or to rho: "
                    "what they reflect and how they face what the camera sees",
                    RITSCHEL_2011 " as thesis 4.5 has it, eqs 4.1-4.3 and 5.1 with w_d = 1"),
    IRB_OPTION_FLOAT(
        struct ism_params, view_weight, 0.5, 0, 0.95, "",
        "bidirectional: w_v, the view's part in rho; below 1, so that every texel that "
        "reflects can be drawn",
        "thesis eq. 4.3; value: ours"),
    IRB_OPTION_INT(struct ism_params, view_samples, 64, 1, IRB_IMPORTANCE_MOST_VIEW_SAMPLES, "",
                   "bidirectional: M, visible points that rho_v is the mean over",
                   "thesis eq. 4.2; value: ours"),
    IRB_OPTION_ENUM(struct ism_params, visibility, ISM_IMPERFECT, visibilities,
                    "of the lights: no shadows; imperfect shadow maps; or, as the best that this "
                    "family can do, the triangles rasterised into a hemicube for each light",
                    RITSCHEL_2008 "; exact-raster: ours, with a bias of its own"),
    IRB_OPTION_ENUM(
        struct ism_params, points, ISM_AREA, point_kinds,
        "of the scene: random ones, as dense everywhere; on a grid of each triangle; or "
        "such a grid made in every frame by the tessellation hardware",
        "area: " RITSCHEL_2008 "; thesis 5.2"),
    IRB_OPTION_INT(struct ism_params, point_count, 1 << 20, 1, 1 << 26, "",
                   "area: points of the whole scene; each map gets one in `vpls` of them",
                   RITSCHEL_2008 "; value: as many as the thesis's 512 maps take, 6.2"),
    IRB_OPTION_BOOL(struct ism_params, redraw_points, 0, "area: draw other points in every frame",
                    RITSCHEL_2008),
    IRB_OPTION_FLOAT(struct ism_params, adaptive_points, 0, 0, 0.95, "",
                     "area: share of the points that goes by how large triangles look from the "
                     "frame's lights (mean form factor, no occlusion), the rest by area; made in "
                     "every frame; for splat_size surface",
                     "after " RITSCHEL_2011 "; measure: ours"),
    IRB_OPTION_FLOAT(struct ism_params, f_min, 5, 1, 64, "",
                     "tessellation, dynamic: least factor of an edge or a triangle",
                     "thesis eqs 5.3-5.4, algorithm 5.2"),
    IRB_OPTION_FLOAT(struct ism_params, f_max, 32, 1, 64, "",
                     "tessellation, dynamic: factor of the scene's longest edge and largest "
                     "triangle; with 512 maps the thesis has f[16,64]",
                     "thesis eqs 5.3-5.4, table 6.1"),
    IRB_OPTION_ENUM(struct ism_params, smoothstep, IRB_SMOOTHSTEP_3, irb_smoothstep_names,
                    "tessellation, dynamic: order of the polynomial between the two factors",
                    "thesis 5.2"),
    IRB_OPTION_ENUM(struct ism_params, splatter, ISM_SPLAT_ATOMIC, splatters,
                    "area, tessellation: splats by atomic minima in a compute shader, or drawn as "
                    "points with a depth test",
                    "raster: thesis 5.3.2; atomic: ours"),
    IRB_OPTION_FLOAT(
        struct ism_params, splat_factor, 1, 0.01, 64, "",
        "s_f: maps that each point is splatted into; below 1, share of the points that are",
        "thesis 5.3.2, table 6.1"),
    IRB_OPTION_FLOAT(struct ism_params, splat_scale, 1, 0.05, 16, "",
                     "size of a splat; 1 = as large as the part of the surface that one of a map's "
                     "points stands for",
                     "ours"),
    IRB_OPTION_ENUM(struct ism_params, splat_size, IRB_ISM_SIZE_SURFACE, irb_ism_size_names,
                    "what that part is: the same for all points; or that of the point's own "
                    "triangle, as it looks from the light",
                    "even: thesis 5.3.2; surface: ours"),
    IRB_OPTION_INT(struct ism_params, splat_most, 9, 1, 128, "texels", "largest side of a splat",
                   "ours"),
    IRB_OPTION_FLOAT(struct ism_params, near, 0.002, 0, 1, "",
                     "points nearer to a light than this share of the scene's diagonal are left "
                     "out of its map: those of its own surface",
                     "ours"),
    IRB_OPTION_ENUM(struct ism_params, map_size, ISM_MAP_128, map_sizes,
                    "side of a shadow map, texels; with exact-raster, of a face of the hemicube",
                    "thesis 5.1.3"),
    IRB_OPTION_INT(struct ism_params, pull_push, 4, 0, 9, "levels",
                   "j: levels of pull-push that fill holes of the shadow maps, at most as many as "
                   "the map's side can be halved; 0 = off",
                   "thesis 5.3.2; value: ours"),
    IRB_OPTION_ENUM(struct ism_params, pull, IRB_ISM_MEAN, irb_ism_pull_names,
                    "of four texels: their median, or the mean of those close in depth",
                    "mean: " RITSCHEL_2008 "; median: thesis 5.3.2"),
    IRB_OPTION_FLOAT(
        struct ism_params, bias, 0.05, 0, 0.99, "",
        "a receiver at distance d from a light is in shadow where the map has a surface "
        "nearer than d (1 - bias - slope a tan theta) - offset; a: angle of a texel, "
        "theta: between normal and light",
        "ours"),
    IRB_OPTION_FLOAT(struct ism_params, slope, 0, 0, 64, "texels", "see bias", "ours"),
    IRB_OPTION_FLOAT(struct ism_params, offset, 0.01, 0, 1, "",
                     "see bias; as a share of the scene's diagonal", "ours"),
    IRB_OPTION_INT(struct ism_params, interleave_n, 3, 1, IRB_INTERLEAVE_MOST, "",
                   "n: tiles across of the interleaved shading", "thesis 5.1.4"),
    IRB_OPTION_INT(struct ism_params, interleave_m, 3, 1, IRB_INTERLEAVE_MOST, "",
                   "m: tiles up of the interleaved shading", "thesis 5.1.4"),
    IRB_OPTION_FLOAT(struct ism_params, filter_depth, 0.05, 0, 10, "",
                     "alpha: largest difference of two pixels' distances to the camera that the "
                     "filter averages, as a share of the scene's diagonal",
                     "thesis 5.3.3; value: ours"),
    IRB_OPTION_FLOAT(
        struct ism_params, filter_cosine, 0.95, -1, 1, "",
        "beta: least cosine between the normals of two pixels that the filter averages",
        "thesis 5.3.3; value: ours"),
    IRB_OPTION_FLOAT(
        struct ism_params, clamp, 0, 0, 1e12, "",
        "largest cos cos d^2/r^2 of a light and a pixel, d the diagonal of the scene's bounds; 0 = "
        "no clamp",
        "thesis 3.2.1; unit: ours"),
    IRB_OPTION_END,
};
