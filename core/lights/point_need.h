/* SPDX-License-Identifier: MIT
 *
 * Where imperfect shadow maps need points: weights of triangles for irb_points_generate(), from the
 * lights as they are now (after Ritschel et al. 2011, whose points are denser where they matter to
 * the view; the measure is ours).
 *
 * A triangle's need is the mean over lights of its form factor seen from the light, that is, of the
 * share of the light's flux that would reach it if nothing stood between:
 *
 *     need(T) = 1/L sum_l F(l, T),   F(l, T) = 1/pi int_T max(cos_l, 0) |cos_T| / r^2 dA,
 *
 * for a small triangle cos_l |cos_T| A/(pi d^2), for all that surrounds a light 1. All lights with
 * flux count alike, as all have a map with as many points: importance has chosen them, by flux or
 * for the view, and through it the points follow the view.
 *
 * The need is one number a triangle: within it points are as dense everywhere, so that a wall of
 * two triangles gets more points as a whole, not where a light is near.
 */
#ifndef IRB_LIGHTS_POINT_NEED_H
#define IRB_LIGHTS_POINT_NEED_H

#include "core/lights/virtual_light.h"
#include "core/scene/scene.h"

/* As core/lights/virtual_light.h has them. */
struct irb_need_light {
    float position[4], normal[4], flux[4];
};

/* need: a double for each of the scene's triangles, where objects and vertices are now, in [0,1].
 * Triangles of no object, or in a light's plane, get 0; likewise all without a light with flux. */
void irb_point_need(const struct irb_scene *scene, const struct irb_need_light *lights, int count,
                    double *need);

/* Lights that the weights look at, at most: every k-th of a view's. */
enum { IRB_NEED_LIGHTS = 64 };

/* weights: a float for each of the scene's triangles; their sum is 1, or 0 in a scene without area.
 * The share `by_need` of it, in [0,1], goes by the need, the rest by the area at rest, so that what
 * these lights do not see has points too. Reads the lights back. Same input, same bits.
 * IRB_E_MEMORY.
 */
bool irb_point_weights(const struct irb_scene *scene, const struct irb_virtual_lights *lights,
                       float by_need, float *weights, struct irb_error *err);

#endif
