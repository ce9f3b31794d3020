/* SPDX-License-Identifier: MIT
 *
 * When a surface that a shadow map holds stands between a light and a receiver.
 *
 * All in the light's frame: light at the origin, normal along z, receiver at q on a triangle with
 * normal n. A map gives the distance d in the direction w of a texel's centre, so there is a surface
 * at d w. It may stand between a point of a disc-shaped light and the receiver only where it lies
 * before both the plane z = q.z, beyond which there are neither, and the receiver's tangent plane:
 *
 *     d w.m < 1,  m = n / n.q
 *
 * Without the latter, slanted receivers would shadow themselves. It is tested in the direction of
 * the texel's centre, so that a plane never shadows itself in a map that is exact there.
 *
 * Where the surface was sampled elsewhere, up to s texels off in both directions of the map, the
 * tangent plane may be as near as anywhere in that square: w.m grows by s times the sum of its
 * changes over a texel in both.
 */
struct shadow_test {
    vec3 q;       /* m; z > 0 */
    vec3 m;       /* 1/m */
    float scale;  /* 1 - bias */
    float offset; /* m */
    float slack;  /* 2 s times the side of a texel in [-1,1]^2 */
    vec2 centre;  /* of an imperfect shadow map in the atlas, texels */
    float texels; /* half its side */
};

const float LEAST_DISTANCE = 1e-9; /* m: square root of LEAST_R2 */

/* Of a triangle that is seen from behind (n.q >= 0) only the first plane remains. */
shadow_test shadow_test_of(vec3 q, vec3 n)
{
    shadow_test s;
    s.q = vec3(q.xy, max(q.z, LEAST_DISTANCE));
    s.m = n / min(dot(n, q), -LEAST_DISTANCE);
    return s;
}
