/* SPDX-License-Identifier: MIT
 *
 * Irradiance of the split G-buffer from VPLs, with the visibility of their VALs (Dong et al. 2009;
 * thesis 3.2.5):
 *     E(x) = n m sum over the tile's VALs of V_val(x) sum over its VPLs of Phi F
 * The VPLs come by tile and VAL (order.comp), so that each V is looked up once, and only where any
 * light arrives. VISIBILITY is 0 (V = 1) or 1.
 *
 * alpha takes n m sum Phi F (1 - V), mean of the channels. With CLAMPED pi F is cut at `bound`, and
 * what that takes of n m sum Phi F V goes into `lost`.
 */
#define GROUP 8
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

/* What the lights begin..end-1 add without shadow; w: what the bound took, mean of the channels. */
vec4 unshadowed(int begin, int end, vec3 x, vec3 n)
{
    vec4 sum = vec4(0.0);
    for (int l = begin; l < end; l++) {
        int i = VPL_VECTORS * (l - block_begin);
        vec3 flux = lights[i + 2].xyz;
        float g = geometry_term(x, n, lights[i].xyz, lights[i + 1].xyz);
#ifdef CLAMPED
        sum.w += dot(flux, vec3(1.0 / 3.0)) * max(g - bound, 0.0);
        g = min(g, bound);
#endif
        sum.rgb += flux * g;
    }
    return sum * (1.0 / PI);
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
    ivec2 corner = tile_size * ivec2(t % tiles_across, t / tiles_across);
    ivec2 place = ivec2(gl_WorkGroupID.xy) * GROUP + ivec2(gl_LocalInvocationID.xy);
    bool inside = place.x < tile_size.x && place.y < tile_size.y;
    ivec2 at = corner + min(place, tile_size - 1);
    vec3 x = texelFetch(split_position, at, 0).xyz;
    vec3 n = texelFetch(split_normal, at, 0).xyz; /* 0 without geometry: so is the sum */
    vec4 sum = vec4(0.0);
    float taken = 0.0;
    int end = min(first_of_tile(t + 1, vpl_count, tile_count), block_end);
    int begin = max(first_of_tile(t, vpl_count, tile_count), block_begin);
    while (begin < end) {
        int val = val_of(begin), next = begin + 1;
        while (next < end && val_of(next) == val)
            next++;
        if (val >= first_val && val < last_val) {
            vec4 e = unshadowed(begin, next, x, n);
            float v = 0.0;
            if (e.r + e.g + e.b > 0.0)
                v = visibility(val, x);
            sum += vec4(v * e.rgb, (1.0 - v) * dot(e.rgb, vec3(1.0 / 3.0)));
            taken += v * e.w;
        }
        begin = next;
    }
    /* loads and stores outside the image do nothing */
    ivec2 target = inside ? at : ivec2(-1);
    vec4 before = imageLoad(split_image, target);
    imageStore(split_image, target,
               (accumulate != 0 ? before : vec4(0.0)) + float(tile_count) * sum);
#ifdef CLAMPED
    float lost_before = imageLoad(lost, target).r;
    imageStore(lost, target,
               vec4((accumulate != 0 ? lost_before : 0.0) + float(tile_count) * taken));
#endif
}
