/* SPDX-License-Identifier: MIT */
#include "core/frame/gbuffer.h"

#include <stdlib.h>

enum { TARGETS = 5 };

static bool create_texture(struct irb_gbuffer *gbuffer, struct irb_texture **out, const char *name,
                           unsigned format, struct irb_error *err)
{
    *out = irb_texture_create(
        gbuffer->gl,
        &(struct irb_texture_desc){
            .name = name, .format = format, .width = gbuffer->width, .height = gbuffer->height},
        err);
    return *out != NULL;
}

static bool create_targets(struct irb_gbuffer *g, struct irb_error *err)
{
    if (!create_texture(g, &g->position, "gbuffer: position", GL_RGBA32F, err) ||
        !create_texture(g, &g->normal, "gbuffer: normal", GL_RGBA32F, err) ||
        !create_texture(g, &g->geometric, "gbuffer: geometric normal", GL_RGBA32F, err) ||
        !create_texture(g, &g->diffuse, "gbuffer: diffuse", GL_RGBA32F, err) ||
        !create_texture(g, &g->specular, "gbuffer: specular", GL_RGBA32F, err) ||
        !create_texture(g, &g->depth, "gbuffer: depth", GL_DEPTH_COMPONENT32F, err))
        return false;
    struct irb_texture *const colour[TARGETS] = {g->position, g->normal, g->geometric, g->diffuse,
                                                 g->specular};
    g->framebuffer = irb_framebuffer_create(g->gl, "gbuffer", colour, TARGETS, g->depth, err);
    return g->framebuffer != NULL;
}

struct irb_gbuffer *irb_gbuffer_create(struct irb_gl *gl, int width, int height,
                                       struct irb_error *err)
{
    struct irb_gbuffer *gbuffer = calloc(1, sizeof *gbuffer);
    if (!gbuffer) {
        irb_fail(err, IRB_E_MEMORY, "out of memory");
        return NULL;
    }
    gbuffer->gl = gl;
    gbuffer->width = width;
    gbuffer->height = height;
    gbuffer->program = irb_program_create(
        gl,
        &(struct irb_program_desc){
            .name = "gbuffer", .vertex = "frame/geometry.vert", .fragment = "frame/gbuffer.frag"},
        err);
    if (gbuffer->program && create_targets(gbuffer, err))
        return gbuffer;
    irb_gbuffer_destroy(gbuffer);
    return NULL;
}

void irb_gbuffer_destroy(struct irb_gbuffer *gbuffer)
{
    if (!gbuffer)
        return;
    irb_framebuffer_destroy(gbuffer->framebuffer);
    irb_texture_destroy(gbuffer->position);
    irb_texture_destroy(gbuffer->normal);
    irb_texture_destroy(gbuffer->geometric);
    irb_texture_destroy(gbuffer->diffuse);
    irb_texture_destroy(gbuffer->specular);
    irb_texture_destroy(gbuffer->depth);
    irb_program_destroy(gbuffer->program);
    free(gbuffer);
}

/* projection * view, rounded once */
static void multiply(const float a[16], const float b[16], float out[16])
{
    for (int c = 0; c < 4; c++)
        for (int r = 0; r < 4; r++) {
            double sum = 0;
            for (int k = 0; k < 4; k++)
                sum += (double)a[4 * k + r] * b[4 * c + k];
            out[4 * c + r] = (float)sum;
        }
}

bool irb_gbuffer_render(struct irb_gbuffer *gbuffer, const struct irb_scene_gl *scene,
                        const struct irb_camera *camera, struct irb_error *err)
{
    const struct irb_gl_api *api = &gbuffer->gl->api;
    static const float zero[4] = {0}, farthest = 1;
    float view[16], projection[16], view_projection[16];

    irb_camera_matrices(camera, (float)gbuffer->width / (float)gbuffer->height, view, projection);
    multiply(projection, view, view_projection);
    irb_framebuffer_bind(gbuffer->framebuffer);
    api->Disable(GL_SCISSOR_TEST);
    api->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    api->DepthMask(GL_TRUE);
    for (int i = 0; i < TARGETS; i++)
        api->ClearNamedFramebufferfv(gbuffer->framebuffer->id, GL_COLOR, i, zero);
    api->ClearNamedFramebufferfv(gbuffer->framebuffer->id, GL_DEPTH, 0, &farthest);
    api->Enable(GL_DEPTH_TEST);
    api->DepthFunc(GL_LESS);
    irb_program_mat4(gbuffer->program, "view_projection", view_projection);
    irb_program_vec3(gbuffer->program, "camera_position", camera->position);
    irb_scene_gl_draw(scene, gbuffer->program);
    api->Disable(GL_DEPTH_TEST);
    return irb_gl_check(gbuffer->gl, "gbuffer: draw", err);
}

bool irb_gbuffer_read(const struct irb_gbuffer *gbuffer, struct irb_gbuffer_image *out,
                      struct irb_error *err)
{
    *out = (struct irb_gbuffer_image){.width = gbuffer->width, .height = gbuffer->height};
    if (irb_texture_read(gbuffer->position, 4, &out->position, err) &&
        irb_texture_read(gbuffer->normal, 4, &out->normal, err) &&
        irb_texture_read(gbuffer->geometric, 3, &out->geometric, err) &&
        irb_texture_read(gbuffer->diffuse, 3, &out->diffuse, err) &&
        irb_texture_read(gbuffer->specular, 4, &out->specular, err))
        return true;
    irb_gbuffer_image_destroy(out);
    return false;
}
