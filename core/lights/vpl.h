/* SPDX-License-Identifier: MIT
 *
 * Virtual point lights sampled from a reflective shadow map, in a buffer that shaders read as
 * uniform blocks of IRB_VPL_BLOCK lights (shaders/lights/vpl.glsl).
 *
 * Each VPL carries position, normal and flux such that E(x) = sum Phi/pi cos_x cos_y/r^2
 * estimates the irradiance from the whole RSM: Phi = Phi_p / (N p_p) for texel p chosen with
 * probability p_p.
 */
#ifndef IRB_LIGHTS_VPL_H
#define IRB_LIGHTS_VPL_H

#include "core/frame/rsm.h"

/* Lights in one uniform block: 48 bytes each, 48 KiB, below GL's 64 KiB. */
enum { IRB_VPL_BLOCK = 1024, IRB_VPL_BYTES = 48 };

enum irb_vpl_sampling {
    IRB_VPL_ALL,        /* every lit texel, each once, in raster order */
    IRB_VPL_UNIFORM,    /* Halton points over the map; those on unlit texels are dropped */
    IRB_VPL_IMPORTANCE, /* Halton points warped hierarchically by flux (Clarberg 2005) */
};
extern const char *const irb_vpl_sampling_names[]; /* "all", "uniform", "importance", NULL */

struct irb_vpl_set {
    struct irb_buffer *lights;  /* capacity rounded up to whole blocks; from `count` to the end of
                                   its block the flux is zero. std140 and std430: vec4 position,
                                   vec4 unit normal, vec4 flux (W); each w = 0 */
    struct irb_buffer *counter; /* uint count, written by the sampling pass */
    int capacity;
    int count; /* lights in use after the last sampling */
    enum irb_vpl_sampling sampling;
    float normal_offset; /* m: how far a light is shifted against its normal (Dachsbacher and
                            Stamminger 2005); 0, may be set before any sampling */
    struct irb_vpl_sampler *sampler; /* private: programs, the flux pyramid */
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

/* Blocks of IRB_VPL_BLOCK lights that `count` lights take up. */
static inline int irb_vpl_set_blocks(const struct irb_vpl_set *set)
{
    return (set->count + IRB_VPL_BLOCK - 1) / IRB_VPL_BLOCK;
}

#endif
