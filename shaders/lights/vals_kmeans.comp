/* SPDX-License-Identifier: MIT
 *
 * k-means over the VPLs, in one work group (Dong et al. 2009; thesis 3.2.5): assign each VPL to the
 * VAL of least mu (eq. 3.7), put each VAL at the mean of its VPLs, and again until nothing changes.
 * Dark ones have no VAL.
 *
 * A dispatch makes as many iterations as IRB_LOOP_ROUNDS_MOST lets it, and the next one goes on.
 *
 * Sums run over the VPLs in their order, one invocation a VAL, relative to the first VPL, so that
 * scenes far from the origin lose nothing.
 */
#define GROUP 256
layout(local_size_x = GROUP) in;
#include "gl/constants.glsl"
#include "lights/virtual_light.glsl"

layout(std430, binding = 0) readonly buffer Vpls { vec4 vpls[]; };
#include "lights/vals_lit.glsl"
layout(std430, binding = 2) buffer Assignment { uint assignment[]; };
layout(std430, binding = 5) buffer Means { vec4 means[]; };
#include "lights/vals_statistics.glsl"

uniform int vpl_count, val_count;
uniform int tiles;           /* of interleaved sampling */
uniform int fresh;           /* 1: the frame's first dispatch; 0: goes on where the last one stopped */
uniform int reuse;           /* 1: starts from the means that are there */
uniform int iterations;      /* of this dispatch, at most */
uniform float weight_distance; /* 1/m */
uniform float weight_angle;    /* 1/rad */

/* Shorter sums of unit normals, per VPL, have no direction: the first one's stands in. Source: ours. */
const float LEAST_NORMAL = 1e-4;

shared vec4 centre[MOST_VALS]; /* m; 1 where it takes part */
shared vec3 normal[MOST_VALS];
shared uint val_of[MOST_VPLS];
shared int changed;

/* All of the group has done what comes before. */
void sync()
{
    memoryBarrierShared();
    barrier();
}

/* Number of the VPL that has point p of the sequence's stretch: lights/sample.glsl, backwards. */
int vpl_of_point(int p)
{
    int length = vpl_count / tiles, longer = vpl_count % tiles; /* tiles that have one more */
    int tile = p < longer * (length + 1) ? p / (length + 1)
                                         : longer + (p - longer * (length + 1)) / max(length, 1);
    return (p - tile * length - min(tile, longer)) * tiles + tile;
}

/* Number of the VPL that is the v-th lit one of the sequence's stretch; -1: there are fewer. */
int lit_vpl(int v)
{
    int found = -1;
    for (int p = 0; p < vpl_count && v >= 0; p++) {
        int l = vpl_of_point(p);
        found = is_lit(l) && v == 0 ? l : found;
        v -= is_lit(l) ? 1 : 0;
    }
    return found;
}

void start(int v)
{
    if (fresh == 0 || reuse != 0) {
        centre[v] = means[2 * v];
        normal[v] = means[2 * v + 1].xyz;
    } else {
        int l = lit_vpl(v);
        centre[v] = vec4(vpls[VPL_VECTORS * max(l, 0)].xyz, l >= 0 ? 1.0 : 0.0);
        normal[v] = vpls[VPL_VECTORS * max(l, 0) + 1].xyz;
    }
}

/* Between 0 and pi; pi/2 to a zero vector. By the sine as well: the arc cosine alone knows small
 * angles to 3e-4 only. */
float angle_between(vec3 a, vec3 b)
{
    float sine = length(cross(a, b)), cosine = dot(a, b);
    return sine > 0.0 ? atan(sine, cosine) : cosine > 0.0 ? 0.0 : cosine < 0.0 ? PI : 0.5 * PI;
}

uint nearest(int l)
{
    vec3 x = vpls[VPL_VECTORS * l].xyz, n = vpls[VPL_VECTORS * l + 1].xyz;
    float least = uintBitsToFloat(0x7f7fffffu); /* largest float */
    uint best = 0u;
    for (int v = 0; v < val_count; v++) {
        precise float mu = weight_distance * distance(x, centre[v].xyz) +
                           weight_angle * angle_between(n, normal[v]);
        bool nearer = centre[v].w > 0.0 && mu < least;
        least = nearer ? mu : least;
        best = nearer ? uint(v) : best;
    }
    return best;
}

/* Mean position and normal of a VAL's VPLs; where it has none, it stays. */
void update(int v)
{
    vec3 origin = vpls[0].xyz, x = vec3(0.0), n = vec3(0.0), first = vec3(0.0);
    float count = 0.0;
    for (int l = 0; l < vpl_count; l++)
        if (val_of[l] == uint(v)) {
            vec3 n_l = vpls[VPL_VECTORS * l + 1].xyz;
            x += vpls[VPL_VECTORS * l].xyz - origin;
            n += n_l;
            first = count == 0.0 ? n_l : first;
            count += 1.0;
        }
    if (count > 0.0) {
        centre[v].xyz = origin + x / count;
        normal[v] = length(n) > LEAST_NORMAL * count ? normalize(n) : first;
    }
}

void main()
{
    int i = int(gl_LocalInvocationIndex);
    bool converged = fresh == 0 && statistics.converged != 0u;
    if (converged)
        return;
    for (int v = i; v < val_count; v += GROUP)
        start(v);
    for (int l = i; l < vpl_count; l += GROUP)
        val_of[l] = fresh != 0 ? NO_VAL : assignment[l];
    int iteration = 0;
    while (iteration < iterations && !converged) {
        if (i == 0)
            changed = 0;
        sync();
        for (int l = i; l < vpl_count; l += GROUP) {
            uint best = is_lit(l) ? nearest(l) : NO_VAL;
            if (best != val_of[l])
                atomicOr(changed, 1);
            val_of[l] = best;
        }
        sync();
        converged = changed == 0;
        iteration++;
        if (!converged)
            for (int v = i; v < val_count; v += GROUP)
                update(v);
        sync();
    }
    for (int v = i; v < val_count; v += GROUP) {
        means[2 * v] = centre[v];
        means[2 * v + 1] = vec4(normal[v], 0.0);
    }
    for (int l = i; l < vpl_count; l += GROUP)
        assignment[l] = val_of[l];
    if (i == 0) {
        statistics.in_use = 0u;
        statistics.iterations = (fresh != 0 ? 0u : statistics.iterations) + uint(iteration);
        statistics.converged = converged ? 1u : 0u;
    }
}
