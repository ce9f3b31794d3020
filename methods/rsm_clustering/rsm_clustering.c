/* SPDX-License-Identifier: MIT
 *
 * Reflective shadow map clustering: the RSM's texels in clusters that go on from frame to frame,
 * one iteration of k-means each, and one-bounce light from the clusters taken as area lights.
 */
#include "methods/method.h"
#include "core/frame/shadow_term.h"
#include "methods/rsm_clustering/lighting.h"
#include "methods/rsm_clustering/pictures.h"

#include <stdlib.h>

extern const struct irb_method irb_method_rsm_clustering;

enum {
    STAGE_IMPORTANCE,
    STAGE_SEED,
    STAGE_GRID,
    STAGE_ASSIGN,
    STAGE_SORT,
    STAGE_UPDATE,
    STAGE_GEOMETRY,
    STAGE_SPLAT,
    STAGE_PULL_PUSH,
    STAGE_CLUSTER,
    STAGE_MAPS,
    STAGE_BASIS,
    STAGE_PREFILTER,
    STAGE_SPLIT,
    STAGE_LIGHT,
    STAGE_MERGE,
    STAGE_FILTER
};
static const char *const stages[] = {"importance", "seed",     "grid",      "assign",    "sort",
                                     "update",     "geometry", "splat",     "pull-push", "cluster",
                                     "maps",       "basis",    "prefilter", "split",     "light",
                                     "merge",      "filter",   NULL};

struct rsc_state {
    struct irb_gl *gl; /* borrowed */
    int width, height;
    uint64_t seed;
    unsigned frame;                 /* frames since the sequence began */
    struct irb_texture *irradiance; /* RGBA32F, W/m2; share of the light that is in shadow */
    struct rsc_area_lights *lights;
    struct rsc_lighting lighting;
    /* for the RSM's resolution, when the first frame shows it */
    struct irb_importance *importance;
    struct irb_pyramid *pyramid;
    struct rsc_clusters *clusters;
    struct rsc_pictures *pictures;  /* for debugging, when first asked for */
    struct irb_shadow_term *shadow; /* likewise, of the image's size */
};

static void destroy_clustering(struct rsc_state *s)
{
    irb_importance_destroy(s->importance);
    irb_pyramid_destroy(s->pyramid);
    rsc_clusters_destroy(s->clusters);
    rsc_pictures_destroy(s->pictures);
    s->importance = NULL;
    s->pyramid = NULL;
    s->clusters = NULL;
    s->pictures = NULL;
}

static void rsc_destroy(void *user)
{
    struct rsc_state *s = user;
    if (!s)
        return;
    destroy_clustering(s);
    rsc_lighting_destroy(&s->lighting);
    rsc_area_lights_destroy(s->lights);
    irb_texture_destroy(s->irradiance);
    irb_shadow_term_destroy(s->shadow);
    free(s);
}

static bool rsc_resize(void *user, int width, int height, struct irb_error *err)
{
    struct rsc_state *s = user;
    const struct irb_texture_desc desc = {.name = "rsm-clustering: irradiance",
                                          .format = GL_RGBA32F,
                                          .width = width,
                                          .height = height};
    struct irb_texture *irradiance = irb_texture_create(s->gl, &desc, err);
    if (!irradiance)
        return false;
    irb_texture_destroy(s->irradiance);
    rsc_pictures_destroy(s->pictures);
    irb_shadow_term_destroy(s->shadow);
    s->irradiance = irradiance;
    s->pictures = NULL;
    s->shadow = NULL;
    s->width = width;
    s->height = height;
    return true;
}

static void *rsc_create(struct irb_gl *gl, const struct irb_scene_gl *scene, int width, int height,
                        const void *settings, struct irb_error *err)
{
    (void)scene;
    (void)settings;
    struct rsc_state *s = calloc(1, sizeof *s);
    if (!s) {
        irb_fail(err, IRB_E_MEMORY, "rsm-clustering: out of memory");
        return NULL;
    }
    s->gl = gl;
    rsc_lighting_init(&s->lighting, gl);
    s->lights = rsc_area_lights_create(gl, err);
    if (s->lights && rsc_resize(s, width, height, err))
        return s;
    rsc_destroy(s);
    return NULL;
}

static bool rsc_begin_sequence(void *user, const void *settings, uint64_t seed,
                               struct irb_error *err)
{
    struct rsc_state *s = user;
    (void)settings;
    (void)err;
    s->seed = seed;
    s->frame = 0;
    if (s->clusters)
        rsc_clusters_forget(s->clusters);
    return true;
}

/* Another resolution of the RSM starts anew. */
static bool prepare_clustering(struct rsc_state *s, int resolution, const struct rsc_resolved *r,
                               struct irb_error *err)
{
    if (!s->clusters || s->clusters->resolution != resolution) {
        destroy_clustering(s);
        if (!(s->importance = irb_importance_create(s->gl, resolution, err)) ||
            !(s->pyramid = irb_pyramid_create(s->gl, resolution, err)) ||
            !(s->clusters = rsc_clusters_create(s->gl, resolution, err)))
            return false;
    }
    return rsc_clusters_prepare(s->clusters, &r->clustering, err) &&
           rsc_area_lights_prepare(s->lights, r->clustering.clusters, r->corners, err);
}

static bool cluster(struct rsc_state *s, const struct irb_frame_inputs *in,
                    const struct rsc_resolved *r, struct irb_error *err)
{
    struct rsc_clusters *c = s->clusters;
    const struct rsc_settings *settings = &r->clustering;
    bool ok = true;
    IRB_STAGE(ok, in, STAGE_IMPORTANCE,
              irb_importance_compute(s->importance, in->rsm, in->light, in->gbuffer, &r->importance,
                                     err) &&
                  irb_pyramid_build(s->pyramid, s->importance->map, err));
    IRB_STAGE(ok, in, STAGE_SEED, rsc_clusters_seed(c, in->rsm, s->pyramid, settings, err));
    IRB_STAGE(ok, in, STAGE_GRID, rsc_clusters_grid(c, settings, err));
    IRB_STAGE(ok, in, STAGE_ASSIGN, rsc_clusters_assign(c, in->rsm, settings, err));
    IRB_STAGE(ok, in, STAGE_SORT, rsc_clusters_sort(c, in->rsm, settings, err));
    IRB_STAGE(ok, in, STAGE_UPDATE, rsc_clusters_update(c, in->rsm, settings, err));
    IRB_STAGE(ok, in, STAGE_GEOMETRY,
              rsc_area_lights_make(s->lights, c, in->rsm, settings, r->area, r->corners, err));
    return ok;
}

/* The split G-buffer, shadows from imperfect maps or none. */
static bool shade(struct rsc_state *s, const struct irb_frame_inputs *in,
                  const struct rsc_resolved *r, struct irb_error *err)
{
    struct irb_ism_lighting *l = &s->lighting.ism;
    const struct irb_virtual_lights discs = rsc_area_lights_discs(s->lights);
    const struct irb_virtual_lights lights = rsc_area_lights_view(s->lights);
    const struct irb_ism *maps = rsc_has_ism(r) ? l->maps : NULL;
    bool ok = true;
    if (maps) {
        IRB_STAGE(ok, in, STAGE_SPLAT,
                  irb_ism_splat(l->maps, in->scene, l->points, &discs, &r->ism, err));
        IRB_STAGE(ok, in, STAGE_PULL_PUSH, irb_ism_pull_push(l->maps, &r->ism, err));
    }
    IRB_STAGE(ok, in, STAGE_LIGHT,
              irb_shade_run(l->shade, l->interleave, &lights, maps, &r->shade, err));
    return ok;
}

/* Likewise, shadows from VALs: maps and light, batch by batch. */
static bool shade_clustered(struct rsc_state *s, const struct irb_frame_inputs *in,
                            const struct rsc_resolved *r, struct irb_error *err)
{
    static const struct irb_val_stages val_stages = {STAGE_MAPS, STAGE_BASIS, STAGE_PREFILTER,
                                                     STAGE_LIGHT};
    struct rsc_lighting *l = &s->lighting;
    const struct irb_virtual_lights discs = rsc_area_lights_discs(s->lights);
    const int tiles = l->ism.interleave->n * l->ism.interleave->m;
    bool ok = true;
    IRB_STAGE(ok, in, STAGE_CLUSTER,
              irb_vals_cluster(l->vals, &discs, &r->vals, err) &&
                  irb_vals_order(l->vals, &discs, tiles, err));
    return ok &&
           irb_val_lighting_shade(&l->val_lighting, in->scene, l->ism.interleave, l->vals,
                                  r->vals.vals, &r->val_lighting, in->timer, &val_stages, err);
}

static bool light(struct rsc_state *s, const struct irb_frame_inputs *in,
                  const struct rsc_resolved *r, struct irb_error *err)
{
    struct irb_interleave *interleave = s->lighting.ism.interleave;
    bool ok = true;
    IRB_STAGE(ok, in, STAGE_SPLIT, irb_interleave_split(interleave, in->gbuffer, err));
    ok = ok && (r->is_clustered ? shade_clustered(s, in, r, err) : shade(s, in, r, err));
    IRB_STAGE(ok, in, STAGE_MERGE, irb_interleave_merge(interleave, err));
    IRB_STAGE(ok, in, STAGE_FILTER,
              irb_interleave_filter(interleave, in->gbuffer, r->filter_depth, r->filter_cosine,
                                    s->irradiance, err));
    return ok;
}

static bool report_vals(const struct rsc_state *s, struct irb_frame_output *out,
                        struct irb_error *err)
{
    struct irb_vals_statistics statistics;
    if (!irb_vals_statistics(s->lighting.vals, &statistics, err))
        return false;
    irb_output_statistic(out, "vals_in_use", statistics.in_use);
    irb_output_statistic(out, "iterations", statistics.iterations);
    irb_output_statistic(out, "converged", statistics.converged);
    return true;
}

/* Outside the stages: the report is no part of the method's cost. */
static bool report(struct rsc_state *s, const struct irb_frame_inputs *in,
                   const struct rsc_resolved *r, struct irb_frame_output *out,
                   struct irb_error *err)
{
    struct rsc_census census;
    if (!rsc_clusters_count(s->clusters, in->rsm, &census, err))
        return false;
    const struct irb_cluster_census *texels = &census.texels;
    out->uncovered_flux = texels->flux > 0 ? texels->uncovered_flux / texels->flux : 0;
    irb_output_statistic(out, "clusters", r->clustering.clusters);
    irb_output_statistic(out, "clusters_in_use", census.in_use);
    irb_output_statistic(out, "seeded", census.seeded);
    irb_output_statistic(out, "lit_texels", texels->lit);
    irb_output_statistic(out, "lost_texels", texels->uncovered);
    return !r->is_clustered || report_vals(s, out, err);
}

/* What is in shadow, and the VALs' maps. */
static bool draw_shadows(struct rsc_state *s, const struct rsc_resolved *r,
                         struct irb_frame_output *out, struct irb_error *err)
{
    if (!s->shadow && !(s->shadow = irb_shadow_term_create(s->gl, s->width, s->height, err)))
        return false;
    if (!irb_shadow_term_draw(s->shadow, s->irradiance, err))
        return false;
    irb_output_layer(out, "shadow-term", s->shadow->image, IRB_DEBUG_SCALAR);
    if (r->is_clustered)
        irb_output_layer(out, "csm-maps", s->lighting.val_lighting.maps->distance,
                         IRB_DEBUG_DISTANCE);
    return true;
}

static bool draw_pictures(struct rsc_state *s, const struct irb_frame_inputs *in,
                          const struct rsc_resolved *r, struct irb_frame_output *out,
                          struct irb_error *err)
{
    if (!s->pictures && !(s->pictures = rsc_pictures_create(s->gl, s->clusters->resolution,
                                                            s->width, s->height, err)))
        return false;
    const struct rsc_pictures *p = s->pictures;
    if (!rsc_pictures_draw(s->pictures, s->clusters, s->lights, in->rsm, in->gbuffer, err))
        return false;
    irb_output_layer(out, "importance", s->importance->map, IRB_DEBUG_SCALAR);
    irb_output_layer(out, "cluster-map", p->map, IRB_DEBUG_COLOUR);
    irb_output_layer(out, "rsm-flux", p->flux, IRB_DEBUG_COLOUR);
    irb_output_layer(out, "clustered-flux", p->clustered, IRB_DEBUG_COLOUR);
    irb_output_layer(out, "cluster-centres", p->centres, IRB_DEBUG_COLOUR);
    irb_output_layer(out, "area-lights", p->lights, IRB_DEBUG_COLOUR);
    return !(rsc_has_ism(r) || r->is_clustered) || draw_shadows(s, r, out, err);
}

static bool rsc_render_frame(void *user, const struct irb_frame_inputs *in,
                             struct irb_frame_output *out, struct irb_error *err)
{
    struct rsc_state *s = user;
    struct rsc_resolved r;
    *out = (struct irb_frame_output){.irradiance = s->irradiance};
    if (!rsc_params_resolve(in->params, irb_scene_diagonal(in->scene->scene), s->seed, s->frame, &r,
                            err) ||
        !prepare_clustering(s, in->rsm->resolution, &r, err) ||
        !rsc_lighting_prepare(&s->lighting, in->scene, &r, s->width, s->height, err))
        return false;
    s->frame++;
    return cluster(s, in, &r, err) && light(s, in, &r, err) && report(s, in, &r, out, err) &&
           (!in->debug || draw_pictures(s, in, &r, out, err));
}

static bool rsc_claims_visibility(const void *settings)
{
    const struct rsc_params *p = settings;
    return p->visibility != IRB_SHADE_NONE;
}

static unsigned rsc_needs(const void *settings)
{
    (void)settings;
    return IRB_NEEDS_HISTORY;
}

static bool rsc_check(const void *settings, const struct irb_frame_sizes *sizes,
                      struct irb_error *err)
{
    return rsc_params_check(settings, sizes->rsm_resolution, err);
}

const struct irb_method irb_method_rsm_clustering = {
    .abi = IRB_METHOD_ABI,
    .name = "rsm-clustering",
    .title = "Reflective shadow map clustering",
    .citation = "R. Prutkin, A. S. Kaplanyan and C. Dachsbacher, Reflective Shadow Map Clustering "
                "for Real-Time Global Illumination, Eurographics 2012 Short Papers",
    .path_classes = "LDDE",
    .params_size = sizeof(struct rsc_params),
    .params = rsc_options,
    .stages = stages,
    .claims_visibility = rsc_claims_visibility,
    .needs = rsc_needs,
    .check = rsc_check,
    .create = rsc_create,
    .resize = rsc_resize,
    .begin_sequence = rsc_begin_sequence,
    .render_frame = rsc_render_frame,
    .destroy = rsc_destroy,
};
