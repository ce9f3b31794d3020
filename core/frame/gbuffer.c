/* SPDX-License-Identifier: MIT */
#include "core/frame/gbuffer.h"

#include <stdlib.h>

enum { TARGETS = 5, SLIM_TARGETS = 3 };

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

/* Thesis table 5.1a. */
static bool create_slim_targets(struct irb_gbuffer *g, struct irb_error *err)
{
    if (!create_texture(g, &g->diffuse, "slim gbuffer: diffuse", GL_RGBA8, err) ||
        !create_texture(g, &g->specular, "slim gbuffer: specular", GL_RGBA8, err) ||
        !create_texture(g, &g->normal, "slim gbuffer: normal", GL_RG16, err) ||
        !create_texture(g, &g->depth, "slim gbuffer: depth", GL_DEPTH_COMPONENT32F, err))
        return false;
    struct irb_texture *const colour[SLIM_TARGETS] = {g->diffuse, g->specular, g->normal};
    g->framebuffer =
        irb_framebuffer_create(g->gl, "slim gbuffer", colour, SLIM_TARGETS, g->depth, err);
    return g->framebuffer != NULL;
}

struct irb_gbuffer *irb_gbuffer_create(struct irb_gl *gl, int width, int height,
                                       struct irb_error *err)
{
    return irb_gbuffer_create_layout(gl, IRB_LAYOUT_FULL, width, height, err);
}

struct irb_gbuffer *irb_gbuffer_create_layout(struct irb_gl *gl, enum irb_layout layout, int width,
                                              int height, struct irb_error *err)
{
    const bool slim = layout == IRB_LAYOUT_SLIM;
    struct irb_gbuffer *gbuffer = calloc(1, sizeof *gbuffer);
    if (!gbuffer) {
        irb_fail(err, IRB_E_MEMORY, "out of memory");
        return NULL;
    }
    gbuffer->gl = gl;
    gbuffer->width = width;
    gbuffer->height = height;
    gbuffer->layout = layout;
    if (irb_surface_program_create(&gbuffer->program, gl, slim ? "slim gbuffer" : "gbuffer",
                                   slim ? "frame/gbuffer_slim.frag" : "frame/gbuffer.frag", err) &&
        (slim ? create_slim_targets(gbuffer, err) : create_targets(gbuffer, err)))
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
    irb_surface_program_destroy(&gbuffer->program);
    free(gbuffer);
}

/* What the slim layout is decoded with. */
static void keep_camera(struct irb_gbuffer *gbuffer, const struct irb_camera *camera,
                        const float view[16], const float projection[16])
{
    for (int i = 0; i < 3; i++) {
        gbuffer->camera_position[i] = camera->position[i];
        gbuffer->right[i] = view[4 * i];
        gbuffer->up[i] = view[4 * i + 1];
        gbuffer->back[i] = view[4 * i + 2];
    }
    gbuffer->tangent[0] = 1 / projection[0];
    gbuffer->tangent[1] = 1 / projection[5];
    gbuffer->z_near = camera->z_near;
    gbuffer->z_far = camera->z_far;
}

/* Turns the projection's depth round, from -1..1 to 1..0: near (far - d)/(d (far - near)) at the
 * depth d. As a float is finest near 0, its steps are then about 1e-7 d throughout, where those of
 * the usual depth grow with d^2: at 20 m, with z_near at 5 mm, two surfaces 5 mm apart would be
 * one, and the G-buffer would hold points that the eye does not see. The slim layout keeps the
 * depth that it is decoded from (thesis 5.1.1). */
static void reverse_depth(const struct irb_camera *camera, float projection[16])
{
    double near = camera->z_near, far = camera->z_far;

    projection[10] = (float)(near / (far - near));
    projection[14] = (float)(near * far / (far - near));
}

static void clear(const struct irb_gbuffer *gbuffer)
{
    const struct irb_gl_api *api = &gbuffer->gl->api;
    static const float zero[4] = {0};
    const float farthest = gbuffer->layout == IRB_LAYOUT_SLIM ? 1 : 0;
    const int targets = gbuffer->layout == IRB_LAYOUT_SLIM ? SLIM_TARGETS : TARGETS;

    api->Disable(GL_SCISSOR_TEST);
    api->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    api->DepthMask(GL_TRUE);
    for (int i = 0; i < targets; i++)
        api->ClearNamedFramebufferfv(gbuffer->framebuffer->id, GL_COLOR, i, zero);
    api->ClearNamedFramebufferfv(gbuffer->framebuffer->id, GL_DEPTH, 0, &farthest);
}

static void set_uniforms(const struct irb_gbuffer *gbuffer, const float view_projection[16],
                         const struct irb_program *program)
{
    irb_program_mat4(program, "view_projection", view_projection);
    irb_program_vec3(program, "camera_position", gbuffer->camera_position);
    irb_program_vec3(program, "view_right", gbuffer->right);
    irb_program_vec3(program, "view_up", gbuffer->up);
    irb_program_vec3(program, "view_back", gbuffer->back);
}

bool irb_gbuffer_render(struct irb_gbuffer *gbuffer, const struct irb_scene_gl *scene,
                        const struct irb_camera *camera, struct irb_error *err)
{
    const struct irb_gl_api *api = &gbuffer->gl->api;
    const bool reversed = gbuffer->layout != IRB_LAYOUT_SLIM;
    float view[16], projection[16], view_projection[16];

    if (!irb_surface_program_prepare(&gbuffer->program, scene, err))
        return false;
    irb_camera_matrices(camera, (float)gbuffer->width / (float)gbuffer->height, view, projection);
    if (reversed)
        reverse_depth(camera, projection);
    irb_matrix_product(projection, view, view_projection);
    keep_camera(gbuffer, camera, view, projection);
    set_uniforms(gbuffer, view_projection, gbuffer->program.opaque);
    if (gbuffer->program.masked)
        set_uniforms(gbuffer, view_projection, gbuffer->program.masked);
    irb_framebuffer_bind(gbuffer->framebuffer);
    clear(gbuffer);
    if (reversed)
        api->ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    api->Enable(GL_DEPTH_TEST);
    api->DepthFunc(reversed ? GL_GREATER : GL_LESS);
    irb_scene_gl_draw(scene, &gbuffer->program);
    api->Disable(GL_DEPTH_TEST);
    api->DepthFunc(GL_LESS);
    api->ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    return irb_gl_check(gbuffer->gl, "gbuffer: draw", err);
}

int irb_gbuffer_pixel_bytes(const struct irb_gbuffer *gbuffer)
{
    const struct irb_texture *const layers[] = {gbuffer->position,  gbuffer->normal,
                                                gbuffer->geometric, gbuffer->diffuse,
                                                gbuffer->specular,  gbuffer->depth};
    int64_t bytes = 0;
    for (size_t i = 0; i < sizeof layers / sizeof *layers; i++)
        bytes += layers[i] ? layers[i]->bytes : 0;
    return (int)(bytes / ((int64_t)gbuffer->width * gbuffer->height));
}

const char *irb_gbuffer_define(enum irb_layout layout)
{
    return layout == IRB_LAYOUT_SLIM ? "GBUFFER_SLIM 1" : "GBUFFER_SLIM 0";
}

int irb_gbuffer_bind(const struct irb_gbuffer *gbuffer, const struct irb_program *program,
                     int first_unit)
{
    const bool slim = gbuffer->layout == IRB_LAYOUT_SLIM;
    const struct {
        const char *name;
        const struct irb_texture *texture;
    } layers[] = {
        {"gbuffer_normal", gbuffer->normal},     {"gbuffer_diffuse", gbuffer->diffuse},
        {"gbuffer_specular", gbuffer->specular}, {"gbuffer_depth", slim ? gbuffer->depth : NULL},
        {"gbuffer_position", gbuffer->position}, {"gbuffer_geometric", gbuffer->geometric},
    };
    int unit = first_unit;
    for (size_t i = 0; i < sizeof layers / sizeof *layers; i++)
        if (layers[i].texture) {
            gbuffer->gl->api.BindTextureUnit((GLuint)unit, layers[i].texture->id);
            irb_program_int(program, layers[i].name, unit++);
        }
    irb_program_vec3(program, "gbuffer_camera", gbuffer->camera_position);
    irb_program_vec3(program, "gbuffer_right", gbuffer->right);
    irb_program_vec3(program, "gbuffer_up", gbuffer->up);
    irb_program_vec3(program, "gbuffer_back", gbuffer->back);
    irb_program_vec2(program, "gbuffer_tangent", gbuffer->tangent);
    irb_program_vec2(program, "gbuffer_near_far", (const float[]){gbuffer->z_near, gbuffer->z_far});
    return unit;
}

bool irb_gbuffer_read(const struct irb_gbuffer *gbuffer, struct irb_gbuffer_image *out,
                      struct irb_error *err)
{
    *out = (struct irb_gbuffer_image){.width = gbuffer->width, .height = gbuffer->height};
    if (gbuffer->layout != IRB_LAYOUT_FULL)
        return irb_fail(err, IRB_E_INTERNAL, "G-buffer: only the full layout is read back");
    if (irb_texture_read(gbuffer->position, 4, &out->position, err) &&
        irb_texture_read(gbuffer->normal, 4, &out->normal, err) &&
        irb_texture_read(gbuffer->geometric, 3, &out->geometric, err) &&
        irb_texture_read(gbuffer->diffuse, 3, &out->diffuse, err) &&
        irb_texture_read(gbuffer->specular, 4, &out->specular, err))
        return true;
    irb_gbuffer_image_destroy(out);
    return false;
}
