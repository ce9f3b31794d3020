/* SPDX-License-Identifier: MIT
 *
 * Walks over the texels of one cluster, in raster order whatever the way:
 *     walk w = begin_walk(id, cell);
 *     for (; w.goes_on; walk_on(w))
 *         if (is_member(w)) ... member_at(w) ...
 *
 * Long walks take several dispatches, `part` 0, 1, .., of part_rounds each (core/gl/context.h,
 * IRB_LOOP_ROUNDS_MOST). What has been summed up to the end of a part that is not the last
 * (w.ends false) goes into `carry`, and from there on into the next; parts after the last have
 * w.begins false, and nothing is left to do.
 *
 * SORTED 1: the cluster's range of the sorted and reordered texels, found by binary search. SORTED
 * 0: every texel of the cluster map that the cluster could have got, which is those in the grid's
 * cells at most `reach` from its own, or all.
 */
#include "methods/rsm_clustering/member.glsl"

uniform uint part, part_rounds;
layout(std430, binding = 2) buffer Carry { vec4 carry[]; }; /* CARRY_VECTORS of a cluster */

#if SORTED
#include "methods/rsm_clustering/keys.glsl"
#include "methods/rsm_clustering/reordered.glsl"

struct walk {
    uint at, stop;
    bool goes_on, begins, ends;
};

uniform int texel_bits;
uniform uint texel_count;

walk begin_walk(uint id, ivec2 cell)
{
    uint begin = lower_bound(texel_count, id << texel_bits), at = begin + part * part_rounds;
    uint end = cell.x >= 0 ? lower_bound(texel_count, (id + 1u) << texel_bits) : begin;
    uint stop = min(end, at + part_rounds);
    return walk(at, stop, at < end, part == 0u || at < end, stop == end);
}

void walk_on(inout walk w)
{
    w.at++;
    w.goes_on = w.at < w.stop;
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
    uint id, left;       /* texels of this part */
    bool goes_on, begins, ends;
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
    uvec2 size = uvec2(high - low);
    uint begin = part * part_rounds, end = cell.x >= 0 ? size.x * size.y : 0u;
    uint left = begin < end ? min(end - begin, part_rounds) : 0u;
    ivec2 at = low + ivec2(begin % size.x, begin / size.x);
    return walk(at, low, high, id, left, left > 0u, part == 0u || left > 0u, begin + left >= end);
}

void walk_on(inout walk w)
{
    w.at.x++;
    if (w.at.x >= w.high.x)
        w.at = ivec2(w.low.x, w.at.y + 1);
    w.left--;
    w.goes_on = w.left > 0u;
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
