/* SPDX-License-Identifier: MIT */
#include "core/lights/ism_lighting.h"

bool irb_ism_lighting_prepare(struct irb_ism_lighting *l, const struct irb_scene_gl *scene,
                              const struct irb_ism_lighting_desc *d, struct irb_error *err)
{
    return irb_interleave_prepare(&l->interleave, l->gl, d->width, d->height, d->n, d->m, err) &&
           (l->shade || (l->shade = irb_shade_create(l->gl, err))) &&
           (!d->maps || irb_ism_prepare(&l->maps, l->gl, d->map_size, d->maps, err)) &&
           (!d->points || irb_points_prepare(&l->points, l->gl, scene, d->points, err));
}

void irb_ism_lighting_destroy(struct irb_ism_lighting *l)
{
    irb_points_destroy(l->points);
    irb_ism_destroy(l->maps);
    irb_interleave_destroy(l->interleave);
    irb_shade_destroy(l->shade);
    *l = (struct irb_ism_lighting){.gl = l->gl};
}
