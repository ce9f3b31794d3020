/* SPDX-License-Identifier: MIT */
#include "methods/acrsm/shadows.h"

void acrsm_lighting_destroy(struct acrsm_lighting *l)
{
    irb_points_destroy(l->points);
    irb_ism_destroy(l->ism);
    irb_interleave_destroy(l->interleave);
    irb_shade_destroy(l->shade);
    *l = (struct acrsm_lighting){.gl = l->gl};
}

static bool prepare_points(struct acrsm_lighting *l, const struct irb_scene_gl *scene,
                           const struct irb_points_desc *wanted, struct irb_error *err)
{
    const struct irb_points_desc *have = &l->point_settings;
    if (l->points && have->f_min == wanted->f_min && have->f_max == wanted->f_max &&
        have->smoothstep == wanted->smoothstep)
        return true;
    irb_points_destroy(l->points);
    l->point_settings = *wanted;
    l->points = irb_points_create(l->gl, scene, wanted, err);
    return l->points != NULL;
}

static bool prepare_interleave(struct acrsm_lighting *l, int width, int height, int n, int m,
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

bool acrsm_lighting_prepare(struct acrsm_lighting *l, const struct irb_scene_gl *scene,
                            const struct acrsm_resolved *settings, int width, int height, int n,
                            int m, struct irb_error *err)
{
    const bool shadows = acrsm_has_shadows(settings);
    return prepare_interleave(l, width, height, n, m, err) &&
           (l->shade || (l->shade = irb_shade_create(l->gl, err))) &&
           (!shadows || l->ism ||
            (l->ism = irb_ism_create(l->gl, ACRSM_MAP_SIZE, ACRSM_MAPS, err))) &&
           (!shadows || settings->dynamic_points ||
            prepare_points(l, scene, &settings->points, err));
}
