/* SPDX-License-Identifier: MIT */
#include "core/lights/points.h"

#include <stdlib.h>
#include <string.h>

static int64_t chunk_points(const struct irb_points_desc *desc)
{
    int64_t bytes = desc->chunk_bytes;
    if (bytes <= 0 || bytes > IRB_POINTS_CHUNK_BYTES)
        bytes = IRB_POINTS_CHUNK_BYTES;
    const int64_t points = bytes / (int64_t)sizeof(struct irb_point);
    return points > 0 ? points : 1;
}

static bool create_chunk(struct irb_points *points, struct irb_points_chunk *chunk,
                         const struct irb_point *from, uint64_t first, uint64_t count,
                         struct irb_error *err)
{
    const struct irb_gl_api *api = &points->gl->api;
    chunk->points = irb_buffer_create(points->gl, "points: chunk", (int64_t)(count * sizeof *from),
                                      from + first, err);
    if (!chunk->points)
        return false;
    points->bytes += chunk->points->bytes;
    chunk->first = (uint32_t)first;
    chunk->count = (uint32_t)count;
    api->CreateTextures(GL_TEXTURE_BUFFER, 1, &chunk->texture);
    api->TextureBuffer(chunk->texture, GL_RG32UI, chunk->points->id);
    return true;
}

/* The last chunk first: the list gives up each one's memory once it is uploaded. */
static bool create_chunks(struct irb_points *points, struct irb_point_list *list, uint64_t most,
                          struct irb_error *err)
{
    const uint64_t chunks = (points->count + most - 1) / most;
    points->chunks = calloc((size_t)chunks + 1, sizeof *points->chunks);
    if (!points->chunks)
        return irb_fail(err, IRB_E_MEMORY, "points: out of memory");
    points->chunk_count = (int)chunks;
    for (uint64_t i = chunks; i-- > 0;) {
        const uint64_t first = i * most;
        if (!create_chunk(points, &points->chunks[i], list->points, first, list->count - first,
                          err))
            return false;
        list->count = first;
        struct irb_point *rest = realloc(list->points, (size_t)(first + 1) * sizeof *rest);
        list->points = rest ? rest : list->points;
    }
    return true;
}

/* Buffer textures of this many texels must be allowed (GL promises only 65536). */
static bool check_texels(struct irb_gl *gl, uint64_t texels, struct irb_error *err)
{
    GLint64 most = 0;
    gl->api.GetInteger64v(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
    return texels <= (uint64_t)most ||
           irb_fail(err, IRB_E_BACKEND,
                    "points: chunks of %llu points exceed the driver's buffer textures of %lld "
                    "texels",
                    (unsigned long long)texels, (long long)most);
}

struct irb_points *irb_points_create(struct irb_gl *gl, const struct irb_scene_gl *scene,
                                     const struct irb_points_desc *desc, struct irb_error *err)
{
    struct irb_point_list list;
    if (!irb_points_generate(scene->scene, desc, &list, err))
        return NULL;
    const uint64_t most = (uint64_t)chunk_points(desc);
    struct irb_points *points = calloc(1, sizeof *points);
    if (points) {
        *points = (struct irb_points){.gl = gl,
                                      .count = list.count,
                                      .area = list.area,
                                      .runs = list.runs,
                                      .run_count = list.run_count,
                                      .made_by = *desc,
                                      .weighted = desc->weights != NULL};
        points->made_by.weights = NULL; /* they are borrowed until now only */
        list.runs = NULL;
        points->density = irb_buffer_create(
            gl, "points: density", (int64_t)scene->scene->triangle_count * 4, list.density, err);
    } else {
        irb_fail(err, IRB_E_MEMORY, "points: out of memory");
    }
    bool ok = points && points->density &&
              check_texels(gl, most < list.count ? most : list.count, err) &&
              create_chunks(points, &list, most, err) && irb_gl_check(gl, "points: upload", err);
    irb_point_list_destroy(&list);
    if (ok) {
        points->bytes += points->density->bytes;
        return points;
    }
    irb_points_destroy(points);
    return NULL;
}

static bool are_made_by(const struct irb_points *points, const struct irb_points_desc *desc)
{
    const struct irb_points_desc *by = &points->made_by;
    return !points->weighted && !desc->weights && by->kind == desc->kind &&
           by->count == desc->count && by->seed == desc->seed && by->f_min == desc->f_min &&
           by->f_max == desc->f_max && by->smoothstep == desc->smoothstep &&
           by->most_bytes == desc->most_bytes && by->chunk_bytes == desc->chunk_bytes;
}

bool irb_points_prepare(struct irb_points **points, struct irb_gl *gl,
                        const struct irb_scene_gl *scene, const struct irb_points_desc *desc,
                        struct irb_error *err)
{
    if (*points && are_made_by(*points, desc))
        return true;
    irb_points_destroy(*points);
    *points = irb_points_create(gl, scene, desc, err);
    return *points != NULL;
}

void irb_points_destroy(struct irb_points *points)
{
    if (!points)
        return;
    for (int i = 0; i < points->chunk_count; i++) {
        if (points->chunks[i].texture)
            points->gl->api.DeleteTextures(1, &points->chunks[i].texture);
        irb_buffer_destroy(points->chunks[i].points);
    }
    irb_buffer_destroy(points->density);
    free(points->chunks);
    free(points->runs);
    free(points);
}
