/* SPDX-License-Identifier: MIT
 *
 * Members of clusters as they are read from the RSM.
 */
#include "frame/rsm_fetch.glsl"
#include "frame/solid_angle.glsl"
#include "methods/rsm_clustering/member.glsl"

/* A surface seen at a flatter angle counts as if it were seen at this one: cosines of shading
 * normals may be 0 where the triangle's is not. Source: ours. */
const float LEAST_COSINE = 0.05;

/* Surface that the texel sees, m2: dw r^2/cos, or side^2/cos for a beam. */
float texel_area(ivec2 texel, vec3 position, vec3 normal)
{
    float side = 2.0 * rsm_half_extent / float(rsm_resolution());
    vec3 to_light = rsm_light_position - position;
    if (rsm_spread.x == 0.0)
        return side * side / max(-dot(normal, rsm_light_direction), LEAST_COSINE);
    float r2 = dot(to_light, to_light);
    float cosine = r2 > 0.0 ? dot(normal, to_light) * inversesqrt(r2) : 1.0;
    vec2 corner = vec2(texel) * side - rsm_half_extent;
    return texel_solid_angle(corner, side) * r2 / max(cosine, LEAST_COSINE);
}

member fetch_member(ivec2 texel)
{
    vec3 position = rsm_fetch_position(texel).xyz, normal = rsm_fetch_normal(texel);
    return member(position, texel_area(texel, position, normal), normal, rsm_fetch_flux(texel));
}
