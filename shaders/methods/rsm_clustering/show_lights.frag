/* SPDX-License-Identifier: MIT
 *
 * A light's fragment, where no surface hides it. Its plane is the mean of what it stands for, so it
 * may lie behind some of it: by HIDDEN of the way from the camera it still shows.
 */
#include "frame/gbuffer_fetch.glsl"

uniform vec3 camera;

flat in vec3 light_colour;
in vec3 world_position;
layout(location = 0) out vec4 colour;

const float HIDDEN = 0.02;

void main()
{
    vec4 surface = gbuffer_fetch_position(ivec2(gl_FragCoord.xy));
    if (surface.w > 0.0 &&
        distance(world_position, camera) > (1.0 + HIDDEN) * distance(surface.xyz, camera))
        discard;
    colour = vec4(light_colour, 1.0);
}
