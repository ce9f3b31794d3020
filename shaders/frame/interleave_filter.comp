/* SPDX-License-Identifier: MIT
 *
 * Geometry-aware box filter over the merged image (thesis 5.3.3):
 *     Delta_alpha = 1 - step(alpha, |x_z - s_z|),  Delta_beta = step(beta, <n, s_n>),
 * a sample counts where both are 1. z is the distance to the camera. The window has TILES_X x
 * TILES_Y pixels and is shifted inwards at the border: any such window holds each tile once.
 *
 * alpha of `merged` is the irradiance that shadows took (mean of the channels); of the result, its
 * share of all.
 */
layout(local_size_x = 8, local_size_y = 8) in;

#include "frame/gbuffer_fetch.glsl"

uniform sampler2D merged;
uniform float filter_depth;  /* alpha, m */
uniform float filter_cosine; /* beta */
layout(rgba32f, binding = 0) writeonly uniform image2D filtered;

const ivec2 WINDOW = ivec2(TILES_X, TILES_Y);

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(filtered);
    if (pixel.x >= size.x || pixel.y >= size.y)
        return;
    vec3 normal = gbuffer_fetch_normal(pixel);
    float distance = gbuffer_fetch_distance(pixel);
    ivec2 corner = clamp(pixel - WINDOW / 2, ivec2(0), size - WINDOW);
    vec4 sum = vec4(0.0);
    float count = 0.0;
    for (int y = 0; y < TILES_Y; y++) {
        for (int x = 0; x < TILES_X; x++) {
            ivec2 at = corner + ivec2(x, y);
            float z = gbuffer_fetch_distance(at); /* 0 without geometry */
            float cosine = dot(gbuffer_fetch_normal(at), normal);
            bool alike = z > 0.0 && abs(z - distance) < filter_depth && cosine >= filter_cosine;
            if (at == pixel || alike) {
                sum += texelFetch(merged, at, 0);
                count += 1.0;
            }
        }
    }
    sum = distance > 0.0 ? sum / count : vec4(0.0);
    float all = dot(sum.rgb, vec3(1.0 / 3.0)) + sum.a;
    imageStore(filtered, pixel, vec4(sum.rgb, all > 0.0 ? sum.a / all : 0.0));
}
