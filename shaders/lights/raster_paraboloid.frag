/* SPDX-License-Identifier: MIT
 *
 * Euclidean distance of the surface at a paraboloid's texel: where the texel's ray meets the
 * triangle itself. Blended by minimum.
 */
#include "frame/alpha_mask.glsl"
#include "lights/paraboloid.glsl"
#include "lights/raster_charts.glsl"

flat in vec4 edge_0; /* w: m, largest distance of a corner */
flat in vec4 edge_1;
flat in vec4 edge_2;
flat in vec4 plane;
#ifdef ALPHA_MASK
flat in vec2 corner_0;
flat in vec2 corner_1;
flat in vec2 corner_2;
#endif

uniform int raster_size;
uniform float near; /* m: nearer surfaces are left out */

out float distance_to_light; /* m */

void main()
{
    vec2 uv = raster_uv(gl_FragCoord.xy, raster_size);
    vec3 d = paraboloid_direction(paraboloid_above_horizon(uv, raster_size));
    vec3 share = vec3(dot(edge_0.xyz, d), dot(edge_1.xyz, d), dot(edge_2.xyz, d));
    float slope = dot(plane.xyz, d);
    float r = min(plane.w / slope, edge_0.w);
    bool hit = min(min(share.x, share.y), share.z) >= 0.0 && slope > 0.0 && r >= near;
    /* a texel that the disc does not touch is never read */
    float outside = 1.0 + 1.5 / float(raster_size);
    distance_to_light = hit && dot(uv, uv) < outside * outside ? r : RASTER_EMPTY;
#ifdef ALPHA_MASK
    float sum = share.x + share.y + share.z;
    vec2 texcoord = share.x * corner_0 + share.y * corner_1 + share.z * corner_2;
    cut_away(sum > 0.0 ? texcoord / sum : corner_0);
#endif
}
