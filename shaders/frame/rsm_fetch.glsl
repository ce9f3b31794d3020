/* SPDX-License-Identifier: MIT
 *
 * The reflective shadow map in either layout: RSM_SLIM is 0 or 1 (irb_rsm_define()); the uniforms
 * are set by irb_rsm_bind(). Texels without geometry have flux 0, normal 0 and coverage 0.
 *
 * The light's frame is right, up and the direction that light travels; a texel's ray meets the
 * plane at distance 1 (spot) or any plane (directional) at rsm_image_point().
 */
#include "frame/slim.glsl"
#include "frame/spheremap.glsl"

uniform vec3 rsm_light_position;
uniform vec3 rsm_light_right, rsm_light_up, rsm_light_direction;
uniform float rsm_half_extent; /* of the image: tan of the half angle, or metres */
uniform vec2 rsm_spread;       /* spot: (1, 0): across = point * z; directional: (0, 1): point */

uniform sampler2D rsm_flux;
uniform sampler2D rsm_normal;
uniform sampler2D rsm_specular;

int rsm_resolution()
{
    return textureSize(rsm_flux, 0).x;
}

vec2 rsm_image_point(ivec2 texel)
{
    return (vec2(texel) + 0.5) * (2.0 * rsm_half_extent / float(rsm_resolution())) -
           rsm_half_extent;
}

/* In the light's frame: across (right, up) and along its direction, m. */
vec3 rsm_to_light_frame(vec3 world)
{
    vec3 d = world - rsm_light_position;
    return vec3(dot(d, rsm_light_right), dot(d, rsm_light_up), dot(d, rsm_light_direction));
}

vec3 rsm_vector_to_light_frame(vec3 v)
{
    return vec3(dot(v, rsm_light_right), dot(v, rsm_light_up), dot(v, rsm_light_direction));
}

#if RSM_SLIM
uniform sampler2D rsm_depth;  /* reversed: 0 where there is nothing */
uniform vec3 rsm_flux_scale;  /* W */
uniform vec2 rsm_depth_range; /* spot: (z at depth 1, 0); directional: (0, z at depth 0), m */

/* Distance along the light's direction, m; 0 without geometry. */
float rsm_fetch_z(ivec2 texel)
{
    float depth = texelFetch(rsm_depth, texel, 0).r;
    if (depth == 0.0)
        return 0.0;
    return rsm_spread.x > 0.0 ? rsm_depth_range.x / depth : (1.0 - depth) * rsm_depth_range.y;
}

/* World position, m; coverage 0 or 1. */
vec4 rsm_fetch_position(ivec2 texel)
{
    if (texelFetch(rsm_depth, texel, 0).r == 0.0)
        return vec4(0.0);
    float z = rsm_fetch_z(texel);
    vec2 across = rsm_image_point(texel) * (rsm_spread.x * z + rsm_spread.y);
    return vec4(rsm_light_position + across.x * rsm_light_right + across.y * rsm_light_up +
                    z * rsm_light_direction,
                1.0);
}

vec3 rsm_fetch_normal(ivec2 texel)
{
    if (texelFetch(rsm_depth, texel, 0).r == 0.0)
        return vec3(0.0);
    vec3 n = decode_spheremap(spheremap_from_unorm(texelFetch(rsm_normal, texel, 0).rg));
    return rsm_light_right * n.x + rsm_light_up * n.y - rsm_light_direction * n.z;
}

/* Reflected flux, W. */
vec3 rsm_fetch_flux(ivec2 texel)
{
    return texelFetch(rsm_flux, texel, 0).rgb * rsm_flux_scale;
}

/* k_s; exponent */
vec4 rsm_fetch_specular(ivec2 texel)
{
    return decode_specular(texelFetch(rsm_specular, texel, 0));
}
#else
uniform sampler2D rsm_position;

vec4 rsm_fetch_position(ivec2 texel)
{
    return texelFetch(rsm_position, texel, 0);
}

float rsm_fetch_z(ivec2 texel)
{
    vec4 position = rsm_fetch_position(texel);
    return position.w > 0.0 ? rsm_to_light_frame(position.xyz).z : 0.0;
}

vec3 rsm_fetch_normal(ivec2 texel)
{
    return texelFetch(rsm_normal, texel, 0).xyz;
}

vec3 rsm_fetch_flux(ivec2 texel)
{
    return texelFetch(rsm_flux, texel, 0).rgb;
}

vec4 rsm_fetch_specular(ivec2 texel)
{
    return texelFetch(rsm_specular, texel, 0);
}
#endif
