/* SPDX-License-Identifier: MIT
 *
 * The primary light, as core/scene/light.h defines it. Uniforms set by irb_light_uniforms().
 */
#define LIGHT_SPOT 0
#define LIGHT_DIRECTIONAL 1
#define FALLOFF_CONSTANT 0
#define FALLOFF_SMOOTH 1
#define FALLOFF_COSINE 2

uniform int light_type;
uniform int light_falloff_kind;
uniform vec3 light_position;
uniform vec3 light_direction; /* unit, the way the light travels */
uniform vec3 light_right;
uniform vec3 light_up;
uniform vec3 light_intensity; /* spot: W/sr; directional: W/m2 */
uniform float light_cos_outer;
uniform float light_smooth_width; /* cos inner - cos outer, at least 0.001 (KHR_lights_punctual) */
uniform float light_half_width; /* directional: half side of the beam, m */

/* Falloff at an angle from the axis; 0 outside the cone. */
float light_falloff(float cos_theta)
{
    if (cos_theta < light_cos_outer)
        return 0.0;
    if (light_falloff_kind == FALLOFF_SMOOTH) { /* KHR_lights_punctual */
        float t = (cos_theta - light_cos_outer) / light_smooth_width;
        t = clamp(t, 0.0, 1.0);
        return t * t;
    }
    if (light_falloff_kind == FALLOFF_COSINE) /* thesis 5.1.1 */
        return cos_theta / light_cos_outer;
    return 1.0;
}

/* Irradiance (W/m2) at a point, perpendicular to the light, were nothing in the way; the unit
 * direction to the light and the distance over which the way must be free. */
vec3 light_incident(vec3 point, out vec3 to_light, out float distance_to_light)
{
    vec3 from_light = point - light_position;
    if (light_type == LIGHT_DIRECTIONAL) {
        to_light = -light_direction;
        distance_to_light = dot(from_light, light_direction);
        vec2 across = vec2(dot(from_light, light_right), dot(from_light, light_up));
        bool inside = distance_to_light > 0.0 && all(lessThanEqual(abs(across),
                                                                    vec2(light_half_width)));
        return inside ? light_intensity : vec3(0.0);
    }
    float r2 = dot(from_light, from_light);
    distance_to_light = sqrt(r2);
    to_light = r2 > 0.0 ? -from_light / distance_to_light : -light_direction;
    if (r2 <= 0.0)
        return vec3(0.0);
    return light_intensity * (light_falloff(dot(-to_light, light_direction)) / r2);
}
