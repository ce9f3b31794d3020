/* SPDX-License-Identifier: MIT
 *
 * Fragment side of the scene's geometry: the surface that a pixel or texel shows, on the side that
 * faces the viewer (or the light). The uniforms are set by irb_scene_gl_draw().
 */
in vec3 world_position;
in vec3 world_normal;
in vec2 texcoord;

uniform mat4 normal_matrix;
uniform int first_triangle;    /* of the object that is drawn */
uniform vec3 material_diffuse; /* k_d, linear */
uniform vec4 material_specular; /* k_s; exponent alpha */

#include "frame/alpha_mask.glsl"

/* Unit normals of all triangles before the object's transform, computed in double precision: exact
 * where screen space derivatives of the position are not, and one load a fragment. */
layout(std430, binding = 0) readonly buffer FlatNormals { vec4 flat_normals[]; };

struct surface {
    vec3 position;
    vec3 normal;    /* unit shading normal */
    vec3 geometric; /* unit normal of the triangle */
    vec3 diffuse;   /* k_d */
    vec4 specular;  /* k_s; alpha */
};

/* The side is the geometric normal's: winding does not matter, and a shading normal that bends
 * away from it is turned with it. */
surface fetch_surface(vec3 to_viewer)
{
    surface s;
    s.position = world_position;
    vec3 flat_normal = flat_normals[first_triangle + gl_PrimitiveID].xyz;
    s.geometric = normalize(mat3(normal_matrix) * flat_normal);
    if (dot(s.geometric, to_viewer) < 0.0)
        s.geometric = -s.geometric;
    float length_squared = dot(world_normal, world_normal);
    s.normal = length_squared > 0.0 ? world_normal * inversesqrt(length_squared) : s.geometric;
    if (dot(s.normal, s.geometric) < 0.0)
        s.normal = -s.normal;
    s.diffuse = material_diffuse;
    if (has_diffuse_map != 0)
        s.diffuse *= texture(diffuse_map, texcoord).rgb;
    s.specular = material_specular;
    cut_away(texcoord); /* last: the texture's derivatives need all pixels of a quad */
    return s;
}
