/* SPDX-License-Identifier: MIT
 *
 * The yardstick of tests/methods/bench_rsm_gather.c for the polar gather: a texel that each pixel
 * looks up for itself and the same arithmetic, and nothing else: no pattern, no border, no clamp,
 * no layouts. PACKED 1: one RGBA32UI fetch; 0: three RGBA32F fetches.
 */
layout(local_size_x = 8, local_size_y = 8) in;
#include "lights/form_factor.glsl"
#include "methods/rsm/packed.glsl"

layout(rgba32f, binding = 0) uniform writeonly image2D irradiance;

uniform sampler2D gbuffer_position;
uniform sampler2D gbuffer_normal;
uniform usampler2D packed_rsm;
uniform sampler2D rsm_position;
uniform sampler2D rsm_normal;
uniform sampler2D rsm_flux;
uniform int sample_count;

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    vec3 x = texelFetch(gbuffer_position, pixel, 0).xyz;
    vec3 n = texelFetch(gbuffer_normal, pixel, 0).xyz;
    vec3 sum = vec3(0.0);
    for (int i = 0; i < sample_count; i++) {
        ivec2 at = (pixel + ivec2(i & 31, i >> 5)) & 255;
#if PACKED
        uvec4 texel = texelFetch(packed_rsm, at, 0);
        float z = uintBitsToFloat(texel.x);
        sum += packed_flux(texel) *
               geometry_term(x, n, vec3(vec2(at) * z, z), packed_normal(texel));
#else
        sum += texelFetch(rsm_flux, at, 0).rgb *
               geometry_term(x, n, texelFetch(rsm_position, at, 0).xyz,
                             texelFetch(rsm_normal, at, 0).xyz);
#endif
    }
    imageStore(irradiance, pixel, vec4(sum, 0.0));
}
