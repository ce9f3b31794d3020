/* SPDX-License-Identifier: MIT
 *
 * Convolution soft shadow maps (Annen et al. 2007, 2008; thesis 3.1.2, 3.2.5): the shadow test as a
 * Fourier series of order M whose basis images can be filtered beforehand, so that the share of a
 * disc-shaped light that a receiver sees takes two look-ups, one for the mean depth of what blocks
 * it, which gives the penumbra's width (eq. 3.2), and one for the shadow.
 *
 * From the maps of core/lights/raster_maps.h. Depths are Euclidean distances, linear, divided by
 * the map's farthest one, and then by so much more that no difference of two depths comes nearer to
 * the series's period (z - d = 1 is z = d again) than the width of its step.
 *
 * Filtering takes place within the map's image. The paraboloid's footprints are squares of the
 * right solid angle anywhere on it. A hemicube's end at the edges of their face.
 *
 * What an order M leaves of the step is 1/(2M) of the depths on either side of it: blockers that
 * near to a receiver leak light.
 */
#ifndef IRB_LIGHTS_CSM_H
#define IRB_LIGHTS_CSM_H

#include "core/gl/program.h"
#include "core/lights/raster_maps.h"

enum { IRB_CSM_ORDER_MOST = 16, IRB_CSM_MAPS_MOST = 128 };
/* Basis images take at most this much, or what one map needs. Source: ours. */
enum { IRB_CSM_MOST_MIB = 256 };

enum irb_csm_prefilter {
    IRB_CSM_MIP, /* mipmaps, trilinear: cheap; footprints are smooth, and as wide as asked for in
                    their second moment */
    IRB_CSM_SAT, /* summed-area tables: any box; twice the look-ups, and sums of float32 */
};
extern const char *const irb_csm_prefilter_names[]; /* "mip", "sat", NULL */

/* Lengths `offset` and `search_offset` are in half widths 1/(2M) of the series's step. */
struct irb_csm_settings {
    float offset;        /* the receiver is taken for so much nearer in the shadow test: best, more
                            than its own depths vary by within a footprint */
    float scale;         /* the series is multiplied by this and cut at 1: at offset 0 a lit surface
                            reads f(z, z) = 1/2, and 2 puts that right (Annen et al. 2007) */
    float search_offset; /* likewise in the search for blockers: keeps the receiver out of it */
    float damping; /* alpha of exp(-alpha (k/M)^2), by which a_k are multiplied against ringing
                      (Annen et al. 2007); 0: none */
    float
        search_scale; /* radius of that search, in radii of the light at the receiver's distance */
    float penumbra_scale; /* factor of eq. 3.2 */
};

struct irb_csm {
    struct irb_gl *gl; /* borrowed */
    enum irb_raster_projection projection;
    enum irb_csm_prefilter prefilter;
    int size, capacity, order;
    int faces, levels;
    int count;                     /* maps of the last basis */
    float span;                    /* largest z of those */
    struct irb_texture *images;    /* RGBA32F array: shaders/lights/csm.glsl */
    struct irb_buffer *ranges;     /* vec4 a map: z per metre; 0; 0; 0 */
    struct irb_buffer *weights;    /* vec4 an order: a_k; 0; 0; 0 */
    struct irb_csm_passes *passes; /* private */
};

/* How many maps one set can take, at least 1. */
int irb_csm_most(struct irb_gl *gl, enum irb_raster_projection projection, int size, int order);

/* IRB_E_INPUT: a size that is no power of two from 4 on, an order outside
 * 1..IRB_CSM_ORDER_MOST, a capacity outside 1..irb_csm_most(). */
struct irb_csm *irb_csm_create(struct irb_gl *gl, enum irb_raster_projection projection, int size,
                               int capacity, int order, enum irb_csm_prefilter prefilter,
                               struct irb_error *err);
void irb_csm_destroy(struct irb_csm *csm);

/* Basis images of the maps of the last render; then the prefilter over them. IRB_E_INTERNAL for
 * maps of another shape. Never NaN or infinite, empty maps included. Same input, same bits. */
bool irb_csm_basis(struct irb_csm *csm, const struct irb_raster_maps *maps,
                   const struct irb_csm_settings *settings, struct irb_error *err);
bool irb_csm_prefilter(struct irb_csm *csm, struct irb_error *err);

/* What a shader that includes lights/csm_fetch.glsl is compiled with: strings that `list` points
 * to, NULL-terminated. Uniform blocks `binding` and `binding` + 1 will be used. */
struct irb_csm_defines {
    char text[6][32];
    const char *list[8];
};
void irb_csm_defines(const struct irb_csm *csm, int binding, struct irb_csm_defines *out);
/* Sets its uniforms; the next free texture unit. */
int irb_csm_bind(const struct irb_csm *csm, const struct irb_program *program,
                 const struct irb_csm_settings *settings, int binding, int first_unit);

#endif
