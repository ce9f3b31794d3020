/* SPDX-License-Identifier: MIT
 *
 * Fills the grid's lists from the sorted keys.
 */
layout(local_size_x = 64) in;
#include "methods/rsm_clustering/cluster.glsl"
#include "methods/rsm_clustering/keys.glsl"
#include "methods/rsm_clustering/list.glsl"
#include "methods/rsm_clustering/metric.glsl"

uniform uint cluster_count;

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i <= uint(cells * cells))
        cell_starts[i] = lower_bound(cluster_count, i << CLUSTER_BITS);
    if (i >= cluster_count || keys[i] == NO_KEY)
        return;
    uint id = keys[i] & ((1u << CLUSTER_BITS) - 1u);
    cluster c = load_cluster(id);
    listed[LIST_VECTORS * i] = vec4(c.centre, uintBitsToFloat(id));
    listed[LIST_VECTORS * i + 1u] = vec4(c.normal, 0.0);
    listed[LIST_VECTORS * i + 2u] = vec4(colour_of(c.flux), 0.0);
}
