/* SPDX-License-Identifier: MIT
 *
 * Shadow of the primary light by 25-tap percentage-closer filtering of the RSM's linear distances
 * (thesis 5.3.4). Each tap compares with the receiver's tangent plane along the tap's own ray, so
 * that the kernel needs no bias against a plane's slope; what is left for curvature and rasterised
 * texels is a bias of one texel's footprint. Source of the bias: ours.
 */
#include "frame/light.glsl"

uniform sampler2D rsm_normal; /* distance in w, 0 where there is no geometry */
uniform mat4 rsm_view_projection;
uniform float rsm_half_extent;

const int PCF_RADIUS = 2; /* 5 x 5 taps */
const float BIAS_TEXELS = 1.0;    /* of a texel's footprint perpendicular to the light */
const float MAX_SLOPE = 10.0;   /* tangent up to which the plane is followed away from the light */

/* Distance (spot: from the apex; beam: along it) of the plane through `point` on the ray of the
 * image point `xy`. */
float plane_distance(vec3 point, vec3 normal, vec2 xy)
{
    vec3 across = xy.x * light_right + xy.y * light_up;
    vec3 from_light = point - light_position;
    if (light_type == LIGHT_DIRECTIONAL)
        return dot(normal, from_light - across) / dot(normal, light_direction);
    return dot(normal, from_light) / dot(normal, normalize(light_direction + across));
}

/* Share of the taps that are lit. distance_to_light as the RSM stores it. */
float shadow_factor(vec3 point, vec3 normal, float distance_to_light)
{
    int resolution = textureSize(rsm_normal, 0).x;
    vec4 clip = rsm_view_projection * vec4(point, 1.0);
    if (clip.w <= 0.0)
        return 1.0;
    ivec2 centre = ivec2(floor((clip.xy / clip.w * 0.5 + 0.5) * float(resolution)));
    float side = 2.0 * rsm_half_extent / float(resolution);
    float footprint = light_type == LIGHT_DIRECTIONAL ? side : side * clip.w;
    float bias = BIAS_TEXELS * footprint;
    float reach = MAX_SLOPE * float(PCF_RADIUS + 1) * footprint;
    float lit = 0.0;
    for (int y = -PCF_RADIUS; y <= PCF_RADIUS; y++) {
        for (int x = -PCF_RADIUS; x <= PCF_RADIUS; x++) {
            /* beyond the border the nearest texel stands in: counting those taps as lit would draw
             * the rim of the cone onto surfaces in shadow */
            ivec2 texel = clamp(centre + ivec2(x, y), ivec2(0), ivec2(resolution - 1));
            float blocker = texelFetch(rsm_normal, texel, 0).w;
            vec2 xy = (vec2(texel) + 0.5) * side - rsm_half_extent;
            float receiver = plane_distance(point, normal, xy);
            /* beyond the plane's horizon the quotient changes sign or grows without bound */
            receiver = receiver > 0.0 ? min(receiver, distance_to_light + reach)
                                      : distance_to_light + reach;
            lit += blocker == 0.0 || blocker >= receiver - bias ? 1.0 : 0.0;
        }
    }
    return lit / float((2 * PCF_RADIUS + 1) * (2 * PCF_RADIUS + 1));
}
