/* SPDX-License-Identifier: MIT */
#include "core/frame/light_gl.h"

#include <math.h>

/* KHR_lights_punctual divides by max(0.001, cos inner - cos outer). */
static const double smooth_min_width = 0.001;

void irb_light_uniforms(const struct irb_light *light, const struct irb_program *program)
{
    float right[3], up[3];
    double cos_outer = cos((double)light->outer);
    double width = fmax(smooth_min_width, cos((double)light->inner) - cos_outer);

    irb_light_basis(light, right, up);
    irb_program_int(program, "light_type", (int)light->type);
    irb_program_int(program, "light_falloff_kind", (int)light->falloff);
    irb_program_vec3(program, "light_position", light->position);
    irb_program_vec3(program, "light_direction", light->direction);
    irb_program_vec3(program, "light_right", right);
    irb_program_vec3(program, "light_up", up);
    irb_program_vec3(program, "light_intensity", light->intensity);
    irb_program_float(program, "light_cos_outer", (float)cos_outer);
    irb_program_float(program, "light_smooth_width", (float)width);
    irb_program_float(program, "light_half_width", light->half_width);
}
