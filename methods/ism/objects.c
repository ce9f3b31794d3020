/* SPDX-License-Identifier: MIT */
#include "methods/ism/objects.h"

#include "core/lights/point_need.h"
#include "core/lights/tessellation.h"

#include <stdlib.h>

bool ism_objects_resize(struct ism_objects *o, int width, int height, struct irb_error *err)
{
    const struct irb_texture_desc desc = {
        .name = "ism: irradiance", .format = GL_RGBA32F, .width = width, .height = height};
    struct irb_texture *irradiance = irb_texture_create(o->gl, &desc, err);
    if (!irradiance)
        return false;
    irb_texture_destroy(o->irradiance);
    o->irradiance = irradiance;
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
    o->gl = o->lighting.gl = gl;
    if (ism_objects_resize(o, width, height, err))
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
    destroy_lights(o);
    irb_ism_lighting_destroy(&o->lighting);
    free(o->weights);
    irb_raster_maps_destroy(o->raster);
    free(o);
}

/* The maps grow with the number of lights and do not shrink. */
static bool prepare_lighting(struct ism_objects *o, const struct ism_params *p,
                             const struct irb_scene_gl *scene, struct irb_error *err)
{
    const struct irb_ism_lighting_desc desc = {
        .width = o->width,
        .height = o->height,
        .n = p->interleave_n,
        .m = p->interleave_m,
        .map_size = ism_map_side(p),
        .maps = p->visibility == ISM_IMPERFECT ? p->vpls : 0,
    };
    return irb_ism_lighting_prepare(&o->lighting, scene, &desc, err);
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
        .smoothstep = irb_smoothstep_order(p->smoothstep),
    };
}

static bool weigh_points(struct ism_objects *o, const struct ism_params *p,
                         const struct irb_scene *scene, struct irb_error *err)
{
    const struct irb_virtual_lights lights = irb_vpl_set_view(o->lights);
    if (!o->weights &&
        !(o->weights = malloc(((size_t)scene->triangle_count + 1) * sizeof *o->weights)))
        return irb_fail(err, IRB_E_MEMORY, "ism: out of memory");
    return irb_point_weights(scene, &lights, p->adaptive_points, o->weights, err);
}

bool ism_objects_prepare_points(struct ism_objects *o, const struct ism_params *p,
                                const struct irb_scene_gl *scene, uint64_t seed,
                                struct irb_error *err)
{
    struct irb_points **points = &o->lighting.points;
    struct irb_points_desc desc = points_desc_of(p, seed);
    if (p->visibility != ISM_IMPERFECT || p->points == ISM_DYNAMIC) {
        irb_points_destroy(*points);
        *points = NULL;
        return true;
    }
    if (ism_adapts_points(p)) {
        if (!weigh_points(o, p, scene->scene, err))
            return false;
        desc.weights = o->weights;
    }
    return irb_points_prepare(points, o->gl, scene, &desc, err);
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

bool ism_objects_prepare(struct ism_objects *o, const struct ism_params *p,
                         const struct irb_scene_gl *scene, int rsm_resolution,
                         struct irb_error *err)
{
    return prepare_lighting(o, p, scene, err) && prepare_lights(o, p, rsm_resolution, err) &&
           (p->visibility != ISM_EXACT_RASTER || prepare_raster_maps(o, p, err));
}
