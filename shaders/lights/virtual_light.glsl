/* SPDX-License-Identifier: MIT
 *
 * Virtual lights as core/lights/virtual_light.h lays them out: 3 vec4 each,
 *     position (m); area A (m2), 0 for a point light | unit normal; 0 | flux Phi (W); 0.
 */
#define VPL_VECTORS 3
