/* SPDX-License-Identifier: MIT
 *
 * Dynamic points (thesis 5.3.2), control stage: levels from eqs 5.3 and 5.4, inner t_A, outer t_e.
 */
layout(vertices = 3) out;

uniform vec2 area_range; /* A_min, A_max of the scene at rest, m2 */
uniform vec2 edge_range; /* e_min, e_max, m */
uniform float f_min, f_max;
uniform int smoothstep_order;

in vec3 corner[];
out vec3 control_corner[];
patch out vec3 share; /* unit normal * area that a point stands for, m2 */

float factor(vec2 range, float value)
{
    float width = range.y - range.x;
    float x = width > 0.0 ? clamp((value - range.x) / width, 0.0, 1.0) : 0.0;
    float smoothed = smoothstep_order == 5 ? x * x * x * (x * (6.0 * x - 15.0) + 10.0)
                                           : x * x * (3.0 - 2.0 * x);
    return max(ceil(smoothed * f_max), f_min);
}

/* Points that the tessellator makes (OpenGL 4.5, 11.2.2.2): those on the edges, and on triangles
 * within one another that have two segments fewer a side each, down to one point or none. */
float point_total(vec3 outer, float inner)
{
    float n = ceil(inner);
    if (n == 1.0 && max(outer.x, max(outer.y, outer.z)) > 1.0)
        n = 2.0;
    float rings = floor((n - 1.0) / 2.0); /* of n - 2, n - 4, ... >= 1 segments a side */
    float segments = rings * (n - 1.0 - rings);
    return dot(ceil(outer), vec3(1.0)) + 3.0 * segments + (mod(n, 2.0) == 0.0 ? 1.0 : 0.0);
}

void main()
{
    control_corner[gl_InvocationID] = corner[gl_InvocationID];
    if (gl_InvocationID != 0)
        return;
    vec3 a = corner[2] - corner[1], b = corner[0] - corner[2], c = corner[1] - corner[0];
    vec3 normal = 0.5 * cross(c, -b);
    float area = length(normal);
    /* outer level i belongs to the edge opposite of corner i, as a, b and c do */
    vec3 outer = vec3(factor(edge_range, length(a)), factor(edge_range, length(b)),
                      factor(edge_range, length(c)));
    float inner = factor(area_range, area);
    share = normal / point_total(outer, inner);
    if (!(area > 0.0))
        outer = vec3(0.0); /* no points */
    gl_TessLevelOuter[0] = outer.x;
    gl_TessLevelOuter[1] = outer.y;
    gl_TessLevelOuter[2] = outer.z;
    gl_TessLevelInner[0] = inner;
}
