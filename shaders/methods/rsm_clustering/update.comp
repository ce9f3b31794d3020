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
    sums total = NOTHING, chunk = NOTHING;
    uint texels = 0u;
    for (walk w = begin_walk(id, c.cell); w.goes_on; walk_on(w)) {
        if (!is_member(w))
            continue;
        add(chunk, weigh(member_at(w), c.centre));
        if (++texels % CHUNK == 0u) {
            add(total, chunk);
            chunk = NOTHING;
        }
    }
    add(total, chunk);
    c.texels = float(texels);
    c.flux = total.flux;
    c.area = total.area;
    set_means(c, total);
    store_cluster(id, c);
}
