/* SPDX-License-Identifier: MIT
 *
 * Paraboloid projection of the hemisphere above a light (Brabec et al. 2002; thesis 3.2.4): the
 * light's frame, the map of a direction, and back.
 *
 * A direction at angle theta to the normal lies at radius tan(theta/2): the hemisphere fills the
 * unit disc. Its Jacobian is dw/dA = (1 + cos theta)^2, the solid angle of a unit of the disc's
 * area: 4 at the centre, 1 at the rim.
 */

/* Columns tangent, bitangent, n: right-handed and orthonormal for a unit n; continuous but for
 * n.z changing its sign (Duff et al. 2017, "Building an orthonormal basis, revisited"). */
mat3 light_frame(vec3 n)
{
    float s = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (s + n.z);
    float b = n.x * n.y * a;
    return mat3(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y),
                n);
}

/* Unit direction in the light's frame, d.z >= 0 -> the unit disc. */
vec2 paraboloid(vec3 d)
{
    return d.xy / (1.0 + d.z);
}

/* Unit direction in the light's frame of a point of the plane; beyond the unit disc, z < 0. */
vec3 paraboloid_direction(vec2 p)
{
    float r2 = dot(p, p);
    return vec3(2.0 * p, 1.0 - r2) / (1.0 + r2);
}
