/* SPDX-License-Identifier: MIT
 *
 * A colour for each cluster's number: lightness, too, goes by number.
 */
#include "lights/hues.glsl"

vec3 cluster_colour(uint id)
{
    float value = 0.55 + 0.45 * fract(float(id) * 0.754877666);
    return value * hue_of(int(id), 0.75);
}
