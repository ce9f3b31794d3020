/* SPDX-License-Identifier: MIT
 *
 * The share of the indirect light that is in shadow, which the irradiance holds in alpha, by itself
 * (white = shadow, as in the thesis's figures).
 */
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D irradiance;
layout(r32f, binding = 0) writeonly uniform image2D term;

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(pixel, imageSize(term))))
        imageStore(term, pixel, vec4(texelFetch(irradiance, pixel, 0).a));
}
