/* SPDX-License-Identifier: MIT
 *
 * New centre, normal and flux of every cluster (Prutkin et al. 2012, algorithm 1, lines 18 to 22,
 * and section 4: means weighted by flux, and the flux's sum).
 *
 * The mean normal is taken at unit length; where it all but vanishes, the last one stays. Positions
 * are summed as offsets from the last centre, and sums run in chunks, so that neither a far origin
 * nor many texels cost precision.
 */
layout(local_size_x = 32) in;
#include "methods/rsm_clustering/cluster.glsl"
#include "methods/rsm_clustering/members.glsl"

uniform uint cluster_count;
uniform float flux_unit; /* 1/W: the weights are fluxes of order 1 */

const uint CHUNK = 64u;
/* Length of a mean normal below which its direction is left to rounding. Source: ours. */
const float LEAST_MEAN_NORMAL = 1e-4;

struct sums {
    vec3 flux, offset, normal;
    float weight, area, weighted_area;
};

const sums NOTHING = sums(vec3(0.0), vec3(0.0), vec3(0.0), 0.0, 0.0, 0.0);

void add(inout sums a, sums b)
{
    a.flux += b.flux;
    a.offset += b.offset;
    a.normal += b.normal;
    a.weight += b.weight;
    a.area += b.area;
    a.weighted_area += b.weighted_area;
}

#define CARRY_VECTORS 7

void store_sums(uint at, sums s)
{
    carry[at] = vec4(s.flux, s.weight);
    carry[at + 1u] = vec4(s.offset, s.area);
    carry[at + 2u] = vec4(s.normal, s.weighted_area);
}

sums load_sums(uint at)
{
    vec4 v0 = carry[at], v1 = carry[at + 1u], v2 = carry[at + 2u];
    return sums(v0.xyz, v1.xyz, v2.xyz, v0.w, v1.w, v2.w);
}

sums weigh(member m, vec3 origin)
{
    float w = (m.flux.r + m.flux.g + m.flux.b) * flux_unit;
    return sums(m.flux, w * (m.position - origin), w * m.normal, w, m.area, w * m.area);
}

void set_means(inout cluster c, sums s)
{
    if (!(s.weight > 0.0))
        return;
    float inverse = 1.0 / s.weight, mean_length = length(s.normal) * inverse;
    c.centre += s.offset * inverse;
    c.texel_area = s.weighted_area * inverse;
    if (mean_length > LEAST_MEAN_NORMAL)
        c.normal = normalize(s.normal);
}

void main()
{
    uint id = gl_GlobalInvocationID.x;
    if (id >= cluster_count)
        return;
    cluster c = load_cluster(id);
    walk w = begin_walk(id, c.cell);
    if (!w.begins)
        return;
    sums total = NOTHING, chunk = NOTHING;
    uint texels = 0u, carried = CARRY_VECTORS * id;
    if (part > 0u) {
        total = load_sums(carried);
        chunk = load_sums(carried + 3u);
        texels = floatBitsToUint(carry[carried + 6u].x);
    }
    for (; w.goes_on; walk_on(w)) {
        if (!is_member(w))
            continue;
        add(chunk, weigh(member_at(w), c.centre));
        if (++texels % CHUNK == 0u) {
            add(total, chunk);
            chunk = NOTHING;
        }
    }
    if (!w.ends) {
        store_sums(carried, total);
        store_sums(carried + 3u, chunk);
        carry[carried + 6u].x = uintBitsToFloat(texels);
        return;
    }
    add(total, chunk);
    c.texels = float(texels);
    c.flux = total.flux;
    c.area = total.area;
    set_means(c, total);
    store_cluster(id, c);
}
