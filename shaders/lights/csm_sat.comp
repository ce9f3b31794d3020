/* SPDX-License-Identifier: MIT
 *
 * Summed-area tables of the basis images (Crow 1984), in place: running sums of one row (axis 0) or
 * column (axis 1) an invocation, in order. Texel (x, y) ends as the sum over all up to it.
 */
layout(local_size_x = 64) in;

uniform int axis;
layout(rgba32f, binding = 0) uniform image2DArray images;

void main()
{
    ivec3 size = imageSize(images);
    int line = int(gl_GlobalInvocationID.x), layer = int(gl_WorkGroupID.y);
    if (line >= size.y)
        return;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < size.x; i++) {
        ivec3 at = ivec3(axis == 0 ? ivec2(i, line) : ivec2(line, i), layer);
        sum += imageLoad(images, at);
        imageStore(images, at, sum);
    }
}
