/* SPDX-License-Identifier: MIT */
#include "core/reference/light_source.h"
#include "core/reference/surface.h"

/* The least cos(inner) - cos(outer) of SMOOTH, as KHR_lights_punctual has it. */
static const double smooth_min_width = 0.001;

void light_source_prepare(struct light_source *out, const struct irb_light *light,
                          float scene_offset)
{
    float right[3], up[3];
    irb_light_basis(light, right, up);
    double outer = light->outer, cos_outer = cos(outer), half = sin(0.5 * outer);
    double inner_range = cos(light->inner) - cos_outer;
    *out = (struct light_source){
        .type = light->type,
        .falloff = light->falloff,
        .position = v3_load(light->position),
        .direction = v3_load(light->direction),
        .right = v3_load(right),
        .up = v3_load(up),
        .intensity = v3_load(light->intensity),
        .cos_outer = (float)cos_outer,
        .versine = (float)(2 * half * half),
        .half_width = light->half_width,
    };
    if (light->falloff == IRB_FALLOFF_SMOOTH)
        out->falloff_scale = (float)(1 / fmax(inner_range, smooth_min_width));
    if (light->falloff == IRB_FALLOFF_COSINE)
        out->falloff_scale = (float)(1 / cos_outer); /* outer is below pi/2 */
    double size = light->type == IRB_LIGHT_SPOT ? 2 * 3.14159265358979323846 * (2 * half * half)
                                                : 4 * (double)light->half_width * light->half_width;
    out->density = (float)(1 / size);
    out->dark = !isfinite(out->density) || !(out->density > 0) || !(v3_max(out->intensity) > 0);
    out->offset = SURFACE_OFFSET * v3_max_abs(out->position) + scene_offset;
}
