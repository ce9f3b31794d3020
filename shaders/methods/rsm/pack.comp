/* SPDX-License-Identifier: MIT
 *
 * Packs the RSM for the polar gather, with a border of one dark texel on which samples beyond the
 * map fall.
 */
layout(local_size_x = 8, local_size_y = 8) in;
#include "frame/rsm_fetch.glsl"
#include "methods/rsm/packed.glsl"

layout(rgba32ui, binding = 0) uniform writeonly uimage2D packed_rsm;

uniform float flux_unit; /* 1/W: PACKED_FLUX_STEPS over the largest flux; 0 for a dark light */

void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy), texel = at - 1;
    uvec4 value = uvec4(0u);
    if (all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(texel, ivec2(rsm_resolution()))) &&
        rsm_fetch_position(texel).w > 0.0)
        value = pack_texel(rsm_fetch_z(texel),
                           rsm_vector_to_light_frame(rsm_fetch_normal(texel)),
                           rsm_fetch_flux(texel) * flux_unit);
    imageStore(packed_rsm, at, value);
}
