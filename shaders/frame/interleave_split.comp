/* SPDX-License-Identifier: MIT
 *
 * Splits the G-buffer into tiles (thesis 3.2.3): one work group layer in z a tile.
 */
layout(local_size_x = 8, local_size_y = 8) in;

#include "frame/gbuffer_fetch.glsl"
#include "frame/interleave.glsl"

layout(rgba32f, binding = 0) writeonly uniform image2D split_position;
layout(rgba32f, binding = 1) writeonly uniform image2D split_normal;
layout(rgba32f, binding = 2) writeonly uniform image2D split_geometric;

void main()
{
    int t = int(gl_WorkGroupID.z);
    ivec2 tile = ivec2(t % TILES_X, t / TILES_X), place = ivec2(gl_GlobalInvocationID.xy);
    if (place.x >= interleave_tile.x || place.y >= interleave_tile.y)
        return;
    ivec2 pixel = pixel_of(tile, place), size = gbuffer_size();
    vec4 position = vec4(0.0), normal = vec4(0.0);
    vec3 geometric = vec3(0.0);
    if (pixel.x < size.x && pixel.y < size.y) {
        position = gbuffer_fetch_position(pixel);
        if (position.w > 0.0) {
            normal = vec4(gbuffer_fetch_normal(pixel), gbuffer_fetch_distance(pixel));
            geometric = gbuffer_fetch_geometric(pixel);
        }
    }
    imageStore(split_position, tile * interleave_tile + place, position);
    imageStore(split_normal, tile * interleave_tile + place, normal);
    imageStore(split_geometric, tile * interleave_tile + place, vec4(geometric, 0.0));
}
