/* SPDX-License-Identifier: MIT
 *
 * Sums of one row of the RSM, from left to right, for the report: reflected flux (W, mean of the
 * channels) of all texels, of those that no cluster has, and how many are lit.
 */
layout(local_size_x = 64) in;

#include "frame/rsm_fetch.glsl"
#include "methods/acrsm/cluster.glsl"

uniform usampler2D cluster_map;
layout(std430, binding = 0) writeonly buffer Rows { vec4 rows[]; };

void main()
{
    int y = int(gl_GlobalInvocationID.x), resolution = rsm_resolution();
    if (y >= resolution)
        return;
    vec4 sum = vec4(0.0);
    for (int x = 0; x < resolution; x++) {
        vec3 flux = rsm_fetch_flux(ivec2(x, y));
        float mean = (flux.r + flux.g + flux.b) / 3.0;
        bool uncovered = texelFetch(cluster_map, ivec2(x, y), 0).r == NO_CLUSTER;
        sum += vec4(mean, uncovered ? mean : 0.0, is_lit(flux) ? 1.0 : 0.0, uncovered ? 1.0 : 0.0);
    }
    rows[y] = sum;
}
