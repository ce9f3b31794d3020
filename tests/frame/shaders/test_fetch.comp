/* SPDX-License-Identifier: MIT
 *
 * One layer of a G-buffer (LIGHT 0) or RSM (LIGHT 1) through the functions that methods use.
 */
layout(local_size_x = 8, local_size_y = 8) in;
#include "frame/gbuffer_fetch.glsl"
#include "frame/rsm_fetch.glsl"

layout(rgba32f, binding = 0) uniform writeonly image2D fetched;
uniform int layer;

void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, imageSize(fetched))))
        return;
    vec4 value;
#if LIGHT
    value = layer == 0   ? rsm_fetch_position(at)
            : layer == 1 ? vec4(rsm_fetch_normal(at), 0.0)
            : layer == 2 ? vec4(rsm_fetch_flux(at), 0.0)
                         : rsm_fetch_specular(at);
#else
    value = layer == 0   ? gbuffer_fetch_position(at)
            : layer == 1 ? vec4(gbuffer_fetch_normal(at), 0.0)
            : layer == 2 ? vec4(gbuffer_fetch_diffuse(at), 0.0)
                         : gbuffer_fetch_specular(at);
#endif
    imageStore(fetched, at, value);
}
