/* SPDX-License-Identifier: MIT
 *
 * The specular layer of the slim layouts (thesis table 5.1: k_s in 3 x 8 bits, the power in 8).
 * How the power goes into 8 bits: ours, logarithmic, so that its relative error is below 2.3 %
 * from 0 to 65535.
 */
const float POWER_BITS = 16.0;

vec4 encode_specular(vec4 specular)
{
    return vec4(specular.rgb, log2(1.0 + max(specular.a, 0.0)) / POWER_BITS);
}

vec4 decode_specular(vec4 stored)
{
    return vec4(stored.rgb, exp2(POWER_BITS * stored.a) - 1.0);
}
