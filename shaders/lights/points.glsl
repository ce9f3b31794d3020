/* SPDX-License-Identifier: MIT
 *
 * Points of a scene (core/lights/points.h) on its triangles as they are now
 * (core/lights/world_triangles.h).
 */
uniform usamplerBuffer points;   /* of one chunk: triangle; u | v << 16 */
uniform samplerBuffer triangles; /* 3 a triangle: corner 0, edges to corners 1 and 2; w: share */

struct surface_point {
    vec3 position; /* world, m */
    vec3 share;    /* unit normal of the triangle * area that the point stands for, m2 */
};

surface_point point_on_triangle(int triangle, vec2 weights)
{
    vec4 a = texelFetch(triangles, 3 * triangle);
    vec4 to_b = texelFetch(triangles, 3 * triangle + 1);
    vec4 to_c = texelFetch(triangles, 3 * triangle + 2);
    surface_point p;
    p.position = a.xyz + weights.x * to_b.xyz + weights.y * to_c.xyz;
    p.share = vec3(a.w, to_b.w, to_c.w);
    return p;
}

surface_point fetch_point(int i)
{
    uvec2 packed_point = texelFetch(points, i).rg;
    return point_on_triangle(int(packed_point.x), unpackUnorm2x16(packed_point.y));
}
