/* SPDX-License-Identifier: MIT
 *
 * Last pass of the importance map: rho = (1 - w_v) rho_f + w_v rho_v (thesis eq. 4.3), rho_f as
 * importance_brdf.comp left it and normalised if asked for, rho_v over the view samples the mean of
 * max(0, n_i . l_i) (eq. 4.2) or of bounded geometry terms (Prutkin et al. 2012). 0 in texels without flux.
 */
layout(local_size_x = 8, local_size_y = 8) in;
#include "frame/rsm_fetch.glsl"

layout(r32f, binding = 0) uniform image2D importance;
layout(std430, binding = 0) readonly buffer State { uint largest_bits; uint valid_samples; };
layout(std140, binding = 0) uniform Samples { vec4 view_samples[2 * MOST_VIEW_SAMPLES]; };

uniform int sample_count;  /* M; 0 without view dependence */
uniform float view_weight; /* w_v */
uniform int normalise;     /* 1: rho_f over its maximum */
uniform int view_form;     /* enum irb_importance_view */
uniform float view_nearest; /* m */

const int LAMBERT = 0;

const float LEAST_R2 = 1e-30; /* m2: a sample on the texel itself adds 0, not 0/0 */

float lambert(int i, vec3 texel)
{
    vec3 d = texel - view_samples[2 * i].xyz;
    float cosine = dot(view_samples[2 * i + 1].xyz, d) * inversesqrt(max(dot(d, d), LEAST_R2));
    return max(0.0, cosine);
}

/* cos cos b^2/max(r^2, b^2) */
float geometry(int i, vec3 texel, vec3 normal)
{
    vec3 d = texel - view_samples[2 * i].xyz;
    float r2 = max(dot(d, d), LEAST_R2), b2 = view_nearest * view_nearest;
    float cosines = max(0.0, dot(view_samples[2 * i + 1].xyz, d)) * max(0.0, -dot(normal, d));
    return cosines / r2 * min(b2 / r2, 1.0);
}

float view_importance(vec3 texel, vec3 normal)
{
    float sum = 0.0;
    if (view_form == LAMBERT)
        for (int i = 0; i < sample_count; i++)
            sum += lambert(i, texel);
    else
        for (int i = 0; i < sample_count; i++)
            sum += geometry(i, texel, normal);
    return valid_samples > 0u ? sum / float(valid_samples) : 0.0;
}

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, ivec2(rsm_resolution()))))
        return;
    bool lit = any(greaterThan(rsm_fetch_flux(texel), vec3(0.0)));
    float rho_f = imageLoad(importance, texel).r, largest = uintBitsToFloat(largest_bits);
    if (normalise != 0)
        rho_f = largest > 0.0 ? rho_f / largest : 0.0;
    float rho_v = lit ? view_importance(rsm_fetch_position(texel).xyz, rsm_fetch_normal(texel)) : 0.0;
    float rho = lit ? (1.0 - view_weight) * rho_f + view_weight * rho_v : 0.0;
    imageStore(importance, texel, vec4(rho));
}
