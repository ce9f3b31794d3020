/* SPDX-License-Identifier: MIT
 *
 * Splats a chunk of points into the atlas by atomic minima of distances' bits, which for positive
 * floats order as the distances do. Each invocation keeps one light and takes every N-th point of a
 * stretch, so that the light and its frame are made once for all of them. A work group has up to 8
 * lights side by side: their points are neighbours in memory, and so few maps stay in the cache.
 */
#define GROUP 64
layout(local_size_x = GROUP) in;
#include "lights/points.glsl"
#include "lights/ism_splat.glsl"

layout(r32ui, binding = 0) uniform uimage2D atlas;

uniform int point_count;  /* of the chunk */
uniform uint first_point; /* index of its first point in the whole set */
uniform int map_begin, map_end;     /* of a point's maps, of which there are up to ceil(s_f) */
uniform int point_begin, point_end; /* of an invocation's POINTS_AN_INVOCATION */
uniform int abreast;      /* lights side by side: a power of two, 1 to 8 */

void draw(splat s, ivec2 origin)
{
    ivec2 low = max(s.corner, ivec2(0));
    ivec2 high = min(s.corner + s.side, ivec2(map_size));
    uint bits = floatBitsToUint(s.distance);
    ivec2 at = low;
    while (at.y < high.y) { /* one loop: two would run as long as the widest and the tallest splat */
        imageAtomicMin(atlas, origin + at, bits);
        at.x++;
        if (at.x == high.x)
            at = ivec2(low.x, at.y + 1);
    }
}

void main()
{
    int lane = int(gl_LocalInvocationID.x), rows = GROUP / abreast;
    int slot = int(gl_WorkGroupID.y) * abreast + lane % abreast;
    int round = int(gl_WorkGroupID.x) * rows * POINTS_AN_INVOCATION + lane / abreast;
    if (slot >= light_count)
        return;
    for (int j = map_begin; j < map_end; j++) {
        int map = int((first_point + uint(slot) + uint(j)) % uint(light_count));
        map_light light = fetch_light(map);
        if (light.dark)
            continue;
        ivec2 origin = map_origin(map);
        for (int k = point_begin; k < point_end; k++) {
            int i = (round + k * rows) * light_count + slot;
            if (i >= point_count)
                break;
            if (j >= map_count(mix_bits(first_point + uint(i))))
                continue;
            surface_point p = fetch_point(i);
            splat s = project(p.position, p.share, light);
            if (s.visible)
                draw(s, origin);
        }
    }
}
