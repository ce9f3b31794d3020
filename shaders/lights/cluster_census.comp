/* SPDX-License-Identifier: MIT
 *
 * Of each row of the cluster map: texels that reflect flux, those of them without a cluster, and the
 * flux of all and of those (W, mean of the channels), summed from left to right.
 */
layout(local_size_x = 64) in;
#include "frame/rsm_fetch.glsl"
#include "lights/cluster_map.glsl"

uniform usampler2D cluster_map;
layout(std430, binding = 0) writeonly buffer Rows { vec4 rows[]; };

void main()
{
    int y = int(gl_GlobalInvocationID.x), side = rsm_resolution();
    if (y >= side)
        return;
    vec4 sum = vec4(0.0);
    for (int x = 0; x < side; x++) {
        uint id = texelFetch(cluster_map, ivec2(x, y), 0).r;
        vec3 flux = rsm_fetch_flux(ivec2(x, y));
        float mean = (flux.r + flux.g + flux.b) / 3.0;
        bool uncovered = id == NO_CLUSTER;
        sum += vec4(id != UNLIT ? 1.0 : 0.0, uncovered ? 1.0 : 0.0, mean,
                    uncovered ? mean : 0.0);
    }
    rows[y] = sum;
}
