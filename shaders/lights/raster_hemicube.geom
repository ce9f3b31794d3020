/* SPDX-License-Identifier: MIT
 *
 * A triangle to the five half faces of its light's hemicube (lights/raster_charts.glsl), those that
 * may see it.
 */
layout(triangles) in;
layout(triangle_strip, max_vertices = 15) out;

in vec3 in_light[];
flat in int map[];

uniform int raster_size;
uniform float near_depth; /* m: least depth along a face's axis of what is seen */

flat out vec2 inverse_depth; /* least and largest of the triangle, 1/m */
out float gl_ClipDistance[1];
#ifdef ALPHA_MASK
in vec2 vertex_texcoord[];
out vec2 texcoord;
#endif

const int HALF_FACES = 5, FACES = 3;

/* Texels that snapping to the grid of sub-pixels may move a vertex by, at most: GL has 4 bits. */
const float SNAP = 0.0625;

/* (u, v, 1) times depth. Half faces: z; x, -x; y, -y. */
vec3 project(int half_face, vec3 p)
{
    return half_face == 0   ? p
           : half_face == 1 ? p.yzx
           : half_face == 2 ? -p.yzx
           : half_face == 3 ? p.xzy
                            : -p.xzy;
}

/* Whether any texel's centre may lie in the rectangle of texel coordinates. */
bool holds_centre(vec2 low, vec2 high)
{
    return all(notEqual(floor(low - 0.5 - SNAP), floor(high - 0.5 + SNAP)));
}

/* depth: of the three corners; u, v: times depth. */
bool may_show(vec3 u, vec3 v, vec3 depth)
{
    if (all(lessThan(depth, vec3(near_depth))) || all(greaterThan(u, depth)) ||
        all(lessThan(u, -depth)) || all(greaterThan(v, depth)) || all(lessThan(v, -depth)))
        return false;
    if (any(lessThan(depth, vec3(near_depth))))
        return true;
    vec3 x = u / depth, y = v / depth;
    vec2 low = vec2(min(min(x.x, x.y), x.z), min(min(y.x, y.y), y.z));
    vec2 high = vec2(max(max(x.x, x.y), x.z), max(max(y.x, y.y), y.z));
    float to_texels = 0.5 * float(raster_size);
    return holds_centre((low + 1.0) * to_texels, (high + 1.0) * to_texels);
}

void draw(int half_face)
{
    vec3 a = project(half_face, in_light[0]), b = project(half_face, in_light[1]);
    vec3 c = project(half_face, in_light[2]);
    vec3 u = vec3(a.x, b.x, c.x), v = vec3(a.y, b.y, c.y), depth = vec3(a.z, b.z, c.z);
    if (!may_show(u, v, depth))
        return;
    vec3 seen = max(depth, near_depth);
    vec2 range = 1.0 / vec2(max(max(seen.x, seen.y), seen.z), min(min(seen.x, seen.y), seen.z));
    for (int i = 0; i < 3; i++) {
        gl_Layer = FACES * map[0] + (half_face + 1) / 2;
        gl_Position = vec4(u[i], v[i], near_depth, depth[i]); /* clipped where depth < near */
        gl_ClipDistance[0] = in_light[i].z;                   /* and at the horizon */
        inverse_depth = range;
#ifdef ALPHA_MASK
        texcoord = vertex_texcoord[i];
#endif
        EmitVertex();
    }
    EndPrimitive();
}

void main()
{
    if (max(max(in_light[0].z, in_light[1].z), in_light[2].z) <= 0.0)
        return;
    for (int half_face = 0; half_face < HALF_FACES; half_face++)
        draw(half_face);
}
