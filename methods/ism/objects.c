/* SPDX-License-Identifier: MIT */
#include "methods/ism/objects.h"

#include "core/lights/point_need.h"

#include <stdlib.h>
#include <string.h>

bool ism_objects_resize(struct ism_objects *o, int width, int height, struct irb_error *err)
{
    const struct irb_texture_desc desc = {
        .name = "ism: irradiance", .format = GL_RGBA32F, .width = width, .height = height};
    struct irb_texture *irradiance = irb_texture_create(o->gl, &desc, err);
    if (!irradiance)
        return false;
    irb_texture_destroy(o->irradiance);
    irb_interleave_destroy(o->interleave);
    o->irradiance = irradiance;
    o->interleave = NULL;
    o->width = width;
    o->height = height;
    return true;
}

struct ism_objects *ism_objects_create(struct irb_gl *gl, int width, int height,
                                       struct irb_error *err)
{
    struct ism_objects *o = calloc(1, sizeof *o);
    if (!o) {
        irb_fail(err, IRB_E_MEMORY, "ism: out of memory");
        return NULL;
    }
    o->gl = gl;
    if (ism_objects_resize(o, width, height, err) && (o->shade = irb_shade_create(gl, err)))
        return o;
    ism_objects_destroy(o);
    return NULL;
}

static void destroy_lights(struct ism_objects *o)
{
    irb_vpl_set_destroy(o->lights);
    irb_importance_destroy(o->importance);
    irb_pyramid_destroy(o->pyramid);
    o->lights = NULL;
    o->importance = NULL;
    o->pyramid = NULL;
}

void ism_objects_destroy(struct ism_objects *o)
{
    if (!o)
        return;
    irb_texture_destroy(o->irradiance);
    irb_interleave_destroy(o->interleave);
    destroy_lights(o);
    irb_points_destroy(o->points);
    free(o->weights);
    irb_ism_destroy(o->maps);
    irb_raster_maps_destroy(o->raster);
    irb_shade_destroy(o->shade);
    free(o);
}

static bool prepare_interleave(struct ism_objects *o, const struct ism_params *p,
                               struct irb_error *err)
{
    /* an image that is narrower has fewer tiles */
    const int n = p->interleave_n < o->width ? p->interleave_n : o->width;
    const int m = p->interleave_m < o->height ? p->interleave_m : o->height;
    if (o->interleave && o->interleave->n == n && o->interleave->m == m)
        return true;
    irb_interleave_destroy(o->interleave);
    o->interleave = irb_interleave_create(o->gl, o->width, o->height, n, m, err);
    return o->interleave != NULL;
}

static bool prepare_lights(struct ism_objects *o, const struct ism_params *p, int rsm_resolution,
                           struct irb_error *err)
{
    const bool map = p->importance == ISM_BIDIRECTIONAL;
    const enum irb_vpl_sampling sampling = map ? IRB_VPL_MAP : IRB_VPL_IMPORTANCE;
    if (o->lights && o->lights->sampling == sampling && o->rsm_resolution == rsm_resolution)
        return true;
    destroy_lights(o);
    o->rsm_resolution = rsm_resolution;
    /* as many as there can be: their number may change from frame to frame */
    return (o->lights = irb_vpl_set_create(o->gl, sampling, rsm_resolution, IRB_VPL_BLOCK, err)) &&
           (!map || ((o->importance = irb_importance_create(o->gl, rsm_resolution, err)) &&
                     (o->pyramid = irb_pyramid_create(o->gl, rsm_resolution, err))));
}

static struct irb_points_desc points_desc_of(const struct ism_params *p, uint64_t seed)
{
    if (p->points == ISM_AREA)
        return (struct irb_points_desc){
            .kind = IRB_POINTS_AREA, .count = p->point_count, .seed = seed};
    return (struct irb_points_desc){
        .kind = IRB_POINTS_TESSELLATION,
        .f_min = p->f_min,
        .f_max = p->f_max,
        .smoothstep = p->smoothstep == ISM_SMOOTHSTEP_5 ? 5 : 3,
    };
}

static bool same_points(const struct irb_points_desc *a, const struct irb_points_desc *b)
{
    return a->kind == b->kind && a->count == b->count && a->seed == b->seed &&
           a->f_min == b->f_min && a->f_max == b->f_max && a->smoothstep == b->smoothstep;
}

/* points_desc is left as no other points have it, so that none take these for theirs. */
static bool make_adaptive_points(struct ism_objects *o, const struct ism_params *p,
                                 const struct irb_scene_gl *scene, struct irb_points_desc desc,
                                 struct irb_error *err)
{
    const struct irb_virtual_lights lights = irb_vpl_set_view(o->lights);
    irb_points_destroy(o->points);
    o->points = NULL;
    o->points_desc = (struct irb_points_desc){.count = -1};
    if (!o->weights &&
        !(o->weights = malloc(((size_t)scene->scene->triangle_count + 1) * sizeof *o->weights)))
        return irb_fail(err, IRB_E_MEMORY, "ism: out of memory");
    desc.weights = o->weights;
    return irb_point_weights(scene->scene, &lights, p->adaptive_points, o->weights, err) &&
           (o->points = irb_points_create(o->gl, scene, &desc, err));
}

bool ism_objects_prepare_points(struct ism_objects *o, const struct ism_params *p,
                                const struct irb_scene_gl *scene, uint64_t seed,
                                struct irb_error *err)
{
    const struct irb_points_desc desc = points_desc_of(p, seed);
    const bool wanted = p->visibility == ISM_IMPERFECT && p->points != ISM_DYNAMIC;
    if (wanted && ism_adapts_points(p))
        return make_adaptive_points(o, p, scene, desc, err);
    if (wanted && o->points && same_points(&desc, &o->points_desc))
        return true;
    irb_points_destroy(o->points);
    o->points = NULL;
    o->points_desc = desc;
    return !wanted || (o->points = irb_points_create(o->gl, scene, &desc, err));
}

/* The atlas grows with the number of lights and does not shrink. */
static bool prepare_maps(struct ism_objects *o, const struct ism_params *p, struct irb_error *err)
{
    const int side = ism_map_side(p);
    if (o->maps && o->maps->map_size == side && o->maps->capacity >= p->vpls)
        return true;
    irb_ism_destroy(o->maps);
    o->maps = irb_ism_create(o->gl, side, p->vpls, err);
    return o->maps != NULL;
}

/* As many at a time as memory allows. */
static bool prepare_raster_maps(struct ism_objects *o, const struct ism_params *p,
                                struct irb_error *err)
{
    const int side = ism_map_side(p);
    const int most = irb_raster_maps_most(o->gl, IRB_RASTER_HEMICUBE, side);
    const int capacity = p->vpls < most ? p->vpls : most;
    if (o->raster && o->raster->size == side && o->raster->capacity >= capacity)
        return true;
    irb_raster_maps_destroy(o->raster);
    o->raster = irb_raster_maps_create(o->gl, IRB_RASTER_HEMICUBE, side, capacity, err);
    return o->raster != NULL;
}

bool ism_objects_prepare(struct ism_objects *o, const struct ism_params *p, int rsm_resolution,
                         struct irb_error *err)
{
    return prepare_interleave(o, p, err) && prepare_lights(o, p, rsm_resolution, err) &&
           (p->visibility != ISM_IMPERFECT || prepare_maps(o, p, err)) &&
           (p->visibility != ISM_EXACT_RASTER || prepare_raster_maps(o, p, err));
}
