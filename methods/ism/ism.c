/* SPDX-License-Identifier: MIT
 *
 * Imperfect shadow maps: one-bounce light from virtual point lights, each with a coarse shadow map
 * splatted from points of the scene; interleaved sampling with a geometry-aware filter.
 *
 * Points may adapt to the lights (Ritschel et al. 2011; core/lights/point_need.h): by whole
 * triangles, and for all maps alike. Does not: make points for the view but through its lights, nor
 * bounce light twice.
 */
#include "methods/method.h"

#include "core/frame/shadow_term.h"
#include "core/lights/tessellation.h"
#include "core/sampling/halton.h"
#include "core/sampling/sobol.h"
#include "methods/ism/objects.h"

#include <stdlib.h>

extern const struct irb_method irb_method_ism;

enum {
    STAGE_SAMPLE,
    STAGE_POINTS,
    STAGE_SPLAT,
    STAGE_PULL_PUSH,
    STAGE_RASTER,
    STAGE_SPLIT,
    STAGE_LIGHT,
    STAGE_MERGE,
    STAGE_FILTER
};
static const char *const stages[] = {"sample", "points", "splat", "pull-push", "raster",
                                     "split",  "light",  "merge", "filter",    NULL};

struct ism_state {
    struct ism_objects *objects;
    struct irb_shadow_term *shadow_term; /* made when layers are first asked for */
};

static void ism_destroy(void *user)
{
    struct ism_state *state = user;
    if (!state)
        return;
    ism_objects_destroy(state->objects);
    irb_shadow_term_destroy(state->shadow_term);
    free(state);
}

static void *ism_create(struct irb_gl *gl, const struct irb_scene_gl *scene, int width, int height,
                        const void *settings, struct irb_error *err)
{
    (void)scene;
    (void)settings;
    struct ism_state *state = calloc(1, sizeof *state);
    if (!state) {
        irb_fail(err, IRB_E_MEMORY, "ism: out of memory");
        return NULL;
    }
    if ((state->objects = ism_objects_create(gl, width, height, err)))
        return state;
    ism_destroy(state);
    return NULL;
}

static bool ism_resize(void *user, int width, int height, struct irb_error *err)
{
    struct ism_state *state = user;
    irb_shadow_term_destroy(state->shadow_term);
    state->shadow_term = NULL;
    return ism_objects_resize(state->objects, width, height, err);
}

static bool ism_begin_sequence(void *user, const void *settings, uint64_t seed,
                               struct irb_error *err)
{
    (void)user;
    (void)settings;
    (void)seed;
    (void)err;
    return true; /* no history */
}

/* The same points in every frame, or, with the sequence `random`, some that the seed and the
 * frame's number choose. */
static unsigned first_point(const struct ism_params *p, const struct irb_frame_inputs *in,
                            int count)
{
    uint64_t seed = in->seed;
    if (p->sequence == ISM_RANDOM)
        seed = irb_hash_u32(irb_hash_u32((uint32_t)in->seed, (uint32_t)(in->seed >> 32)),
                            (uint32_t)in->frame);
    return irb_halton_stretch(seed, 0, (uint32_t)count);
}

static bool sample(struct ism_objects *o, const struct irb_frame_inputs *in, struct irb_error *err)
{
    const struct ism_params *p = in->params;
    const unsigned first = first_point(p, in, p->vpls);
    o->lights->tiles = o->lighting.interleave->n * o->lighting.interleave->m;
    if (p->importance == ISM_FLUX)
        return irb_vpl_set_sample(o->lights, in->rsm, p->vpls, first, err);
    const struct irb_importance_settings settings = {
        .diffuse_weight = 1,
        .view_weight = p->view_weight,
        .view_samples = p->view_samples,
        .norm = IRB_IMPORTANCE_NORM_MAX,
        .first = first_point(p, in, p->view_samples),
    };
    return irb_importance_compute(o->importance, in->rsm, in->light, in->gbuffer, &settings, err) &&
           irb_pyramid_build(o->pyramid, o->importance->map, err) &&
           irb_vpl_set_sample_map(o->lights, in->rsm, o->pyramid, p->vpls, first, err);
}

static struct irb_ism_settings map_settings(const struct ism_params *p)
{
    const int halvings = 5 + p->map_size; /* of 32, ... */
    return (struct irb_ism_settings){
        .splatter = p->points == ISM_DYNAMIC          ? IRB_ISM_TESSELLATION
                    : p->splatter == ISM_SPLAT_RASTER ? IRB_ISM_RASTER
                                                      : IRB_ISM_ATOMIC,
        .splat_factor = p->splat_factor,
        .splat_scale = p->splat_scale,
        .splat_size = p->splat_size,
        .splat_most = p->splat_most,
        .near = p->near,
        .pull_push = p->pull_push < halvings ? p->pull_push : halvings,
        .pull = p->pull,
        .f_min = p->f_min,
        .f_max = p->f_max,
        .smoothstep = irb_smoothstep_order(p->smoothstep),
    };
}

struct coverage {
    double splatted, filled; /* share of the maps' texels, before and after pull-push */
};

/* The coverage is measured outside the stages: it is no part of the method's cost. */
static bool build_maps(struct ism_objects *o, const struct irb_frame_inputs *in,
                       struct coverage *coverage, struct irb_error *err)
{
    const struct irb_ism_settings settings = map_settings(in->params);
    const struct irb_virtual_lights lights = irb_vpl_set_view(o->lights);
    const struct irb_ism_lighting *l = &o->lighting;
    bool ok = true;
    IRB_STAGE(ok, in, STAGE_SPLAT,
              irb_ism_splat(l->maps, in->scene, l->points, &lights, &settings, err));
    ok = ok && irb_ism_coverage(l->maps, &coverage->splatted, err);
    IRB_STAGE(ok, in, STAGE_PULL_PUSH, irb_ism_pull_push(l->maps, &settings, err));
    return ok && irb_ism_coverage(l->maps, &coverage->filled, err);
}

/* Of rasterised maps, whose texels hold the distance of their own ray: what rounding leaves.
 * Source: ours, by tests/integration/bench_ism_visibility.c. */
static const float raster_bias = 0.001f, raster_offset = 0.0005f, raster_near = 0.001f;

/* Lengths in metres; the bounds are those at rest, the same in all frames. */
static struct irb_shade_settings shade_settings(const struct ism_params *p, float diagonal)
{
    const bool raster = p->visibility == ISM_EXACT_RASTER;
    return (struct irb_shade_settings){
        .visibility = raster                            ? IRB_SHADE_RASTER
                      : p->visibility == ISM_UNOCCLUDED ? IRB_SHADE_NONE
                                                        : IRB_SHADE_BINARY,
        .bias = raster ? raster_bias : p->bias,
        .slope = raster ? 0 : p->slope,
        .offset = (raster ? raster_offset : p->offset) * diagonal,
        .taps = 1,
        .blocker_taps = 1,
        .bound = diagonal > 0 ? p->clamp / (diagonal * diagonal) : 0,
    };
}

static bool light_raster(struct ism_objects *o, const struct irb_frame_inputs *in,
                         const struct irb_virtual_lights *lights,
                         const struct irb_shade_settings *settings, struct irb_error *err)
{
    const struct irb_shade_raster raster = {
        .maps = o->raster,
        .scene = in->scene,
        .near = raster_near * irb_scene_diagonal(in->scene->scene),
        .timer = in->timer,
        .maps_stage = STAGE_RASTER,
        .light_stage = STAGE_LIGHT,
    };
    const struct irb_ism_lighting *l = &o->lighting;
    return irb_shade_run_raster(l->shade, l->interleave, lights, &raster, settings, err);
}

static bool light(struct ism_objects *o, const struct irb_frame_inputs *in, struct irb_error *err)
{
    const struct ism_params *p = in->params;
    const struct irb_ism_lighting *l = &o->lighting;
    const struct irb_virtual_lights lights = irb_vpl_set_view(o->lights);
    const struct irb_ism *maps = p->visibility == ISM_IMPERFECT ? l->maps : NULL;
    const struct irb_shade_settings settings =
        shade_settings(p, irb_scene_diagonal(in->scene->scene));
    bool ok = true;
    if (p->visibility == ISM_EXACT_RASTER)
        return light_raster(o, in, &lights, &settings, err);
    IRB_STAGE(ok, in, STAGE_LIGHT,
              irb_shade_run(l->shade, l->interleave, &lights, maps, &settings, err));
    return ok;
}

/* Split, light, merge, filter. */
static bool light_tiles(struct ism_objects *o, const struct irb_frame_inputs *in,
                        struct irb_error *err)
{
    const struct ism_params *p = in->params;
    struct irb_interleave *interleave = o->lighting.interleave;
    const float depth = p->filter_depth * irb_scene_diagonal(in->scene->scene);
    bool ok = true;
    IRB_STAGE(ok, in, STAGE_SPLIT, irb_interleave_split(interleave, in->gbuffer, err));
    ok = ok && light(o, in, err);
    IRB_STAGE(ok, in, STAGE_MERGE, irb_interleave_merge(interleave, err));
    IRB_STAGE(ok, in, STAGE_FILTER,
              irb_interleave_filter(interleave, in->gbuffer, depth, p->filter_cosine, o->irradiance,
                                    err));
    return ok;
}

static bool debug(struct ism_state *state, bool maps, struct irb_frame_output *out,
                  struct irb_error *err)
{
    const struct ism_objects *o = state->objects;
    if (!state->shadow_term &&
        !(state->shadow_term = irb_shadow_term_create(o->gl, o->width, o->height, err)))
        return false;
    if (!irb_shadow_term_draw(state->shadow_term, o->irradiance, err))
        return false;
    if (maps)
        irb_output_layer(out, "ism-atlas", o->lighting.maps->atlas, IRB_DEBUG_DISTANCE);
    irb_output_layer(out, "split", o->lighting.interleave->split, IRB_DEBUG_RADIANCE);
    irb_output_layer(out, "shadow-term", state->shadow_term->image, IRB_DEBUG_SCALAR);
    return true;
}

/* Outside the stages: the report is no part of the method's cost. */
static bool report(struct ism_state *state, const struct irb_frame_inputs *in,
                   const struct coverage *coverage, struct irb_frame_output *out,
                   struct irb_error *err)
{
    const struct ism_params *p = in->params;
    struct ism_objects *o = state->objects;
    const bool maps = p->visibility == ISM_IMPERFECT;
    if (p->clamp > 0 &&
        !irb_shade_lost(o->lighting.shade, o->lighting.interleave, &out->clamped_light, err))
        return false;
    irb_output_statistic(out, "vpls", o->lights->count);
    if (maps && o->lighting.points) {
        irb_output_statistic(out, "points", (double)o->lighting.points->count);
        irb_output_statistic(out, "point_bytes", (double)o->lighting.points->bytes);
        irb_output_statistic(out, "splats",
                             (double)o->lighting.points->count * (double)p->splat_factor);
    }
    if (maps) {
        irb_output_statistic(out, "coverage_splatted", coverage->splatted);
        irb_output_statistic(out, "coverage", coverage->filled);
    }
    return !in->debug || debug(state, maps, out, err);
}

/* Area points are drawn once for a sequence, before any stage, or anew in every frame, in a stage
 * of theirs; adaptive ones after the lights. */
static bool prepare_points(struct ism_objects *o, const struct irb_frame_inputs *in, bool sampled,
                           struct irb_error *err)
{
    const struct ism_params *p = in->params;
    if (sampled != ism_adapts_points(p))
        return true;
    if (!sampled && (!p->redraw_points || p->points != ISM_AREA))
        return ism_objects_prepare_points(o, p, in->scene, in->seed, err);
    const uint64_t frame = p->redraw_points ? (uint32_t)in->frame : 0;
    const uint64_t seed = in->seed ^ frame << 32;
    bool ok = true;
    IRB_STAGE(ok, in, STAGE_POINTS, ism_objects_prepare_points(o, p, in->scene, seed, err));
    return ok;
}

static bool ism_render_frame(void *user, const struct irb_frame_inputs *in,
                             struct irb_frame_output *out, struct irb_error *err)
{
    struct ism_state *state = user;
    struct ism_objects *o = state->objects;
    const struct ism_params *p = in->params;
    struct coverage coverage = {0};

    *out = (struct irb_frame_output){.irradiance = o->irradiance};
    if (!ism_objects_prepare(o, p, in->scene, in->rsm->resolution, err) ||
        !prepare_points(o, in, false, err))
        return false;
    bool ok = true;
    IRB_STAGE(ok, in, STAGE_SAMPLE, sample(o, in, err));
    ok = ok && prepare_points(o, in, true, err);
    if (p->visibility == ISM_IMPERFECT)
        ok = ok && build_maps(o, in, &coverage, err);
    return ok && light_tiles(o, in, err) && report(state, in, &coverage, out, err);
}

static bool ism_claims_visibility(const void *settings)
{
    const struct ism_params *p = settings;
    return p->visibility != ISM_UNOCCLUDED;
}

static bool ism_check(const void *settings, const struct irb_frame_sizes *sizes,
                      struct irb_error *err)
{
    const struct ism_params *p = settings;
    (void)sizes;
    if (p->visibility != ISM_IMPERFECT || p->points == ISM_AREA)
        return true;
    const int order = irb_smoothstep_order(p->smoothstep);
    return irb_tessellation_check((double)p->f_min, (double)p->f_max, order, err);
}

const struct irb_method irb_method_ism = {
    .abi = IRB_METHOD_ABI,
    .name = "ism",
    .title = "Imperfect shadow maps",
    .citation = "T. Ritschel, T. Grosch, M. H. Kim, H.-P. Seidel, C. Dachsbacher and J. Kautz, "
                "Imperfect Shadow Maps for Efficient Computation of Indirect Illumination, "
                "SIGGRAPH Asia 2008",
    .path_classes = "LDDE",
    .params_size = sizeof(struct ism_params),
    .params = ism_options,
    .stages = stages,
    .claims_visibility = ism_claims_visibility,
    .check = ism_check,
    .create = ism_create,
    .resize = ism_resize,
    .begin_sequence = ism_begin_sequence,
    .render_frame = ism_render_frame,
    .destroy = ism_destroy,
};
