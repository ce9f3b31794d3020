/* SPDX-License-Identifier: MIT
 *
 * The yardstick of tests/methods/bench_rsm_gather.c: the arithmetic of gather.comp over one block
 * of lights and nothing else, for TILE x TILE pixels an invocation.
 */
#define GROUP 8
#define PIXELS (TILE * TILE)
layout(local_size_x = GROUP, local_size_y = GROUP) in;
#include "lights/form_factor.glsl"

layout(std140, binding = 0) uniform Block { vec4 lights[3 * 1024]; };
layout(rgba32f, binding = 0) uniform writeonly image2D irradiance;

uniform sampler2D gbuffer_position;
uniform sampler2D gbuffer_normal;

void main()
{
    ivec2 base = ivec2(gl_WorkGroupID.xy) * (GROUP * TILE) + ivec2(gl_LocalInvocationID.xy);
    vec3 x[PIXELS], n[PIXELS], sum[PIXELS];
    for (int j = 0; j < PIXELS; j++) {
        x[j] = texelFetch(gbuffer_position, base + GROUP * ivec2(j % TILE, j / TILE), 0).xyz;
        n[j] = texelFetch(gbuffer_normal, base + GROUP * ivec2(j % TILE, j / TILE), 0).xyz;
        sum[j] = vec3(0.0);
    }
    for (int i = 0; i < 1024; i++)
        for (int j = 0; j < PIXELS; j++)
            sum[j] += lights[3 * i + 2].xyz *
                      geometry_term(x[j], n[j], lights[3 * i].xyz, lights[3 * i + 1].xyz);
    for (int j = 0; j < PIXELS; j++)
        imageStore(irradiance, base + GROUP * ivec2(j % TILE, j / TILE), vec4(sum[j], 0.0));
}
