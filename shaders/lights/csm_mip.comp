/* SPDX-License-Identifier: MIT
 *
 * One mip level of the basis images: means of 2 x 2 texels of the level below.
 */
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2DArray images;
uniform int level; /* that is written */
layout(rgba32f, binding = 0) writeonly uniform image2DArray target;

void main()
{
    ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at.xy, imageSize(target).xy)))
        return;
    ivec3 from = ivec3(2 * at.xy, at.z);
    vec4 low = texelFetch(images, from, level - 1) +
               texelFetch(images, from + ivec3(1, 0, 0), level - 1);
    vec4 high = texelFetch(images, from + ivec3(0, 1, 0), level - 1) +
                texelFetch(images, from + ivec3(1, 1, 0), level - 1);
    imageStore(target, at, 0.25 * (low + high));
}
