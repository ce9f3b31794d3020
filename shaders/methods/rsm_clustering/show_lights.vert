/* SPDX-License-Identifier: MIT
 *
 * The area lights as the camera sees them, an instance each (Prutkin et al. 2012, figures 1 and 3):
 * discs as hexagons of the same area (CORNERS 0), or polygons.
 */
#include "gl/constants.glsl"
#include "lights/paraboloid.glsl"
#include "lights/polygon_light.glsl"
#include "methods/rsm_clustering/cluster_colour.glsl"

layout(std430, binding = 6) readonly buffer Lights { vec4 lights[]; };

uniform vec3 camera, right, up, back;
uniform vec2 tangent; /* of half the field of view */
uniform vec2 near_far;

flat out vec3 light_colour;
out vec3 world_position;

vec3 corner_of(uint first, int i)
{
    mat3 frame = light_frame(lights[first + 1u].xyz);
#if CORNERS > 0
    vec4 pair = lights[first + 3u + uint(i / 2)];
    vec2 corner = i % 2 == 0 ? pair.xy : pair.zw;
#else
    /* a regular hexagon of area A has the radius sqrt(2 A/(3 sqrt(3))) */
    float angle = PI / 3.0 * float(i);
    vec2 corner = sqrt(lights[first].w * 0.384900179) * vec2(cos(angle), sin(angle));
#endif
    return lights[first].xyz + corner.x * frame[0] + corner.y * frame[1];
}

void main()
{
    uint first = uint(LIGHT_VECTORS * gl_InstanceID);
    bool dark = lights[first + 2u].xyz == vec3(0.0);
    world_position = corner_of(first, gl_VertexID);
    vec3 d = world_position - camera;
    float z = -dot(d, back), near = near_far.x, far = near_far.y;
    gl_Position = vec4(dot(d, right) / tangent.x, dot(d, up) / tangent.y,
                       (z * (far + near) - 2.0 * far * near) / (far - near), z);
    if (dark)
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0); /* outside */
    light_colour = cluster_colour(uint(gl_InstanceID));
}
