/* SPDX-License-Identifier: MIT */
#include "methods/clustered_visibility/params.h"
#include "methods/method.h"

#include "core/sampling/halton.h"

enum { UNIT_METRES, UNIT_BBOX };
static const char *const units[] = {"metres", "bbox", NULL};
enum { VISIBILITY_NONE, VISIBILITY_CLUSTERED };
static const char *const visibilities[] = {"none", "clustered", NULL};

#define P struct cv_params
const struct irb_option cv_options[] = {
    IRB_OPTION_INT(
        P, vpls, 512, 1, IRB_VALS_MOST_LIGHTS, "",
        "virtual point lights, drawn from the RSM by flux, the same Halton points in each "
        "frame; 512 are some 57 for every tile of 3 x 3",
        "Dong et al. 2009: hundreds to thousands; value: ours"),
    IRB_OPTION_INT(P, vals, IRB_VALS_DEFAULT_COUNT, 1, IRB_VALS_MOST, "",
                   "k: clusters of the VPLs, which are virtual area lights with a shadow map each",
                   "thesis 3.2.5; value: ours"),
    IRB_OPTION_FLOAT(P, w_x, IRB_VALS_DEFAULT_W_X, 0, 1e6, "",
                     "weight of the distance from VPL to VAL", "thesis eq. 3.7; value: ours"),
    IRB_OPTION_FLOAT(P, w_a, IRB_VALS_DEFAULT_W_A, 0, 1e6, "1/rad",
                     "weight of the angle between their normals: with distances in diagonals, 0.5 "
                     "keeps walls at right angles apart up to 3/4 of a diagonal",
                     "thesis eq. 3.7; value: ours"),
    IRB_OPTION_ENUM(
        P, metric_unit, UNIT_BBOX, units,
        "unit of the distances in eq. 3.7: metres, or the diagonal of the scene at rest, "
        "by which the clustering does not depend on the scene's scale",
        "ours"),
    IRB_OPTION_INT(P, iterations, IRB_VALS_DEFAULT_ITERATIONS, 1, 1024, "",
                   "most iterations of k-means, which ends when no VPL changes its VAL",
                   "thesis 3.2.5: until convergence; bound: ours"),
    IRB_OPTION_ENUM(P, start, IRB_VALS_DEFAULT_START, irb_vals_start_names,
                    "k-means starts from the first k VPLs in every frame, or from the VALs of the "
                    "frame before, of which those that have lost their VPLs stay away",
                    "thesis 3.2.5, figure 3.9"),
    IRB_OPTION_ENUM(P, area, IRB_VALS_DEFAULT_AREA, irb_vals_area_names,
                    "a VAL's area: of the disc with the same second moment, or of the disc through "
                    "its farthest VPL; its radius is w_light of eq. 3.2",
                    "thesis eq. 3.2; ours"),
    IRB_OPTION_ENUM(P, centre, IRB_VALS_DEFAULT_CENTRE, irb_vals_centre_names,
                    "where a VAL's shadow map stands: at the mean of its VPLs, which lies inside "
                    "round surfaces, whose own shadow then covers all; lifted to the highest VPL, "
                    "which on flat ones is the same; or at the VPL nearest to the mean",
                    "ours: thesis 3.2.5 says where clusters have their centres, not their maps"),
    IRB_OPTION_ENUM(P, visibility, VISIBILITY_CLUSTERED, visibilities,
                    "indirect shadows: none, or from the VALs' shadow maps", "thesis 3.2.5"),
    IRB_OPTION_ENUM(P, projection, IRB_VALS_DEFAULT_PROJECTION, irb_raster_projection_names,
                    "of the shadow maps; a hemicube's are filtered within one face at a time",
                    "Dong et al. 2009: paraboloid; hemicube: ours"),
    IRB_OPTION_ENUM(P, map_size, IRB_VALS_DEFAULT_MAP_SIZE, irb_vals_map_size_names,
                    "texels a side of a shadow map's face", "thesis 3.2.5; value: ours"),
    IRB_OPTION_FLOAT(
        P, near, IRB_VALS_DEFAULT_NEAR, 0, 1, "",
        "surfaces nearer to a VAL than this share of the scene's diagonal are left out "
        "of its map",
        "ours"),
    IRB_OPTION_INT(P, csm_order, IRB_CSM_DEFAULT_ORDER, 1, IRB_CSM_ORDER_MOST, "",
                   "M: order of the Fourier series of the shadow test",
                   "thesis eq. 3.5; value: ours"),
    IRB_OPTION_ENUM(P, csm_prefilter, IRB_CSM_DEFAULT_PREFILTER, irb_csm_prefilter_names,
                    "of the basis images: mipmaps, or summed-area tables", "thesis 3.1.2"),
    IRB_OPTION_FLOAT(
        P, csm_offset, IRB_CSM_DEFAULT_OFFSET, 0, 4, "",
        "receivers are taken for so much nearer, in halves 1/(2M) of the series's step. "
        "Orders M of 8 and more do best with csm_offset and csm_search_offset M/8, a sixteenth of "
        "the depths' range, csm_scale 1, csm_damping 1",
        "Annen et al. 2007; value: ours"),
    IRB_OPTION_FLOAT(P, csm_scale, IRB_CSM_DEFAULT_SCALE, 0.1, 8, "",
                     "the series's sum is multiplied by this and cut at 1: without offset, a lit "
                     "surface reads 1/2",
                     "Annen et al. 2007"),
    IRB_OPTION_FLOAT(
        P, csm_search_offset, IRB_CSM_DEFAULT_SEARCH_OFFSET, 0, 4, "",
        "offset in the search for blockers: at 0.613, where Si(pi x) = pi/2, the series first "
        "reaches 1, so that the receiver's own surface has no weight there",
        "ours"),
    IRB_OPTION_FLOAT(P, search_scale, IRB_CSM_DEFAULT_SEARCH_SCALE, 0, 16, "",
                     "radius of the search for blockers at the receiver, in w_light; s finds all "
                     "from 1/(1 + s) of the way on, and penumbrae are cut at it",
                     "thesis 3.1.1; value: ours"),
    IRB_OPTION_FLOAT(P, penumbra_scale, IRB_CSM_DEFAULT_PENUMBRA_SCALE, 0, 16, "",
                     "factor of the penumbra's width", "thesis eq. 3.2"),
    IRB_OPTION_FLOAT(
        P, csm_damping, IRB_CSM_DEFAULT_DAMPING, 0, 16, "",
        "alpha: order k is damped by exp(-alpha (k/M)^2), against ringing, at the cost of "
        "a wider step",
        "Annen et al. 2007"),
    IRB_OPTION_FLOAT(
        P, clamp, 0, 0, 1e12, "",
        "largest cos cos d^2/r^2 of a light and a pixel, d the diagonal of the scene's "
        "bounds; 0 = no clamp",
        "thesis 3.2.1; unit: ours"),
    IRB_OPTION_INT(P, interleave_n, 3, 1, IRB_INTERLEAVE_MOST, "",
                   "n: tiles across of the interleaved shading: each pixel is lit by every nm-th "
                   "VPL, and n x m pixels are averaged where they agree",
                   "thesis 3.2.3; value: ours"),
    IRB_OPTION_INT(P, interleave_m, 3, 1, IRB_INTERLEAVE_MOST, "",
                   "m: tiles up of the interleaved shading", "thesis 3.2.3; value: ours"),
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

static struct irb_vals_settings clustering_of(const struct cv_params *p, float diagonal)
{
    const float unit = p->metric_unit == UNIT_BBOX && diagonal > 0 ? diagonal : 1;
    return (struct irb_vals_settings){
        .vals = p->vals,
        .weight_distance = p->w_x / unit,
        .weight_angle = p->w_a,
        .iterations = p->iterations,
        .start = (enum irb_vals_start)p->start,
        .area = (enum irb_vals_area)p->area,
        .centre = (enum irb_vals_centre)p->centre,
    };
}

static struct irb_val_lighting_settings lighting_of(const struct cv_params *p, float diagonal)
{
    return (struct irb_val_lighting_settings){
        .visibility = p->visibility == VISIBILITY_CLUSTERED,
        .projection = (enum irb_raster_projection)p->projection,
        .size = irb_vals_map_side(p->map_size),
        .near = p->near * diagonal,
        .order = p->csm_order,
        .prefilter = (enum irb_csm_prefilter)p->csm_prefilter,
        .csm = {.offset = p->csm_offset,
                .scale = p->csm_scale,
                .search_offset = p->csm_search_offset,
                .damping = p->csm_damping,
                .search_scale = p->search_scale,
                .penumbra_scale = p->penumbra_scale},
        .bound = diagonal > 0 ? p->clamp / diagonal / diagonal : 0,
    };
}

bool cv_claims_visibility(const void *params)
{
    const struct cv_params *p = params;
    return p->visibility != VISIBILITY_NONE;
}

unsigned cv_needs(const void *params)
{
    const struct cv_params *p = params;
    return p->start == IRB_VALS_REUSE ? IRB_NEEDS_HISTORY : IRB_NEEDS_NOTHING;
}

void cv_params_resolve(const struct cv_params *p, float diagonal, uint64_t seed,
                       struct cv_resolved *out)
{
    *out = (struct cv_resolved){
        .vpls = p->vpls,
        .first = irb_halton_stretch(seed, 0, (uint32_t)p->vpls),
        .clustering = clustering_of(p, diagonal),
        .lighting = lighting_of(p, diagonal),
        .interleave_n = p->interleave_n,
        .interleave_m = p->interleave_m,
        .filter_depth = p->filter_depth * diagonal,
        .filter_cosine = p->filter_cosine,
    };
}
