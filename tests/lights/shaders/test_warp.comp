/* SPDX-License-Identifier: MIT
 *
 * Halton points warped all the way down (texel and probability) and `levels` levels down.
 */
layout(local_size_x = 64) in;
#include "lights/warp.glsl"

uniform uint count;
uniform int levels;
layout(std430, binding = 0) writeonly buffer Out { vec4 warped[]; }; /* two a point */

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= count)
        return;
    float probability;
    ivec2 texel = warp(halton(i), probability);
    warped[2u * i] = vec4(warp_levels(halton(i), levels), halton(i));
    warped[2u * i + 1u] = vec4(texel, probability, 0.0);
}
