/* SPDX-License-Identifier: MIT
 *
 * Dynamic points (thesis 5.3.2), evaluation stage: each new point and the index of its first map,
 *     i = primitive + 7 u + 89 v + 991 w,
 * whole part taken. The primitive is the triangle's number in the scene.
 */
layout(triangles, equal_spacing, point_mode) in;
#include "lights/ism_splat.glsl"

in vec3 control_corner[];
patch in vec3 share;

out vec3 position; /* world, m */
out vec3 share_of_point;
flat out uint index;
flat out uint random;

void main()
{
    vec3 weights = gl_TessCoord;
    position = weights.x * control_corner[0] + weights.y * control_corner[1] +
               weights.z * control_corner[2];
    share_of_point = share;
    index = uint(gl_PrimitiveID) + uint(dot(weights, vec3(7.0, 89.0, 991.0)));
    random = mix_bits(uint(gl_PrimitiveID) ^
                      mix_bits(floatBitsToUint(weights.x) ^ mix_bits(floatBitsToUint(weights.y))));
}
