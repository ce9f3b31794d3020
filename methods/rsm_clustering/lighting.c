/* SPDX-License-Identifier: MIT */
#include "methods/rsm_clustering/lighting.h"

void rsc_lighting_init(struct rsc_lighting *l, struct irb_gl *gl)
{
    *l = (struct rsc_lighting){.gl = gl};
    irb_val_lighting_init(&l->val_lighting, gl);
}

void rsc_lighting_destroy(struct rsc_lighting *l)
{
    irb_points_destroy(l->points);
    irb_ism_destroy(l->ism);
    irb_interleave_destroy(l->interleave);
    irb_shade_destroy(l->shade);
    irb_vals_destroy(l->vals);
    irb_val_lighting_destroy(&l->val_lighting);
    rsc_lighting_init(l, l->gl);
}

static bool prepare_interleave(struct rsc_lighting *l, int width, int height, int n, int m,
                               struct irb_error *err)
{
    const struct irb_interleave *have = l->interleave;
    const int columns = n < width ? n : width, rows = m < height ? m : height;
    if (have && have->width == width && have->height == height && have->n == columns &&
        have->m == rows)
        return true;
    irb_interleave_destroy(l->interleave);
    l->interleave = irb_interleave_create(l->gl, width, height, n, m, err);
    return l->interleave != NULL;
}

static bool prepare_points(struct rsc_lighting *l, const struct irb_scene_gl *scene,
                           const struct irb_points_desc *wanted, struct irb_error *err)
{
    const struct irb_points_desc *have = &l->point_settings;
    if (l->points && have->count == wanted->count && have->seed == wanted->seed)
        return true;
    irb_points_destroy(l->points);
    l->point_settings = *wanted;
    l->points = irb_points_create(l->gl, scene, wanted, err);
    return l->points != NULL;
}

bool rsc_lighting_prepare(struct rsc_lighting *l, const struct irb_scene_gl *scene,
                          const struct rsc_resolved *settings, int width, int height,
                          struct irb_error *err)
{
    if (!prepare_interleave(l, width, height, settings->interleave_n, settings->interleave_m, err))
        return false;
    if (settings->is_clustered)
        return (l->vals || (l->vals = irb_vals_create(l->gl, err))) &&
               irb_val_lighting_prepare(&l->val_lighting, l->interleave, &settings->val_lighting,
                                        settings->vals.vals, err);
    return (l->shade || (l->shade = irb_shade_create(l->gl, err))) &&
           (!rsc_has_ism(settings) ||
            ((l->ism || (l->ism = irb_ism_create(l->gl, RSC_MAP_SIZE, IRB_VPL_BLOCK, err))) &&
             prepare_points(l, scene, &settings->points, err)));
}
