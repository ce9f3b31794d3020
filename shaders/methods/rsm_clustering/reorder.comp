/* SPDX-License-Identifier: MIT
 *
 * Puts the RSM into the order of the sorted keys (Prutkin et al. 2012, algorithm 1, line 17).
 */
layout(local_size_x = 64) in;
#include "methods/rsm_clustering/keys.glsl"
#include "methods/rsm_clustering/reordered.glsl"
#include "methods/rsm_clustering/texel.glsl"

uniform int texel_bits;

void main()
{
    uint i = gl_GlobalInvocationID.x;
    int side = rsm_resolution();
    if (i >= uint(side * side) || keys[i] == NO_KEY)
        return;
    int index = int(keys[i] & ((1u << texel_bits) - 1u));
    member m = fetch_member(ivec2(index % side, index / side));
    records[RECORD_VECTORS * i] = vec4(m.position, m.area);
    records[RECORD_VECTORS * i + 1u] = vec4(m.normal, 0.0);
    records[RECORD_VECTORS * i + 2u] = vec4(m.flux, 0.0);
}
