/* SPDX-License-Identifier: MIT
 *
 * A point for each cluster, where the light's image shows its centre.
 */
#include "methods/rsm_clustering/cluster.glsl"

uniform mat4 view_projection; /* of the RSM */

void main()
{
    cluster c = load_cluster(uint(gl_VertexID));
    gl_Position = view_projection * vec4(c.centre, 1.0);
    gl_Position.z = 0.0;
    if (!(c.texels > 0.0))
        gl_Position = vec4(2.0, 2.0, 0.0, 1.0); /* outside */
}
