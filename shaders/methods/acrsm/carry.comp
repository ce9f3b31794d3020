/* SPDX-License-Identifier: MIT
 *
 * Brings the clusters of the last frame to this frame's light.
 * SPACE 0: they keep their place in the light's view, as in the thesis, whose positions are in view
 *          space (table 5.2): world positions and normals move along with the light.
 * SPACE 1: they keep their place in the world; their place in the RSM is computed anew.
 */
layout(local_size_x = 64) in;

#include "frame/rsm_fetch.glsl"
#include "methods/acrsm/cluster.glsl"

layout(std430, binding = 0) buffer Clusters { cluster clusters[CLUSTERS_MOST]; };

uniform int active_count;
uniform mat4 motion; /* of the light since the last frame, world to world; a rigid motion */
uniform vec3 last_light_position;

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(active_count) || !in_use(clusters[i].count))
        return;
#if SPACE == 0
    /* relative to the light, so that nothing cancels far from the origin */
    clusters[i].position =
        rsm_light_position + mat3(motion) * (clusters[i].position - last_light_position);
    clusters[i].normal = mat3(motion) * clusters[i].normal;
#else
    vec3 at = rsm_to_light_frame(clusters[i].position);
    float scale = rsm_half_extent * (rsm_spread.x * at.z + rsm_spread.y);
    /* behind a spot there is no place in its image */
    clusters[i].uv = scale > 0.0 ? at.xy / (2.0 * scale) + 0.5 : vec2(-1.0);
    if (any(lessThan(clusters[i].uv, vec2(0.0))) ||
        any(greaterThanEqual(clusters[i].uv, vec2(1.0)))) {
        clusters[i].uv = clamp(clusters[i].uv, vec2(0.0), vec2(1.0));
        clusters[i].count = VANISHED;
    }
#endif
}
