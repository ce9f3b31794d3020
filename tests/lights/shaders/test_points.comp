/* SPDX-License-Identifier: MIT
 *
 * Points of a chunk as splatters see them: position, share.
 */
layout(local_size_x = 64) in;
#include "lights/points.glsl"

layout(std430, binding = 0) writeonly buffer Out { vec4 found[]; };
uniform int point_count;
uniform int first_point;

void main()
{
    int i = int(gl_GlobalInvocationID.x);
    if (i >= point_count)
        return;
    surface_point p = fetch_point(i);
    found[2 * (first_point + i)] = vec4(p.position, 0.0);
    found[2 * (first_point + i) + 1] = vec4(p.share, 0.0);
}
