/* SPDX-License-Identifier: MIT
 *
 * Irradiance by the paper's sampling (Dachsbacher and Stamminger 2005, section 4.1): the receiver
 * is projected into the light's image, and one fixed pattern of samples round it, the same for all
 * pixels, picks the texels that light it:
 *     E(x) = sum_s w_s Phi_p(s)/pi cos_x cos_y / r^2,
 * p(s) the texel under the sample, w_s how many texels the sample stands for. Samples beyond the
 * map contribute 0.
 *
 * A receiver outside the light's image is projected onto its border, towards the centre, so that
 * it is lit by the nearest part of the map (ours: the paper is silent).
 *
 * PACKED 1 takes each texel from the packed map with one fetch, in the light's frame; 0 with three
 * from the RSM, in world space. With CLAMPED the geometry term is cut at `bound`; alpha takes the
 * irradiance that is lost by it (mean of the channels).
 */
#include "frame/gbuffer_fetch.glsl"
#include "frame/rsm_fetch.glsl"
#include "gl/constants.glsl"
#include "lights/form_factor.glsl"
#include "methods/rsm/pixels.glsl"
#if PACKED
#include "methods/rsm/packed.glsl"
#endif

/* offset in the map's texels; w_s; 0 */
layout(std140, binding = 0) uniform Pattern { vec4 pattern[PATTERN_BLOCK]; };
layout(rgba32f, binding = 0) uniform image2D irradiance; /* W/m2 */

uniform int sample_count; /* in this block */
uniform int first_block;  /* 1: nothing to add to */
uniform float bound;      /* 1/m2 */
uniform float normal_offset; /* m */

const float LEAST_W = 1e-30;

/* Where the light's image shows the point given in the light's frame, in texels. */
vec2 project(vec3 p)
{
    vec2 across = p.xy / rsm_half_extent;
    float depth = rsm_spread.x > 0.0 ? p.z : 1.0;
    float scale = max(max(abs(across.x), abs(across.y)), max(depth, LEAST_W));
    return (across / scale * 0.5 + 0.5) * float(rsm_resolution());
}

#if PACKED
uniform usampler2D packed_rsm;
uniform float flux_unit; /* W: inverse of pack.comp's */
#define NORMAL_UNIT PACKED_NORMAL_UNIT
#else
#define NORMAL_UNIT 1.0
#endif

void main()
{
    ivec2 target[PIXELS];
    vec3 x[PIXELS], n[PIXELS];
    vec2 centre[PIXELS];
    vec4 sum[PIXELS];
    for (int j = 0; j < PIXELS; j++) {
        target[j] = target_of(j);
        ivec2 pixel = pixel_of(target[j]);
        x[j] = gbuffer_fetch_position(pixel).xyz;
        n[j] = gbuffer_fetch_normal(pixel); /* 0 without geometry: so is the sum */
        vec3 in_light = rsm_to_light_frame(x[j]);
        centre[j] = project(in_light);
#if PACKED
        x[j] = in_light;
        n[j] = rsm_vector_to_light_frame(n[j]);
#endif
        sum[j] = vec4(0.0);
    }
    float last = float(rsm_resolution());
    vec2 spread = rsm_spread;
    float side = 2.0 * rsm_half_extent / last;
    float corner = 0.5 * side - rsm_half_extent;
    for (int i = 0; i < sample_count; i++) {
        vec3 s = pattern[i].xyz;
        for (int j = 0; j < PIXELS; j++) {
            vec2 at = clamp(floor(centre[j] + s.xy), -1.0, last);
#if PACKED
            uvec4 texel = texelFetch(packed_rsm, ivec2(at) + 1, 0);
            float z = uintBitsToFloat(texel.x);
            vec3 n_y = packed_normal(texel);
            vec3 flux = packed_flux(texel);
            vec3 y = vec3((at * side + corner) * (spread.x * z + spread.y), z);
#else
            bool inside = all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, vec2(last)));
            ivec2 texel = clamp(ivec2(at), ivec2(0), ivec2(int(last) - 1));
            vec3 y = rsm_fetch_position(texel).xyz;
            vec3 n_y = rsm_fetch_normal(texel);
            vec3 flux = inside ? rsm_fetch_flux(texel) : vec3(0.0);
#endif
#ifdef OFFSET
            y -= n_y * (normal_offset / NORMAL_UNIT);
#endif
            float g = geometry_term(x[j], n[j], y, n_y);
#ifdef CLAMPED
            sum[j].a += (flux.x + flux.y + flux.z) * (s.z * max(g - bound * NORMAL_UNIT, 0.0));
            g = min(g, bound * NORMAL_UNIT);
#endif
            sum[j].rgb += flux * (g * s.z);
        }
    }
    for (int j = 0; j < PIXELS; j++) {
        vec4 e = sum[j] * vec4(vec3(INV_PI), INV_PI / 3.0);
#if PACKED
        e *= flux_unit / NORMAL_UNIT;
#endif
        vec4 before = imageLoad(irradiance, target[j]);
        imageStore(irradiance, target[j], (first_block != 0 ? vec4(0.0) : before) + e);
    }
}
