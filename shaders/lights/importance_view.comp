/* SPDX-License-Identifier: MIT
 *
 * The view samples of thesis eq. 4.2: Halton points over the G-buffer. A point on a pixel without
 * geometry gets normal 0, by which it adds nothing, and is not counted.
 */
layout(local_size_x = 64) in;
#include "frame/gbuffer_fetch.glsl"
#include "sampling/halton.glsl"

layout(std430, binding = 0) buffer State { uint largest_bits; uint valid_samples; };
/* position (m); 0 | unit normal; 0 */
layout(std430, binding = 1) writeonly buffer Samples { vec4 view_samples[]; };

uniform uint sample_count; /* M */
uniform uint first;        /* index of the first Halton point */

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= sample_count)
        return;
    ivec2 size = gbuffer_size();
    ivec2 pixel = min(ivec2(halton(first + i) * vec2(size)), size - 1);
    vec4 position = gbuffer_fetch_position(pixel);
    bool valid = position.w > 0.0;
    view_samples[2u * i] = vec4(position.xyz, 0.0);
    view_samples[2u * i + 1u] = vec4(valid ? gbuffer_fetch_normal(pixel) : vec3(0.0), 0.0);
    if (valid)
        atomicAdd(valid_samples, 1u);
}
