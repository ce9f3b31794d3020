/* SPDX-License-Identifier: MIT
 *
 * Triangles of objects with one transform, in world space (core/lights/world_triangles.h).
 */
layout(local_size_x = 64) in;
#define TRIANGLES_AN_INVOCATION 16

layout(std430, binding = 0) readonly buffer Positions { float positions[]; };
layout(std430, binding = 1) readonly buffer Indices { uint indices[]; };
layout(std430, binding = 2) readonly buffer Density { float density[]; };
layout(std430, binding = 3) writeonly buffer Corners { vec4 corners[]; };

uniform mat4 model; /* rest -> current position */
uniform int first_triangle;
uniform int triangle_count;
uniform int has_density;

vec3 corner(int i)
{
    uint at = 3u * indices[i];
    return (model * vec4(positions[at], positions[at + 1u], positions[at + 2u], 1.0)).xyz;
}

void main()
{
    int begin = int(gl_WorkGroupID.x) * 64 * TRIANGLES_AN_INVOCATION +
                int(gl_LocalInvocationID.x);
    for (int k = 0; k < TRIANGLES_AN_INVOCATION; k++) {
        int i = begin + 64 * k;
        if (i >= triangle_count)
            break;
        int triangle = first_triangle + i;
        vec3 a = corner(3 * triangle);
        vec3 to_b = corner(3 * triangle + 1) - a, to_c = corner(3 * triangle + 2) - a;
        float points = has_density != 0 ? density[triangle] : 1.0;
        vec3 share = points > 0.0 ? cross(to_b, to_c) * (0.5 / points) : vec3(0.0);
        corners[3 * triangle] = vec4(a, share.x);
        corners[3 * triangle + 1] = vec4(to_b, share.y);
        corners[3 * triangle + 2] = vec4(to_c, share.z);
    }
}
