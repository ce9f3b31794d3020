/* SPDX-License-Identifier: MIT
 *
 * A colour for each cluster's number: hues a golden ratio apart, lightness by number.
 */
vec3 cluster_colour(uint id)
{
    float hue = fract(float(id) * 0.61803398875);
    float value = 0.55 + 0.45 * fract(float(id) * 0.754877666);
    vec3 rgb = clamp(abs(fract(hue + vec3(0.0, 2.0, 1.0) / 3.0) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
    return value * mix(vec3(1.0), rgb, 0.75);
}
