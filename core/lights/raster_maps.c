/* SPDX-License-Identifier: MIT */
#include "core/lights/raster_maps.h"

#include <math.h>
#include <stdlib.h>

const char *const irb_raster_projection_names[] = {"hemicube", "paraboloid", NULL};

enum { LIGHTS_BINDING = 0 }; /* uniform block of shaders/lights/raster_maps.vert */

/* Least `near` as a share of the scene's diagonal: some float32 steps of its coordinates. Source:
 * ours. */
static const float least_near = 1e-6f;
/* Depth along a face's axis at which the hemicube is clipped, as a share of `near`: just below
 * 1/sqrt(3), the least depth at that distance. */
static const float near_depth_share = 0.577f;

static int faces_of(enum irb_raster_projection projection)
{
    return projection == IRB_RASTER_HEMICUBE ? 3 : 1;
}

int irb_raster_maps_most(struct irb_gl *gl, enum irb_raster_projection projection, int size)
{
    const int faces = faces_of(projection);
    const int64_t light_bytes = (int64_t)size * size * faces * (int64_t)sizeof(float);
    const int64_t most = ((int64_t)IRB_RASTER_MOST_MIB << 20) / (light_bytes > 0 ? light_bytes : 1);
    GLint layers = 0;

    gl->api.GetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &layers);
    if (most < 1)
        return 1;
    return most < layers / faces ? (int)most : layers / faces;
}

static bool check_desc(struct irb_gl *gl, enum irb_raster_projection projection, int size,
                       int capacity, struct irb_error *err)
{
    if (size < 2 || size % 2)
        return irb_fail(err, IRB_E_INPUT,
                        "shadow maps: expected an even size of at least 2 texels, found %d", size);
    const int most = irb_raster_maps_most(gl, projection, size);
    if (capacity < 1 || capacity > most)
        return irb_fail(err, IRB_E_INPUT,
                        "shadow maps: expected 1..%d lights of %d x %d texels at a time (%d MiB), "
                        "found %d",
                        most, size, size, IRB_RASTER_MOST_MIB, capacity);
    return true;
}

static bool create_program(struct irb_raster_maps *maps, struct irb_error *err)
{
    static const struct irb_program_desc stages[] = {
        [IRB_RASTER_HEMICUBE] = {.name = "shadow maps: hemicube",
                                 .vertex = "lights/raster_maps.vert",
                                 .geometry = "lights/raster_hemicube.geom",
                                 .fragment = "lights/raster_hemicube.frag"},
        [IRB_RASTER_PARABOLOID] = {.name = "shadow maps: paraboloid",
                                   .vertex = "lights/raster_maps.vert",
                                   .geometry = "lights/raster_paraboloid.geom",
                                   .fragment = "lights/raster_paraboloid.frag"},
    };
    return irb_surface_program_create_stages(&maps->program, maps->gl, &stages[maps->projection],
                                             err);
}

static bool create_target(struct irb_raster_maps *maps, struct irb_error *err)
{
    maps->distance =
        irb_texture_create(maps->gl,
                           &(struct irb_texture_desc){.name = "shadow maps: distance",
                                                      .format = GL_R32F,
                                                      .width = maps->size,
                                                      .height = maps->size,
                                                      .layers = maps->capacity * maps->faces},
                           err);
    maps->framebuffer = maps->distance ? irb_framebuffer_create(maps->gl, "shadow maps",
                                                                &maps->distance, 1, NULL, err)
                                       : NULL;
    return maps->framebuffer != NULL;
}

struct irb_raster_maps *irb_raster_maps_create(struct irb_gl *gl,
                                               enum irb_raster_projection projection, int size,
                                               int capacity, struct irb_error *err)
{
    if (!check_desc(gl, projection, size, capacity, err))
        return NULL;
    struct irb_raster_maps *maps = calloc(1, sizeof *maps);
    if (!maps) {
        irb_fail(err, IRB_E_MEMORY, "out of memory");
        return NULL;
    }
    maps->gl = gl;
    maps->projection = projection;
    maps->size = size;
    maps->capacity = capacity;
    maps->faces = faces_of(projection);
    if (create_program(maps, err) && create_target(maps, err))
        return maps;
    irb_raster_maps_destroy(maps);
    return NULL;
}

void irb_raster_maps_destroy(struct irb_raster_maps *maps)
{
    if (!maps)
        return;
    irb_framebuffer_destroy(maps->framebuffer);
    irb_texture_destroy(maps->distance);
    irb_surface_program_destroy(&maps->program);
    free(maps);
}

static void clear(const struct irb_raster_maps *maps)
{
    const struct irb_gl_api *api = &maps->gl->api;
    const float empty[4] = {INFINITY, INFINITY, INFINITY, INFINITY};

    api->Disable(GL_SCISSOR_TEST);
    api->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    api->ClearNamedFramebufferfv(maps->framebuffer->id, GL_COLOR, 0, empty);
}

/* Blending by minimum keeps the nearest surface without a depth buffer, and in any order. */
static void set_state(const struct irb_gl_api *api)
{
    api->Disable(GL_DEPTH_TEST);
    api->Enable(GL_BLEND);
    api->BlendEquation(GL_MIN);
    api->ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
}

static void reset_state(const struct irb_gl_api *api)
{
    api->Disable(GL_CLIP_DISTANCE0);
    api->ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    api->BlendEquation(GL_FUNC_ADD);
    api->Disable(GL_BLEND);
}

/* Lights of one block: `first` counts within it. */
static void draw_block(const struct irb_raster_maps *maps, const struct irb_scene_gl *scene,
                       const struct irb_virtual_lights *lights, int block, int first, int first_map,
                       int count)
{
    const int bytes = IRB_VPL_BLOCK * IRB_VPL_BYTES;
    const struct irb_program *const programs[] = {maps->program.opaque, maps->program.masked};

    for (int i = 0; i < 2 && programs[i]; i++) {
        irb_program_int(programs[i], "first_light", first);
        irb_program_int(programs[i], "first_map", first_map);
    }
    maps->gl->api.BindBufferRange(GL_UNIFORM_BUFFER, LIGHTS_BINDING, lights->buffer->id,
                                  (GLintptr)block * bytes, bytes);
    irb_scene_gl_draw_instances(scene, &maps->program, count);
}

static void draw(const struct irb_raster_maps *maps, const struct irb_scene_gl *scene,
                 const struct irb_virtual_lights *lights, int first, int count)
{
    for (int done = 0; done < count;) {
        int block = (first + done) / IRB_VPL_BLOCK, within = (first + done) % IRB_VPL_BLOCK;
        int rest = IRB_VPL_BLOCK - within;
        int now = count - done < rest ? count - done : rest;
        draw_block(maps, scene, lights, block, within, done, now);
        done += now;
    }
}

static void set_uniforms(const struct irb_raster_maps *maps, const struct irb_scene_gl *scene,
                         float near)
{
    const struct irb_program *const programs[] = {maps->program.opaque, maps->program.masked};
    const float least = least_near * irb_scene_diagonal(scene->scene);

    near = near > least ? near : least;
    for (int i = 0; i < 2 && programs[i]; i++) {
        irb_program_int(programs[i], "raster_size", maps->size);
        irb_program_float(programs[i], "near", near);
        irb_program_float(programs[i], "near_depth", near_depth_share * near);
    }
}

bool irb_raster_maps_render(struct irb_raster_maps *maps, const struct irb_scene_gl *scene,
                            const struct irb_virtual_lights *lights, int first, int count,
                            float near, struct irb_error *err)
{
    const struct irb_gl_api *api = &maps->gl->api;

    if (first < 0 || count < 0 || count > maps->capacity || first > lights->count - count)
        return irb_fail(err, IRB_E_INTERNAL,
                        "shadow maps: made for %d of lights 0..%d, asked for %d from %d on",
                        maps->capacity, lights->count - 1, count, first);
    if (!irb_surface_program_prepare(&maps->program, scene, err))
        return false;
    maps->count = count;
    set_uniforms(maps, scene, near);
    irb_framebuffer_bind(maps->framebuffer);
    clear(maps);
    set_state(api);
    if (maps->projection == IRB_RASTER_HEMICUBE)
        api->Enable(GL_CLIP_DISTANCE0);
    draw(maps, scene, lights, first, count);
    reset_state(api);
    return irb_gl_check(maps->gl, "shadow maps: draw", err);
}

int irb_raster_maps_bind(const struct irb_raster_maps *maps, const struct irb_program *program,
                         int first_unit)
{
    maps->gl->api.BindTextureUnit((GLuint)first_unit, maps->distance->id);
    irb_program_int(program, "raster_maps", first_unit);
    irb_program_int(program, "raster_size", maps->size);
    return first_unit + 1;
}

const char *irb_raster_define(enum irb_raster_projection projection)
{
    return projection == IRB_RASTER_HEMICUBE ? "RASTER_PROJECTION 0" : "RASTER_PROJECTION 1";
}
