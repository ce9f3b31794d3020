/* SPDX-License-Identifier: MIT
 *
 * Sums of one row of the split buffers, from left to right: the irradiance that is there (mean of
 * the channels) and what the bound took.
 */
layout(local_size_x = 64) in;

uniform sampler2D split_image, lost;
layout(std430, binding = 0) writeonly buffer Rows { vec2 rows[]; };

void main()
{
    int y = int(gl_GlobalInvocationID.x);
    ivec2 size = textureSize(split_image, 0);
    if (y >= size.y)
        return;
    vec2 sum = vec2(0.0);
    for (int x = 0; x < size.x; x++) {
        vec3 e = texelFetch(split_image, ivec2(x, y), 0).rgb;
        sum += vec2(dot(e, vec3(1.0 / 3.0)), texelFetch(lost, ivec2(x, y), 0).r);
    }
    rows[y] = sum;
}
