/* SPDX-License-Identifier: MIT
 *
 * Counts texels of each map that hold a distance, within the unit disc: one invocation a row.
 */
layout(local_size_x = 64) in;
#include "lights/ism_empty.glsl"

layout(r32ui, binding = 0) readonly uniform uimage2D atlas;
layout(std430, binding = 0) buffer Filled { uint filled[]; }; /* one a map, 0 at first */

uniform int map_size;
uniform int maps_a_row;

void main()
{
    int y = int(gl_GlobalInvocationID.x), map = int(gl_WorkGroupID.y);
    if (y >= map_size)
        return;
    ivec2 origin = map_size * ivec2(map % maps_a_row, map / maps_a_row);
    int from_centre = 2 * y + 1 - map_size; /* in half texels, exact */
    uint count = 0u;
    for (int x = 0; x < map_size; x++) {
        int across = 2 * x + 1 - map_size;
        bool inside = across * across + from_centre * from_centre <= map_size * map_size;
        if (inside && imageLoad(atlas, origin + ivec2(x, y)).r != EMPTY)
            count++;
    }
    atomicAdd(filled[map], count);
}
