/* SPDX-License-Identifier: MIT
 *
 * Form factors of virtual lights, with the cosines of both sides clamped at 0 as in Dachsbacher and
 * Stamminger 2005, for a receiver x and a light y:
 *     point (thesis eq. 3.6), without its 1/pi:  G = cos_x cos_y / r^2   (1/m2), E(x) = Phi/pi G
 *     disc of area A (thesis eq. 5.5):  F = cos_x cos_y / (pi r^2 + A)   (1/m2), E(x) = Phi F
 * F with A = 0 is G/pi. A F, the share of the receiver's hemisphere, stays below 1.
 */
#include "gl/constants.glsl"

/* Below every r^2 of a scene in metres, and its square is still a normal float: at r = 0 both
 * cosines vanish and G is 0, not 0/0. */
const float LEAST_R2 = 1e-18;

float geometry_term(vec3 x, vec3 n_x, vec3 y, vec3 n_y)
{
    vec3 d = y - x;
    float r2 = max(dot(d, d), LEAST_R2);
    float cos_x = max(dot(n_x, d), 0.0);
    float cos_y = max(-dot(n_y, d), 0.0);
    return cos_x * cos_y / (r2 * r2);
}

/* F from r cos_x and r cos_y, both >= 0 (m), and r^2. No area is too large: F goes to 0. */
float disc_form_factor(float r_cos_x, float r_cos_y, float r2, float area)
{
    r2 = max(r2, LEAST_R2);
    return r_cos_x * r_cos_y / (r2 * (PI * r2 + area));
}
