/* SPDX-License-Identifier: MIT
 *
 * Distances from the atlas of imperfect shadow maps (core/lights/ism.h). The uniforms are set by
 * irb_ism_bind().
 */
uniform usampler2D ism_atlas;  /* bits of float32 distances, m; those of +Inf where empty */
uniform int ism_map_size;      /* texels a side */
uniform int ism_maps_a_row;

/* The map's corner in the atlas, texels. */
ivec2 ism_origin(int map)
{
    return ism_map_size * ivec2(map % ism_maps_a_row, map / ism_maps_a_row);
}

/* Texel of a map that holds p in [-1,1]^2, clamped to the map. */
ivec2 ism_texel(vec2 p)
{
    return clamp(ivec2(floor((0.5 * p + 0.5) * float(ism_map_size))), 0, ism_map_size - 1);
}

/* Euclidean distance from the light to the surface, m; +Inf where no surface was found. The texel
 * is clamped to the map. */
float ism_fetch(int map, ivec2 texel)
{
    ivec2 inside = clamp(texel, 0, ism_map_size - 1);
    return uintBitsToFloat(texelFetch(ism_atlas, ism_origin(map) + inside, 0).r);
}

/* Of the texel nearest to p in [-1,1]^2 (lights/paraboloid.glsl). */
float ism_distance(int map, vec2 p)
{
    return uintBitsToFloat(texelFetch(ism_atlas, ism_origin(map) + ism_texel(p), 0).r);
}
