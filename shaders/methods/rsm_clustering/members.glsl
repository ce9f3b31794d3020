/* SPDX-License-Identifier: MIT
 *
 * Walks over the texels of one cluster, in raster order whatever the way:
 *     for (walk w = begin_walk(id, cell); w.goes_on; walk_on(w))
 *         if (is_member(w)) ... member_at(w) ...
 *
 * SORTED 1: the cluster's range of the sorted and reordered texels, found by binary search. SORTED
 * 0: every texel of the cluster map that the cluster could have got, which is those in the grid's
 * cells at most `reach` from its own, or all.
 */
#include "methods/rsm_clustering/member.glsl"

#if SORTED
#include "methods/rsm_clustering/keys.glsl"
#include "methods/rsm_clustering/reordered.glsl"

struct walk {
    uint at, end;
    bool goes_on;
};

uniform int texel_bits;
uniform uint texel_count;

walk begin_walk(uint id, ivec2 cell)
{
    uint at = lower_bound(texel_count, id << texel_bits);
    uint end = lower_bound(texel_count, (id + 1u) << texel_bits);
    return walk(at, end, at < end);
}

void walk_on(inout walk w)
{
    w.at++;
    w.goes_on = w.at < w.end;
}

bool is_member(walk w)
{
    return true;
}

member member_at(walk w)
{
    vec4 v0 = records[RECORD_VECTORS * w.at];
    return member(v0.xyz, v0.w, records[RECORD_VECTORS * w.at + 1u].xyz,
                  records[RECORD_VECTORS * w.at + 2u].xyz);
}
#else
#include "methods/rsm_clustering/texel.glsl"

struct walk {
    ivec2 at, low, high; /* high: outside */
    uint id;
    bool goes_on;
};

uniform usampler2D cluster_map;
uniform int cells; /* of the grid, a side */
uniform int reach; /* cells; -1: the whole map */

walk begin_walk(uint id, ivec2 cell)
{
    ivec2 low = ivec2(0), high = ivec2(rsm_resolution());
    if (reach >= 0) {
        /* first texels of the cells' rows and columns, rounded up: t belongs to floor(t cells/n) */
        ivec2 first = max(cell - reach, 0), last = min(cell + reach + 1, cells), n = high;
        low = (first * n + cells - 1) / cells;
        high = (last * n + cells - 1) / cells;
    }
    return walk(low, low, high, id, cell.x >= 0);
}

void walk_on(inout walk w)
{
    w.at.x++;
    if (w.at.x >= w.high.x)
        w.at = ivec2(w.low.x, w.at.y + 1);
    w.goes_on = w.at.y < w.high.y;
}

bool is_member(walk w)
{
    return texelFetch(cluster_map, w.at, 0).r == w.id;
}

member member_at(walk w)
{
    return fetch_member(w.at);
}
#endif
