/* SPDX-License-Identifier: MIT
 *
 * Where a point of the scene is splatted in a light's imperfect shadow map, and how large (thesis
 * 5.3.2). The same for all splatters (core/lights/ism.h).
 *
 * Size: a patch of area a at distance r, seen at the cosine c, has the solid angle a c / r^2. The
 * paraboloid's Jacobian is dw/dA = (1 + cos theta)^2 (lights/paraboloid.glsl), and a unit of the
 * disc's area is (S/2)^2 texels of a map of S x S, so the patch covers
 *     a c / r^2 (S/2)^2 / (1 + cos theta)^2  texels.
 * Of N maps, each gets s_f/N of the points, so that one of its splats stands for N/s_f times the
 * area a that a point of the whole set stands for. With scale^2 that is side^2, rounded to a whole
 * side and kept within [1, splat_most]. a c is the point's own, or even_area for all points.
 */
#include "gl/constants.glsl"
#include "lights/paraboloid.glsl"
#include "lights/virtual_light.glsl"

layout(std140, binding = 0) uniform Lights { vec4 lights[VPL_VECTORS * VPL_BLOCK]; };

uniform int light_count;    /* N */
uniform float splat_factor; /* s_f */
uniform float splat_area;   /* (scale S/2)^2 N/s_f */
uniform float even_area;    /* m2: a c of every point; 0: as its triangle has it */
uniform int splat_most;     /* texels */
uniform int map_size;       /* S, texels */
uniform int maps_a_row;
uniform float near;         /* m: nearer points are left out */
uniform float near_radii;   /* likewise, in radii sqrt(A/pi) of the light */

/* Sine of the lowest elevation above a light's plane: below are points of the surface that it
 * stands on, up to rounding. A light sends 1e-6 of its flux there, into a sixteenth of a texel. */
const float HORIZON = 1e-3;

struct map_light {
    vec3 position;
    float near; /* m */
    mat3 frame;
    bool dark;
};

map_light fetch_light(int map)
{
    map_light l;
    l.position = lights[VPL_VECTORS * map].xyz;
    l.near = max(near, near_radii * sqrt(lights[VPL_VECTORS * map].w * INV_PI));
    l.frame = light_frame(lights[VPL_VECTORS * map + 1].xyz);
    vec3 flux = lights[VPL_VECTORS * map + 2].xyz;
    l.dark = !(max(flux.x, max(flux.y, flux.z)) > 0.0);
    return l;
}

struct splat {
    bool visible;
    float distance; /* m */
    ivec2 corner;   /* lowest texel in the map; it may lie outside */
    int side;       /* texels */
};

splat project(vec3 position, vec3 share, map_light light)
{
    splat s;
    vec3 d = position - light.position;
    vec3 local = d * light.frame;
    s.distance = sqrt(dot(d, d));
    s.visible = local.z > HORIZON * s.distance && s.distance >= light.near;
    float along = s.distance + local.z;
    vec2 texel = (0.5 * local.xy / along + 0.5) * float(map_size);
    float facing = even_area > 0.0 ? even_area : abs(dot(share, d)) / s.distance;
    float side2 = splat_area * facing / (along * along);
    s.side = int(clamp(sqrt(side2) + 0.5, 1.0, float(splat_most)));
    /* whole texels: centred on the texel where the side is odd, on its nearest corner where even */
    s.corner = ivec2(floor(texel - 0.5 * float(s.side - 1)));
    return s;
}

/* Well mixed bits of a number (the finaliser of MurmurHash3, Appleby 2011). */
uint mix_bits(uint h)
{
    h ^= h >> 16;
    h *= 0x85ebca6bu;
    h ^= h >> 13;
    h *= 0xc2b2ae35u;
    return h ^ (h >> 16);
}

/* Maps that a point goes to: the whole part of s_f, and one more for a share of the points that is
 * its fraction. `random`: of the point. */
int map_count(uint random)
{
    float whole = floor(splat_factor);
    return int(whole) + (float(random >> 8) < (splat_factor - whole) * 16777216.0 ? 1 : 0);
}

ivec2 map_origin(int map)
{
    return map_size * ivec2(map % maps_a_row, map / maps_a_row);
}
