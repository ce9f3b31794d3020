/* SPDX-License-Identifier: MIT
 *
 * What texels and clusters are compared by (Prutkin et al. 2012, eq. 1):
 *     mu(p, c) = w_d |x_p - x_c|^2 + w_n (1 - n_p . n_c) + w_phi (Phi_p/|Phi_p| - Phi_c/|Phi_c|)^2.
 */
struct traits {
    vec3 position, normal;
    vec3 colour; /* Phi/|Phi| */
};

uniform vec3 metric_weights; /* w_d (1/m2), w_n, w_phi */

/* 0 for black. By the largest channel first: squares of small fluxes would vanish. */
vec3 colour_of(vec3 flux)
{
    float largest = max(flux.r, max(flux.g, flux.b));
    return largest > 0.0 ? normalize(flux / largest) : vec3(0.0);
}

float difference(traits p, traits c)
{
    vec3 d = p.position - c.position, colour = p.colour - c.colour;
    precise float mu = metric_weights.x * dot(d, d) +
                       metric_weights.y * (1.0 - dot(p.normal, c.normal)) +
                       metric_weights.z * dot(colour, colour);
    return mu;
}
