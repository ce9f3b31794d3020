/* SPDX-License-Identifier: MIT
 *
 * A triangle to the rectangle that encloses its image in its light's paraboloid; which texels of it
 * see the triangle is found for each (lights/raster_paraboloid.frag). Edges may then bend as they
 * do, and nothing need be subdivided.
 */
layout(triangles) in;
layout(triangle_strip, max_vertices = 4) out;

in vec3 in_light[];
flat in int map[];

uniform int raster_size;

flat out vec4 edge_0; /* a point p of the triangle's cone has dot(edge_i.xyz, p) >= 0 */
flat out vec4 edge_1;
flat out vec4 edge_2;
flat out vec4 plane; /* dot(plane.xyz, p) = plane.w >= 0 */
#ifdef ALPHA_MASK
in vec2 vertex_texcoord[];
flat out vec2 corner_0;
flat out vec2 corner_1;
flat out vec2 corner_2;
#endif

const float LEAST = 1e-30; /* against 0/0 */

vec2 low, high; /* of the image, (u, v) */

void enclose(vec2 uv)
{
    low = min(low, uv);
    high = max(high, uv);
}

/* The image's corners: those of the triangle above the horizon, and where its edges cross that. */
void enclose_corners()
{
    low = vec2(2.0);
    high = vec2(-2.0);
    for (int i = 0; i < 3; i++) {
        vec3 p = in_light[i], q = in_light[(i + 1) % 3];
        if (p.z >= 0.0)
            enclose(p.xy / max(length(p) + p.z, LEAST));
        if ((p.z >= 0.0) != (q.z >= 0.0)) {
            vec2 across = p.z >= 0.0 ? q.xy * p.z - p.xy * q.z : p.xy * q.z - q.xy * p.z;
            enclose(across * inversesqrt(max(dot(across, across), LEAST)));
        }
    }
}

/* Edges are arcs of circles with a radius of at least 1 (great circles under a stereographic
 * projection), and none is longer than half a circle: over a chord of length L they rise by at most
 * 1 - sqrt(1 - L^2/4). */
void enclose_arcs()
{
    vec2 extent = high - low;
    float rise = 1.0 - sqrt(max(1.0 - 0.25 * dot(extent, extent), 0.0));
    /* texels beyond the rim look inwards, by less than 5/4 texels (raster_charts.glsl) */
    float texel = 2.0 / float(raster_size);
    vec2 farthest = max(abs(low), abs(high)) + rise;
    bool at_rim = dot(farthest, farthest) > (1.0 - texel) * (1.0 - texel);
    float margin = rise + (at_rim ? 1.25 * texel : 0.0);
    low -= margin;
    high += margin;
}

/* Grown by what snapping to the grid of sub-pixels may take away: GL has 4 bits. */
bool snap_to_texels()
{
    float to_texels = 0.5 * float(raster_size);
    const float SNAP = 0.0625;
    low -= SNAP / to_texels;
    high += SNAP / to_texels;
    vec2 first = floor((low + 1.0) * to_texels - 0.5), last = floor((high + 1.0) * to_texels - 0.5);
    return all(notEqual(first, last));
}

void main()
{
    vec3 a = in_light[0], b = in_light[1], c = in_light[2];
    if (max(max(a.z, b.z), c.z) <= 0.0)
        return;
    enclose_corners();
    enclose_arcs();
    if (!snap_to_texels())
        return;
    /* The products of an edge's two corners change nothing but their sign where the triangle beyond
     * takes them in the other order, so that no texel falls between the two. */
    precise vec3 bc = b.yzx * c.zxy - b.zxy * c.yzx;
    precise vec3 ca = c.yzx * a.zxy - c.zxy * a.yzx;
    precise vec3 ab = a.yzx * b.zxy - a.zxy * b.yzx;
    vec3 normal = cross(b - a, c - a);
    float offset = dot(a, normal), side = offset < 0.0 ? -1.0 : 1.0;
    float farthest = sqrt(max(max(dot(a, a), dot(b, b)), dot(c, c)));
    if (offset == 0.0)
        return; /* seen edge-on */
    for (int i = 0; i < 4; i++) {
        edge_0 = vec4(side * bc, farthest);
        edge_1 = vec4(side * ca, 0.0);
        edge_2 = vec4(side * ab, 0.0);
        plane = side * vec4(normal, offset);
#ifdef ALPHA_MASK
        corner_0 = vertex_texcoord[0];
        corner_1 = vertex_texcoord[1];
        corner_2 = vertex_texcoord[2];
#endif
        gl_Layer = map[0];
        gl_Position = vec4((i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, 0.0, 1.0);
        EmitVertex();
    }
    EndPrimitive();
}
