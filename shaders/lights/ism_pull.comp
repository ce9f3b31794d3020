/* SPDX-License-Identifier: MIT
 *
 * Pull: a level of half the size from the one before (core/lights/ism.h). Each texel takes from its
 * 2 x 2 children one distance:
 *     MEDIAN  the median of the valid ones; of an even number the lower of the middle two, so that
 *             it is always a distance that occurs (the thesis says no more than median of four)
 *     MEAN    the mean of the valid ones close to the nearest of them (Ritschel et al. 2008)
 */
layout(local_size_x = 8, local_size_y = 8) in;

layout(r32ui, binding = 0) readonly uniform uimage2D finer;
layout(r32ui, binding = 1) writeonly uniform uimage2D coarser;

uniform ivec2 extent;    /* of the coarser level's part in use, texels */
uniform float closeness; /* MEAN: greatest relative difference */

#include "lights/ism_empty.glsl"

#if MEAN
uint pull(uint a, uint b, uint c, uint d)
{
    uint nearest = min(min(a, b), min(c, d));
    float most = uintBitsToFloat(nearest) * (1.0 + closeness), sum = 0.0, count = 0.0;
    uint child[4] = uint[4](a, b, c, d);
    for (int i = 0; i < 4; i++) {
        float distance = uintBitsToFloat(child[i]);
        bool close = child[i] != EMPTY && distance <= most;
        sum += close ? distance : 0.0;
        count += close ? 1.0 : 0.0;
    }
    return nearest == EMPTY ? EMPTY : floatBitsToUint(sum / count);
}
#else
/* Sorted, the empty ones come last: of n valid ones the (n-1)/2-th, from 0. */
uint pull(uint a, uint b, uint c, uint d)
{
    uint low_ab = min(a, b), high_ab = max(a, b), low_cd = min(c, d), high_cd = max(c, d);
    uint first = min(low_ab, low_cd);
    uint middle = max(low_ab, low_cd), other = min(high_ab, high_cd);
    uint second = min(middle, other), third = max(middle, other);
    return third == EMPTY ? first : second; /* n <= 2: first; n = 3 or 4: second */
}
#endif

void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (at.x >= extent.x || at.y >= extent.y)
        return;
    uint a = imageLoad(finer, 2 * at).r, b = imageLoad(finer, 2 * at + ivec2(1, 0)).r;
    uint c = imageLoad(finer, 2 * at + ivec2(0, 1)).r, d = imageLoad(finer, 2 * at + 1).r;
    imageStore(coarser, at, uvec4(pull(a, b, c, d)));
}
