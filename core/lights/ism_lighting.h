/* SPDX-License-Identifier: MIT
 *
 * What an image is lit with by virtual lights of which each has an imperfect shadow map, or none:
 * the split G-buffer and its shading, the maps, the points that are splatted into them. Everything
 * is made when a frame first needs it, and anew when a parameter asks for another one.
 */
#ifndef IRB_LIGHTS_ISM_LIGHTING_H
#define IRB_LIGHTS_ISM_LIGHTING_H

#include "core/frame/interleave.h"
#include "core/lights/ism.h"
#include "core/lights/shade.h"

struct irb_ism_lighting {
    struct irb_gl *gl; /* borrowed */
    struct irb_interleave *interleave;
    struct irb_shade *shade;
    struct irb_ism *maps;      /* NULL until there are to be some */
    struct irb_points *points; /* likewise */
};

struct irb_ism_lighting_desc {
    int width, height;                    /* of the image */
    int n, m;                             /* tiles across, up */
    int map_size, maps;                   /* texels a side; at least so many, 0: none are needed */
    const struct irb_points_desc *points; /* NULL: none are needed */
};

/* Before the stages of a frame: makes what is missing. What isn't needed stays as it is. */
bool irb_ism_lighting_prepare(struct irb_ism_lighting *lighting, const struct irb_scene_gl *scene,
                              const struct irb_ism_lighting_desc *desc, struct irb_error *err);
void irb_ism_lighting_destroy(struct irb_ism_lighting *lighting); /* what it holds; only gl stays */

#endif
