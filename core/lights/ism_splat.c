/* SPDX-License-Identifier: MIT */
#include "core/lights/ism.h"

#include "core/lights/ism_passes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Work group size of shaders/lights/ism_atomic.comp, and points of one light that an invocation
 * takes. */
enum { GROUP = 64, POINTS_AN_INVOCATION = 32, MOST_ABREAST = 8 };
enum { TRIANGLES_UNIT = 0, POINTS_UNIT = 1, LIGHTS_BINDING = 0, MOST_FACTOR = 64 };

void irb_ism_destroy_splat(struct irb_ism_passes *passes)
{
    for (int i = 0; i < IRB_ISM_SPLATTERS; i++)
        irb_program_destroy(passes->splat[i]);
    irb_framebuffer_destroy(passes->target);
    irb_texture_destroy(passes->depth);
}

/* ---- Settings ---- */

static bool check_numbers(const struct irb_ism_settings *s, struct irb_error *err)
{
    if (!(s->splat_factor > 0) || !(s->splat_factor <= MOST_FACTOR))
        return irb_fail(err, IRB_E_INPUT,
                        "ism: expected a splat factor above 0, at most %d, found %g", MOST_FACTOR,
                        (double)s->splat_factor);
    if (!(s->splat_scale > 0) || !isfinite(s->splat_scale) || s->splat_most < 1)
        return irb_fail(err, IRB_E_INPUT,
                        "ism: expected a splat scale above 0 and splats of at least 1 texel, found "
                        "%g and %d",
                        (double)s->splat_scale, s->splat_most);
    if (s->splat_size < IRB_ISM_SIZE_EVEN || s->splat_size > IRB_ISM_SIZE_SURFACE)
        return irb_fail(err, IRB_E_INTERNAL, "ism: splat size %d", s->splat_size);
    if (!(s->near >= 0) || !isfinite(s->near) || !(s->near_radii >= 0) || !isfinite(s->near_radii))
        return irb_fail(err, IRB_E_INPUT, "ism: expected near cuts of at least 0, found %g and %g",
                        (double)s->near, (double)s->near_radii);
    return true;
}

static bool check(const struct irb_ism *ism, const struct irb_points *points,
                  const struct irb_virtual_lights *lights, const struct irb_ism_settings *s,
                  struct irb_error *err)
{
    GLint most_level = 0;
    GLfloat sizes[2] = {1, 1};
    ism->gl->api.GetIntegerv(GL_MAX_TESS_GEN_LEVEL, &most_level);
    ism->gl->api.GetFloatv(GL_POINT_SIZE_RANGE, sizes);
    if (s->splatter < 0 || s->splatter >= IRB_ISM_SPLATTERS ||
        (s->splatter != IRB_ISM_TESSELLATION && !points))
        return irb_fail(err, IRB_E_INTERNAL, "ism: splatter %d %s points", s->splatter,
                        points ? "with" : "without");
    if (lights->count < 0 || lights->count > ism->capacity)
        return irb_fail(err, IRB_E_INPUT, "ism: %d lights for %d maps", lights->count,
                        ism->capacity);
    if (!check_numbers(s, err))
        return false;
    if (s->splatter != IRB_ISM_ATOMIC && (float)s->splat_most > sizes[1])
        return irb_fail(err, IRB_E_INPUT,
                        "ism: splats of %d texels exceed the driver's points of %g", s->splat_most,
                        (double)sizes[1]);
    if (s->splatter == IRB_ISM_TESSELLATION && !(s->f_max <= (float)most_level))
        return irb_fail(err, IRB_E_INPUT,
                        "ism: tessellation factor %g is above the driver's %d levels",
                        (double)s->f_max, most_level);
    return s->splatter != IRB_ISM_TESSELLATION ||
           irb_tessellation_check((double)s->f_min, (double)s->f_max, s->smoothstep, err);
}

/* ---- Programs ---- */

static const struct irb_program_desc descs[IRB_ISM_SPLATTERS] = {
    [IRB_ISM_ATOMIC] = {.name = "ism: atomic", .compute = "lights/ism_atomic.comp"},
    [IRB_ISM_RASTER] = {.name = "ism: raster",
                        .vertex = "lights/ism_raster.vert",
                        .geometry = "lights/ism_splat.geom",
                        .fragment = "lights/ism_splat.frag"},
    [IRB_ISM_TESSELLATION] = {.name = "ism: tessellation",
                              .vertex = "lights/ism_tessellation.vert",
                              .tess_control = "lights/ism_tessellation.tesc",
                              .tess_evaluation = "lights/ism_tessellation.tese",
                              .geometry = "lights/ism_splat.geom",
                              .fragment = "lights/ism_splat.frag"},
};

/* Maps that a point goes to, at most. */
static int most_maps(const struct irb_ism_settings *settings)
{
    return (int)ceilf(settings->splat_factor);
}

static const struct irb_program *
get_program(struct irb_ism *ism, const struct irb_ism_settings *settings, struct irb_error *err)
{
    const int splatter = settings->splatter, most = most_maps(settings);
    struct irb_program **program = &ism->passes->splat[splatter];
    char block[32], maps[32], points[48];
    snprintf(block, sizeof block, "VPL_BLOCK %d", IRB_VPL_BLOCK);
    snprintf(maps, sizeof maps, "MOST_MAPS %d", most);
    snprintf(points, sizeof points, "POINTS_AN_INVOCATION %d", POINTS_AN_INVOCATION);
    const char *const defines[] = {block, maps, points, NULL};
    struct irb_program_desc desc = descs[splatter];
    desc.defines = defines;
    if (*program && ism->passes->most_maps[splatter] == most)
        return *program;
    irb_program_destroy(*program);
    *program = irb_program_create(ism->gl, &desc, err);
    ism->passes->most_maps[splatter] = most;
    return *program;
}

/* What the tessellator goes by; `measured_points` is looked up by factors that may have keys. */
static void measure(struct irb_ism_passes *passes, const struct irb_scene *scene,
                    const struct irb_ism_settings *s)
{
    const bool known = passes->measured == scene;
    if (known && passes->measured_f[0] == s->f_min && passes->measured_f[1] == s->f_max &&
        passes->measured_order == s->smoothstep)
        return;
    if (!known)
        irb_tessellation_measure(scene, &passes->range);
    passes->measured = scene;
    passes->measured_f[0] = s->f_min;
    passes->measured_f[1] = s->f_max;
    passes->measured_order = s->smoothstep;
    passes->measured_points = irb_tessellation_points(scene, &passes->range, s->smoothstep,
                                                      (double)s->f_min, (double)s->f_max);
}

/* Area of the scene at rest that a point stands for, m2; 0 without points. */
static double even_area(const struct irb_ism *ism, const struct irb_scene *scene,
                        const struct irb_points *points)
{
    if (points)
        return points->count ? points->area / (double)points->count : 0;
    double area = 0, edges[3];
    for (uint32_t t = 0; t < scene->triangle_count; t++)
        area += irb_triangle_size(scene, t, edges);
    return ism->passes->measured_points > 0 ? area / ism->passes->measured_points : 0;
}

static void set_uniforms(const struct irb_ism *ism, const struct irb_program *program,
                         const struct irb_scene *scene, const struct irb_points *points,
                         const struct irb_ism_settings *s)
{
    const bool even = s->splat_size == IRB_ISM_SIZE_EVEN;
    const double half = 0.5 * ism->map_size * (double)s->splat_scale;
    const double area = half * half * ism->count / (double)s->splat_factor;
    irb_program_use(program);
    irb_program_int(program, "light_count", ism->count);
    irb_program_float(program, "splat_factor", s->splat_factor);
    irb_program_float(program, "splat_area", (float)area);
    irb_program_float(program, "even_area", even ? (float)even_area(ism, scene, points) : 0.0f);
    irb_program_int(program, "splat_most", s->splat_most);
    irb_program_int(program, "map_size", ism->map_size);
    irb_program_int(program, "maps_a_row", ism->maps_a_row);
    irb_program_float(program, "near", s->near * irb_scene_diagonal(scene));
    irb_program_float(program, "near_radii", s->near_radii);
    irb_world_triangles_bind(ism->passes->triangles, program, TRIANGLES_UNIT);
    ism->gl->api.BindBufferBase(GL_UNIFORM_BUFFER, LIGHTS_BINDING, ism->passes->lights->id);
}

static void bind_chunk(const struct irb_ism *ism, const struct irb_program *program,
                       const struct irb_points_chunk *chunk)
{
    ism->gl->api.BindTextureUnit(POINTS_UNIT, chunk->texture);
    irb_program_int(program, "points", POINTS_UNIT);
    irb_program_uint(program, "first_point", chunk->first);
    irb_program_int(program, "point_count", (int)chunk->count);
}

/* ---- Atomic ---- */

/* Lights that a work group has side by side: as few as fill it, at most 8. */
static int lights_abreast(int lights)
{
    int abreast = 1;
    while (2 * abreast <= lights && abreast < MOST_ABREAST)
        abreast *= 2;
    return abreast;
}

/* Rounds of loops that a splat of s->splat_most texels a side takes. */
static int splat_rounds(const struct irb_ism *ism, const struct irb_ism_settings *s)
{
    const int side = s->splat_most < ism->map_size ? s->splat_most : ism->map_size;
    return side * side + 2;
}

/* One chunk, in as many dispatches as IRB_LOOP_ROUNDS_MOST asks for where all splats are as large
 * as they may get: some of the maps each, or one map and some of each invocation's points. */
static void dispatch_atomic(const struct irb_ism *ism, const struct irb_program *program,
                            const struct irb_ism_settings *s, uint32_t groups,
                            uint32_t light_groups)
{
    const int in_all = most_maps(s), fit = IRB_LOOP_ROUNDS_MOST / splat_rounds(ism, s);
    const int points = fit > POINTS_AN_INVOCATION ? POINTS_AN_INVOCATION : fit > 0 ? fit : 1;
    const int maps = fit > POINTS_AN_INVOCATION ? fit / POINTS_AN_INVOCATION : 1;
    for (int map = 0; map < in_all; map += maps)
        for (int point = 0; point < POINTS_AN_INVOCATION; point += points) {
            const int rest = POINTS_AN_INVOCATION - point;
            irb_program_int(program, "map_begin", map);
            irb_program_int(program, "map_end", map + maps < in_all ? map + maps : in_all);
            irb_program_int(program, "point_begin", point);
            irb_program_int(program, "point_end", point + (rest < points ? rest : points));
            ism->gl->api.DispatchCompute(groups, light_groups, 1);
        }
}

static void splat_atomic(const struct irb_ism *ism, const struct irb_program *program,
                         const struct irb_points *points, const struct irb_ism_settings *settings)
{
    const struct irb_gl_api *api = &ism->gl->api;
    const uint32_t lights = (uint32_t)ism->count;
    const uint32_t abreast = (uint32_t)lights_abreast(ism->count);
    const uint32_t rounds_a_group = GROUP / abreast * POINTS_AN_INVOCATION;
    irb_program_int(program, "abreast", (int)abreast);
    api->BindImageTexture(0, ism->atlas->id, 0, GL_FALSE, 0, GL_READ_WRITE, GL_R32UI);
    for (int i = 0; i < points->chunk_count; i++) {
        const uint32_t rounds = (points->chunks[i].count + lights - 1) / lights;
        bind_chunk(ism, program, &points->chunks[i]);
        dispatch_atomic(ism, program, settings, (rounds + rounds_a_group - 1) / rounds_a_group,
                        (lights + abreast - 1) / abreast);
    }
    api->MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                       GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
}

/* ---- Raster and tessellation ---- */

static bool make_target(struct irb_ism *ism, struct irb_error *err)
{
    struct irb_ism_passes *passes = ism->passes;
    if (!passes->depth)
        passes->depth =
            irb_texture_create(ism->gl,
                               &(struct irb_texture_desc){.name = "ism: depth",
                                                          .format = GL_DEPTH_COMPONENT32F,
                                                          .width = ism->atlas->width,
                                                          .height = ism->atlas->height},
                               err);
    if (passes->depth && !passes->target)
        passes->target =
            irb_framebuffer_create(ism->gl, "ism: target", &ism->atlas, 1, passes->depth, err);
    return passes->target != NULL;
}

/* Depth from 0 to 1 as it is, nearest first, the first of equals; depth cleared where maps are in
 * use. */
static void begin_raster(const struct irb_ism *ism)
{
    const struct irb_gl_api *api = &ism->gl->api;
    const float far = 1;
    irb_framebuffer_bind(ism->passes->target);
    api->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    api->DepthMask(GL_TRUE);
    api->Enable(GL_SCISSOR_TEST);
    api->Scissor(0, 0, ism->atlas->width, irb_ism_rows(ism, ism->count) * ism->map_size);
    api->ClearBufferfv(GL_DEPTH, 0, &far);
    api->Disable(GL_SCISSOR_TEST);
    api->Disable(GL_BLEND);
    api->Disable(GL_STENCIL_TEST);
    api->Enable(GL_DEPTH_TEST);
    api->DepthFunc(GL_LESS);
    api->DepthRangef(0, 1);
    api->ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    api->Enable(GL_PROGRAM_POINT_SIZE);
    api->BindVertexArray(ism->gl->empty_vertex_array);
}

static void end_raster(const struct irb_ism *ism)
{
    const struct irb_gl_api *api = &ism->gl->api;
    api->BindVertexArray(0);
    api->Disable(GL_PROGRAM_POINT_SIZE);
    api->ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    api->Disable(GL_DEPTH_TEST);
    api->BindFramebuffer(GL_FRAMEBUFFER, 0);
}

static void splat_raster(const struct irb_ism *ism, const struct irb_program *program,
                         const struct irb_points *points)
{
    begin_raster(ism);
    for (int i = 0; i < points->chunk_count; i++) {
        bind_chunk(ism, program, &points->chunks[i]);
        ism->gl->api.DrawArrays(GL_POINTS, 0, (GLsizei)points->chunks[i].count);
    }
    end_raster(ism);
}

static void splat_tessellation(const struct irb_ism *ism, const struct irb_program *program,
                               const struct irb_scene *scene,
                               const struct irb_ism_settings *settings)
{
    const struct irb_gl_api *api = &ism->gl->api;
    const struct irb_tessellation_range *range = &ism->passes->range;
    irb_program_vec2(program, "area_range",
                     (float[]){(float)range->area[0], (float)range->area[1]});
    irb_program_vec2(program, "edge_range",
                     (float[]){(float)range->edge[0], (float)range->edge[1]});
    irb_program_float(program, "f_min", settings->f_min);
    irb_program_float(program, "f_max", settings->f_max);
    irb_program_int(program, "smoothstep_order", settings->smoothstep);
    begin_raster(ism);
    api->PatchParameteri(GL_PATCH_VERTICES, 3);
    api->DrawArrays(GL_PATCHES, 0, (GLsizei)scene->triangle_count * 3);
    end_raster(ism);
}

/* ---- Splat ---- */

static bool prepare(struct irb_ism *ism, const struct irb_scene_gl *scene,
                    const struct irb_points *points, const struct irb_virtual_lights *lights,
                    const struct irb_ism_settings *settings, struct irb_error *err)
{
    struct irb_ism_passes *passes = ism->passes;
    const int before = ism->count;
    ism->count = lights->count;
    irb_ism_clear(ism, irb_ism_rows(ism, before > ism->count ? before : ism->count));
    if (!ism->count)
        return true;
    ism->gl->api.CopyNamedBufferSubData(lights->buffer->id, passes->lights->id, 0, 0,
                                        (GLsizeiptr)lights->count * IRB_VPL_BYTES);
    const bool dynamic = settings->splatter == IRB_ISM_TESSELLATION;
    return irb_world_triangles_update(passes->triangles, scene, dynamic ? NULL : points->density,
                                      err) &&
           (settings->splatter == IRB_ISM_ATOMIC || make_target(ism, err));
}

bool irb_ism_splat(struct irb_ism *ism, const struct irb_scene_gl *scene,
                   const struct irb_points *points, const struct irb_virtual_lights *lights,
                   const struct irb_ism_settings *settings, struct irb_error *err)
{
    if (!check(ism, points, lights, settings, err))
        return false;
    const struct irb_program *program = get_program(ism, settings, err);
    if (!program || !prepare(ism, scene, points, lights, settings, err))
        return false;
    if (ism->count) {
        const bool dynamic = settings->splatter == IRB_ISM_TESSELLATION;
        if (dynamic)
            measure(ism->passes, scene->scene, settings);
        set_uniforms(ism, program, scene->scene, dynamic ? NULL : points, settings);
        if (settings->splatter == IRB_ISM_ATOMIC)
            splat_atomic(ism, program, points, settings);
        else if (settings->splatter == IRB_ISM_RASTER)
            splat_raster(ism, program, points);
        else
            splat_tessellation(ism, program, scene->scene, settings);
    }
    return irb_gl_check(ism->gl, "ism: splat", err);
}
