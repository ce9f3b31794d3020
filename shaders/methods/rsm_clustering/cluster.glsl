/* SPDX-License-Identifier: MIT
 *
 * A cluster of RSM texels, as it is kept from frame to frame: 4 vec4,
 *     centre (m); texels in it, 0 where it is empty
 *     unit normal; sum of the texels' areas (m2)
 *     flux Phi (W); mean area of a texel (m2)
 *     grid cell (x, y), -1 where it takes no part; 1 where it was seeded in this frame; 0
 * centre, normal and mean area are weighted by flux.
 */
#define CLUSTER_VECTORS 4

struct cluster {
    vec3 centre;
    float texels;
    vec3 normal;
    float area;
    vec3 flux;
    float texel_area;
    ivec2 cell;
    bool seeded;
};

layout(std430, binding = 0) buffer Clusters { vec4 clusters[]; };

cluster load_cluster(uint id)
{
    vec4 v0 = clusters[CLUSTER_VECTORS * id], v1 = clusters[CLUSTER_VECTORS * id + 1u];
    vec4 v2 = clusters[CLUSTER_VECTORS * id + 2u], v3 = clusters[CLUSTER_VECTORS * id + 3u];
    return cluster(v0.xyz, v0.w, v1.xyz, v1.w, v2.xyz, v2.w, ivec2(v3.xy), v3.z > 0.0);
}

void store_cluster(uint id, cluster c)
{
    clusters[CLUSTER_VECTORS * id] = vec4(c.centre, c.texels);
    clusters[CLUSTER_VECTORS * id + 1u] = vec4(c.normal, c.area);
    clusters[CLUSTER_VECTORS * id + 2u] = vec4(c.flux, c.texel_area);
    clusters[CLUSTER_VECTORS * id + 3u] = vec4(vec2(c.cell), c.seeded ? 1.0 : 0.0, 0.0);
}
