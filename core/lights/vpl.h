/* SPDX-License-Identifier: MIT
 *
 * Virtual point lights sampled from a reflective shadow map, in a buffer that shaders read as
 * uniform blocks of IRB_VPL_BLOCK lights (shaders/lights/virtual_light.glsl).
 *
 * Each VPL carries position, normal and flux such that E(x) = sum Phi/pi cos_x cos_y/r^2
 * estimates the irradiance from the whole RSM: Phi = Phi_p / (N p_p) for texel p chosen with
 * probability p_p.
 */
#ifndef IRB_LIGHTS_VPL_H
#define IRB_LIGHTS_VPL_H

#include "core/lights/pyramid.h"
#include "core/lights/virtual_light.h"

enum irb_vpl_sampling {
    IRB_VPL_ALL,        /* every lit texel, each once, in raster order */
    IRB_VPL_UNIFORM,    /* Halton points over the map; those on unlit texels are dropped */
    IRB_VPL_IMPORTANCE, /* Halton points warped hierarchically by flux (Clarberg 2005) */
    IRB_VPL_MAP,        /* likewise, by a map of the caller's */
};
extern const char *const irb_vpl_sampling_names[]; /* "all", "uniform", "importance", "map", NULL */

struct irb_vpl_set {
    struct irb_buffer *lights;  /* as core/lights/virtual_light.h has them, all with area 0;
                                   capacity rounded up to whole blocks */
    struct irb_buffer *counter; /* uint count, written by the sampling pass */
    int capacity;
    int count; /* lights in use after the last sampling */
    enum irb_vpl_sampling sampling;
    float normal_offset; /* m: how far a light is shifted against its normal (Dachsbacher and
                            Stamminger 2005); 0, may be set before any sampling */
    int tiles; /* of interleaved sampling (core/frame/interleave.h), to be set before sampling: the
                  lights of one tile, those whose number has one residue modulo this, take
                  consecutive points of the sequence, so that each tile's are spread over the map;
                  0 or 1: all in the sequence's order */
    struct irb_vpl_sampler *sampler; /* private: programs, the flux's pyramid */
    struct irb_gl *gl;               /* borrowed */
};

/* Room for `capacity` lights; for IRB_VPL_ALL that is at least resolution^2. IRB_E_INPUT when the
 * buffer would exceed the driver's limit for shader storage (GL guarantees 128 MiB: 1672 x 1672).
 */
struct irb_vpl_set *irb_vpl_set_create(struct irb_gl *gl, enum irb_vpl_sampling sampling,
                                       int rsm_resolution, int capacity, struct irb_error *err);
void irb_vpl_set_destroy(struct irb_vpl_set *set);

/* Draws `samples` candidates, at most `capacity` (ignored by ALL, which takes every texel), and
 * keeps those with flux, in order; N counts the dropped ones too, so that the estimate stays
 * unbiased. The Halton sequence (without its point 0) starts at `first`, so that a caller may use
 * the same points each frame or go on. An RSM without flux gives 0 lights. Same input, same bits.
 */
bool irb_vpl_set_sample(struct irb_vpl_set *set, const struct irb_rsm *rsm, int samples,
                        unsigned first, struct irb_error *err);

/* The same for a set of IRB_VPL_MAP: texels are chosen in proportion to the map that `pyramid` was
 * built from, of the RSM's resolution. Lit texels where the map is 0 get no lights: the estimate is
 * unbiased only where the map is positive wherever there is flux. */
bool irb_vpl_set_sample_map(struct irb_vpl_set *set, const struct irb_rsm *rsm,
                            const struct irb_pyramid *pyramid, int samples, unsigned first,
                            struct irb_error *err);

/* The lights in use. Valid until the set is sampled again or destroyed. */
static inline struct irb_virtual_lights irb_vpl_set_view(const struct irb_vpl_set *set)
{
    return (struct irb_virtual_lights){.buffer = set->lights, .count = set->count};
}

/* Blocks of IRB_VPL_BLOCK lights that `count` lights take up. */
static inline int irb_vpl_set_blocks(const struct irb_vpl_set *set)
{
    return (set->count + IRB_VPL_BLOCK - 1) / IRB_VPL_BLOCK;
}

#endif
