/* SPDX-License-Identifier: MIT
 *
 * Halton points in bases 2 and 3 (Halton 1964): point i of the sequence, in [0,1)^2. The sequence
 * is taken without its point (0,0), which would put a light on the first texel of any flux at all,
 * however little that is.
 */
const float BELOW_ONE = 0.99999994; /* largest float below 1 */

float radical_inverse_2(uint i)
{
    /* 24 bits, so that the conversion never rounds up to 1 */
    return float(bitfieldReverse(i) >> 8) * (1.0 / 16777216.0);
}

float radical_inverse_3(uint i)
{
    /* digits are gathered in an integer: 15 of them (3^15 > 2^23) are exact in a float's place */
    uint reversed = 0u, scale = 1u;
    for (int digit = 0; digit < 15; digit++) {
        reversed = reversed * 3u + i % 3u;
        scale *= 3u;
        i /= 3u;
    }
    return min(float(reversed) / float(scale), BELOW_ONE);
}

vec2 halton(uint i)
{
    return vec2(radical_inverse_2(i + 1u), radical_inverse_3(i + 1u));
}
