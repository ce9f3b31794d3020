/* SPDX-License-Identifier: MIT
 *
 * z per metre of every map: its farthest surface is at `span`. One work group a map.
 */
layout(local_size_x = 256) in;

uniform sampler2DArray raster_maps; /* m; +Inf: nothing */
uniform int faces;                  /* of a map */
uniform float span;
layout(std430, binding = 0) writeonly buffer Ranges { vec4 ranges[]; };

shared uint farthest; /* bits of a float >= 0, which compare as the floats do */

void main()
{
    int map = int(gl_WorkGroupID.x), size = textureSize(raster_maps, 0).x;
    if (gl_LocalInvocationIndex == 0u)
        farthest = 0u;
    memoryBarrierShared();
    barrier();
    float most = 0.0;
    for (int i = int(gl_LocalInvocationIndex); i < faces * size * size; i += 256) {
        ivec3 at = ivec3(i % size, i / size % size, map * faces + i / (size * size));
        uint bits = floatBitsToUint(texelFetch(raster_maps, at, 0).r);
        most = bits < 0x7f800000u ? max(most, uintBitsToFloat(bits)) : most;
    }
    atomicMax(farthest, floatBitsToUint(most));
    memoryBarrierShared();
    barrier();
    if (gl_LocalInvocationIndex == 0u) {
        float range = uintBitsToFloat(farthest);
        /* 1e-30: a quotient that stays finite */
        ranges[map] = vec4(range > 1e-30 ? span / range : 1.0, 0.0, 0.0, 0.0);
    }
}
