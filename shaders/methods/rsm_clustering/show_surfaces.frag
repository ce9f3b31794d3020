/* SPDX-License-Identifier: MIT
 *
 * What the camera sees in grey, as a ground for the lights.
 */
#include "frame/gbuffer_fetch.glsl"

uniform vec3 camera;

layout(location = 0) out vec4 colour;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 position = gbuffer_fetch_position(pixel);
    vec3 to_camera = camera - position.xyz;
    float facing = abs(dot(gbuffer_fetch_normal(pixel), normalize(to_camera)));
    colour = vec4(vec3(position.w > 0.0 ? 0.1 + 0.3 * facing : 0.0), 1.0);
}
