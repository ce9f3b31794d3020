/* SPDX-License-Identifier: MIT
 *
 * The yardstick of tests/methods/bench_rsm_gather.c: the arithmetic of gather.comp and nothing else.
 */
#include "lights/form_factor.glsl"

layout(std140, binding = 0) uniform Block { vec4 lights[3 * 1024]; };

uniform sampler2D gbuffer_position;
uniform sampler2D gbuffer_normal;

layout(location = 0) out vec4 irradiance;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 x = texelFetch(gbuffer_position, pixel, 0).xyz;
    vec3 n = texelFetch(gbuffer_normal, pixel, 0).xyz;
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 1024; i++)
        sum += lights[3 * i + 2].xyz * geometry_term(x, n, lights[3 * i].xyz, lights[3 * i + 1].xyz);
    irradiance = vec4(0.318309886183790672 * sum, 1.0);
}
