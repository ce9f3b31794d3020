/* SPDX-License-Identifier: MIT
 *
 * Virtual point lights as core/lights/vpl.h lays them out: 3 vec4 each,
 *     position (m); 0 | unit normal; 0 | flux Phi (W); 0.
 */
#define VPL_VECTORS 3
