/* SPDX-License-Identifier: MIT
 *
 * Sums of one row of the irradiance image, from left to right: what is there (mean of the
 * channels) and what the clamp took.
 */
layout(local_size_x = 64) in;

uniform sampler2D irradiance;
layout(std430, binding = 0) writeonly buffer Rows { vec2 rows[]; };

void main()
{
    int y = int(gl_GlobalInvocationID.x);
    ivec2 size = textureSize(irradiance, 0);
    if (y >= size.y)
        return;
    vec2 sum = vec2(0.0);
    for (int x = 0; x < size.x; x++) {
        vec4 e = texelFetch(irradiance, ivec2(x, y), 0);
        sum += vec2((e.r + e.g + e.b) / 3.0, e.a);
    }
    rows[y] = sum;
}
