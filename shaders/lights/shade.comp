/* SPDX-License-Identifier: MIT
 *
 * Shading without visibility or from imperfect shadow maps: lights/shade.glsl.
 */
#include "lights/shade.glsl"
