/* SPDX-License-Identifier: MIT
 *
 * Irradiance from one block of virtual lights, without visibility (Dachsbacher and Stamminger
 * 2005; thesis 3.2.2, eq. 3.6):
 *     E(x) = sum Phi/pi cos_x cos_y / r^2.
 *
 * With CLAMPED the geometry term is cut at `bound`; alpha takes the irradiance that is lost by it
 * (mean of the channels).
 */
#include "frame/gbuffer_fetch.glsl"
#include "gl/constants.glsl"
#include "lights/form_factor.glsl"
#include "lights/virtual_light.glsl"
#include "methods/rsm/pixels.glsl"

layout(std140, binding = 0) uniform Block { vec4 lights[VPL_VECTORS * VPL_BLOCK]; };
layout(rgba32f, binding = 0) uniform image2D irradiance; /* W/m2 */

uniform int light_count;  /* in this block */
uniform int first_block;  /* 1: nothing to add to */
uniform float bound;      /* 1/m2 */

void main()
{
    ivec2 target[PIXELS];
    vec3 x[PIXELS], n[PIXELS];
    vec4 sum[PIXELS];
    for (int j = 0; j < PIXELS; j++) {
        target[j] = target_of(j);
        ivec2 pixel = pixel_of(target[j]);
        x[j] = gbuffer_fetch_position(pixel).xyz;
        n[j] = gbuffer_fetch_normal(pixel); /* 0 without geometry: so is the sum */
        sum[j] = vec4(0.0);
    }
    for (int i = 0; i < light_count; i++) {
        vec3 y = lights[VPL_VECTORS * i].xyz;
        vec3 n_y = lights[VPL_VECTORS * i + 1].xyz;
        vec3 flux = lights[VPL_VECTORS * i + 2].xyz;
#ifdef CLAMPED
        float mean_flux = (flux.x + flux.y + flux.z) * (1.0 / 3.0);
#endif
        for (int j = 0; j < PIXELS; j++) {
            float g = geometry_term(x[j], n[j], y, n_y);
#ifdef CLAMPED
            sum[j].a += mean_flux * max(g - bound, 0.0);
            g = min(g, bound);
#endif
            sum[j].rgb += flux * g;
        }
    }
    /* Loads and stores outside the image do nothing. No branch here: a loop that is not unrolled
     * would index the arrays dynamically and put them into memory, at half the speed. */
    for (int j = 0; j < PIXELS; j++) {
        vec4 before = imageLoad(irradiance, target[j]);
        imageStore(irradiance, target[j],
                   (first_block != 0 ? vec4(0.0) : before) + INV_PI * sum[j]);
    }
}
