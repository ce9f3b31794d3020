/* SPDX-License-Identifier: MIT */
#include "core/frame/rsm.h"

#include "core/frame/light_gl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TARGETS = 4 };

/* Near plane of a spot light's image as a share of the scene's diagonal: far below anything
 * modelled, and harmless to precision, since the depth is reversed floating point. Source: ours. */
static const double near_share = 1e-5;
/* The far plane of a beam lies this much behind the scene's bounds. Source: ours. */
static const double far_margin = 1.001;

static bool create_texture(struct irb_rsm *rsm, struct irb_texture **out, const char *name,
                           unsigned format, struct irb_error *err)
{
    *out = irb_texture_create(
        rsm->gl,
        &(struct irb_texture_desc){
            .name = name, .format = format, .width = rsm->resolution, .height = rsm->resolution},
        err);
    return *out != NULL;
}

static bool create_targets(struct irb_rsm *rsm, struct irb_error *err)
{
    if (!create_texture(rsm, &rsm->position, "rsm: position", GL_RGBA32F, err) ||
        !create_texture(rsm, &rsm->normal, "rsm: normal", GL_RGBA32F, err) ||
        !create_texture(rsm, &rsm->flux, "rsm: flux", GL_RGBA32F, err) ||
        !create_texture(rsm, &rsm->specular, "rsm: specular", GL_RGBA32F, err) ||
        !create_texture(rsm, &rsm->depth, "rsm: depth", GL_DEPTH_COMPONENT32F, err))
        return false;
    struct irb_texture *const colour[TARGETS] = {rsm->position, rsm->normal, rsm->flux,
                                                 rsm->specular};
    rsm->framebuffer = irb_framebuffer_create(rsm->gl, "rsm", colour, TARGETS, rsm->depth, err);
    return rsm->framebuffer != NULL;
}

struct irb_rsm *irb_rsm_create(struct irb_gl *gl, int resolution, struct irb_error *err)
{
    struct irb_rsm *rsm = calloc(1, sizeof *rsm);
    if (!rsm) {
        irb_fail(err, IRB_E_MEMORY, "out of memory");
        return NULL;
    }
    rsm->gl = gl;
    rsm->resolution = resolution;
    rsm->program = irb_program_create(gl,
                                      &(struct irb_program_desc){.name = "rsm",
                                                                 .vertex = "frame/geometry.vert",
                                                                 .fragment = "frame/rsm.frag"},
                                      err);
    if (rsm->program && create_targets(rsm, err))
        return rsm;
    irb_rsm_destroy(rsm);
    return NULL;
}

void irb_rsm_destroy(struct irb_rsm *rsm)
{
    if (!rsm)
        return;
    irb_framebuffer_destroy(rsm->framebuffer);
    irb_texture_destroy(rsm->position);
    irb_texture_destroy(rsm->normal);
    irb_texture_destroy(rsm->flux);
    irb_texture_destroy(rsm->specular);
    irb_texture_destroy(rsm->depth);
    irb_program_destroy(rsm->program);
    free(rsm);
}

/* Diagonal of the bounds, and how far along the light's direction from its position they end. */
static void measure_bounds(const struct irb_scene *scene, const struct irb_light *light,
                           double *diagonal, double *end)
{
    float low[3], high[3];
    double squares = 0, farthest = 0;

    irb_scene_current_bounds(scene, low, high);
    for (int i = 0; i < 3; i++) {
        double extent = (double)high[i] - low[i];
        double corner = light->direction[i] > 0 ? high[i] : low[i];
        squares += extent * extent;
        farthest += light->direction[i] * (corner - light->position[i]);
    }
    *diagonal = sqrt(squares);
    *end = farthest;
}

/* Row `row` of the matrix = scale * (axis . (x - position)) in clip space. */
static void set_row(float matrix[16], int row, const float axis[3], const float position[3],
                    double scale)
{
    double offset = 0;
    for (int i = 0; i < 3; i++) {
        matrix[4 * i + row] = (float)(scale * axis[i]);
        offset += (double)axis[i] * position[i];
    }
    matrix[12 + row] = (float)(-scale * offset);
}

/* Reversed depth in [0,1]: near/z without a far end for the spot, 1 - z/end for the beam. */
static void set_view_projection(struct irb_rsm *rsm, const struct irb_scene *scene,
                                const struct irb_light *light)
{
    float right[3], up[3], *m = rsm->view_projection;
    double diagonal, end;

    measure_bounds(scene, light, &diagonal, &end);
    irb_light_basis(light, right, up);
    memset(m, 0, sizeof rsm->view_projection);
    if (light->type == IRB_LIGHT_SPOT) {
        rsm->half_extent = (float)tan((double)light->outer);
        set_row(m, 3, light->direction, light->position, 1);
        m[14] = (float)(near_share * (diagonal > 0 ? diagonal : 1));
    } else {
        rsm->half_extent = light->half_width;
        m[15] = 1;
        set_row(m, 2, light->direction, light->position, -1 / (end > 0 ? end * far_margin : 1));
        m[14] += 1;
    }
    set_row(m, 0, right, light->position, 1 / (double)rsm->half_extent);
    set_row(m, 1, up, light->position, 1 / (double)rsm->half_extent);
}

bool irb_rsm_render(struct irb_rsm *rsm, const struct irb_scene_gl *scene,
                    const struct irb_light *light, struct irb_error *err)
{
    const struct irb_gl_api *api = &rsm->gl->api;
    static const float zero[4] = {0};

    set_view_projection(rsm, scene->scene, light);
    irb_framebuffer_bind(rsm->framebuffer);
    api->Disable(GL_SCISSOR_TEST);
    api->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    api->DepthMask(GL_TRUE);
    for (int i = 0; i < TARGETS; i++)
        api->ClearNamedFramebufferfv(rsm->framebuffer->id, GL_COLOR, i, zero);
    api->ClearNamedFramebufferfv(rsm->framebuffer->id, GL_DEPTH, 0, zero);
    api->ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    api->Enable(GL_DEPTH_TEST);
    api->DepthFunc(GL_GREATER);
    irb_light_uniforms(light, rsm->program);
    irb_program_int(rsm->program, "resolution", rsm->resolution);
    irb_program_float(rsm->program, "half_extent", rsm->half_extent);
    irb_program_mat4(rsm->program, "view_projection", rsm->view_projection);
    irb_scene_gl_draw(scene, rsm->program);
    api->Disable(GL_DEPTH_TEST);
    api->DepthFunc(GL_LESS);
    api->ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    return irb_gl_check(rsm->gl, "rsm: draw", err);
}
