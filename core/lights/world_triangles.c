/* SPDX-License-Identifier: MIT */
#include "core/lights/world_triangles.h"

#include <stdlib.h>
#include <string.h>

/* Shader storage bindings and work group size of shaders/lights/world_triangles.comp. */
enum { POSITIONS_BINDING = 0, INDICES_BINDING = 1, DENSITY_BINDING = 2, CORNERS_BINDING = 3 };
enum { GROUP = 64, TRIANGLES_AN_INVOCATION = 16, TRIANGLE_BYTES = 48 };

struct irb_world_triangles *irb_world_triangles_create(struct irb_gl *gl, struct irb_error *err)
{
    struct irb_world_triangles *triangles = calloc(1, sizeof *triangles);
    if (!triangles) {
        irb_fail(err, IRB_E_MEMORY, "points: out of memory");
        return NULL;
    }
    triangles->gl = gl;
    triangles->program =
        irb_program_create(gl,
                           &(struct irb_program_desc){.name = "points: world triangles",
                                                      .compute = "lights/world_triangles.comp"},
                           err);
    if (triangles->program)
        return triangles;
    irb_world_triangles_destroy(triangles);
    return NULL;
}

static void destroy_buffer(struct irb_world_triangles *triangles)
{
    if (triangles->texture)
        triangles->gl->api.DeleteTextures(1, &triangles->texture);
    irb_buffer_destroy(triangles->corners);
    triangles->texture = 0;
    triangles->corners = NULL;
}

void irb_world_triangles_destroy(struct irb_world_triangles *triangles)
{
    if (!triangles)
        return;
    destroy_buffer(triangles);
    irb_program_destroy(triangles->program);
    free(triangles);
}

static bool resize(struct irb_world_triangles *triangles, uint32_t count, struct irb_error *err)
{
    const struct irb_gl_api *api = &triangles->gl->api;
    const int64_t bytes = (int64_t)count * TRIANGLE_BYTES;
    GLint64 texels = 0, storage = 0;
    if (triangles->corners && triangles->count == count)
        return true;
    api->GetInteger64v(GL_MAX_TEXTURE_BUFFER_SIZE, &texels);
    api->GetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &storage);
    if (bytes > storage || 3 * (int64_t)count > texels)
        return irb_fail(err, IRB_E_BACKEND,
                        "points: %u triangles take %.1f MiB in world space, above the driver's "
                        "%.1f MiB for one buffer or its %lld texels for one buffer texture",
                        count, (double)bytes / (1 << 20), (double)storage / (1 << 20),
                        (long long)texels);
    destroy_buffer(triangles);
    triangles->count = count;
    triangles->corners =
        irb_buffer_create(triangles->gl, "points: world triangles", bytes, NULL, err);
    if (!triangles->corners)
        return false;
    api->CreateTextures(GL_TEXTURE_BUFFER, 1, &triangles->texture);
    api->TextureBuffer(triangles->texture, GL_RGBA32F, triangles->corners->id);
    return true;
}

/* One dispatch for consecutive objects of one transform: objects at rest are all one. */
static void update_objects(const struct irb_world_triangles *triangles,
                           const struct irb_scene *scene)
{
    const int per_group = GROUP * TRIANGLES_AN_INVOCATION;
    for (int o = 0; o < scene->object_count;) {
        const struct irb_object *object = &scene->objects[o];
        uint32_t end = object->first_triangle + object->triangle_count;
        for (o++; o < scene->object_count; o++) {
            const struct irb_object *next = &scene->objects[o];
            if (next->first_triangle != end ||
                memcmp(next->transform, object->transform, sizeof next->transform))
                break;
            end += next->triangle_count;
        }
        const uint32_t count = end - object->first_triangle;
        irb_program_mat4(triangles->program, "model", object->transform);
        irb_program_int(triangles->program, "first_triangle", (int)object->first_triangle);
        irb_program_int(triangles->program, "triangle_count", (int)count);
        if (count)
            triangles->gl->api.DispatchCompute(
                (count + (unsigned)per_group - 1) / (unsigned)per_group, 1, 1);
    }
}

bool irb_world_triangles_update(struct irb_world_triangles *triangles,
                                const struct irb_scene_gl *scene, const struct irb_buffer *density,
                                struct irb_error *err)
{
    const struct irb_gl_api *api = &triangles->gl->api;
    if (!resize(triangles, scene->scene->triangle_count, err))
        return false;
    irb_program_use(triangles->program);
    irb_program_int(triangles->program, "has_density", density != NULL);
    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, POSITIONS_BINDING, scene->positions->id);
    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, INDICES_BINDING, scene->indices->id);
    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, DENSITY_BINDING,
                        density ? density->id : scene->indices->id);
    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, CORNERS_BINDING, triangles->corners->id);
    update_objects(triangles, scene->scene);
    api->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    return irb_gl_check(triangles->gl, "points: world triangles", err);
}

void irb_world_triangles_bind(const struct irb_world_triangles *triangles,
                              const struct irb_program *program, int unit)
{
    triangles->gl->api.BindTextureUnit((GLuint)unit, triangles->texture);
    irb_program_int(program, "triangles", unit);
}
