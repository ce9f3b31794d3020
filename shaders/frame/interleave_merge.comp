/* SPDX-License-Identifier: MIT
 *
 * Puts the pixels of the tiles back into their places: (x_s, y_s) of thesis 5.3.3.
 */
layout(local_size_x = 8, local_size_y = 8) in;

#include "frame/interleave.glsl"

uniform sampler2D split_image;
layout(rgba32f, binding = 0) writeonly uniform image2D merged;

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(merged);
    if (pixel.x < size.x && pixel.y < size.y)
        imageStore(merged, pixel, texelFetch(split_image, split_of(pixel), 0));
}
