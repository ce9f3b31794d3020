/* SPDX-License-Identifier: MIT
 *
 * First pass of the importance map: rho_f = f_d w_d + f_s (1 - w_d) of every texel (thesis eqs 4.1,
 * 5.1, 5.2) as it is, and its maximum over the map. The RSM holds k_d I dw_p; k_d I is what is
 * left without the texel's extent.
 */
layout(local_size_x = 8, local_size_y = 8) in;
#include "frame/flux_in.glsl"
#include "frame/rsm_fetch.glsl"

layout(r32f, binding = 0) uniform writeonly image2D importance;
/* Floats of one sign are in the order of their bits: an integer maximum needs no order. */
layout(std430, binding = 0) buffer State { uint largest_bits; uint valid_samples; };

uniform float diffuse_weight; /* w_d */

shared uint group_largest;

float max_rgb(vec3 v)
{
    return max(v.r, max(v.g, v.b));
}

float brdf_importance(ivec2 texel)
{
    vec3 flux = rsm_fetch_flux(texel);
    float extent = texel_extent(texel);
    if (!(max_rgb(flux) > 0.0) || !(extent > 0.0))
        return 0.0;
    vec4 specular = rsm_fetch_specular(texel);
    float f_d = max_rgb(flux) / extent;
    float f_s = max_rgb(specular.rgb * light_intensity * texel_falloff(texel)) * specular.a;
    float rho = f_d * diffuse_weight + f_s * (1.0 - diffuse_weight);
    return rho > 0.0 && !isinf(rho) ? rho : 0.0; /* false for NaN */
}

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (gl_LocalInvocationIndex == 0u)
        group_largest = 0u;
    barrier();
    if (all(lessThan(texel, ivec2(resolution)))) {
        float rho = brdf_importance(texel);
        imageStore(importance, texel, vec4(rho));
        atomicMax(group_largest, floatBitsToUint(rho));
    }
    barrier();
    if (gl_LocalInvocationIndex == 0u)
        atomicMax(largest_bits, group_largest);
}
