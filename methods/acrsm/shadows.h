/* SPDX-License-Identifier: MIT
 *
 * What lights and shades with acrsm's area lights: points of the scene, shadow maps, the split
 * G-buffer. Everything is made when a frame first needs it, and anew when a parameter asks for
 * another one.
 */
#ifndef IRB_METHODS_ACRSM_SHADOWS_H
#define IRB_METHODS_ACRSM_SHADOWS_H

#include "methods/acrsm/params.h"

/* Thesis 5.1.3: an atlas of 4096 x 4096 texels, maps of 128 x 128. */
enum { ACRSM_MAP_SIZE = 128, ACRSM_MAPS = 1024 };

struct acrsm_lighting {
    struct irb_gl *gl;         /* borrowed */
    struct irb_points *points; /* static ones of point_settings; NULL where none are needed */
    struct irb_points_desc point_settings;
    struct irb_ism *ism; /* NULL without shadows */
    struct irb_interleave *interleave;
    struct irb_shade *shade;
};

void acrsm_lighting_destroy(struct acrsm_lighting *lighting); /* what it holds; zeroes it */

/* Before the stages of a frame: makes what is missing for images of width x height, n x m tiles. */
bool acrsm_lighting_prepare(struct acrsm_lighting *lighting, const struct irb_scene_gl *scene,
                            const struct acrsm_resolved *settings, int width, int height, int n,
                            int m, struct irb_error *err);

#endif
