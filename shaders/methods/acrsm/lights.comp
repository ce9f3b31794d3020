/* SPDX-License-Identifier: MIT
 *
 * The clusters as virtual area lights. FLUX is enum acrsm_flux:
 *   0 sum          of the texels' flux
 *   1 center       Phi(centre) * number of texels            (thesis 4.7; its scale: ours)
 *   2 center-area  Phi(centre) * number of all clusters' texels * A_c / sum A   (thesis fig. 6.1)
 * A cluster without texels is dark.
 */
layout(local_size_x = 64) in;

#include "lights/virtual_light.glsl"
#include "methods/acrsm/cluster.glsl"

layout(std140, binding = 0) uniform Clusters { cluster clusters[CLUSTERS_MOST]; };
layout(std430, binding = 6) writeonly buffer Lights { vec4 lights[]; };

uniform int active_count;

vec3 flux_of(uint i)
{
#if FLUX == 0
    return clusters[i].flux;
#elif FLUX == 1
    return clusters[i].centre_flux * float(clusters[i].count);
#else
    float area = 0.0, texels = 0.0;
    for (int j = 0; j < active_count; j++) {
        area += in_use(clusters[j].count) ? clusters[j].area : 0.0;
        texels += float(max(clusters[j].count, 0));
    }
    return area > 0.0 ? clusters[i].centre_flux * (texels * (clusters[i].area / area)) : vec3(0.0);
#endif
}

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= CLUSTERS_MOST)
        return;
    bool bright = i < uint(active_count) && in_use(clusters[i].count);
    vec4 position = vec4(clusters[i].position, clusters[i].area);
    vec4 normal = vec4(clusters[i].normal, 0.0);
    lights[VPL_VECTORS * i] = bright ? position : vec4(0.0);
    lights[VPL_VECTORS * i + 1] = bright ? normal : vec4(0.0, 0.0, 1.0, 0.0);
    lights[VPL_VECTORS * i + 2] = bright ? vec4(flux_of(i), 0.0) : vec4(0.0);
}
