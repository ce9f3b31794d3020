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
    bool dark;             /* no cone, beam or intensity */
    struct vec3 position, direction, right, up;
    struct vec3 intensity; /* W/sr or W/m2 at falloff 1 */
    float cos_outer;
    float falloff_scale;   /* SMOOTH: 1/max(0.001, cos_inner - cos_outer); COSINE: 1/cos_outer */
    float versine;         /* 1 - cos_outer, without cancellation */
    float half_width;
    float density;         /* of emit(): 1/solid angle of the cone, or 1/area of the beam */
    float offset;          /* surfaces nearer to the light than this do not block it, metres */
};

void light_source_prepare(struct light_source *out, const struct irb_light *light,
                          float scene_offset);

/* Light at a point, were nothing in the way. */
struct light_incident {
    float factor;        /* irradiance on an element perpendicular to the light / intensity */
    float density;       /* of emit()'s rays through a perpendicular element, 1/m2 */
    float distance;
    struct vec3 to_light;
};

static inline float light_source_falloff(const struct light_source *light, float cos_theta)
{
    if (light->falloff == IRB_FALLOFF_SMOOTH) {
        float s = fminf(1, (cos_theta - light->cos_outer) * light->falloff_scale);
        return s * s;
    }
    return light->falloff == IRB_FALLOFF_COSINE ? cos_theta * light->falloff_scale : 1;
}

/* False outside the cone or beam. */
static inline bool light_source_incident(const struct light_source *light, struct vec3 point,
                                         struct light_incident *out)
{
    struct vec3 d = v3_sub(light->position, point);
    if (light->type == IRB_LIGHT_DIRECTIONAL) {
        out->distance = -v3_dot(d, light->direction);
        if (!(out->distance > 0) || fabsf(v3_dot(d, light->right)) > light->half_width ||
            fabsf(v3_dot(d, light->up)) > light->half_width)
            return false;
        out->to_light = v3_scale(light->direction, -1);
        out->factor = 1;
        out->density = light->density;
        return true;
    }
    float r2 = v3_dot(d, d);
    if (!(r2 > 0))
        return false;
    float inverse = 1 / sqrtf(r2);
    out->to_light = v3_scale(d, inverse);
    float cos_theta = -v3_dot(out->to_light, light->direction);
    if (!(cos_theta >= light->cos_outer))
        return false;
    inverse *= inverse;
    out->distance = sqrtf(r2);
    out->factor = light_source_falloff(light, cos_theta) * inverse;
    out->density = light->density * inverse;
    return true;
}

/* A ray of the light for a point of the unit square: uniform in the cone's solid angle, or over the
 * beam's square. */
void light_source_emit(const struct light_source *light, float x, float y, struct vec3 *origin,
                       struct vec3 *direction);

#endif
