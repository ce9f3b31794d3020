/* SPDX-License-Identifier: MIT
 *
 * Which RSM texel a candidate light stands on, and by what its flux is multiplied: 1/(N p) for a
 * texel chosen with probability p. SAMPLING is 0 all, 1 uniform, 2 importance, 3 map, as enum
 * irb_vpl_sampling; the last two differ in what the pyramid was built from.
 */
#include "frame/rsm_fetch.glsl"
#include "sampling/halton.glsl"

uniform int resolution;  /* texels a side of the RSM */
uniform uint candidates; /* N; all: resolution^2 */
uniform uint first;      /* index of the first Halton point */
uniform uint run_length; /* candidates that one invocation walks through */
uniform uint tiles;      /* of interleaved sampling; 1 = in the order of the sequence */

/* Which point of the stretch candidate i takes: those of one residue modulo `tiles` take
 * consecutive ones. In order, the candidates of every 9th number would share their first two digits
 * in base 3, and so lie in one strip of the map. */
uint point_of(uint i)
{
    uint tile = i % tiles;
    return tile * (candidates / tiles) + min(tile, candidates % tiles) + i / tiles;
}

struct candidate {
    ivec2 texel;
    vec3 flux; /* Phi = Phi_p / (N p), W */
};

#if SAMPLING >= 2
#include "lights/warp.glsl"
#endif

candidate draw(uint i)
{
    candidate c;
#if SAMPLING == 0
    c.texel = ivec2(int(i) % resolution, int(i) / resolution);
    c.flux = rsm_fetch_flux(c.texel);
#elif SAMPLING == 1
    vec2 point = halton(first + point_of(i));
    c.texel = min(ivec2(point * float(resolution)), ivec2(resolution - 1));
    float weight = float(resolution) * float(resolution) / float(candidates);
    c.flux = rsm_fetch_flux(c.texel) * weight;
#else
    float probability;
    c.texel = warp(halton(first + point_of(i)), probability);
    c.flux = vec3(0.0);
    if (probability > 0.0)
        c.flux = rsm_fetch_flux(c.texel) / (float(candidates) * probability);
#endif
    return c;
}

bool is_lit(candidate c)
{
    return any(greaterThan(c.flux, vec3(0.0)));
}
