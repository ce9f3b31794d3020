/* SPDX-License-Identifier: MIT
 *
 * Virtual lights that are convex polygons (core/lights/virtual_light.h), 3 + CORNERS/2 vec4 each,
 *     centre (m); area A (m2) | unit normal; distance of the farthest corner from the centre (m)
 *     flux Phi (W); 0 | two corners (m) each: in the plane through the centre, along tangent and
 *     bitangent of the light's frame (lights/paraboloid.glsl), counter-clockwise.
 * CORNERS is 8 or 16. With 0 they are lights without corners (lights/virtual_light.glsl).
 */
#define LIGHT_VECTORS (3 + CORNERS / 2)
