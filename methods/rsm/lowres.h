/* SPDX-License-Identifier: MIT
 *
 * Low-resolution gather with interpolation in screen space (Dachsbacher and Stamminger 2005,
 * section 4.2; thesis 3.2.2): the gather runs for every scale-th pixel; the pixels between are
 * interpolated where at least three of the four samples round them agree with them in position and
 * normal, and the rest are put on a list, for which the gather runs again.
 */
#ifndef IRB_METHODS_RSM_LOWRES_H
#define IRB_METHODS_RSM_LOWRES_H

#include "methods/rsm/pixels.h"

struct rsm_lowres {
    struct irb_gl *gl;         /* borrowed */
    int scale, width, height;  /* of the full resolution */
    struct irb_texture *image; /* RGBA32F: the gather's, at every scale-th pixel */
    struct irb_buffer *flags;  /* uint a pixel */
    struct irb_buffer *list;   /* uint a pixel: x | y << 16 */
    struct irb_buffer *work;   /* indirect dispatch; pixels listed; pixels with geometry */
    struct irb_buffer *runs;
    struct irb_program *interpolate[2]; /* by the G-buffer's layout */
    struct irb_program *count, *scan, *write;
};

struct rsm_lowres *rsm_lowres_create(struct irb_gl *gl, int width, int height, int scale,
                                     struct irb_error *err);
void rsm_lowres_destroy(struct rsm_lowres *lowres);

struct rsm_agreement {
    float position; /* m: largest distance */
    float normal;   /* least cosine */
};

/* Fills `irradiance` (full resolution) from `image`, and the list of the pixels where it could not.
 * group_pixels: how many of them a work group of the second gather takes. Same input, same bits. */
bool rsm_lowres_interpolate(struct rsm_lowres *lowres, const struct irb_gbuffer *gbuffer,
                            const struct rsm_agreement *agreement,
                            const struct irb_texture *irradiance, int group_pixels,
                            struct irb_error *err);

/* Share of the pixels with geometry that the last interpolation put on the list, [0,1]. Waits. */
bool rsm_lowres_share(struct rsm_lowres *lowres, double *share, struct irb_error *err);

#endif
