/* SPDX-License-Identifier: MIT
 *
 * Full resolution from the low-resolution gather (Dachsbacher and Stamminger 2005, section 4.2;
 * thesis 3.2.2): bilinear among the four samples round a pixel, those of them that agree with it
 * in position and normal, where at least three do. The others are flagged for full evaluation.
 * At the image's border, where there are fewer samples, the nearest stand in for the missing ones.
 */
layout(local_size_x = 8, local_size_y = 8) in;
#include "frame/gbuffer_fetch.glsl"

uniform sampler2D low;                   /* irradiance at every scale-th pixel */
uniform int scale;
uniform float position_threshold;        /* m */
uniform float normal_threshold;          /* least cosine */
layout(rgba32f, binding = 0) uniform writeonly image2D irradiance;
layout(std430, binding = 0) writeonly buffer Flags { uint flags[]; };

const uint COVERED = 1u, REEVALUATE = 2u;
const int LEAST_AGREEING = 3;

void main()
{
    ivec2 size = gbuffer_size(), at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, size)))
        return;
    vec4 position = gbuffer_fetch_position(at);
    vec3 normal = gbuffer_fetch_normal(at);
    /* sample k of a row stands at pixel k * scale + scale/2 */
    ivec2 first = (at + scale - scale / 2) / scale - 1;
    vec2 share = vec2(at - (first * scale + scale / 2)) / float(scale);
    ivec2 last = textureSize(low, 0) - 1;
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    int agreeing = 0;
    for (int i = 0; i < 4; i++) {
        ivec2 corner = ivec2(i & 1, i >> 1);
        ivec2 k = clamp(first + corner, ivec2(0), last);
        ivec2 pixel = min(k * scale + scale / 2, size - 1);
        vec4 there = gbuffer_fetch_position(pixel);
        bool agrees = there.w > 0.0 &&
                      distance(there.xyz, position.xyz) <= position_threshold &&
                      dot(gbuffer_fetch_normal(pixel), normal) >= normal_threshold;
        vec2 w = mix(1.0 - share, share, vec2(corner));
        float weight = agrees ? w.x * w.y : 0.0;
        agreeing += agrees ? 1 : 0;
        sum += weight * texelFetch(low, k, 0);
        weights += weight;
    }
    bool covered = position.w > 0.0, hit = share == vec2(0.0); /* the pixel is a sample itself */
    bool interpolate = covered && weights > 0.0 && (agreeing >= LEAST_AGREEING || hit);
    imageStore(irradiance, at, interpolate ? sum / weights : vec4(0.0));
    flags[at.y * size.x + at.x] =
        covered ? (interpolate ? COVERED : COVERED | REEVALUATE) : 0u;
}
