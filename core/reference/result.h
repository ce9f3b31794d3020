/* SPDX-License-Identifier: MIT
 *
 * Private to the room: making a result.
 */
#ifndef IRB_REFERENCE_RESULT_H
#define IRB_REFERENCE_RESULT_H

#include "core/reference/reference.h"

/* All layers, zero. On failure nothing is left. */
bool irb_reference_image_create(struct irb_reference_image *image, int width, int height,
                                struct irb_error *err);

#endif
