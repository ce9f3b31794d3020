/* SPDX-License-Identifier: MIT
 *
 * Unit normals in two 16-bit numbers by spherical mapping (thesis 5.1.1). Its pair of formulas
 * returns the normal with the sign of z turned: it encodes with +n_z and decodes with -n_z. Here
 * both have -n_z, which puts the direction towards the viewer, where visible normals lie, at the
 * centre of the disc; with +n_z it would lie on the rim, where a step of 1/32767 is up to half a
 * degree.
 *
 *     e = normalize(n_xy) sqrt(0.5 - 0.5 n_z)
 *     n_z = 1 - 2 e.e,  n_xy = normalize(e) sqrt(1 - n_z^2)
 *
 * At n = (0,0,1) normalize() is 0/0; the forms below are the same numbers without it. (0,0,-1)
 * becomes (1,0), one of the rim's points.
 */

vec2 encode_spheremap(vec3 n)
{
    if (n.z >= 0.0)
        return n.xy * inversesqrt(2.0 + 2.0 * n.z); /* 1 - n_z^2 = n_xy.n_xy */
    float l = length(n.xy);
    return (l > 0.0 ? n.xy / l : vec2(1.0, 0.0)) * sqrt(0.5 - 0.5 * n.z);
}

vec3 decode_spheremap(vec2 e)
{
    float r2 = min(dot(e, e), 1.0);
    return vec3(e * (2.0 * sqrt(1.0 - r2)), 1.0 - 2.0 * r2);
}

/* [-1,1] to a 16-bit unsigned normalised number in which 0 is exact. */
vec2 spheremap_to_unorm(vec2 e)
{
    return (e * 32767.0 + 32768.0) * (1.0 / 65535.0);
}

vec2 spheremap_from_unorm(vec2 u)
{
    return (round(u * 65535.0) - 32768.0) * (1.0 / 32767.0);
}
