/* SPDX-License-Identifier: MIT
 *
 * Importance of every RSM texel (thesis 4.5, 5.1.1):
 *
 *     rho   = (1 - w_v) rho_f + w_v rho_v                                  (eq. 4.3)
 *     rho_f = f_d w_d + f_s (1 - w_d)                                      (eq. 4.1)
 *     f_d   = max_rgb(k_d l falloff), f_s = max_rgb(k_s l falloff) alpha   (eqs 5.1, 5.2)
 *     rho_v = mean over M visible points of max(0, n_i . l_i)              (eq. 4.2, clamped)
 *
 * or, for rho_v, IRB_IMPORTANCE_GEOMETRY: the mean of the geometry terms between texel and visible
 * point (Prutkin et al. 2012, section 4), bounded where they are nearer than b:
 *
 *     rho_v = mean of max(0, n_i . l_i) max(0, -n . l_i) b^2/max(r_i^2, b^2)   in [0,1]
 *
 * l is the light's intensity (W/sr) or irradiance (W/m2), l_i the unit direction from the visible
 * point i to the texel, n_i its shading normal, n the texel's, r_i their distance (m). Spot and
 * directional lights, either layout.
 *
 * rho_f carries the light's colour, a falloff above 1 and the exponent alpha, while the thesis
 * calls it normalised and compares rho with absolute thresholds: with IRB_IMPORTANCE_NORM_MAX it is
 * divided by its maximum over the map, so that rho lies in [0,1] whatever the light's unit (a power
 * of two in the intensity changes no bit).
 */
#ifndef IRB_LIGHTS_IMPORTANCE_H
#define IRB_LIGHTS_IMPORTANCE_H

#include "core/frame/gbuffer.h"
#include "core/frame/rsm.h"

enum irb_importance_norm { IRB_IMPORTANCE_NORM_MAX, IRB_IMPORTANCE_NORM_NONE };
enum irb_importance_view { IRB_IMPORTANCE_LAMBERT, IRB_IMPORTANCE_GEOMETRY };

enum { IRB_IMPORTANCE_MOST_VIEW_SAMPLES = 1024 };

struct irb_importance_settings {
    float diffuse_weight; /* w_d, [0,1] */
    float view_weight;    /* w_v, [0,1] */
    int view_samples;     /* M, 1..IRB_IMPORTANCE_MOST_VIEW_SAMPLES; ignored where w_v is 0 */
    int norm;             /* enum irb_importance_norm */
    unsigned first;       /* index of the first Halton point of the view samples */
    int view_form;        /* enum irb_importance_view */
    float view_nearest;   /* b, m, above 0; GEOMETRY only: without it the few texels next to a
                             visible point would outweigh all others by 1/r^2 */
};

struct irb_importance {
    struct irb_texture *map;           /* R32F, resolution^2: rho; 0 where there is no flux */
    struct irb_importance_passes *own; /* private */
    struct irb_gl *gl;                 /* borrowed */
};

struct irb_importance *irb_importance_create(struct irb_gl *gl, int rsm_resolution,
                                             struct irb_error *err);
void irb_importance_destroy(struct irb_importance *importance);

/* Fills the map. `rsm` was rendered for `light`. The view samples are M Halton points over the
 * G-buffer; those on pixels without geometry are dropped, and the mean is over the rest: rho_v is 0
 * where none is left. `gbuffer` may be NULL where w_v is 0. Never NaN or infinite: a dark map gives
 * 0. Same input, same bits. */
bool irb_importance_compute(struct irb_importance *importance, const struct irb_rsm *rsm,
                            const struct irb_light *light, const struct irb_gbuffer *gbuffer,
                            const struct irb_importance_settings *settings, struct irb_error *err);

#endif
