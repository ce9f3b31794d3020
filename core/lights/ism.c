/* SPDX-License-Identifier: MIT */
#include "core/lights/ism.h"

#include "core/lights/ism_passes.h"

#include <stdlib.h>

const char *const irb_ism_size_names[] = {"even", "surface", NULL};
const char *const irb_ism_pull_names[] = {"median", "mean", NULL};

enum { LEAST_MAP = 8, MOST_MAP = 1024 };

void irb_ism_clear(struct irb_ism *ism, int rows)
{
    const uint32_t empty = IRB_ISM_EMPTY;
    if (rows > 0)
        ism->gl->api.ClearTexSubImage(ism->atlas->id, 0, 0, 0, 0, ism->atlas->width,
                                      rows * ism->map_size, 1, GL_RED_INTEGER, GL_UNSIGNED_INT,
                                      &empty);
}

static bool create_objects(struct irb_ism *ism, struct irb_error *err)
{
    const int side = ism->maps_a_row * ism->map_size;
    const struct irb_texture_desc desc = {
        .name = "ism: atlas", .format = GL_R32UI, .width = side, .height = side};
    ism->passes = calloc(1, sizeof *ism->passes);
    if (!ism->passes)
        return irb_fail(err, IRB_E_MEMORY, "ism: out of memory");
    ism->atlas = irb_texture_create(ism->gl, &desc, err);
    if (!ism->atlas)
        return false;
    irb_ism_clear(ism, ism->maps_a_row);
    ism->passes->lights =
        irb_buffer_create(ism->gl, "ism: lights", IRB_VPL_BLOCK * IRB_VPL_BYTES, NULL, err);
    if (ism->passes->lights)
        ism->passes->triangles = irb_world_triangles_create(ism->gl, err);
    return ism->passes->triangles && irb_gl_check(ism->gl, "ism: create", err);
}

struct irb_ism *irb_ism_create(struct irb_gl *gl, int map_size, int capacity, struct irb_error *err)
{
    if (map_size < LEAST_MAP || map_size > MOST_MAP || capacity < 1 || capacity > IRB_VPL_BLOCK) {
        irb_fail(err, IRB_E_INPUT,
                 "ism: expected maps of %d..%d texels a side and 1..%d of them, found %d and %d",
                 LEAST_MAP, MOST_MAP, IRB_VPL_BLOCK, map_size, capacity);
        return NULL;
    }
    struct irb_ism *ism = calloc(1, sizeof *ism);
    if (!ism) {
        irb_fail(err, IRB_E_MEMORY, "ism: out of memory");
        return NULL;
    }
    ism->gl = gl;
    ism->map_size = map_size;
    while (ism->capacity < capacity) {
        ism->maps_a_row++;
        ism->capacity = ism->maps_a_row * ism->maps_a_row;
    }
    if (create_objects(ism, err))
        return ism;
    irb_ism_destroy(ism);
    return NULL;
}

bool irb_ism_prepare(struct irb_ism **ism, struct irb_gl *gl, int map_size, int capacity,
                     struct irb_error *err)
{
    const struct irb_ism *have = *ism;
    if (have && have->map_size == map_size && have->capacity >= capacity)
        return true;
    irb_ism_destroy(*ism);
    *ism = irb_ism_create(gl, map_size, capacity, err);
    return *ism != NULL;
}

void irb_ism_destroy(struct irb_ism *ism)
{
    if (!ism)
        return;
    if (ism->passes) {
        irb_ism_destroy_splat(ism->passes);
        irb_ism_destroy_pull_push(ism->passes);
        irb_world_triangles_destroy(ism->passes->triangles);
        irb_buffer_destroy(ism->passes->lights);
        free(ism->passes);
    }
    irb_texture_destroy(ism->atlas);
    free(ism);
}

bool irb_ism_build(struct irb_ism *ism, const struct irb_scene_gl *scene,
                   const struct irb_points *points, const struct irb_virtual_lights *lights,
                   const struct irb_ism_settings *settings, struct irb_error *err)
{
    return irb_ism_splat(ism, scene, points, lights, settings, err) &&
           irb_ism_pull_push(ism, settings, err);
}

int irb_ism_bind(const struct irb_ism *ism, const struct irb_program *program, int first_unit)
{
    ism->gl->api.BindTextureUnit((GLuint)first_unit, ism->atlas->id);
    irb_program_int(program, "ism_atlas", first_unit);
    irb_program_int(program, "ism_map_size", ism->map_size);
    irb_program_int(program, "ism_maps_a_row", ism->maps_a_row);
    return first_unit + 1;
}
