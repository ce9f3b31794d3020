/* SPDX-License-Identifier: MIT
 *
 * Procedural textures of the built-in scenes: sRGB-encoded, 8 bits, seamless in both directions,
 * the same bytes on every run.
 */
#ifndef IRB_SCENE_BUILTIN_TEXTURE_H
#define IRB_SCENE_BUILTIN_TEXTURE_H

#include "core/scene/builder.h"

enum irb_pattern {
    IRB_PATTERN_BRICK,  /* eight courses of running bond; meant for 0.8 m */
    IRB_PATTERN_ASHLAR, /* four courses of hewn blocks; meant for 2 m */
    IRB_PATTERN_MARBLE, /* two by two veined slabs, light and dark; meant for 2 m */
    IRB_PATTERN_DAMASK, /* grey flowers in a lozenge grid, to be multiplied by a colour; 0.5 m */
};

/* A new texture of size x size texels in the scene that is built; its index. */
int irb_builder_pattern(struct irb_builder *builder, enum irb_pattern pattern, int size);

#endif
