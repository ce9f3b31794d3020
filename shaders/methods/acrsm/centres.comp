/* SPDX-License-Identifier: MIT
 *
 * Notes the clusters' centres in the green channel of the cluster map (thesis 5.1.2, 5.3.1); where
 * several share a texel, the lowest.
 */
layout(local_size_x = 64) in;

#include "methods/acrsm/cluster.glsl"

layout(std140, binding = 0) uniform Clusters { cluster clusters[CLUSTERS_MOST]; };
layout(rg32ui, binding = 0) uniform uimage2D cluster_map;

uniform int active_count;

void main()
{
    int i = int(gl_GlobalInvocationID.x), resolution = imageSize(cluster_map).x;
    if (i >= active_count || !in_use(clusters[i].count))
        return;
    ivec2 texel = texel_at(clusters[i].uv, resolution);
    for (int j = 0; j < i; j++)
        if (in_use(clusters[j].count) && texel_at(clusters[j].uv, resolution) == texel)
            return;
    imageStore(cluster_map, texel, uvec4(imageLoad(cluster_map, texel).r, uint(i), 0u, 0u));
}
