/* SPDX-License-Identifier: MIT
 *
 * Colours of numbered lights and clusters, for pictures.
 */

/* A hue for a number, full value: steps of a golden ratio, so that neighbours in number are far
 * apart. */
vec3 hue_of(int number, float saturation)
{
    float hue = fract(float(number) * 0.618033988749895);
    vec3 rgb = clamp(abs(fract(hue + vec3(0.0, 2.0, 1.0) / 3.0) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
    return mix(vec3(1.0), rgb, saturation);
}
