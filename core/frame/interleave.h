/* SPDX-License-Identifier: MIT
 *
 * Interleaved sampling of many lights (Keller and Heidrich 2001; Laine et al. 2007, section 5;
 * thesis 3.2.3, 5.1.4, 5.3.3): the G-buffer is split into n x m tiles, each of them the whole view
 * at every n-th column and m-th row; each tile is lit by its own share of the lights; what comes
 * out is merged, and a geometry-aware box filter of n x m pixels adds the shares up.
 *
 *     pixel (x, y), row 0 at the bottom, belongs to tile (i, j) = (x mod n, y mod m)
 *     and stands at (i w + x / n, j h + y / m) in the split buffers, w = ceil(W/n), h = ceil(H/m)
 *     light l of N lights tile t = i + j n, and no other, where l mod (n m) = t
 *
 * A tile's irradiance is multiplied by n m, so that the mean over any window of n x m pixels is the
 * sum over all lights, however many there are.
 *
 * Does not: light the split G-buffer; core/lights/shade.h does.
 */
#ifndef IRB_FRAME_INTERLEAVE_H
#define IRB_FRAME_INTERLEAVE_H

#include "core/frame/gbuffer.h"

enum { IRB_INTERLEAVE_MOST = 8 }; /* tiles a side */

struct irb_interleave {
    struct irb_gl *gl;           /* borrowed */
    int n, m;                    /* tiles across and up; at most the image's width and height */
    int width, height;           /* of the image */
    int tile_width, tile_height; /* w, h */
    /* Split: n w x m h. The last columns and rows of a tile may lie outside the image (padding). */
    struct irb_texture *position; /* RGBA32F: world position (m); 1, or 0 in padding and where there
                                     is no geometry */
    struct irb_texture *normal;   /* RGBA32F: unit shading normal; distance to the camera (m); 0
                                     where position.w is */
    struct irb_texture *geometric; /* RGBA32F: unit normal of the triangle (of a slim G-buffer, the
                                      shading normal); 0 */
    struct irb_texture *split;  /* RGBA32F: irradiance of the tile's own lights, times n m (W/m2);
                                   likewise what shadows took of it, mean of the channels */
    struct irb_texture *merged; /* RGBA32F, W x H: the same, pixels in their places */
    struct irb_interleave_passes *passes; /* private */
};

/* n, m in 1..IRB_INTERLEAVE_MOST. An image narrower than n gets n = width, likewise m: a tile
 * without pixels would lose the light of its lights. */
struct irb_interleave *irb_interleave_create(struct irb_gl *gl, int width, int height, int n, int m,
                                             struct irb_error *err);
/* The same into *interleave, unless it is like that already; what was there is destroyed. */
bool irb_interleave_prepare(struct irb_interleave **interleave, struct irb_gl *gl, int width,
                            int height, int n, int m, struct irb_error *err);
void irb_interleave_destroy(struct irb_interleave *interleave);

/* `position` and `normal` from a G-buffer of the same size and of either layout. */
bool irb_interleave_split(struct irb_interleave *interleave, const struct irb_gbuffer *gbuffer,
                          struct irb_error *err);

/* `merged` from `split`, bit by bit. */
bool irb_interleave_merge(struct irb_interleave *interleave, struct irb_error *err);

/* Mean of `merged` over the n x m pixels round each pixel that agree with it: |distance -
 * distance'| < depth (m, of the distances to the camera) and normal.normal' >= cosine. The pixel
 * itself always counts. The window is shifted inwards at the image's border, so that it holds every
 * tile once.
 *
 * out: RGBA32F of the image's size: irradiance (W/m2) without the light that is in shadow; the
 * share of light in shadow, [0,1]. 0 where there is no geometry, share 0 where there is no light.
 */
bool irb_interleave_filter(struct irb_interleave *interleave, const struct irb_gbuffer *gbuffer,
                           float depth, float cosine, const struct irb_texture *out,
                           struct irb_error *err);

#endif
