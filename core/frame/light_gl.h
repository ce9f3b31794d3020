/* SPDX-License-Identifier: MIT
 *
 * The scene's light, as shaders have it.
 */
#ifndef IRB_FRAME_LIGHT_GL_H
#define IRB_FRAME_LIGHT_GL_H

#include "core/gl/program.h"
#include "core/scene/light.h"

/* Sets the uniforms of shaders/frame/light.glsl. */
void irb_light_uniforms(const struct irb_light *light, const struct irb_program *program);

#endif
