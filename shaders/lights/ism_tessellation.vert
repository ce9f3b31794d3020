/* SPDX-License-Identifier: MIT
 *
 * Dynamic points (thesis 5.3.2), vertex stage: the corners of all triangles in world space.
 */
#include "lights/points.glsl"

out vec3 corner; /* world, m */

void main()
{
    int number = gl_VertexID % 3;
    corner = point_on_triangle(gl_VertexID / 3, vec2(number == 1, number == 2)).position;
}
