/* SPDX-License-Identifier: MIT
 *
 * Irradiance of the split G-buffer from virtual lights, with the visibility of their VALs (Dong et
 * al. 2009; thesis 3.2.5):
 *     E(x) = n m sum over the tile's VALs of V_val(x) sum over its lights of Phi F
 * The lights come by tile and VAL (vals_order.comp), so that each V is looked up once, and only where
 * any light arrives. VISIBILITY is 0 (V = 1) or 1. F is that of a disc with DISCS, else of a point.
 * An invocation shades TILE x TILE pixels of one tile, as lights/shade.glsl.
 *
 * alpha takes n m sum Phi F (1 - V), mean of the channels. With CLAMPED pi F is cut at `bound`, and
 * what that takes of n m sum Phi F V goes into `lost`.
 */
#define GROUP 8
#define PIXELS (TILE * TILE)
layout(local_size_x = GROUP, local_size_y = GROUP) in;

#include "lights/form_factor.glsl"
#include "lights/virtual_light.glsl"
#include "lights/vals_tiles.glsl"
#if VISIBILITY
#include "lights/csm_fetch.glsl"
#endif

layout(std140, binding = 0) uniform Block { vec4 lights[VPL_VECTORS * VPL_BLOCK]; };
layout(std140, binding = 1) uniform Vals { vec4 vals[VPL_VECTORS * MOST_VALS]; };
uniform sampler2D split_position, split_normal;
layout(rgba32f, binding = 0) uniform image2D split_image; /* W/m2 */
#ifdef CLAMPED
layout(r32f, binding = 1) uniform image2D lost; /* W/m2 */
#endif

uniform ivec2 tile_size;  /* pixels */
uniform int tiles_across; /* n */
uniform int tile_count;   /* n m */
uniform int vpl_count;
uniform int block_begin, block_end; /* VPLs of the order that the block holds */
uniform int first_val, last_val;    /* VALs that have maps now: first_val <= val < last_val */
uniform int accumulate;             /* 1: adds to what is there */
uniform float bound;                /* 1/m2 */

int val_of(int l)
{
    return int(lights[VPL_VECTORS * (l - block_begin) + 1].w);
}

float pi_form_factor(vec3 x, vec3 n, vec4 place, vec3 normal)
{
#if DISCS
    vec3 d = x - place.xyz;
    float r_cos_x = max(-dot(n, d), 0.0), r_cos_y = max(dot(normal, d), 0.0);
    return PI * disc_form_factor(r_cos_x, r_cos_y, dot(d, d), place.w);
#else
    return geometry_term(x, n, place.xyz, normal);
#endif
}

/* What the lights begin..end-1 add without shadow; w: what the bound took, mean of the channels. */
void unshadowed(int begin, int end, vec3 x[PIXELS], vec3 n[PIXELS], out vec4 sum[PIXELS])
{
    for (int j = 0; j < PIXELS; j++)
        sum[j] = vec4(0.0);
    for (int l = begin; l < end; l++) {
        int i = VPL_VECTORS * (l - block_begin);
        vec4 place = lights[i];
        vec3 normal = lights[i + 1].xyz, flux = lights[i + 2].xyz;
        for (int j = 0; j < PIXELS; j++) {
            float g = pi_form_factor(x[j], n[j], place, normal);
#ifdef CLAMPED
            sum[j].w += dot(flux, vec3(1.0 / 3.0)) * max(g - bound, 0.0);
            g = min(g, bound);
#endif
            sum[j].rgb += flux * g;
        }
    }
    for (int j = 0; j < PIXELS; j++)
        sum[j] *= 1.0 / PI;
}

float visibility(int val, vec3 x)
{
#if VISIBILITY
    vec4 centre = vals[VPL_VECTORS * val];
    mat3 frame = light_frame(vals[VPL_VECTORS * val + 1].xyz);
    return csm_visibility(val - first_val, (x - centre.xyz) * frame, sqrt(centre.w * (1.0 / PI)));
#else
    return 1.0;
#endif
}

void main()
{
    int t = int(gl_WorkGroupID.z);
    ivec2 corner = tile_size * ivec2(t % tiles_across, t / tiles_across), target[PIXELS];
    vec3 x[PIXELS], n[PIXELS];
    vec4 sum[PIXELS], e[PIXELS];
    float taken[PIXELS];
    for (int j = 0; j < PIXELS; j++) {
        ivec2 place = ivec2(gl_WorkGroupID.xy) * (GROUP * TILE) +
                      ivec2(gl_LocalInvocationID.xy) + GROUP * ivec2(j % TILE, j / TILE);
        bool inside = place.x < tile_size.x && place.y < tile_size.y;
        ivec2 at = corner + min(place, tile_size - 1);
        x[j] = texelFetch(split_position, at, 0).xyz;
        n[j] = texelFetch(split_normal, at, 0).xyz; /* 0 without geometry: so is the sum */
        target[j] = inside ? at : ivec2(-1); /* loads and stores outside the image do nothing */
        sum[j] = vec4(0.0);
        taken[j] = 0.0;
    }
    int end = min(first_of_tile(t + 1, vpl_count, tile_count), block_end);
    int begin = max(first_of_tile(t, vpl_count, tile_count), block_begin);
    while (begin < end) {
        int val = val_of(begin), next = begin + 1;
        while (next < end && val_of(next) == val)
            next++;
        if (val >= first_val && val < last_val) {
            unshadowed(begin, next, x, n, e);
            for (int j = 0; j < PIXELS; j++) {
                float v = 0.0;
                if (e[j].r + e[j].g + e[j].b > 0.0)
                    v = visibility(val, x[j]);
                sum[j] += vec4(v * e[j].rgb, (1.0 - v) * dot(e[j].rgb, vec3(1.0 / 3.0)));
                taken[j] += v * e[j].w;
            }
        }
        begin = next;
    }
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
