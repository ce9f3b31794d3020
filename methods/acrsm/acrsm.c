/* SPDX-License-Identifier: MIT
 *
 * Adaptively-clustered reflective shadow maps: one-bounce light from clusters of RSM texels taken
 * as area lights, with soft shadows from imperfect shadow maps and interleaved shading.
 */
#include "core/frame/shadow_term.h"
#include "core/lights/ism_lighting.h"
#include "core/lights/tessellation.h"
#include "methods/method.h"
#include "methods/acrsm/params.h"

#include <stdlib.h>

extern const struct irb_method irb_method_acrsm;

enum {
    STAGE_IMPORTANCE,
    STAGE_EVALUATE,
    STAGE_SEED,
    STAGE_MAP,
    STAGE_AVERAGE,
    STAGE_SPLAT,
    STAGE_PULL_PUSH,
    STAGE_SPLIT,
    STAGE_LIGHT,
    STAGE_MERGE,
    STAGE_FILTER
};
static const char *const stages[] = {"importance", "evaluate", "seed",  "map",   "average", "splat",
                                     "pull-push",  "split",    "light", "merge", "filter",  NULL};

/* Thesis 5.1.3: an atlas of 4096 x 4096 texels, maps of 128 x 128. */
enum { MAP_SIZE = 128, MAPS = 1024 };

struct acrsm_state {
    struct irb_gl *gl; /* borrowed */
    int width, height;
    uint64_t seed;
    struct irb_texture *irradiance; /* RGBA32F, W/m2; share of the light that is in shadow */
    /* for the RSM's resolution, when the first frame shows it */
    struct irb_importance *importance;
    struct irb_pyramid *pyramid;
    struct acrsm_clusters *clusters;
    struct irb_ism_lighting lighting;
    /* for debugging, when first asked for */
    struct irb_texture *map_picture, *centre_picture;
    struct irb_shadow_term *shadow_term;
};

static void destroy_clustering(struct acrsm_state *s)
{
    irb_importance_destroy(s->importance);
    irb_pyramid_destroy(s->pyramid);
    acrsm_clusters_destroy(s->clusters);
    irb_texture_destroy(s->map_picture);
    irb_texture_destroy(s->centre_picture);
    s->importance = NULL;
    s->pyramid = NULL;
    s->clusters = NULL;
    s->map_picture = s->centre_picture = NULL;
}

static void acrsm_destroy(void *user)
{
    struct acrsm_state *s = user;
    if (!s)
        return;
    destroy_clustering(s);
    irb_ism_lighting_destroy(&s->lighting);
    irb_texture_destroy(s->irradiance);
    irb_shadow_term_destroy(s->shadow_term);
    free(s);
}

static bool acrsm_resize(void *user, int width, int height, struct irb_error *err)
{
    struct acrsm_state *s = user;
    const struct irb_texture_desc desc = {
        .name = "acrsm: irradiance", .format = GL_RGBA32F, .width = width, .height = height};
    struct irb_texture *irradiance = irb_texture_create(s->gl, &desc, err);
    if (!irradiance)
        return false;
    irb_texture_destroy(s->irradiance);
    irb_shadow_term_destroy(s->shadow_term);
    s->irradiance = irradiance;
    s->shadow_term = NULL;
    s->width = width;
    s->height = height;
    return true;
}

static void *acrsm_create(struct irb_gl *gl, const struct irb_scene_gl *scene, int width,
                          int height, const void *settings, struct irb_error *err)
{
    (void)scene;
    (void)settings;
    struct acrsm_state *s = calloc(1, sizeof *s);
    if (!s) {
        irb_fail(err, IRB_E_MEMORY, "acrsm: out of memory");
        return NULL;
    }
    s->gl = s->lighting.gl = gl;
    if (acrsm_resize(s, width, height, err))
        return s;
    acrsm_destroy(s);
    return NULL;
}

static bool acrsm_begin_sequence(void *user, const void *settings, uint64_t seed,
                                 struct irb_error *err)
{
    struct acrsm_state *s = user;
    (void)settings;
    s->seed = seed;
    return !s->clusters || acrsm_clusters_begin(s->clusters, seed, err);
}

/* Another resolution of the RSM is another sequence. */
static bool prepare_clustering(struct acrsm_state *s, int resolution, struct irb_error *err)
{
    if (s->clusters && s->clusters->resolution == resolution)
        return true;
    destroy_clustering(s);
    return (s->importance = irb_importance_create(s->gl, resolution, err)) &&
           (s->pyramid = irb_pyramid_create(s->gl, resolution, err)) &&
           (s->clusters = acrsm_clusters_create(s->gl, resolution, err)) &&
           acrsm_clusters_begin(s->clusters, s->seed, err);
}

static bool prepare_lighting(struct acrsm_state *s, const struct irb_frame_inputs *in,
                             const struct acrsm_resolved *r, struct irb_error *err)
{
    const struct acrsm_params *p = in->params;
    const bool shadows = acrsm_has_shadows(r);
    const struct irb_ism_lighting_desc desc = {
        .width = s->width,
        .height = s->height,
        .n = p->interleave_n,
        .m = p->interleave_m,
        .map_size = MAP_SIZE,
        .maps = shadows ? MAPS : 0,
        .points = shadows && !r->dynamic_points ? &r->points : NULL,
    };
    return irb_ism_lighting_prepare(&s->lighting, in->scene, &desc, err);
}

static bool cluster(struct acrsm_state *s, const struct irb_frame_inputs *in,
                    const struct acrsm_resolved *r, struct irb_error *err)
{
    struct acrsm_clusters *c = s->clusters;
    const struct acrsm_settings *settings = &r->clustering;
    const struct irb_texture *importance = s->importance->map;
    bool ok = acrsm_clusters_frame(c, in->rsm, settings, err);
    IRB_STAGE(ok, in, STAGE_IMPORTANCE,
              irb_importance_compute(s->importance, in->rsm, in->light, in->gbuffer, &r->importance,
                                     err) &&
                  irb_pyramid_build(s->pyramid, importance, err));
    IRB_STAGE(ok, in, STAGE_EVALUATE, acrsm_evaluate(c, in->rsm, settings, err));
    IRB_STAGE(ok, in, STAGE_SEED,
              acrsm_carry(c, in->rsm, settings, err) &&
                  acrsm_seed(c, in->rsm, importance, s->pyramid, settings, err));
    IRB_STAGE(ok, in, STAGE_MAP, acrsm_map(c, in->rsm, importance, settings, err));
    IRB_STAGE(ok, in, STAGE_AVERAGE,
              acrsm_average(c, in->rsm, in->light, importance, settings, err));
    return ok;
}

static bool light(struct acrsm_state *s, const struct irb_frame_inputs *in,
                  const struct acrsm_resolved *r, struct irb_error *err)
{
    const struct irb_virtual_lights lights = acrsm_clusters_lights(s->clusters);
    struct irb_ism_lighting *l = &s->lighting;
    const struct irb_ism *maps = acrsm_has_shadows(r) ? l->maps : NULL;
    bool ok = true;
    if (maps) {
        IRB_STAGE(ok, in, STAGE_SPLAT,
                  irb_ism_splat(l->maps, in->scene, r->dynamic_points ? NULL : l->points, &lights,
                                &r->ism, err));
        IRB_STAGE(ok, in, STAGE_PULL_PUSH, irb_ism_pull_push(l->maps, &r->ism, err));
    }
    IRB_STAGE(ok, in, STAGE_SPLIT, irb_interleave_split(l->interleave, in->gbuffer, err));
    IRB_STAGE(ok, in, STAGE_LIGHT,
              irb_shade_run(l->shade, l->interleave, &lights, maps, &r->shade, err));
    IRB_STAGE(ok, in, STAGE_MERGE, irb_interleave_merge(l->interleave, err));
    IRB_STAGE(ok, in, STAGE_FILTER,
              irb_interleave_filter(l->interleave, in->gbuffer, r->filter_depth, r->filter_cosine,
                                    s->irradiance, err));
    return ok;
}

/* Outside the stages: the report is no part of the method's cost. */
static bool report(struct acrsm_state *s, const struct irb_frame_inputs *in,
                   const struct acrsm_resolved *r, struct irb_frame_output *out,
                   struct irb_error *err)
{
    struct acrsm_report clusters;
    double coverage = 0;
    if (!acrsm_clusters_report(s->clusters, in->rsm, &clusters, err) ||
        (acrsm_has_shadows(r) && !irb_ism_coverage(s->lighting.maps, &coverage, err)))
        return false;
    out->uncovered_flux = clusters.uncovered;
    irb_output_statistic(out, "clusters", r->clustering.clusters);
    irb_output_statistic(out, "clusters_in_use", clusters.in_use);
    irb_output_statistic(out, "seeded", clusters.seeded);
    irb_output_statistic(out, "merged", clusters.merged);
    irb_output_statistic(out, "split", clusters.split);
    irb_output_statistic(out, "delta_spread", clusters.spread);
    irb_output_statistic(out, "count_spread", clusters.count_spread);
    irb_output_statistic(out, "flux_gain", clusters.gain);
    if (acrsm_has_shadows(r))
        irb_output_statistic(out, "coverage", coverage);
    if (acrsm_has_shadows(r) && !r->dynamic_points)
        irb_output_statistic(out, "point_bytes", (double)s->lighting.points->bytes);
    return true;
}

static bool prepare_pictures(struct acrsm_state *s, struct irb_error *err)
{
    const int resolution = s->clusters->resolution;
    const struct irb_texture_desc map = {
        .name = "acrsm: picture", .format = GL_RGBA32F, .width = resolution, .height = resolution};
    return (s->map_picture || (s->map_picture = irb_texture_create(s->gl, &map, err))) &&
           (s->centre_picture || (s->centre_picture = irb_texture_create(s->gl, &map, err))) &&
           (s->shadow_term ||
            (s->shadow_term = irb_shadow_term_create(s->gl, s->width, s->height, err)));
}

static bool debug(struct acrsm_state *s, const struct acrsm_resolved *r,
                  struct irb_frame_output *out, struct irb_error *err)
{
    if (!prepare_pictures(s, err) ||
        !acrsm_clusters_picture(s->clusters, ACRSM_PICTURE_MAP, s->map_picture, err) ||
        !acrsm_clusters_picture(s->clusters, ACRSM_PICTURE_CENTRES, s->centre_picture, err) ||
        !irb_shadow_term_draw(s->shadow_term, s->irradiance, err))
        return false;
    irb_output_layer(out, "cluster-map", s->map_picture, IRB_DEBUG_COLOUR);
    irb_output_layer(out, "cluster-centres", s->centre_picture, IRB_DEBUG_COLOUR);
    irb_output_layer(out, "importance", s->importance->map, IRB_DEBUG_SCALAR);
    if (acrsm_has_shadows(r))
        irb_output_layer(out, "ism-atlas", s->lighting.maps->atlas, IRB_DEBUG_DISTANCE);
    irb_output_layer(out, "shadow-term", s->shadow_term->image, IRB_DEBUG_SCALAR);
    irb_output_layer(out, "split", s->lighting.interleave->split, IRB_DEBUG_RADIANCE);
    return true;
}

static bool acrsm_render_frame(void *user, const struct irb_frame_inputs *in,
                               struct irb_frame_output *out, struct irb_error *err)
{
    struct acrsm_state *s = user;
    const struct acrsm_params *p = in->params;
    struct acrsm_resolved r;
    *out = (struct irb_frame_output){.irradiance = s->irradiance};
    acrsm_params_resolve(p, in->rsm->resolution, irb_scene_diagonal(in->scene->scene), s->seed, &r);
    return prepare_clustering(s, in->rsm->resolution, err) && prepare_lighting(s, in, &r, err) &&
           cluster(s, in, &r, err) && light(s, in, &r, err) && report(s, in, &r, out, err) &&
           (!in->debug || debug(s, &r, out, err));
}

static bool acrsm_claims_visibility(const void *settings)
{
    const struct acrsm_params *p = settings;
    return p->visibility != IRB_SHADE_NONE;
}

/* Also where nothing is merged or split: clusters stay where they are. */
static unsigned acrsm_needs(const void *settings)
{
    (void)settings;
    return IRB_NEEDS_HISTORY;
}

static bool acrsm_check(const void *settings, const struct irb_frame_sizes *sizes,
                        struct irb_error *err)
{
    const struct acrsm_params *p = settings;
    struct acrsm_resolved r;
    acrsm_params_resolve(p, sizes->rsm_resolution, 1, 1, &r);
    return !acrsm_has_shadows(&r) ||
           irb_tessellation_check((double)p->f_min, (double)p->f_max, r.points.smoothstep, err);
}

const struct irb_method irb_method_acrsm = {
    .abi = IRB_METHOD_ABI,
    .name = "acrsm",
    .title = "Adaptively-clustered reflective shadow maps",
    .citation = "F. Weinzierl-Heigl, Adaptively-Clustered Reflective Shadow Maps, master's thesis",
    .path_classes = "LDDE",
    .params_size = sizeof(struct acrsm_params),
    .params = acrsm_options,
    .stages = stages,
    .claims_visibility = acrsm_claims_visibility,
    .needs = acrsm_needs,
    .check = acrsm_check,
    .create = acrsm_create,
    .resize = acrsm_resize,
    .begin_sequence = acrsm_begin_sequence,
    .render_frame = acrsm_render_frame,
    .destroy = acrsm_destroy,
};
