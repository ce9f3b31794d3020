/* SPDX-License-Identifier: MIT
 *
 * Which clusters' squares reach into a tile of the RSM: a bit for each cluster. An invocation makes
 * one word of one tile. It also clears the words in which the mapping notes where clusters are.
 */
layout(local_size_x = 64) in;

#include "methods/acrsm/cluster.glsl"
#include "methods/acrsm/tiles.glsl"

layout(std140, binding = 0) uniform Clusters { cluster clusters[CLUSTERS_MOST]; };
layout(std430, binding = 4) writeonly buffer Candidates { uint candidates[]; };
layout(std430, binding = 5) writeonly buffer Presence { uint presence[]; };

uniform int active_count;
uniform int resolution;
uniform int side; /* of the clusters' squares, texels */
uniform int presence_length;

uint candidates_in(ivec2 tile, int word)
{
    ivec2 low = tile * TILE_SIDE, high = low + TILE_SIDE - 1;
    uint mask = 0u;
    for (int b = 0; b < 32; b++) {
        int i = 32 * word + b;
        if (i >= active_count || !is_mapped_to(clusters[i].count))
            continue;
        ivec2 corner = square_corner(texel_at(clusters[i].uv, resolution), side);
        if (all(lessThanEqual(corner, high)) && all(greaterThanEqual(corner + side - 1, low)))
            mask |= 1u << b;
    }
    return mask;
}

void main()
{
    int id = int(gl_GlobalInvocationID.x), tiles = tiles_a_row(resolution);
    if (id < presence_length)
        presence[id] = 0u;
    int tile = id / CLUSTER_WORDS;
    if (tile < tiles * tiles)
        candidates[id] = candidates_in(ivec2(tile % tiles, tile / tiles), id % CLUSTER_WORDS);
}
