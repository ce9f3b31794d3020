/* SPDX-License-Identifier: MIT
 *
 * Point-to-point form factor (thesis eq. 3.6, with the cosines of both sides clamped at 0 as in
 * Dachsbacher and Stamminger 2005), without its 1/pi:
 *     G = max(0, cos_x) max(0, cos_y) / r^2   (1/m2)
 * for a receiver x and a light y. E(x) = Phi/pi * G.
 */

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
