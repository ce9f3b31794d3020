/* SPDX-License-Identifier: MIT
 *
 * Pictures of the RSM's size (Prutkin et al. 2012, figure 2). SHOW_CLUSTERS: the cluster map, texels
 * without a cluster within reach white; SHOW_FLUX: reflected flux; SHOW_CLUSTERED: the mean flux of
 * each texel's cluster. Flux is shown with a gamma of 2.2, in units of the most that a white texel
 * reflects.
 */
layout(local_size_x = 8, local_size_y = 8) in;
#include "frame/rsm_fetch.glsl"
#include "lights/cluster_map.glsl"
#include "methods/rsm_clustering/cluster.glsl"
#include "methods/rsm_clustering/cluster_colour.glsl"

#define SHOW_CLUSTERS 0
#define SHOW_FLUX 1
#define SHOW_CLUSTERED 2

uniform usampler2D cluster_map;
uniform int show;
uniform float flux_unit; /* 1/W */
layout(rgba32f, binding = 0) uniform writeonly image2D picture;

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, ivec2(rsm_resolution()))))
        return;
    uint id = texelFetch(cluster_map, texel, 0).r;
    vec3 flux = rsm_fetch_flux(texel), colour = vec3(0.0);
    if (show == SHOW_CLUSTERS) {
        colour = is_cluster(id) ? cluster_colour(id) : vec3(id == NO_CLUSTER ? 1.0 : 0.0);
    } else {
        if (show == SHOW_CLUSTERED)
            flux = is_cluster(id) ? load_cluster(id).flux / load_cluster(id).texels : vec3(0.0);
        colour = pow(clamp(flux * flux_unit, 0.0, 1.0), vec3(1.0 / 2.2));
    }
    imageStore(picture, texel, vec4(colour, 1.0));
}
