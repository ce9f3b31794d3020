/* SPDX-License-Identifier: MIT
 *
 * One level of the pyramid of sums that lights/warp.glsl walks down; level 0 is a map (SOURCE_MAP
 * 1) or the luminance of the RSM's reflected flux (0). Fixed order of additions: the same bits on
 * every run.
 */
layout(local_size_x = 8, local_size_y = 8) in;

#include "frame/rsm_fetch.glsl"

uniform sampler2D map;
uniform int resolution;
uniform int level;
uniform int side;        /* of this level */
uniform int offset;      /* of this level */
uniform int finer_offset; /* of level - 1 */

layout(std430, binding = 2) buffer Pyramid { float pyramid[]; };

const vec3 LUMINANCE = vec3(0.2126, 0.7152, 0.0722); /* Rec.709 */
const float MOST = 1e30; /* of a value: the sum over any map of 2^28 texels is finite */

float value_of(ivec2 at)
{
#if SOURCE_MAP
    float value = texelFetch(map, at, 0).r;
#else
    float value = dot(rsm_fetch_flux(at), LUMINANCE);
#endif
    return value > 0.0 && !isinf(value) ? min(value, MOST) : 0.0; /* false for NaN */
}

void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (at.x >= side || at.y >= side)
        return;
    float value = 0.0;
    if (level > 0) {
        int corner = finer_offset + 4 * at.y * side + 2 * at.x;
        value = (pyramid[corner] + pyramid[corner + 1]) +
                (pyramid[corner + 2 * side] + pyramid[corner + 2 * side + 1]);
    } else if (at.x < resolution && at.y < resolution) {
        value = value_of(at);
    }
    pyramid[offset + at.y * side + at.x] = value;
}
