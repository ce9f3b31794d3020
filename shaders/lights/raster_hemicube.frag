/* SPDX-License-Identifier: MIT
 *
 * Euclidean distance of the surface at a hemicube's texel. Blended by minimum.
 */
#include "frame/alpha_mask.glsl"
#include "lights/raster_charts.glsl"

flat in vec2 inverse_depth;
#ifdef ALPHA_MASK
in vec2 texcoord;
#endif

uniform int raster_size;
uniform float near; /* m: nearer surfaces are left out */

out float distance_to_light; /* m */

void main()
{
    /* Between the triangle's own depths: seen edge-on, it would leave them by any amount within the
     * sub-pixel grid. */
    float inverse = clamp(gl_FragCoord.w, inverse_depth.x, inverse_depth.y);
    vec2 uv = raster_uv(gl_FragCoord.xy, raster_size);
    float r = sqrt(1.0 + dot(uv, uv)) / inverse;
    distance_to_light = r >= near ? r : RASTER_EMPTY;
#ifdef ALPHA_MASK
    cut_away(texcoord);
#endif
}
