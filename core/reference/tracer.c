/* SPDX-License-Identifier: MIT
 *
 * Everything that depends on Embree 3. Embree 4 has other names for three things used here: the
 * header (embree4), RTCIntersectContext (now RTCIntersectArguments, passed last and optional), and
 * their flags.
 */
#include "core/reference/tracer.h"

#include <embree3/rtcore.h>
#include <stdlib.h>

struct irb_tracer {
    RTCDevice device;
    RTCScene scene;
    struct surface_set surfaces;
    uint32_t *triangle_of[2]; /* of each geometry's primitives, where there are masks; owned */
};

/* Geometries of the scene: an alpha mask costs a call a hit, which only what has one shall pay. */
enum { OPAQUE, MASKED, GEOMETRIES };

/* Embree's filter: a hit that the mask leaves out doesn't count, and the ray goes on. Rays are
 * traced one by one, for which RTCHitN is a plain RTCHit. */
static void cut_away(const struct RTCFilterFunctionNArguments *args)
{
    const struct irb_tracer *tracer = args->geometryUserPtr;
    const struct RTCHit *hit = (const void *)args->hit;
    if (args->valid[0] == -1 &&
        !surface_is_there(&tracer->surfaces, tracer->triangle_of[MASKED][hit->primID], hit->u,
                          hit->v))
        args->valid[0] = 0;
}

static void fill_geometry(const struct irb_tracer *tracer, unsigned id, struct vec3 *vertices,
                          uint32_t *indices, uint32_t count)
{
    const struct surface_set *set = &tracer->surfaces;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t triangle = set->masked ? tracer->triangle_of[id][i] : i;
        for (uint32_t k = 3 * i; k < 3 * i + 3; k++) {
            vertices[k] = set->triangles[triangle].vertex[k - 3 * i];
            indices[k] = k;
        }
    }
}

static bool attach_geometry(struct irb_tracer *tracer, unsigned id, uint32_t count)
{
    RTCGeometry geometry = rtcNewGeometry(tracer->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    struct vec3 *vertices =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof *vertices, 3 * (size_t)count);
    uint32_t *indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
                                                RTC_FORMAT_UINT3, 3 * sizeof *indices, count);
    if (vertices && indices) {
        fill_geometry(tracer, id, vertices, indices, count);
        rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
        if (id == MASKED) {
            rtcSetGeometryUserData(geometry, tracer);
            rtcSetGeometryIntersectFilterFunction(geometry, cut_away);
            rtcSetGeometryOccludedFilterFunction(geometry, cut_away);
        }
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(tracer->scene, geometry, id);
    }
    rtcReleaseGeometry(geometry);
    return vertices && indices;
}

/* Without masks one geometry holds all triangles, numbered as they are. */
static bool attach_geometries(struct irb_tracer *tracer)
{
    const struct surface_set *set = &tracer->surfaces;
    uint32_t counts[GEOMETRIES] = {0};
    if (!set->masked)
        return attach_geometry(tracer, OPAQUE, set->triangle_count);
    for (int id = 0; id < GEOMETRIES; id++) {
        tracer->triangle_of[id] = malloc(set->triangle_count * sizeof *tracer->triangle_of[id]);
        if (!tracer->triangle_of[id])
            return false;
    }
    for (uint32_t i = 0; i < set->triangle_count; i++) {
        int id = surface_is_masked(set, i) ? MASKED : OPAQUE;
        tracer->triangle_of[id][counts[id]++] = i;
    }
    return (!counts[OPAQUE] || attach_geometry(tracer, OPAQUE, counts[OPAQUE])) &&
           attach_geometry(tracer, MASKED, counts[MASKED]);
}

struct irb_tracer *irb_tracer_create(const struct irb_scene *scene, struct irb_error *err)
{
    struct irb_tracer *tracer = calloc(1, sizeof *tracer);
    if (!tracer) {
        irb_fail(err, IRB_E_MEMORY, "no memory for the tracer");
        return NULL;
    }
    if (!surface_set_create(&tracer->surfaces, scene, err)) {
        free(tracer);
        return NULL;
    }
    /* One thread builds, so that the tree, and with it the order in which ties at shared edges are
     * resolved, is the same each time. */
    tracer->device = rtcNewDevice("threads=1");
    if (tracer->device)
        tracer->scene = rtcNewScene(tracer->device);
    bool attached = tracer->scene && attach_geometries(tracer);
    if (attached) {
        rtcSetSceneFlags(tracer->scene, RTC_SCENE_FLAG_ROBUST);
        rtcSetSceneBuildQuality(tracer->scene, RTC_BUILD_QUALITY_HIGH);
        rtcCommitScene(tracer->scene);
    }
    enum RTCError error = rtcGetDeviceError(tracer->device);
    if (!attached || error != RTC_ERROR_NONE) {
        irb_fail(err, error == RTC_ERROR_OUT_OF_MEMORY ? IRB_E_MEMORY : IRB_E_INTERNAL,
                 "Embree could not build scene %s (error %d)", scene->name, (int)error);
        irb_tracer_destroy(tracer);
        return NULL;
    }
    return tracer;
}

void irb_tracer_destroy(struct irb_tracer *tracer)
{
    if (!tracer)
        return;
    if (tracer->scene)
        rtcReleaseScene(tracer->scene);
    if (tracer->device)
        rtcReleaseDevice(tracer->device);
    surface_set_destroy(&tracer->surfaces);
    free(tracer->triangle_of[OPAQUE]);
    free(tracer->triangle_of[MASKED]);
    free(tracer);
}

const struct surface_set *irb_tracer_surfaces(const struct irb_tracer *tracer)
{
    return &tracer->surfaces;
}

void *irb_tracer_embree_scene(const struct irb_tracer *tracer)
{
    return tracer->scene;
}

static void record(struct trace_recording *recording, const struct trace_ray *rays, int count,
                   bool occlusion)
{
    for (int i = 0; i < count && recording->count < recording->capacity; i++) {
        recording->rays[recording->count] = rays[i];
        recording->occlusion[recording->count++] = occlusion;
    }
}

/* Field by field: a whole struct would be copied by loads that are wider than the stores before
 * them, for which the processor has to wait. */
static inline void fill_ray(struct RTCRay *out, const struct trace_ray *ray)
{
    out->org_x = ray->origin.x;
    out->org_y = ray->origin.y;
    out->org_z = ray->origin.z;
    out->tnear = ray->near;
    out->dir_x = ray->direction.x;
    out->dir_y = ray->direction.y;
    out->dir_z = ray->direction.z;
    out->time = 0;
    out->tfar = ray->far;
    out->mask = ~0u;
    out->id = 0;
    out->flags = 0;
}

void trace_closest(struct trace_context *context, const struct trace_ray *rays, int count,
                   struct trace_hit *hits)
{
    struct RTCIntersectContext embree;
    RTCScene scene = context->tracer->scene;
    const bool masked = context->tracer->surfaces.masked;
    rtcInitIntersectContext(&embree);
    context->rays += (uint64_t)count;
    if (context->recording)
        record(context->recording, rays, count, false);
    for (int i = 0; i < count; i++) {
        struct RTCRayHit query;
        fill_ray(&query.ray, &rays[i]);
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        query.hit.primID = TRACE_MISS; /* left alone where nothing is hit */
        rtcIntersect1(scene, &embree, &query);
        hits[i].t = query.ray.tfar;
        hits[i].u = query.hit.u;
        hits[i].v = query.hit.v;
        hits[i].triangle = query.hit.primID;
        if (masked && query.hit.primID != TRACE_MISS)
            hits[i].triangle = context->tracer->triangle_of[query.hit.geomID][query.hit.primID];
    }
}

void trace_occluded(struct trace_context *context, const struct trace_ray *rays, int count,
                    bool *occluded)
{
    struct RTCIntersectContext embree;
    RTCScene scene = context->tracer->scene;
    rtcInitIntersectContext(&embree);
    context->rays += (uint64_t)count;
    if (context->recording)
        record(context->recording, rays, count, true);
    for (int i = 0; i < count; i++) {
        struct RTCRay ray;
        fill_ray(&ray, &rays[i]);
        rtcOccluded1(scene, &embree, &ray);
        occluded[i] = ray.tfar < 0; /* Embree sets -inf where something is in the way */
    }
}
