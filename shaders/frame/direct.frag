/* SPDX-License-Identifier: MIT
 *
 * Direct light, Lambert + Blinn (thesis 2.2.3, 5.3.4; both terms as it has them):
 *     L = (k_d n.l + k_s (n.h)^alpha) I / (pi r^2)
 */
#include "frame/shadow.glsl"
#include "gl/constants.glsl"

uniform sampler2D gbuffer_position;
uniform sampler2D gbuffer_normal;
uniform sampler2D gbuffer_geometric;
uniform sampler2D gbuffer_diffuse;
uniform sampler2D gbuffer_specular;
uniform vec3 camera_position;

layout(location = 0) out vec4 radiance;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    radiance = vec4(0.0);
    vec4 position = texelFetch(gbuffer_position, pixel, 0);
    if (position.w == 0.0)
        return;
    vec3 to_light;
    float r;
    vec3 irradiance = light_incident(position.xyz, to_light, r);
    vec3 normal = texelFetch(gbuffer_normal, pixel, 0).xyz;
    vec3 geometric = texelFetch(gbuffer_geometric, pixel, 0).xyz;
    float n_l = dot(normal, to_light);
    /* the light must be on the side that is seen, of the surface and of its shading normal */
    if (n_l <= 0.0 || dot(geometric, to_light) <= 0.0 || irradiance == vec3(0.0))
        return;
    vec3 k_d = texelFetch(gbuffer_diffuse, pixel, 0).rgb;
    vec4 specular = texelFetch(gbuffer_specular, pixel, 0);
    vec3 half_vector = to_light + normalize(camera_position - position.xyz);
    float h2 = dot(half_vector, half_vector);
    float n_h = h2 > 0.0 ? max(0.0, dot(normal, half_vector) * inversesqrt(h2)) : 0.0;
    vec3 brdf = k_d * n_l;
    if (specular.rgb != vec3(0.0) && n_h > 0.0)
        brdf += specular.rgb * pow(n_h, specular.a);
    radiance.rgb = brdf * irradiance * (INV_PI * shadow_factor(position.xyz, geometric, r));
}
