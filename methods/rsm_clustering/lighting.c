/* SPDX-License-Identifier: MIT */
#include "methods/rsm_clustering/lighting.h"

void rsc_lighting_init(struct rsc_lighting *l, struct irb_gl *gl)
{
    *l = (struct rsc_lighting){.ism.gl = gl};
    irb_val_lighting_init(&l->val_lighting, gl);
}

void rsc_lighting_destroy(struct rsc_lighting *l)
{
    irb_ism_lighting_destroy(&l->ism);
    irb_vals_destroy(l->vals);
    irb_val_lighting_destroy(&l->val_lighting);
    rsc_lighting_init(l, l->ism.gl);
}

static bool prepare_clustered(struct rsc_lighting *l, const struct rsc_resolved *settings,
                              int width, int height, struct irb_error *err)
{
    struct irb_ism_lighting *ism = &l->ism;
    return irb_interleave_prepare(&ism->interleave, ism->gl, width, height, settings->interleave_n,
                                  settings->interleave_m, err) &&
           (l->vals || (l->vals = irb_vals_create(ism->gl, err))) &&
           irb_val_lighting_prepare(&l->val_lighting, ism->interleave, &settings->val_lighting,
                                    settings->vals.vals, err);
}

bool rsc_lighting_prepare(struct rsc_lighting *l, const struct irb_scene_gl *scene,
                          const struct rsc_resolved *settings, int width, int height,
                          struct irb_error *err)
{
    if (settings->is_clustered)
        return prepare_clustered(l, settings, width, height, err);
    const bool shadows = rsc_has_ism(settings);
    const struct irb_ism_lighting_desc desc = {
        .width = width,
        .height = height,
        .n = settings->interleave_n,
        .m = settings->interleave_m,
        .map_size = RSC_MAP_SIZE,
        .maps = shadows ? IRB_VPL_BLOCK : 0,
        .points = shadows ? &settings->points : NULL,
    };
    return irb_ism_lighting_prepare(&l->ism, scene, &desc, err);
}
