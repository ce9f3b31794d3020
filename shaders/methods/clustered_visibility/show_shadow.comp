/* SPDX-License-Identifier: MIT
 *
 * Share of the light that is in shadow, as a scalar.
 */
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D irradiance;
layout(r32f, binding = 0) writeonly uniform image2D picture;

void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(at, imageSize(picture))))
        imageStore(picture, at, texelFetch(irradiance, at, 0).aaaa);
}
