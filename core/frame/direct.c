/* SPDX-License-Identifier: MIT */
#include "core/frame/direct.h"

#include "core/frame/light_gl.h"

#include <stdlib.h>

struct irb_direct *irb_direct_create(struct irb_gl *gl, int width, int height,
                                     struct irb_error *err)
{
    struct irb_direct *direct = calloc(1, sizeof *direct);
    if (!direct) {
        irb_fail(err, IRB_E_MEMORY, "out of memory");
        return NULL;
    }
    direct->gl = gl;
    direct->program =
        irb_program_create(gl,
                           &(struct irb_program_desc){.name = "direct light",
                                                      .vertex = "gl/fullscreen.vert",
                                                      .fragment = "frame/direct.frag"},
                           err);
    if (direct->program)
        direct->radiance = irb_texture_create(
            gl,
            &(struct irb_texture_desc){
                .name = "direct: radiance", .format = GL_RGBA32F, .width = width, .height = height},
            err);
    if (direct->radiance)
        direct->framebuffer = irb_framebuffer_create(gl, "direct", &direct->radiance, 1, NULL, err);
    if (direct->framebuffer)
        return direct;
    irb_direct_destroy(direct);
    return NULL;
}

void irb_direct_destroy(struct irb_direct *direct)
{
    if (!direct)
        return;
    irb_framebuffer_destroy(direct->framebuffer);
    irb_texture_destroy(direct->radiance);
    irb_program_destroy(direct->program);
    free(direct);
}

static void bind_textures(const struct irb_direct *direct, const struct irb_gbuffer *gbuffer,
                          const struct irb_rsm *rsm)
{
    const struct {
        const char *name;
        const struct irb_texture *texture;
    } inputs[] = {
        {"gbuffer_position", gbuffer->position},   {"gbuffer_normal", gbuffer->normal},
        {"gbuffer_geometric", gbuffer->geometric}, {"gbuffer_diffuse", gbuffer->diffuse},
        {"gbuffer_specular", gbuffer->specular},   {"rsm_normal", rsm->normal},
    };
    for (unsigned i = 0; i < sizeof inputs / sizeof *inputs; i++) {
        direct->gl->api.BindTextureUnit(i, inputs[i].texture->id);
        irb_program_int(direct->program, inputs[i].name, (int)i);
    }
}

bool irb_direct_render(struct irb_direct *direct, const struct irb_gbuffer *gbuffer,
                       const struct irb_rsm *rsm, const struct irb_light *light,
                       const struct irb_camera *camera, struct irb_error *err)
{
    if (gbuffer->width != direct->framebuffer->width ||
        gbuffer->height != direct->framebuffer->height)
        return irb_fail(err, IRB_E_INTERNAL, "direct light: G-buffer of %dx%d, expected %dx%d",
                        gbuffer->width, gbuffer->height, direct->framebuffer->width,
                        direct->framebuffer->height);
    bind_textures(direct, gbuffer, rsm);
    irb_light_uniforms(light, direct->program);
    irb_program_vec3(direct->program, "camera_position", camera->position);
    irb_program_mat4(direct->program, "rsm_view_projection", rsm->view_projection);
    irb_program_float(direct->program, "rsm_half_extent", rsm->half_extent);
    irb_framebuffer_bind(direct->framebuffer);
    irb_program_use(direct->program);
    irb_gl_draw_fullscreen(direct->gl);
    return irb_gl_check(direct->gl, "direct: draw", err);
}
