/* SPDX-License-Identifier: MIT */
#include "core/scene/builder.h"

#include "core/scene/vec.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void irb_builder_begin(struct irb_builder *builder, const char *name)
{
    *builder = (struct irb_builder){.scene = calloc(1, sizeof(struct irb_scene))};
    if (!builder->scene) {
        builder->failure = IRB_E_MEMORY;
        return;
    }
    snprintf(builder->scene->name, sizeof builder->scene->name, "%s", name);
}

/* Room for one more element; NULL when memory is out, and `array` is left as it was. */
static void *grow_by_one(struct irb_builder *builder, void *array, int count, size_t size)
{
    void *grown = builder->failure ? NULL : realloc(array, ((size_t)count + 1) * size);

    if (!grown)
        builder->failure = IRB_E_MEMORY;
    return grown;
}

int irb_builder_material(struct irb_builder *builder, const char *name, const float diffuse[3])
{
    struct irb_scene *scene = builder->scene;
    struct irb_material material = {.exponent = 1, .diffuse_texture = -1};
    struct irb_material *grown;

    if (builder->failure)
        return 0;
    grown = grow_by_one(builder, scene->materials, scene->material_count, sizeof *grown);
    if (!grown)
        return 0;
    snprintf(material.name, sizeof material.name, "%s", name);
    memcpy(material.diffuse, diffuse, sizeof material.diffuse);
    scene->materials = grown;
    grown[scene->material_count] = material;
    return scene->material_count++;
}

int irb_builder_texture(struct irb_builder *builder, const char *name, int width, int height,
                        unsigned char *rgba)
{
    struct irb_scene *scene = builder->scene;
    struct irb_scene_texture texture = {.width = width, .height = height, .rgba = rgba};
    struct irb_scene_texture *grown = NULL;

    if (!builder->failure)
        grown = grow_by_one(builder, scene->textures, scene->texture_count, sizeof *grown);
    if (!grown) {
        free(rgba);
        return -1;
    }
    snprintf(texture.name, sizeof texture.name, "%s", name);
    scene->textures = grown;
    grown[scene->texture_count] = texture;
    return scene->texture_count++;
}

void irb_builder_object(struct irb_builder *builder, const char *name, int material)
{
    struct irb_scene *scene = builder->scene;
    struct irb_object object = {.material = material};
    struct irb_object *grown;

    if (builder->failure)
        return;
    if (scene->object_count > 0 && scene->objects[scene->object_count - 1].triangle_count == 0)
        scene->object_count--;
    grown = grow_by_one(builder, scene->objects, scene->object_count, sizeof *grown);
    if (!grown)
        return;
    snprintf(object.name, sizeof object.name, "%s", name);
    object.first_triangle = scene->triangle_count;
    for (int i = 0; i < 4; i++)
        object.transform[5 * i] = 1;
    scene->objects = grown;
    grown[scene->object_count++] = object;
}

/* Doubles a capacity within a maximum; 0 when the maximum is reached. */
static uint32_t next_capacity(uint32_t capacity, uint32_t maximum)
{
    if (capacity >= maximum)
        return 0;
    if (capacity < 1024)
        return 1024;
    return capacity > maximum / 2 ? maximum : capacity * 2;
}

static bool reallocate(void *array, size_t count, size_t size)
{
    void **slot = array, *grown = realloc(*slot, count * size);

    if (grown)
        *slot = grown;
    return grown != NULL;
}

static bool vertex_room(struct irb_builder *builder)
{
    struct irb_scene *scene = builder->scene;
    uint32_t capacity;

    if (builder->failure)
        return false;
    if (scene->vertex_count < builder->vertex_capacity)
        return true;
    capacity = next_capacity(builder->vertex_capacity, IRB_SCENE_MAX_VERTICES);
    if (capacity == 0 || !reallocate(&scene->positions, capacity, 3 * sizeof(float)) ||
        !reallocate(&scene->normals, capacity, 3 * sizeof(float)) ||
        !reallocate(&scene->texcoords, capacity, 2 * sizeof(float))) {
        builder->failure = IRB_E_MEMORY;
        return false;
    }
    builder->vertex_capacity = capacity;
    return true;
}

uint32_t irb_builder_vertex(struct irb_builder *builder, const double position[3],
                            const double normal[3], const double texcoord[2])
{
    struct irb_scene *scene = builder->scene;
    uint32_t v;

    if (!vertex_room(builder))
        return 0;
    v = scene->vertex_count++;
    for (int i = 0; i < 3; i++) {
        scene->positions[3 * (size_t)v + i] = (float)position[i];
        scene->normals[3 * (size_t)v + i] = (float)normal[i];
    }
    for (int i = 0; i < 2; i++)
        scene->texcoords[2 * (size_t)v + i] = texcoord ? (float)texcoord[i] : 0;
    return v;
}

void irb_builder_triangle(struct irb_builder *builder, uint32_t a, uint32_t b, uint32_t c)
{
    struct irb_scene *scene = builder->scene;

    if (builder->failure)
        return;
    if (scene->triangle_count >= builder->triangle_capacity) {
        uint32_t capacity = next_capacity(builder->triangle_capacity, IRB_SCENE_MAX_TRIANGLES);

        if (capacity == 0 || !reallocate(&scene->indices, capacity, 3 * sizeof(uint32_t))) {
            builder->failure = IRB_E_MEMORY;
            return;
        }
        builder->triangle_capacity = capacity;
    }
    uint32_t *index = scene->indices + 3 * (size_t)scene->triangle_count++;
    index[0] = a;
    index[1] = b;
    index[2] = c;
    if (scene->object_count > 0)
        scene->objects[scene->object_count - 1].triangle_count++;
}

void irb_builder_quad(struct irb_builder *builder, const double corners[4][3])
{
    for (int half = 0; half < 2; half++) {
        const double *p[3] = {corners[0], corners[1 + half], corners[2 + half]};
        double normal[3];
        uint32_t v[3];

        vec_triangle_cross(p[0], p[1], p[2], normal);
        vec_normalize(normal);
        for (int i = 0; i < 3; i++)
            v[i] = irb_builder_vertex(builder, p[i], normal, NULL);
        irb_builder_triangle(builder, v[0], v[1], v[2]);
    }
}

/* Adds each triangle's cross product (twice its area along its normal) to its three vertices. */
static void sum_area_normals(const struct irb_scene *scene, uint32_t first_vertex,
                             uint32_t first_triangle, double *sums)
{
    for (uint32_t t = first_triangle; t < scene->triangle_count; t++) {
        const uint32_t *index = scene->indices + 3 * (size_t)t;
        double p[3][3], cross[3];

        for (int corner = 0; corner < 3; corner++)
            vec_from_float(scene->positions + 3 * (size_t)index[corner], p[corner]);
        vec_triangle_cross(p[0], p[1], p[2], cross);
        for (int corner = 0; corner < 3; corner++) {
            double *sum = sums + 3 * (size_t)(index[corner] - first_vertex);

            for (int i = 0; i < 3; i++)
                sum[i] += cross[i];
        }
    }
}

void irb_builder_smooth_normals(struct irb_builder *builder, uint32_t first_vertex,
                                uint32_t first_triangle, bool only_zero)
{
    struct irb_scene *scene = builder->scene;
    double *sums;

    if (builder->failure || first_vertex >= scene->vertex_count)
        return;
    sums = calloc(scene->vertex_count - first_vertex, 3 * sizeof *sums);
    if (!sums) {
        builder->failure = IRB_E_MEMORY;
        return;
    }
    sum_area_normals(scene, first_vertex, first_triangle, sums);
    for (uint32_t v = first_vertex; v < scene->vertex_count; v++) {
        double *sum = sums + 3 * (size_t)(v - first_vertex);
        float *normal = scene->normals + 3 * (size_t)v;

        if (only_zero && (normal[0] != 0 || normal[1] != 0 || normal[2] != 0))
            continue;
        if (!vec_normalize(sum))
            sum[1] = 1;
        for (int i = 0; i < 3; i++)
            normal[i] = (float)sum[i];
    }
    free(sums);
}

/* Of the vertices that triangles use: a stray vertex does not move near and far planes. */
static void set_bounds(struct irb_scene *scene)
{
    for (size_t i = 0; i < 3 * (size_t)scene->triangle_count; i++) {
        const float *p = scene->positions + 3 * (size_t)scene->indices[i];

        for (int axis = 0; axis < 3; axis++) {
            if (i == 0 || p[axis] < scene->bounds_min[axis])
                scene->bounds_min[axis] = p[axis];
            if (i == 0 || p[axis] > scene->bounds_max[axis])
                scene->bounds_max[axis] = p[axis];
        }
    }
}

struct irb_scene *irb_builder_finish(struct irb_builder *builder, struct irb_error *err)
{
    struct irb_scene *scene = builder->scene;

    if (builder->failure) {
        irb_builder_abandon(builder);
        irb_fail(err, IRB_E_MEMORY,
                 "the scene does not fit: out of memory, or more than %d vertices or %d triangles",
                 IRB_SCENE_MAX_VERTICES, IRB_SCENE_MAX_TRIANGLES);
        return NULL;
    }
    if (scene->object_count > 0 && scene->objects[scene->object_count - 1].triangle_count == 0)
        scene->object_count--;
    set_bounds(scene);
    builder->scene = NULL;
    return scene;
}

void irb_builder_abandon(struct irb_builder *builder)
{
    irb_scene_destroy(builder->scene);
    builder->scene = NULL;
}
