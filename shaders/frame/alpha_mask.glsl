/* SPDX-License-Identifier: MIT
 *
 * Alpha masks of the scene's materials. The uniforms are set by irb_scene_gl_draw().
 */
uniform int has_diffuse_map;
uniform sampler2D diffuse_map; /* sRGB-decoded by the sampler, trilinear, repeat */

#ifdef ALPHA_MASK
uniform float alpha_cutoff; /* of the texture's alpha */

/* Leaves out what the material's mask cuts away (glTF 2.0, 3.9.4). From the texture's finest level
 * whatever the distance, as the reference does: camera, light and ray then meet the same surface,
 * where mipmaps would let leaves and meshes thin out or close with distance. In programs of its own,
 * since a shader that may discard tests depth late. */
void cut_away(vec2 texcoord)
{
    float alpha = has_diffuse_map != 0 ? textureLod(diffuse_map, texcoord, 0.0).a : 1.0;
    if (alpha < alpha_cutoff)
        discard;
}
#else
void cut_away(vec2 texcoord) {}
#endif
