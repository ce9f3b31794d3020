/* SPDX-License-Identifier: MIT
 *
 * Look-ups in rasterised shadow maps, and the frames of the lights.
 */
layout(local_size_x = 64) in;
#include "lights/raster_maps_fetch.glsl"

struct query {
    vec4 direction; /* in the light's frame; w: map */
    vec4 normal;    /* of the light */
};
struct answer {
    vec4 texel_direction; /* w: distance */
    vec4 texel;
    vec4 tangent, bitangent;
};

uniform uint count;
layout(std430, binding = 0) readonly buffer Queries { query queries[]; };
layout(std430, binding = 1) writeonly buffer Answers { answer answers[]; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= count)
        return;
    int map = int(queries[i].direction.w);
    vec3 d = queries[i].direction.xyz;
    mat3 frame = light_frame(queries[i].normal.xyz);
    ivec3 texel = raster_texel(map, d);
    answers[i].texel_direction = vec4(raster_direction(texel), raster_distance(map, d));
    answers[i].texel = vec4(texel, 0);
    answers[i].tangent = vec4(frame[0], 0.0);
    answers[i].bitangent = vec4(frame[1], 0.0);
}
