/* SPDX-License-Identifier: MIT
 *
 * Reflected flux of the RSM, dark and grey: a background.
 */
layout(local_size_x = 8, local_size_y = 8) in;
#include "frame/rsm_fetch.glsl"

uniform float flux_unit; /* 1/W */
layout(rgba32f, binding = 0) writeonly uniform image2D picture;

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, ivec2(rsm_resolution()))))
        return;
    float flux = dot(rsm_fetch_flux(texel), vec3(1.0 / 3.0)) * flux_unit;
    imageStore(picture, texel, vec4(vec3(0.4 * pow(clamp(flux, 0.0, 1.0), 1.0 / 2.2)), 1.0));
}
