/* SPDX-License-Identifier: MIT
 *
 * Pictures of the clustering. LAYER 0: each cluster in a colour of its own, the same in all frames;
 * lit texels without a cluster are white, unlit ones black. LAYER 1: the same, darker, with a white
 * dot at each centre.
 */
layout(local_size_x = 8, local_size_y = 8) in;

#include "lights/hues.glsl"
#include "methods/acrsm/cluster.glsl"

uniform usampler2D cluster_map;
layout(rgba32f, binding = 0) writeonly uniform image2D picture;

const float DARKER = 0.35;
const int DOT = 1; /* texels on each side of a centre */

vec3 colour_of(uint i)
{
    if (i == UNLIT)
        return vec3(0.0);
    if (i == NO_CLUSTER)
        return vec3(1.0);
    float value = 0.55 + 0.15 * float(i % 4u);
    return value * hue_of(int(i), 0.75);
}

bool near_centre(ivec2 texel)
{
    for (int y = -DOT; y <= DOT; y++)
        for (int x = -DOT; x <= DOT; x++) {
            ivec2 at = clamp(texel + ivec2(x, y), ivec2(0), textureSize(cluster_map, 0) - 1);
            if (texelFetch(cluster_map, at, 0).g != NO_CLUSTER)
                return true;
        }
    return false;
}

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, textureSize(cluster_map, 0))))
        return;
    vec3 colour = colour_of(texelFetch(cluster_map, texel, 0).r);
#if LAYER == 1
    colour = near_centre(texel) ? vec3(1.0) : DARKER * colour;
#endif
    imageStore(picture, texel, vec4(colour, 1.0));
}
