/* SPDX-License-Identifier: MIT
 *
 * Private to the room: the primary light prepared for the inner loop. The same radiometry as
 * core/scene/light.h (a test compares the two), with what does not depend on the point computed
 * once, and the densities that multiple importance sampling needs.
 */
#ifndef IRB_REFERENCE_LIGHT_SOURCE_H
#define IRB_REFERENCE_LIGHT_SOURCE_H

#include "core/reference/vec3.h"
#include "core/scene/light.h"

struct light_source {
    enum irb_light_type type;
    enum irb_falloff falloff;
    bool dark; /* no cone, beam or intensity */
    struct vec3 position, direction, right, up;
    struct vec3 intensity; /* W/sr or W/m2 at falloff 1 */
    float cos_outer;
    float falloff_scale; /* SMOOTH: 1/max(0.001, cos_inner - cos_outer); COSINE: 1/cos_outer */
    float versine;       /* 1 - cos_outer, without cancellation */
    float half_width;
    float density; /* of emit(): 1/solid angle of the cone, or 1/area of the beam */
    float offset;  /* surfaces nearer to the light than this do not block it, metres */
};

void light_source_prepare(struct light_source *out, const struct irb_light *light,
                          float scene_offset);

/* Light at a point, were nothing in the way. */
struct light_incident {
    float factor;  /* irradiance on an element perpendicular to the light / intensity */
    float density; /* of emit()'s rays through a perpendicular element, 1/m2 */
    float cos_geometric, cos_shading; /* between the surface's normals and the light */
    float distance;
    float inverse_distance;
    struct vec3 to_light;
};

static inline float light_source_falloff(const struct light_source *light, enum irb_falloff falloff,
                                         float cos_theta)
{
    if (falloff == IRB_FALLOFF_SMOOTH) {
        float s = (cos_theta - light->cos_outer) * light->falloff_scale;
        return smaller(1, s * s);
    }
    return falloff == IRB_FALLOFF_COSINE ? cos_theta * light->falloff_scale : 1;
}

/* 0 outside the cone or beam, and where either normal faces away, else 1. `type` and `falloff` are
 * the light's; as constants they leave no branch. */
static inline int light_source_incident(const struct light_source *light, enum irb_light_type type,
                                        enum irb_falloff falloff, struct vec3 point,
                                        struct vec3 geometric, struct vec3 shading,
                                        struct light_incident *out)
{
    struct vec3 d = v3_sub(light->position, point);
    int inside;
    if (type == IRB_LIGHT_DIRECTIONAL) {
        out->to_light = v3_scale(light->direction, -1);
        out->distance = -v3_dot(d, light->direction);
        out->factor = 1;
        out->density = light->density;
        inside = (out->distance > 0) & (fabsf(v3_dot(d, light->right)) <= light->half_width) &
                 (fabsf(v3_dot(d, light->up)) <= light->half_width);
    } else {
        float r2 = v3_dot(d, d), inverse2 = 1 / r2;
        float cos_theta;
        out->distance = sqrtf(r2);
        out->inverse_distance = out->distance * inverse2;
        out->to_light = v3_scale(d, out->inverse_distance);
        cos_theta = -v3_dot(out->to_light, light->direction);
        inside = cos_theta >= light->cos_outer; /* false for r = 0, which gives NaN */
        out->factor = light_source_falloff(light, falloff, cos_theta) * inverse2;
        out->density = light->density * inverse2;
    }
    out->cos_geometric = v3_dot(geometric, out->to_light);
    out->cos_shading = v3_dot(shading, out->to_light);
    return inside & (out->cos_geometric > 0) & (out->cos_shading > 0);
}

/* The shadow ray of a point whose rays start at `origin`: towards a spot itself, along the beam of
 * a directional light. `far` counts in lengths of the direction. */
static inline void light_source_shadow(const struct light_source *light, enum irb_light_type type,
                                       const struct light_incident *incident, struct vec3 origin,
                                       struct vec3 *direction, float *far)
{
    if (type == IRB_LIGHT_SPOT) {
        *direction = v3_sub(light->position, origin);
        *far = 1 - light->offset * incident->inverse_distance;
    } else {
        *direction = incident->to_light;
        *far = incident->distance - light->offset;
    }
}

/* A ray of the light: for a spot from a point of the unit disc, uniform in the cone's solid angle;
 * for a beam from a point of the unit square, uniform over the beam. */
static inline void light_source_emit(const struct light_source *light, float x, float y,
                                     struct vec3 *origin, struct vec3 *direction)
{
    if (light->type == IRB_LIGHT_DIRECTIONAL) {
        *origin = v3_mad(light->position, light->half_width * (2 * x - 1), light->right);
        *origin = v3_mad(*origin, light->half_width * (2 * y - 1), light->up);
        *direction = light->direction;
        return;
    }
    /* area-preserving: 1 - cos(theta) is uniform in r^2 */
    float v = light->versine * (x * x + y * y);
    float s = sqrtf(light->versine * (2 - v));
    struct vec3 d = v3_scale(light->direction, 1 - v);
    d = v3_mad(d, x * s, light->right);
    *origin = light->position;
    *direction = v3_mad(d, y * s, light->up);
}

#endif
