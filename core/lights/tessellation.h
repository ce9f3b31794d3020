/* SPDX-License-Identifier: MIT
 *
 * Tessellation factors of the thesis, equations 5.3 and 5.4:
 *
 *     t_A = max(ceil(smoothstep(A_min, A_max, A) f_max), f_min)   of a triangle of area A
 *     t_e = max(ceil(smoothstep(e_min, e_max, e) f_max), f_min)   of an edge of length e
 *
 * A_min ... e_max are taken over the whole scene at rest, without triangles of area 0. Where all
 * areas (or edges) are equal, smoothstep is 0/0 and counts as 0: the factor is f_min.
 */
#ifndef IRB_LIGHTS_TESSELLATION_H
#define IRB_LIGHTS_TESSELLATION_H

#include "core/scene/scene.h"

/* What an option chooses, and the order of its polynomial. */
enum irb_smoothstep { IRB_SMOOTHSTEP_3, IRB_SMOOTHSTEP_5 };
extern const char *const irb_smoothstep_names[]; /* "3", "5", NULL */
int irb_smoothstep_order(int smoothstep);

struct irb_tessellation_range {
    double area[2]; /* A_min, A_max, m2; 0, 0 without a triangle that has an area */
    double edge[2]; /* e_min, e_max, m */
};

void irb_tessellation_measure(const struct irb_scene *scene, struct irb_tessellation_range *range);

/* Area of a triangle at rest (m2) and its edges opposite of corners 0, 1 and 2 (m). */
double irb_triangle_size(const struct irb_scene *scene, uint32_t triangle, double edges[3]);

/* t_A or t_e for `value` of range[0]..range[1]. order: 3 for 3x^2 - 2x^3, 5 for
 * 6x^5 - 15x^4 + 10x^3. */
double irb_tessellation_factor(const double range[2], double value, int order, double f_min,
                               double f_max);

/* Points that tessellation hardware makes of the scene in point mode with the inner and outer
 * levels t_A and t_e; triangles without area have none. */
double irb_tessellation_points(const struct irb_scene *scene,
                               const struct irb_tessellation_range *range, int order, double f_min,
                               double f_max);

/* IRB_E_INPUT unless 1 <= f_min <= f_max <= 1024 and the order is 3 or 5. */
bool irb_tessellation_check(double f_min, double f_max, int order, struct irb_error *err);

#endif
