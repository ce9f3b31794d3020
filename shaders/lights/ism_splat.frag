/* SPDX-License-Identifier: MIT
 *
 * The thesis's splatter (5.3.2), fragment stage: the distance, inside the map only.
 */
flat in float distance_to_light;
flat in ivec2 origin;

layout(location = 0) out uint bits;

uniform int map_size;

void main()
{
    ivec2 texel = ivec2(gl_FragCoord.xy) - origin;
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, ivec2(map_size))))
        discard;
    bits = floatBitsToUint(distance_to_light);
}
