/* SPDX-License-Identifier: MIT */
#include "core/frame/rsm.h"

#include "core/frame/light_gl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TARGETS = 4, SLIM_TARGETS = 3 };

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

/* Thesis table 5.1b. */
static bool create_slim_targets(struct irb_rsm *rsm, struct irb_error *err)
{
    if (!create_texture(rsm, &rsm->flux, "slim rsm: flux", GL_RGBA8, err) ||
        !create_texture(rsm, &rsm->specular, "slim rsm: specular", GL_RGBA8, err) ||
        !create_texture(rsm, &rsm->normal, "slim rsm: normal", GL_RG16, err) ||
        !create_texture(rsm, &rsm->depth, "slim rsm: depth", GL_DEPTH_COMPONENT32F, err))
        return false;
    struct irb_texture *const colour[SLIM_TARGETS] = {rsm->flux, rsm->specular, rsm->normal};
    rsm->framebuffer =
        irb_framebuffer_create(rsm->gl, "slim rsm", colour, SLIM_TARGETS, rsm->depth, err);
    return rsm->framebuffer != NULL;
}

struct irb_rsm *irb_rsm_create(struct irb_gl *gl, int resolution, struct irb_error *err)
{
    return irb_rsm_create_layout(gl, IRB_LAYOUT_FULL, resolution, err);
}

struct irb_rsm *irb_rsm_create_layout(struct irb_gl *gl, enum irb_layout layout, int resolution,
                                      struct irb_error *err)
{
    const bool slim = layout == IRB_LAYOUT_SLIM;
    struct irb_rsm *rsm = calloc(1, sizeof *rsm);
    if (!rsm) {
        irb_fail(err, IRB_E_MEMORY, "out of memory");
        return NULL;
    }
    rsm->gl = gl;
    rsm->resolution = resolution;
    rsm->layout = layout;
    if (irb_surface_program_create(&rsm->program, gl, slim ? "slim rsm" : "rsm",
                                   slim ? "frame/rsm_slim.frag" : "frame/rsm.frag", err) &&
        (slim ? create_slim_targets(rsm, err) : create_targets(rsm, err)))
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
    irb_surface_program_destroy(&rsm->program);
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
    rsm->directional = light->type == IRB_LIGHT_DIRECTIONAL;
    memcpy(rsm->light_position, light->position, sizeof rsm->light_position);
    memcpy(rsm->direction, light->direction, sizeof rsm->direction);
    memcpy(rsm->right, right, sizeof right);
    memcpy(rsm->up, up, sizeof up);
    memset(m, 0, sizeof rsm->view_projection);
    if (light->type == IRB_LIGHT_SPOT) {
        rsm->half_extent = (float)tan((double)light->outer);
        set_row(m, 3, light->direction, light->position, 1);
        m[14] = rsm->depth_range = (float)(near_share * (diagonal > 0 ? diagonal : 1));
    } else {
        rsm->half_extent = light->half_width;
        m[15] = 1;
        rsm->depth_range = (float)(end > 0 ? end * far_margin : 1);
        set_row(m, 2, light->direction, light->position, -1 / (double)rsm->depth_range);
        m[14] += 1;
    }
    set_row(m, 0, right, light->position, 1 / (double)rsm->half_extent);
    set_row(m, 1, up, light->position, 1 / (double)rsm->half_extent);
}

/* The texel at the image's centre is the one that gets most: the falloff and the solid angle,
 * at most the texel's area on the image plane, are largest on the axis. */
static void set_flux_scale(struct irb_rsm *rsm, const struct irb_light *light)
{
    const double side = 2.0 * rsm->half_extent / rsm->resolution;
    const double falloff = rsm->directional ? 1 : irb_light_falloff(light, 1);
    for (int i = 0; i < 3; i++)
        rsm->flux_scale[i] = (float)(light->intensity[i] * falloff * side * side);
}

static void clear(const struct irb_rsm *rsm)
{
    const struct irb_gl_api *api = &rsm->gl->api;
    static const float zero[4] = {0};
    const int targets = rsm->layout == IRB_LAYOUT_SLIM ? SLIM_TARGETS : TARGETS;

    api->Disable(GL_SCISSOR_TEST);
    api->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    api->DepthMask(GL_TRUE);
    for (int i = 0; i < targets; i++)
        api->ClearNamedFramebufferfv(rsm->framebuffer->id, GL_COLOR, i, zero);
    api->ClearNamedFramebufferfv(rsm->framebuffer->id, GL_DEPTH, 0, zero);
}

static void set_uniforms(const struct irb_rsm *rsm, const struct irb_light *light,
                         const struct irb_program *program)
{
    irb_light_uniforms(light, program);
    irb_program_int(program, "resolution", rsm->resolution);
    irb_program_float(program, "half_extent", rsm->half_extent);
    irb_program_vec3(program, "flux_scale", rsm->flux_scale);
    irb_program_mat4(program, "view_projection", rsm->view_projection);
}

bool irb_rsm_render(struct irb_rsm *rsm, const struct irb_scene_gl *scene,
                    const struct irb_light *light, struct irb_error *err)
{
    const struct irb_gl_api *api = &rsm->gl->api;

    if (!irb_surface_program_prepare(&rsm->program, scene, err))
        return false;
    set_view_projection(rsm, scene->scene, light);
    set_flux_scale(rsm, light);
    set_uniforms(rsm, light, rsm->program.opaque);
    if (rsm->program.masked)
        set_uniforms(rsm, light, rsm->program.masked);
    irb_framebuffer_bind(rsm->framebuffer);
    clear(rsm);
    api->ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    api->Enable(GL_DEPTH_TEST);
    api->DepthFunc(GL_GREATER);
    irb_scene_gl_draw(scene, &rsm->program);
    api->Disable(GL_DEPTH_TEST);
    api->DepthFunc(GL_LESS);
    api->ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    return irb_gl_check(rsm->gl, "rsm: draw", err);
}

int irb_rsm_texel_bytes(const struct irb_rsm *rsm)
{
    const struct irb_texture *const layers[] = {rsm->position, rsm->normal, rsm->flux,
                                                rsm->specular, rsm->depth};
    int64_t bytes = 0;
    for (size_t i = 0; i < sizeof layers / sizeof *layers; i++)
        bytes += layers[i] ? layers[i]->bytes : 0;
    return (int)(bytes / ((int64_t)rsm->resolution * rsm->resolution));
}

const char *irb_rsm_define(enum irb_layout layout)
{
    return layout == IRB_LAYOUT_SLIM ? "RSM_SLIM 1" : "RSM_SLIM 0";
}

float irb_rsm_largest_flux(const struct irb_rsm *rsm)
{
    return fmaxf(rsm->flux_scale[0], fmaxf(rsm->flux_scale[1], rsm->flux_scale[2]));
}

float irb_rsm_flux_unit(const struct irb_rsm *rsm)
{
    const float least = 1e-37f; /* W: below it the inverse is not a float */
    const float largest = irb_rsm_largest_flux(rsm);
    return largest > least ? 1 / largest : 1;
}

static void set_fetch_uniforms(const struct irb_rsm *rsm, const struct irb_program *program)
{
    const float spread[2] = {!rsm->directional, rsm->directional};
    const float range[2] = {rsm->directional ? 0 : rsm->depth_range,
                            rsm->directional ? rsm->depth_range : 0};
    irb_program_vec3(program, "rsm_light_position", rsm->light_position);
    irb_program_vec3(program, "rsm_light_right", rsm->right);
    irb_program_vec3(program, "rsm_light_up", rsm->up);
    irb_program_vec3(program, "rsm_light_direction", rsm->direction);
    irb_program_float(program, "rsm_half_extent", rsm->half_extent);
    irb_program_vec2(program, "rsm_spread", spread);
    irb_program_vec2(program, "rsm_depth_range", range);
    irb_program_vec3(program, "rsm_flux_scale", rsm->flux_scale);
}

int irb_rsm_bind(const struct irb_rsm *rsm, const struct irb_program *program, int first_unit)
{
    const bool slim = rsm->layout == IRB_LAYOUT_SLIM;
    const struct {
        const char *name;
        const struct irb_texture *texture;
    } layers[] = {
        {"rsm_flux", rsm->flux},
        {"rsm_normal", rsm->normal},
        {"rsm_specular", rsm->specular},
        {slim ? "rsm_depth" : "rsm_position", slim ? rsm->depth : rsm->position},
    };
    int unit = first_unit;
    for (size_t i = 0; i < sizeof layers / sizeof *layers; i++) {
        rsm->gl->api.BindTextureUnit((GLuint)unit, layers[i].texture->id);
        irb_program_int(program, layers[i].name, unit++);
    }
    set_fetch_uniforms(rsm, program);
    return unit;
}
