/* SPDX-License-Identifier: MIT
 *
 * The (re-)seed list (thesis 4.4, 5.3.1): clusters without a texel take the next points of the
 * Halton sequence, in order. One invocation, since each point's number depends on all before.
 *
 * In order of the tiles of the interleaved shading, where light i goes to tile i mod `tiles`: in
 * their own order every ninth point, say, lies in one of nine strips (two digits in base 3 are the
 * same), and a tile would be lit from one strip of the light's image.
 */
layout(local_size_x = 1) in;

#include "methods/acrsm/cluster.glsl"
#include "methods/acrsm/lists.glsl"

layout(std430, binding = 0) readonly buffer Clusters { cluster clusters[CLUSTERS_MOST]; };

uniform int active_count;
uniform int tiles;
uniform bool reseed; /* vanished clusters too, not only new ones */

void main()
{
    uint next = next_seed, vanished = 0u;
    for (int tile = 0; tile < tiles; tile++)
        for (int i = tile; i < active_count; i += tiles) {
            int count = clusters[i].count;
            if (count == UNBORN || (reseed && count == VANISHED))
                seed_number[i] = next++;
            if (reseed && count == VANISHED)
                vanished++;
        }
    next_seed = next;
    seeded = vanished;
}
