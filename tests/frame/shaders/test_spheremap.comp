/* SPDX-License-Identifier: MIT
 *
 * Normals through the slim layouts' encoding and back, by 16-bit numbers.
 */
layout(local_size_x = 64) in;
#include "frame/spheremap.glsl"

layout(std430, binding = 0) buffer Normals { vec4 normals[]; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(normals.length()))
        return;
    vec2 stored = spheremap_to_unorm(encode_spheremap(normals[i].xyz));
    stored = round(clamp(stored, 0.0, 1.0) * 65535.0) / 65535.0;
    normals[i] = vec4(decode_spheremap(spheremap_from_unorm(stored)), 0.0);
}
