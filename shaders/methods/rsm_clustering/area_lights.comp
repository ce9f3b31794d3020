/* SPDX-License-Identifier: MIT
 *
 * Clusters as area lights (Prutkin et al. 2012, section 5): a disc each, as
 * core/lights/virtual_light.h has them, and with CORNERS above 0 a polygon each. Empty clusters and
 * what follows them in their block are dark.
 *
 * The disc's area, which the paper leaves open: AREA_TEXELS, the sum of its texels' surfaces;
 * AREA_MOMENT, the disc of the same second moment: 2 pi <|x - x_c|^2>, weighted by flux, and the
 * mean area of a texel, which is the moment of the texels themselves; AREA_MAX, the disc that
 * reaches the farthest texel's rim.
 *
 * The polygon: the texels in the plane through the centre, across the normal; in each of CORNERS
 * evenly spread directions the farthest of them, moved out by a texel's radius. These are points of
 * the rim of the texels' hull, widened by a regular polygon of that radius.
 */
layout(local_size_x = 32) in;
#include "gl/constants.glsl"
#include "lights/paraboloid.glsl"
#include "lights/polygon_light.glsl"
#include "lights/virtual_light.glsl"
#include "methods/rsm_clustering/cluster.glsl"
#include "methods/rsm_clustering/members.glsl"

#define AREA_TEXELS 0
#define AREA_MOMENT 1
#define AREA_MAX 2

layout(std430, binding = 6) writeonly buffer Lights { vec4 lights[]; };
#if CORNERS > 0
layout(std430, binding = 7) writeonly buffer Polygons { vec4 polygons[]; };
#endif

uniform uint cluster_count;
uniform uint light_count; /* whole blocks */
uniform int area;
uniform float flux_unit; /* 1/W */

struct extent {
    float weight, moment; /* sum of w, of w |x - x_c|^2 */
    float radius;         /* m, to the farthest texel's rim */
#if CORNERS > 0
    vec2 corner[CORNERS];
    float reach[CORNERS];
#endif
};

#if CORNERS > 0
vec2 direction(int i)
{
    float angle = 2.0 * PI * float(i) / float(CORNERS);
    return vec2(cos(angle), sin(angle));
}
#endif

#define CARRY_VECTORS (1 + CORNERS)

/* Of nothing, or what the parts before this one found. */
extent begin_extent(uint id)
{
    vec4 sums = part > 0u ? carry[CARRY_VECTORS * id] : vec4(0.0);
    extent e;
    e.weight = sums.x;
    e.moment = sums.y;
    e.radius = sums.z;
#if CORNERS > 0
    for (int i = 0; i < CORNERS; i++) {
        vec4 corner = vec4(vec2(0.0), -1e38, 0.0);
        if (part > 0u)
            corner = carry[CARRY_VECTORS * id + 1u + uint(i)];
        e.corner[i] = corner.xy;
        e.reach[i] = corner.z;
    }
#endif
    return e;
}

void store_extent(uint id, extent e)
{
    carry[CARRY_VECTORS * id] = vec4(e.weight, e.moment, e.radius, 0.0);
#if CORNERS > 0
    for (int i = 0; i < CORNERS; i++)
        carry[CARRY_VECTORS * id + 1u + uint(i)] = vec4(e.corner[i], e.reach[i], 0.0);
#endif
}

void measure(inout extent e, walk w, cluster c, mat3 frame)
{
    for (; w.goes_on; walk_on(w)) {
        if (!is_member(w))
            continue;
        member m = member_at(w);
        vec3 d = m.position - c.centre;
        float weight = (m.flux.r + m.flux.g + m.flux.b) * flux_unit;
        e.weight += weight;
        e.moment += weight * dot(d, d);
        e.radius = max(e.radius, length(d) + sqrt(m.area / PI));
#if CORNERS > 0
        vec2 p = vec2(dot(d, frame[0]), dot(d, frame[1]));
        for (int i = 0; i < CORNERS; i++) {
            float reach = dot(p, direction(i));
            e.corner[i] = reach > e.reach[i] ? p : e.corner[i];
            e.reach[i] = max(e.reach[i], reach);
        }
#endif
    }
}

float disc_area(cluster c, extent e)
{
    if (area == AREA_MAX)
        return PI * e.radius * e.radius;
    if (area == AREA_MOMENT)
        return c.texel_area + (e.weight > 0.0 ? 2.0 * PI * e.moment / e.weight : 0.0);
    return c.area;
}

#if CORNERS > 0
void write_polygon(uint id, cluster c, extent e)
{
    uint first = uint(LIGHT_VECTORS) * id;
    float rim = sqrt(c.texel_area / PI), twice_area = 0.0, radius2 = 0.0;
    for (int i = 0; i < CORNERS; i++) {
        vec2 a = e.corner[i] + rim * direction(i);
        vec2 b = e.corner[(i + 1) % CORNERS] + rim * direction((i + 1) % CORNERS);
        twice_area += a.x * b.y - a.y * b.x;
        radius2 = max(radius2, dot(a, a));
        if (i % 2 == 0)
            polygons[first + 3u + uint(i / 2)] = vec4(a, b);
    }
    bool dark = !(c.texels > 0.0 && twice_area > 0.0);
    polygons[first] = vec4(c.centre, dark ? 0.0 : 0.5 * twice_area);
    polygons[first + 1u] = vec4(c.normal, sqrt(radius2));
    polygons[first + 2u] = vec4(dark ? vec3(0.0) : c.flux, 0.0);
}
#endif

void main()
{
    uint id = gl_GlobalInvocationID.x;
    if (id >= light_count)
        return;
    cluster c = cluster(vec3(0.0), 0.0, vec3(0.0, 0.0, 1.0), 0.0, vec3(0.0), 0.0, ivec2(-1), false);
    if (id < cluster_count)
        c = load_cluster(id);
    walk w = begin_walk(id, c.cell);
    if (!w.begins)
        return;
    extent e = begin_extent(id);
    measure(e, w, c, light_frame(c.normal));
    if (!w.ends) {
        store_extent(id, e);
        return;
    }
    bool dark = !(c.texels > 0.0);
    lights[VPL_VECTORS * id] = vec4(c.centre, dark ? 0.0 : disc_area(c, e));
    lights[VPL_VECTORS * id + 1u] = vec4(c.normal, 0.0);
    lights[VPL_VECTORS * id + 2u] = vec4(dark ? vec3(0.0) : c.flux, 0.0);
#if CORNERS > 0
    write_polygon(id, c, e);
#endif
}
