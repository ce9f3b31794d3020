/* SPDX-License-Identifier: MIT
 *
 * The primary light and the camera of one frame, as plain values.
 */
#ifndef IRB_SCENE_LIGHT_H
#define IRB_SCENE_LIGHT_H

#include "core/base/hash.h"
#include "core/base/option.h"

enum irb_light_type { IRB_LIGHT_SPOT, IRB_LIGHT_DIRECTIONAL };

/* Angular falloff of a spot light; 1 on the axis for CONSTANT and SMOOTH.
 * COSINE is the thesis's (5.1.1): cos(theta)/cos(omega_s), largest on the axis, 1 at the rim. */
enum irb_falloff { IRB_FALLOFF_CONSTANT, IRB_FALLOFF_SMOOTH, IRB_FALLOFF_COSINE };

extern const char *const irb_light_type_names[]; /* "spot", "directional", NULL */
extern const char *const irb_falloff_names[];    /* "constant", "smooth", "cosine", NULL */

struct irb_light {
    enum irb_light_type type;
    float position[3];  /* spot: apex. directional: a point of the plane in which the beam starts */
    float direction[3]; /* unit, the way the light travels */
    float intensity[3]; /* spot: W/sr at falloff 1. directional: W/m2 perpendicular to the beam */
    float outer;        /* spot: half-angle omega_s of the cone, radians, (0, pi/2) */
    float inner;        /* spot: half-angle up to which SMOOTH is 1, radians, [0, outer) */
    enum irb_falloff falloff;
    float half_width; /* directional: half side of the square beam, metres */
};

/* Right and up of the light's image; the same in the RSM and the reference. right x up =
 * -direction. Straight down gives right = +x, up = -z; every other direction takes that frame along
 * by the shortest rotation, so that it is continuous but at straight up. */
void irb_light_basis(const struct irb_light *light, float right[3], float up[3]);

/* Falloff at angle theta from the axis; 0 outside the cone. */
double irb_light_falloff(const struct irb_light *light, double cos_theta);

/* Power that leaves the light, W per colour channel (closed form for each falloff). */
void irb_light_power(const struct irb_light *light, double watts[3]);

/* Irradiance (W/m2, per channel) on a surface element perpendicular to the light at `point`, were
 * nothing in the way; and the unit direction from the point to the light and the distance over
 * which the way must be free. Zero outside the cone or beam, or behind the light. */
void irb_light_incident(const struct irb_light *light, const float point[3], float irradiance[3],
                        float to_light[3], float *distance);

void irb_light_hash(const struct irb_light *light, struct irb_hash *hash);

struct irb_camera {
    float position[3];
    float target[3];
    float up[3];         /* unit; not parallel to the view */
    float vertical_fov;  /* full angle, radians */
    float z_near, z_far; /* metres, set from the scene's bounds where the config gives none */
};

/* Column-major view and projection (depth -1..1, right-handed), aspect = width/height. */
void irb_camera_matrices(const struct irb_camera *camera, float aspect, float view[16],
                         float projection[16]);

/* out = a b, column-major, each element rounded once; `out` must not be `a` or `b`. */
void irb_matrix_product(const float a[16], const float b[16], float out[16]);

void irb_camera_hash(const struct irb_camera *camera, struct irb_hash *hash);

#endif
