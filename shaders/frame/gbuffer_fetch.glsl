/* SPDX-License-Identifier: MIT
 *
 * The camera's G-buffer in either layout: GBUFFER_SLIM is 0 or 1 (irb_gbuffer_define()); the
 * uniforms are set by irb_gbuffer_bind(). Pixels without geometry have normal 0 and coverage 0.
 */
#include "frame/slim.glsl"
#include "frame/spheremap.glsl"

#if GBUFFER_SLIM
uniform sampler2D gbuffer_diffuse;
uniform sampler2D gbuffer_specular;
uniform sampler2D gbuffer_normal;
uniform sampler2D gbuffer_depth;
uniform vec3 gbuffer_camera;
uniform vec3 gbuffer_right, gbuffer_up, gbuffer_back;
uniform vec2 gbuffer_tangent; /* of half the field of view, across and up */
uniform vec2 gbuffer_near_far;

ivec2 gbuffer_size()
{
    return textureSize(gbuffer_depth, 0);
}

/* World position, m; coverage 0 or 1. */
vec4 gbuffer_fetch_position(ivec2 pixel)
{
    float depth = texelFetch(gbuffer_depth, pixel, 0).r;
    if (depth == 1.0)
        return vec4(0.0);
    float near = gbuffer_near_far.x, far = gbuffer_near_far.y;
    float z = near * far / (depth * (far - near) - far); /* thesis 5.1.1 */
    vec2 xy = ((vec2(pixel) + 0.5) / vec2(gbuffer_size()) * 2.0 - 1.0) * gbuffer_tangent;
    vec3 ray = gbuffer_right * xy.x + gbuffer_up * xy.y - gbuffer_back;
    return vec4(gbuffer_camera - z * ray, 1.0);
}

vec3 gbuffer_fetch_normal(ivec2 pixel)
{
    if (texelFetch(gbuffer_depth, pixel, 0).r == 1.0)
        return vec3(0.0);
    vec3 n = decode_spheremap(spheremap_from_unorm(texelFetch(gbuffer_normal, pixel, 0).rg));
    return gbuffer_right * n.x + gbuffer_up * n.y + gbuffer_back * n.z;
}

/* Euclidean distance to the camera, m; 0 without geometry. */
float gbuffer_fetch_distance(ivec2 pixel)
{
    vec4 position = gbuffer_fetch_position(pixel);
    return position.w * distance(position.xyz, gbuffer_camera);
}

/* The slim layout has no normals of the triangles: the shading normal stands in. */
vec3 gbuffer_fetch_geometric(ivec2 pixel)
{
    return gbuffer_fetch_normal(pixel);
}

vec3 gbuffer_fetch_diffuse(ivec2 pixel)
{
    return texelFetch(gbuffer_diffuse, pixel, 0).rgb;
}

/* k_s; exponent */
vec4 gbuffer_fetch_specular(ivec2 pixel)
{
    return decode_specular(texelFetch(gbuffer_specular, pixel, 0));
}
#else
uniform sampler2D gbuffer_position;
uniform sampler2D gbuffer_normal;
uniform sampler2D gbuffer_geometric;
uniform sampler2D gbuffer_diffuse;
uniform sampler2D gbuffer_specular;

ivec2 gbuffer_size()
{
    return textureSize(gbuffer_position, 0);
}

vec4 gbuffer_fetch_position(ivec2 pixel)
{
    return texelFetch(gbuffer_position, pixel, 0);
}

vec3 gbuffer_fetch_normal(ivec2 pixel)
{
    return texelFetch(gbuffer_normal, pixel, 0).xyz;
}

float gbuffer_fetch_distance(ivec2 pixel)
{
    return texelFetch(gbuffer_normal, pixel, 0).w;
}

vec3 gbuffer_fetch_geometric(ivec2 pixel)
{
    return texelFetch(gbuffer_geometric, pixel, 0).xyz;
}

vec3 gbuffer_fetch_diffuse(ivec2 pixel)
{
    return texelFetch(gbuffer_diffuse, pixel, 0).rgb;
}

vec4 gbuffer_fetch_specular(ivec2 pixel)
{
    return texelFetch(gbuffer_specular, pixel, 0);
}
#endif
