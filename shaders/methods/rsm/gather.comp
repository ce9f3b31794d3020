/* SPDX-License-Identifier: MIT
 *
 * Irradiance from one block of virtual lights, without visibility (Dachsbacher and Stamminger
 * 2005; thesis 3.2.2, eq. 3.6):
 *     E(x) = sum Phi/pi cos_x cos_y / r^2.
 *
 * An invocation gathers for TILE x TILE pixels at once: a light is loaded once for all of them, and
 * on a software rasteriser that load is what a light costs. Lanes lie side by side, an invocation's
 * own pixels GROUP columns or rows apart.
 *
 * With CLAMPED the geometry term is cut at `bound`; alpha takes the irradiance that is lost by it
 * (mean of the channels).
 */
#define GROUP 8
#define PIXELS (TILE * TILE)
layout(local_size_x = GROUP, local_size_y = GROUP) in;
#include "lights/form_factor.glsl"
#include "lights/vpl.glsl"

layout(std140, binding = 0) uniform Block { vec4 lights[VPL_VECTORS * VPL_BLOCK]; };
layout(rgba32f, binding = 0) uniform image2D irradiance; /* W/m2 */

uniform sampler2D gbuffer_position;
uniform sampler2D gbuffer_normal;
uniform int light_count;  /* in this block */
uniform int first_block;  /* 1: nothing to add to */
uniform float bound;      /* 1/m2 */

const float INV_PI = 0.318309886183790672;

void main()
{
    ivec2 size = imageSize(irradiance);
    ivec2 base = ivec2(gl_WorkGroupID.xy) * (GROUP * TILE) +
                 ivec2(gl_LocalInvocationID.xy);
    vec3 x[PIXELS], n[PIXELS];
    vec4 sum[PIXELS];
    for (int j = 0; j < PIXELS; j++) {
        ivec2 pixel = min(base + GROUP * ivec2(j % TILE, j / TILE), size - 1);
        x[j] = texelFetch(gbuffer_position, pixel, 0).xyz;
        n[j] = texelFetch(gbuffer_normal, pixel, 0).xyz; /* 0 without geometry: so is the sum */
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
        ivec2 pixel = base + GROUP * ivec2(j % TILE, j / TILE);
        vec4 before = imageLoad(irradiance, pixel);
        imageStore(irradiance, pixel, (first_block != 0 ? vec4(0.0) : before) + INV_PI * sum[j]);
    }
}
