/* SPDX-License-Identifier: MIT
 *
 * Layouts of the G-buffer and the RSM.
 *
 *     full  32-bit floats throughout: what the reference and the direct light use.
 *     slim  the ACRSM thesis's (5.1.1, table 5.1): 8-bit k_d, k_s and flux, 2 x 16-bit spheremap
 *           normals in the viewer's space, positions from the hardware depth. Half to a sixth of
 *           the memory, at a cost in precision that trials can measure.
 *
 * Shaders read both through frame/gbuffer_fetch.glsl and frame/rsm_fetch.glsl, compiled with the
 * layout's define and bound with irb_gbuffer_bind() and irb_rsm_bind().
 */
#ifndef IRB_FRAME_LAYOUT_H
#define IRB_FRAME_LAYOUT_H

enum irb_layout { IRB_LAYOUT_FULL, IRB_LAYOUT_SLIM };

/* "full", "slim", NULL */
extern const char *const irb_layout_names[];

#endif
