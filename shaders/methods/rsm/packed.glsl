/* SPDX-License-Identifier: MIT
 *
 * An RSM texel in 16 bytes, one fetch, in the light's frame (right, up, direction):
 *     x    distance along the light's direction (m, 32-bit float)
 *     y,z  normal, 3 x 16 bits signed; the upper half of z: blue
 *     w    red, green; flux in units of PACKED_FLUX_UNIT, 16-bit floats
 * The position follows from the texel's place and x. Errors: none in the position beyond rounding,
 * 1.5e-5 in the normal, 2^-11 relative in the flux.
 */
const float PACKED_NORMAL_UNIT = 32767.0;
/* Of the RSM's largest possible flux. Half floats go to 64 times of it and keep their full
 * precision down to 6e-8 of it. */
const float PACKED_FLUX_STEPS = 1024.0;

uvec4 pack_texel(float z, vec3 normal, vec3 flux)
{
    ivec3 n = ivec3(round(clamp(normal, -1.0, 1.0) * PACKED_NORMAL_UNIT));
    uvec4 texel;
    texel.x = floatBitsToUint(z);
    texel.y = (uint(n.x) & 0xffffu) | (uint(n.y) << 16);
    texel.z = (uint(n.z) & 0xffffu) | (packHalf2x16(vec2(flux.b, 0.0)) << 16);
    texel.w = packHalf2x16(flux.rg);
    return texel;
}

/* In PACKED_NORMAL_UNIT. */
vec3 packed_normal(uvec4 texel)
{
    ivec4 t = ivec4(texel);
    return vec3((t.y << 16) >> 16, t.y >> 16, (t.z << 16) >> 16);
}

vec3 packed_flux(uvec4 texel)
{
    return vec3(unpackHalf2x16(texel.w), unpackHalf2x16(texel.z).y);
}
