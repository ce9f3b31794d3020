/* SPDX-License-Identifier: MIT
 *
 * The cluster that each lit texel is most similar to (Prutkin et al. 2012, algorithm 1, lines 13 to
 * 15): among those in the grid's cells at most `reach` from the texel's, or among all. Of two that
 * are alike the lower number.
 *
 * The texel's key for the sort: its cluster, its index.
 */
layout(local_size_x = 8, local_size_y = 8) in;
#include "frame/rsm_fetch.glsl"
#include "lights/cluster_map.glsl"
#include "methods/rsm_clustering/keys.glsl"
#include "methods/rsm_clustering/list.glsl"
#include "methods/rsm_clustering/metric.glsl"

layout(r32ui, binding = 0) uniform writeonly uimage2D cluster_map;

uniform int reach;      /* r, cells; -1: all clusters */
uniform int texel_bits; /* 0: no keys are wanted */

struct choice {
    uint id;
    float mu;
};

void choose(inout choice best, traits p, uint begin, uint end)
{
    for (uint i = begin; i < end; i++) {
        vec4 head = listed[LIST_VECTORS * i];
        uint id = floatBitsToUint(head.w);
        float mu = difference(p, traits(head.xyz, listed[LIST_VECTORS * i + 1u].xyz,
                                        listed[LIST_VECTORS * i + 2u].xyz));
        bool better = mu < best.mu || (mu == best.mu && id < best.id);
        best.id = better ? id : best.id;
        best.mu = better ? mu : best.mu;
    }
}

uint cluster_of(ivec2 texel, vec3 flux)
{
    traits p = traits(rsm_fetch_position(texel).xyz, rsm_fetch_normal(texel), colour_of(flux));
    choice best = choice(NO_CLUSTER, uintBitsToFloat(0x7f800000u));
    if (reach < 0) {
        choose(best, p, 0u, cell_starts[cells * cells]);
        return best.id;
    }
    ivec2 cell = texel * cells / rsm_resolution();
    ivec2 low = max(cell - reach, 0), high = min(cell + reach, cells - 1);
    for (int row = low.y; row <= high.y; row++)
        choose(best, p, cell_starts[row * cells + low.x], cell_starts[row * cells + high.x + 1]);
    return best.id;
}

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    int side = rsm_resolution();
    if (any(greaterThanEqual(texel, ivec2(side))))
        return;
    vec3 flux = rsm_fetch_flux(texel);
    uint id = is_lit(flux) ? cluster_of(texel, flux) : UNLIT;
    imageStore(cluster_map, texel, uvec4(id));
    uint index = uint(texel.y * side + texel.x);
    if (texel_bits > 0)
        keys[index] = is_cluster(id) ? id << texel_bits | index : NO_KEY;
}
