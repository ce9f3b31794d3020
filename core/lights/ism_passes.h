/* SPDX-License-Identifier: MIT
 *
 * What ism.c, ism_splat.c and ism_pull_push.c share. Private to core/lights.
 */
#ifndef IRB_LIGHTS_ISM_PASSES_H
#define IRB_LIGHTS_ISM_PASSES_H

#include "core/lights/ism.h"
#include "core/lights/tessellation.h"
#include "core/lights/world_triangles.h"

/* Bits of +Inf: a texel without a distance. EMPTY of shaders/lights/ism_empty.glsl. */
#define IRB_ISM_EMPTY 0x7f800000u

enum { IRB_ISM_PULLS = 2, IRB_ISM_SPLATTERS = 3 };

struct irb_ism_passes {
    struct irb_world_triangles *triangles;
    struct irb_buffer *lights; /* one block: a copy of those of the last splat */
    struct irb_program *splat[IRB_ISM_SPLATTERS];
    int most_maps[IRB_ISM_SPLATTERS]; /* of a point, that the program was made for */
    /* RASTER and TESSELLATION */
    struct irb_texture *depth;
    struct irb_framebuffer *target;
    /* TESSELLATION */
    const struct irb_scene *measured; /* scene that `range` is of */
    struct irb_tessellation_range range;
    double measured_points; /* that the tessellator makes with these factors: */
    float measured_f[2];
    int measured_order;
    /* pull-push */
    struct irb_program *pull[IRB_ISM_PULLS], *push[IRB_ISM_PULLS];
    struct irb_texture *pyramid; /* level k has half the atlas's size k + 1 times */
    /* coverage */
    struct irb_program *coverage;
    struct irb_buffer *filled; /* texels of each map */
};

/* Rows of maps that `count` maps take up. */
static inline int irb_ism_rows(const struct irb_ism *ism, int count)
{
    return (count + ism->maps_a_row - 1) / ism->maps_a_row;
}

/* Empties the first `rows` rows of maps. */
void irb_ism_clear(struct irb_ism *ism, int rows);

void irb_ism_destroy_splat(struct irb_ism_passes *passes);
void irb_ism_destroy_pull_push(struct irb_ism_passes *passes);

#endif
