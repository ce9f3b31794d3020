/* SPDX-License-Identifier: MIT
 *
 * The thesis's splatter (5.3.2), vertex stage: point i of the set, as a point of the scene.
 */
#include "lights/points.glsl"
#include "lights/ism_splat.glsl"

uniform uint first_point; /* index of the chunk's first point in the whole set */

out vec3 position; /* world, m */
out vec3 share_of_point; /* see lights/points.glsl */
flat out uint index;  /* i: the first map is i mod N */
flat out uint random;

void main()
{
    surface_point p = fetch_point(gl_VertexID);
    position = p.position;
    share_of_point = p.share;
    index = first_point + uint(gl_VertexID);
    random = mix_bits(index);
}
