/* SPDX-License-Identifier: MIT
 *
 * Clustered visibility: every pixel is lit by many virtual point lights (VPLs), and shadowed by few
 * virtual area lights (VALs), which are clusters of them, with one convolution soft shadow map
 * each.
 */
#include "methods/method.h"
#include "core/lights/vpl.h"
#include "methods/clustered_visibility/params.h"
#include "methods/clustered_visibility/pictures.h"

#include <stdlib.h>

extern const struct irb_method irb_method_clustered_visibility;

enum {
    STAGE_SAMPLE,
    STAGE_CLUSTER,
    STAGE_MAPS,
    STAGE_BASIS,
    STAGE_PREFILTER,
    STAGE_SPLIT,
    STAGE_LIGHT,
    STAGE_MERGE,
    STAGE_FILTER
};
static const char *const stages[] = {"sample", "cluster", "maps",  "basis",  "prefilter",
                                     "split",  "light",   "merge", "filter", NULL};

struct cv_state {
    struct irb_gl *gl; /* borrowed */
    int width, height;
    uint64_t seed;
    struct irb_texture *irradiance; /* RGBA32F, W/m2; share of the light that is in shadow */
    struct irb_vals *vals;
    struct irb_val_lighting lighting;
    struct irb_interleave *interleave;
    struct irb_vpl_set *vpls;     /* made when the first frame shows the RSM's resolution */
    int rsm_resolution;           /* that `vpls` is made for */
    struct cv_pictures *pictures; /* for debugging, when first asked for */
};

static void cv_destroy(void *user)
{
    struct cv_state *s = user;
    if (!s)
        return;
    irb_texture_destroy(s->irradiance);
    irb_vals_destroy(s->vals);
    irb_val_lighting_destroy(&s->lighting);
    irb_interleave_destroy(s->interleave);
    irb_vpl_set_destroy(s->vpls);
    cv_pictures_destroy(s->pictures);
    free(s);
}

static bool cv_resize(void *user, int width, int height, struct irb_error *err)
{
    struct cv_state *s = user;
    const struct irb_texture_desc desc = {.name = "clustered-visibility: irradiance",
                                          .format = GL_RGBA32F,
                                          .width = width,
                                          .height = height};
    struct irb_texture *irradiance = irb_texture_create(s->gl, &desc, err);
    if (!irradiance)
        return false;
    irb_texture_destroy(s->irradiance);
    cv_pictures_destroy(s->pictures);
    s->irradiance = irradiance;
    s->pictures = NULL;
    s->width = width;
    s->height = height;
    return true;
}

static void *cv_create(struct irb_gl *gl, const struct irb_scene_gl *scene, int width, int height,
                       const void *settings, struct irb_error *err)
{
    (void)scene;
    (void)settings;
    struct cv_state *s = calloc(1, sizeof *s);
    if (!s) {
        irb_fail(err, IRB_E_MEMORY, "clustered-visibility: out of memory");
        return NULL;
    }
    s->gl = gl;
    irb_val_lighting_init(&s->lighting, gl);
    s->vals = irb_vals_create(gl, err);
    if (s->vals && cv_resize(s, width, height, err))
        return s;
    cv_destroy(s);
    return NULL;
}

static bool cv_begin_sequence(void *user, const void *settings, uint64_t seed,
                              struct irb_error *err)
{
    struct cv_state *s = user;
    (void)settings;
    (void)err;
    s->seed = seed;
    irb_vals_forget(s->vals);
    return true;
}

static bool prepare_vpls(struct cv_state *s, int resolution, struct irb_error *err)
{
    if (!s->vpls || s->rsm_resolution != resolution) {
        irb_vpl_set_destroy(s->vpls);
        cv_pictures_destroy(s->pictures);
        s->pictures = NULL;
        s->vpls =
            irb_vpl_set_create(s->gl, IRB_VPL_IMPORTANCE, resolution, IRB_VALS_MOST_LIGHTS, err);
        s->rsm_resolution = resolution;
    }
    if (s->vpls)
        s->vpls->tiles = s->interleave->n * s->interleave->m;
    return s->vpls != NULL;
}

static bool cluster(struct cv_state *s, const struct irb_frame_inputs *in,
                    const struct cv_resolved *r, struct irb_error *err)
{
    bool ok = true;
    IRB_STAGE(ok, in, STAGE_SAMPLE, irb_vpl_set_sample(s->vpls, in->rsm, r->vpls, r->first, err));
    const struct irb_virtual_lights vpls = irb_vpl_set_view(s->vpls);
    IRB_STAGE(ok, in, STAGE_CLUSTER,
              irb_vals_cluster(s->vals, &vpls, &r->clustering, err) &&
                  irb_vals_order(s->vals, &vpls, r->clustering.tiles, err));
    return ok;
}

/* Maps and light, batch by batch. */
static bool light(struct cv_state *s, const struct irb_frame_inputs *in,
                  const struct cv_resolved *r, struct irb_error *err)
{
    static const struct irb_val_stages val_stages = {STAGE_MAPS, STAGE_BASIS, STAGE_PREFILTER,
                                                     STAGE_LIGHT};
    const int vals = s->vals->vpls ? r->clustering.vals : 0;
    bool ok = true;
    IRB_STAGE(ok, in, STAGE_SPLIT, irb_interleave_split(s->interleave, in->gbuffer, err));
    ok = ok && irb_val_lighting_shade(&s->lighting, in->scene, s->interleave, s->vals, vals,
                                      &r->lighting, in->timer, &val_stages, err);
    IRB_STAGE(ok, in, STAGE_MERGE, irb_interleave_merge(s->interleave, err));
    IRB_STAGE(ok, in, STAGE_FILTER,
              irb_interleave_filter(s->interleave, in->gbuffer, r->filter_depth, r->filter_cosine,
                                    s->irradiance, err));
    return ok;
}

/* Outside the stages: the report is no part of the method's cost. */
static bool report(struct cv_state *s, struct irb_frame_output *out, struct irb_error *err)
{
    struct irb_vals_statistics statistics;
    if (!irb_vals_statistics(s->vals, &statistics, err) ||
        !irb_val_lighting_lost(&s->lighting, s->interleave, &out->clamped_light, err))
        return false;
    irb_output_statistic(out, "vpls", s->vpls->count);
    irb_output_statistic(out, "vals_in_use", statistics.in_use);
    irb_output_statistic(out, "iterations", statistics.iterations);
    irb_output_statistic(out, "converged", statistics.converged);
    return true;
}

static bool draw_pictures(struct cv_state *s, const struct irb_frame_inputs *in, bool maps,
                          struct irb_frame_output *out, struct irb_error *err)
{
    if (!s->pictures &&
        !(s->pictures = cv_pictures_create(s->gl, s->rsm_resolution, s->width, s->height, err)))
        return false;
    if (!cv_pictures_draw(s->pictures, in->rsm, s->vals, s->irradiance,
                          maps ? s->lighting.csm : NULL, err))
        return false;
    irb_output_layer(out, "vals", s->pictures->vals, IRB_DEBUG_COLOUR);
    irb_output_layer(out, "shadow-term", s->pictures->shadow->image, IRB_DEBUG_SCALAR);
    if (maps) {
        irb_output_layer(out, "csm-maps", s->lighting.maps->distance, IRB_DEBUG_DISTANCE);
        irb_output_layer(out, "csm-basis", s->pictures->basis, IRB_DEBUG_COLOUR);
    }
    return true;
}

static bool cv_render_frame(void *user, const struct irb_frame_inputs *in,
                            struct irb_frame_output *out, struct irb_error *err)
{
    struct cv_state *s = user;
    struct cv_resolved r;
    *out = (struct irb_frame_output){.irradiance = s->irradiance};
    cv_params_resolve(in->params, irb_scene_diagonal(in->scene->scene), s->seed, &r);
    if (!irb_interleave_prepare(&s->interleave, s->gl, s->width, s->height, r.interleave_n,
                                r.interleave_m, err) ||
        !prepare_vpls(s, in->rsm->resolution, err) ||
        !irb_val_lighting_prepare(&s->lighting, s->interleave, &r.lighting, r.clustering.vals, err))
        return false;
    r.clustering.tiles = s->vpls->tiles;
    const bool ok = cluster(s, in, &r, err) && light(s, in, &r, err) && report(s, out, err);
    return ok && (!in->debug ||
                  draw_pictures(s, in, r.lighting.visibility && s->vals->vpls > 0, out, err));
}

const struct irb_method irb_method_clustered_visibility = {
    .abi = IRB_METHOD_ABI,
    .name = "clustered-visibility",
    .title = "Clustered visibility",
    .citation = "Z. Dong, T. Grosch, T. Ritschel, J. Kautz and H.-P. Seidel, Real-time Indirect "
                "Illumination with Clustered Visibility, VMV 2009",
    .path_classes = "LDDE",
    .params_size = sizeof(struct cv_params),
    .params = cv_options,
    .stages = stages,
    .claims_visibility = cv_claims_visibility,
    .needs = cv_needs,
    .create = cv_create,
    .resize = cv_resize,
    .begin_sequence = cv_begin_sequence,
    .render_frame = cv_render_frame,
    .destroy = cv_destroy,
};
