/* SPDX-License-Identifier: MIT
 *
 * Push: holes of a level from the one of half its size (core/lights/ism.h); texels that hold a
 * distance keep it.
 *     MEDIAN  the parent's distance
 *     MEAN    the mean of the parent and its three neighbours on the texel's side, with bilinear
 *             weights, of those that are valid and close to the parent
 * A hole whose parent is empty stays a hole. No neighbour is taken from another map.
 */
layout(local_size_x = 8, local_size_y = 8) in;

layout(r32ui, binding = 0) uniform uimage2D finer;
layout(r32ui, binding = 1) readonly uniform uimage2D coarser;

uniform ivec2 extent;    /* of the finer level's part in use, texels */
uniform int parent_size; /* of a map in the coarser level, texels */
uniform float closeness; /* MEAN: greatest relative difference */

#include "lights/ism_empty.glsl"

#if MEAN
uint push(ivec2 at, ivec2 parent, uint own)
{
    ivec2 low = parent / parent_size * parent_size;
    ivec2 other = clamp(parent + 2 * (at & 1) - 1, low, low + parent_size - 1);
    uint value[4] = uint[4](own, imageLoad(coarser, ivec2(other.x, parent.y)).r,
                            imageLoad(coarser, ivec2(parent.x, other.y)).r,
                            imageLoad(coarser, other).r);
    float weight[4] = float[4](9.0, 3.0, 3.0, 1.0);
    float centre = uintBitsToFloat(own), sum = 0.0, total = 0.0;
    for (int i = 0; i < 4; i++) {
        float distance = uintBitsToFloat(value[i]);
        bool close = value[i] != EMPTY && abs(distance - centre) <= closeness * centre;
        sum += close ? weight[i] * distance : 0.0;
        total += close ? weight[i] : 0.0;
    }
    return floatBitsToUint(sum / total);
}
#else
uint push(ivec2 at, ivec2 parent, uint own)
{
    return own;
}
#endif

void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy), parent = at / 2;
    if (at.x >= extent.x || at.y >= extent.y || imageLoad(finer, at).r != EMPTY)
        return;
    uint own = imageLoad(coarser, parent).r;
    if (own != EMPTY)
        imageStore(finer, at, uvec4(push(at, parent, own)));
}
