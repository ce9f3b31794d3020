/* SPDX-License-Identifier: MIT
 *
 * Virtual lights as every pass reads them (shaders/lights/virtual_light.glsl): three vec4 each in a
 * buffer that is std140 and std430 alike,
 *
 *     position (m); area A (m2), 0 for a point light (VPL)
 *     unit normal; 0
 *     reflected flux Phi (W); 0
 *
 * A receiver x gets E(x) = Phi cos_x cos_y / (pi r^2 + A) V (thesis eq. 5.5), which for A = 0 is
 * Phi/pi cos_x cos_y / r^2 V. A light without flux is dark: lighting skips it, but it keeps its
 * number, and with it its shadow map.
 */
#ifndef IRB_LIGHTS_VIRTUAL_LIGHT_H
#define IRB_LIGHTS_VIRTUAL_LIGHT_H

#include "core/gl/objects.h"

/* Lights in one uniform block: 48 bytes each, 48 KiB, below GL's 64 KiB. */
enum { IRB_VPL_BLOCK = 1024, IRB_VPL_BYTES = 48 };

/* A borrowed view of somebody's lights. The buffer holds whole blocks of IRB_VPL_BLOCK; what
 * follows `count` in its block is dark. Where lights have shadow maps there are at most
 * IRB_VPL_BLOCK of them. */
struct irb_virtual_lights {
    const struct irb_buffer *buffer;
    int count;   /* in use */
    int corners; /* 0; or 8 or 16: the lights are convex polygons of so many corners, 3 + corners/2
                    vec4 each (shaders/lights/polygon_light.glsl): E(x) = Phi/A F V, F the polygon's
                    form factor. Not for shadow maps, which take lights without corners */
};

#endif
