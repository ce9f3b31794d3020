/* SPDX-License-Identifier: MIT
 *
 * Irradiance of the split G-buffer from virtual lights with visibility (thesis 5.3.3, 3.2.3):
 *     E(x) = n m sum over the tile's lights of Phi F V
 * An invocation shades TILE x TILE pixels of one tile, lanes side by side, so that a light is
 * loaded once for all. VISIBILITY is 0 none, 1 binary, 2 PCSS, 3 raster, as enum irb_shade_visibility.
 *
 * alpha takes n m sum Phi F (1 - V), mean of the channels. With CLAMPED pi F is cut at `bound`, and
 * what that takes of n m sum Phi F V goes into `lost`.
 */
#define GROUP 8
#define PIXELS (TILE * TILE)
layout(local_size_x = GROUP, local_size_y = GROUP) in;

#include "lights/form_factor.glsl"
#include "lights/pcss.glsl"
#include "lights/polygon_light.glsl"

layout(std140, binding = 0) uniform Block { vec4 lights[LIGHT_VECTORS * VPL_BLOCK]; };
uniform sampler2D split_position, split_normal, split_geometric;
layout(rgba32f, binding = 0) uniform image2D split_image; /* W/m2 */
#ifdef CLAMPED
layout(r32f, binding = 1) uniform image2D lost; /* W/m2 */
#endif

uniform ivec2 tile_size;  /* pixels */
uniform int tiles_across; /* n */
uniform int tile_count;   /* n m */
uniform int light_begin, light_end; /* in this block */
uniform int light_base;  /* number of the block's first light */
uniform int map_base;    /* number of the light whose map is the first */
uniform int accumulate;  /* 1: adds to what is there */
uniform float bound;     /* 1/m2 */
uniform float bias;      /* share of the distance */
uniform float slope;     /* texels */
uniform float offset;    /* m */
uniform float map_texel; /* side of a map's texel in [-1,1]^2 */

struct virtual_light {
    vec3 position;
    vec3 flux;
    float area;   /* of the form factor, m2 */
    float radius; /* of the shadow, m */
    mat3 frame;
    vec2 centre; /* of its map in the atlas, texels */
    int map;
    int first; /* of its vectors in the block */
};

virtual_light load_light(int i)
{
    virtual_light l;
    vec4 position = lights[LIGHT_VECTORS * i];
    l.position = position.xyz;
    l.flux = lights[LIGHT_VECTORS * i + 2].xyz;
    l.frame = light_frame(lights[LIGHT_VECTORS * i + 1].xyz);
#ifdef POINT
    l.area = 0.0;
#else
    l.area = position.w;
#endif
    l.radius = sqrt(position.w / PI);
    l.map = light_base + i - map_base;
    l.first = LIGHT_VECTORS * i;
#if VISIBILITY == 1 || VISIBILITY == 2
    l.centre = vec2(ism_origin(l.map)) + 0.5 * float(ism_map_size);
#endif
    return l;
}

#if CORNERS > 0
#include "lights/shade_polygon.glsl"
#endif

/* q: receiver in the light's frame, m; n: its triangle's normal, world. */
float visibility(virtual_light l, vec3 q, vec3 n, bool needed)
{
#if VISIBILITY == 0
    return 1.0;
#else
    shadow_test s = shadow_test_of(q, n * l.frame);
    s.scale = 1.0 - bias;
    s.offset = offset;
#if VISIBILITY == 3
    return raster_visibility(s, l.map, slope);
#else
    s.centre = l.centre;
    s.texels = 0.5 * float(ism_map_size) * (1.0 - 2e-5); /* the rim stays inside */
    s.slack = 2.0 * slope * map_texel;
#if VISIBILITY == 1
    return binary_visibility(s);
#else
    return soft_visibility(s, l.radius, needed);
#endif
#endif
#endif
}

/* First light of tile t in this block. */
int first_light(int t)
{
    int past = (light_base + light_begin) % tile_count;
    return light_begin + (t >= past ? t - past : t - past + tile_count);
}

void main()
{
    int t = int(gl_WorkGroupID.z);
    ivec2 corner = tile_size * ivec2(t % tiles_across, t / tiles_across);
    ivec2 target[PIXELS];
    vec3 x[PIXELS], n[PIXELS], triangle[PIXELS];
    vec4 sum[PIXELS];
    float taken[PIXELS];
    for (int j = 0; j < PIXELS; j++) {
        ivec2 place = ivec2(gl_WorkGroupID.xy) * (GROUP * TILE) +
                      ivec2(gl_LocalInvocationID.xy) + GROUP * ivec2(j % TILE, j / TILE);
        bool inside = place.x < tile_size.x && place.y < tile_size.y;
        ivec2 at = corner + min(place, tile_size - 1);
        x[j] = texelFetch(split_position, at, 0).xyz;
        n[j] = texelFetch(split_normal, at, 0).xyz; /* 0 without geometry: so is the sum */
#if VISIBILITY != 0
        triangle[j] = texelFetch(split_geometric, at, 0).xyz;
#endif
        target[j] = inside ? at : ivec2(-1);
        sum[j] = vec4(0.0);
        taken[j] = 0.0;
    }
    for (int i = first_light(t); i < light_end; i += tile_count) {
        virtual_light l = load_light(i);
        float mean_flux = dot(l.flux, vec3(1.0 / 3.0));
#if CORNERS > 0
        float factors[PIXELS];
        polygon_factors(l, x, n, factors);
#endif
        for (int j = 0; j < PIXELS; j++) {
            vec3 d = x[j] - l.position, q = d * l.frame;
            float r_cos_x = max(-dot(n[j], d), 0.0);
#if CORNERS > 0 && !defined POINT
            float f = factors[j];
#else
            float f = disc_form_factor(r_cos_x, max(q.z, 0.0), dot(d, d), l.area);
#endif
            float v = visibility(l, q, triangle[j], f * mean_flux > 0.0);
#ifdef CLAMPED
            taken[j] += mean_flux * v * max(f - bound / PI, 0.0);
            f = min(f, bound / PI);
#endif
            sum[j].rgb += l.flux * (f * v);
            sum[j].a += mean_flux * (f * (1.0 - v));
        }
    }
    /* Loads and stores outside the image do nothing; no branch, see methods/rsm/gather.comp. */
    for (int j = 0; j < PIXELS; j++) {
        vec4 before = imageLoad(split_image, target[j]);
        imageStore(split_image, target[j],
                   (accumulate != 0 ? before : vec4(0.0)) + float(tile_count) * sum[j]);
#ifdef CLAMPED
        float lost_before = imageLoad(lost, target[j]).r;
        imageStore(lost, target[j],
                   vec4((accumulate != 0 ? lost_before : 0.0) + float(tile_count) * taken[j]));
#endif
    }
}
