/* SPDX-License-Identifier: MIT
 *
 * Composition: L = direct + k_d/pi * E_indirect (+ the method's own radiance), linear; and the
 * fixed-exposure Reinhard preview (thesis 5.3.4).
 */
#ifndef IRB_FRAME_COMPOSITE_H
#define IRB_FRAME_COMPOSITE_H

#include "core/frame/gbuffer_image.h"

/* On the CPU, over read-back images (3 or 4 channels, the first 3 count), so that scoring needs no
 * GL: indirect = k_d/pi * irradiance (+ radiance if not NULL); full = direct + indirect. Both are
 * created with 3 channels; either pointer may be NULL. Pixels without geometry are 0; non-finite
 * values elsewhere pass through, so that scores can count them. IRB_E_INPUT when sizes differ. */
bool irb_composite(const struct irb_gbuffer_image *gbuffer, const struct irb_image *direct,
                   const struct irb_image *irradiance, const struct irb_image *radiance,
                   struct irb_image *indirect, struct irb_image *full, struct irb_error *err);

/* Exposure for a sequence: key / log-average luminance (Reinhard 2002, eqs 1-2, key 0.18) over the
 * pixels of a reference image that show geometry and have finite luminance > 0; 1 when there are
 * none. gbuffer may be NULL: then all pixels count. */
double irb_exposure_of(const struct irb_image *radiance, const struct irb_gbuffer_image *gbuffer);

/* Reinhard L/(1+L) on luminance with the given exposure, then sRGB encoding; *srgb is created with
 * 3 channels in [0,1]. Negative and non-number values show black, infinite ones white. */
bool irb_tonemap(const struct irb_image *radiance, double exposure, struct irb_image *srgb,
                 struct irb_error *err);

#endif
