/* SPDX-License-Identifier: MIT
 *
 * The state of a cluster (thesis table 5.2) as methods/acrsm/clusters.h lays it out; 80 bytes in
 * std140 and std430. Its verification measures lie in a buffer of their own (evaluation.glsl).
 *
 * The cluster map (thesis 5.1.2) has in red the texel's cluster, of those whose squares cover it; in
 * green the cluster that has its centre here, or NO_CLUSTER.
 */
#include "lights/cluster_map.glsl"

#define CLUSTERS_MOST 512

struct cluster {
    vec3 position;     /* m, world */
    float area;        /* m2 */
    vec3 normal;       /* unit */
    float importance;
    vec3 flux;         /* W, of all its texels */
    float irradiance;  /* W/m2, at its centre, mean of the channels */
    vec2 uv;           /* of the RSM */
    vec2 unused;
    vec3 centre_flux;  /* W, of the texel at its centre */
    int count;         /* of its texels, or what follows */
};

/* Instead of a count. PLACED and SPLIT last from evaluation to averaging only. */
const int VANISHED = 0; /* no texel: for the re-seed list */
const int UNBORN = -1;  /* has never been seeded */
const int SPLIT = -2;   /* seed position given, inside the cluster that is split */
const int PLACED = -3;  /* seeded, not yet averaged */

bool in_use(int count)
{
    return count > 0;
}

bool is_mapped_to(int count)
{
    return count > 0 || count == PLACED;
}

ivec2 texel_at(vec2 uv, int resolution)
{
    return clamp(ivec2(floor(uv * float(resolution))), ivec2(0), ivec2(resolution - 1));
}

/* First texel of the square of `side` texels round the centre (thesis 4.6, fig. 5.3). */
ivec2 square_corner(ivec2 centre, int side)
{
    return centre - side / 2;
}

bool in_square(ivec2 texel, ivec2 corner, int side)
{
    /* below the corner the difference wraps round to a large number */
    return all(lessThan(uvec2(texel - corner), uvec2(side)));
}
