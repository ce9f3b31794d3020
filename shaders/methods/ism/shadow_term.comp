/* SPDX-License-Identifier: MIT
 *
 * The share of the light that is in shadow, from the irradiance's alpha, as a layer of its own.
 */
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D irradiance;
layout(r32f, binding = 0) uniform writeonly image2D shadow_term;

void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(at, imageSize(shadow_term))))
        imageStore(shadow_term, at, vec4(texelFetch(irradiance, at, 0).a));
}
