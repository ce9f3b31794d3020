/* SPDX-License-Identifier: MIT */
#include "core/scene/gltf/load.h"

#include "core/scene/vec.h"

#include <stdio.h>
#include <stdlib.h>

/* Height over longest side below which a triangle is a line: half an ulp of a float coordinate. */
#define DEGENERATE_RATIO 0x1p-24

struct primitive {
    struct gltf_loader *loader;
    const struct irb_gltf_primitive *source;
    int node; /* glTF's, whose mesh this is a part of */
    const double *node_world;
    const double *world;     /* the same, or identity where it has a skin */
    double normal_matrix[9]; /* of `world` */
    bool mirrored;           /* `world` has a negative determinant */
    struct gltf_array position, normal, texcoord, indices; /* the last three if their count > 0 */
    bool has_normal, has_texcoord, has_indices;
    uint32_t first_vertex, first_triangle;
    bool deforms;      /* has morph targets or a skin */
    uint32_t *sources; /* of what deforms and is flat: the file's vertex of each; owned */
};

static const double identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/* ---- Opening ---- */

static bool open_optional(const struct primitive *primitive, int accessor, const char *what,
                          int components, struct gltf_array *array, bool *present,
                          struct irb_error *err)
{
    *present = accessor >= 0;
    if (!*present)
        return true;
    if (!gltf_array_open(primitive->loader->gltf, accessor, what, components, array, err))
        return false;
    if (array->count != primitive->position.count)
        return irb_fail(err, IRB_E_INPUT, "%s has %zu entries but POSITION has %zu", what,
                        array->count, primitive->position.count);
    return true;
}

/* Without a texture the coordinates have no effect and are left out. */
static bool open_texcoord(struct primitive *primitive, struct irb_error *err)
{
    const struct irb_gltf *gltf = primitive->loader->gltf;
    const struct irb_gltf_primitive *source = primitive->source;
    char what[32];
    int set;

    if (source->material < 0 || gltf->materials[source->material].base_color_texture < 0)
        return true;
    set = gltf->materials[source->material].base_color_texcoord;
    if (set < 0 || set >= IRB_GLTF_TEXCOORD_SETS)
        return irb_fail(err, IRB_E_INPUT, "texture coordinate set %d, expected 0 to %d", set,
                        IRB_GLTF_TEXCOORD_SETS - 1);
    snprintf(what, sizeof what, "TEXCOORD_%d", set);
    return open_optional(primitive, source->texcoord[set], what, 2, &primitive->texcoord,
                         &primitive->has_texcoord, err);
}

static bool open_indices(struct primitive *primitive, struct irb_error *err)
{
    struct gltf_array *indices = &primitive->indices;
    size_t vertices = primitive->position.count;

    primitive->has_indices = primitive->source->indices >= 0;
    if (!primitive->has_indices)
        return true;
    if (!gltf_array_open(primitive->loader->gltf, primitive->source->indices, "indices", 1, indices,
                         err))
        return false;
    if (indices->component != IRB_GLTF_UNSIGNED_BYTE &&
        indices->component != IRB_GLTF_UNSIGNED_SHORT &&
        indices->component != IRB_GLTF_UNSIGNED_INT)
        return irb_fail(err, IRB_E_INPUT, "indices have component type %d, expected unsigned",
                        indices->component);
    for (size_t i = 0; i < indices->count; i++)
        if (gltf_array_index(indices, i) >= vertices)
            return irb_fail(err, IRB_E_INPUT,
                            "index %u at place %zu is out of range (%zu vertices)",
                            gltf_array_index(indices, i), i, vertices);
    return true;
}

static bool check_positions(const struct primitive *primitive, struct irb_error *err)
{
    const struct gltf_array *position = &primitive->position;

    for (size_t v = 0; v < position->count; v++) {
        double p[3];

        for (int i = 0; i < 3; i++)
            p[i] = gltf_array_get(position, v, i);
        if (!isfinite(p[0]) || !isfinite(p[1]) || !isfinite(p[2]))
            return irb_fail(err, IRB_E_INPUT, "vertex %zu (%g, %g, %g) is not finite", v, p[0],
                            p[1], p[2]);
    }
    return true;
}

static bool open_primitive(struct primitive *primitive, struct irb_error *err)
{
    const struct irb_gltf_primitive *source = primitive->source;

    if (source->compressed && source->position < 0)
        return irb_fail(err, IRB_E_INPUT,
                        "is compressed with KHR_draco_mesh_compression, which is not supported");
    if (source->position < 0)
        return irb_fail(err, IRB_E_INPUT, "has no POSITION attribute");
    if (!gltf_array_open(primitive->loader->gltf, source->position, "POSITION", 3,
                         &primitive->position, err))
        return false;
    if (primitive->position.count > IRB_SCENE_MAX_VERTICES)
        return irb_fail(err, IRB_E_INPUT, "has %zu vertices, expected at most %d",
                        primitive->position.count, IRB_SCENE_MAX_VERTICES);
    return check_positions(primitive, err) && open_indices(primitive, err) &&
           open_optional(primitive, source->normal, "NORMAL", 3, &primitive->normal,
                         &primitive->has_normal, err) &&
           open_texcoord(primitive, err);
}

/* ---- Vertices ---- */

static bool world_position(const struct primitive *primitive, size_t v, double out[3],
                           struct irb_error *err)
{
    double p[3];

    for (int i = 0; i < 3; i++)
        p[i] = gltf_array_get(&primitive->position, v, i);
    vec_transform_point(primitive->world, p, out);
    for (int i = 0; i < 3; i++)
        if (!(fabs(out[i]) <= IRB_SCENE_MAX_COORDINATE))
            return irb_fail(err, IRB_E_INPUT,
                            "vertex %zu lies at %g m in the world, expected at most %g m", v,
                            out[i], IRB_SCENE_MAX_COORDINATE);
    return true;
}

/* Zero where the file's normal has no direction. */
static void world_normal(const struct primitive *primitive, size_t v, double out[3])
{
    double local[3];

    for (int i = 0; i < 3; i++)
        local[i] = gltf_array_get(&primitive->normal, v, i);
    vec_transform_normal(primitive->normal_matrix, local, out);
    if (vec_normalize(out))
        return;
    primitive->loader->bad_normals++;
    out[0] = out[1] = out[2] = 0;
}

static bool texcoord_of(const struct primitive *primitive, size_t v, double out[2],
                        struct irb_error *err)
{
    out[0] = out[1] = 0;
    if (!primitive->has_texcoord)
        return true;
    for (int i = 0; i < 2; i++) {
        out[i] = gltf_array_get(&primitive->texcoord, v, i);
        if (!isfinite(out[i]))
            return irb_fail(err, IRB_E_INPUT, "texture coordinate of vertex %zu is not finite", v);
    }
    return true;
}

/* ---- Triangles ---- */

static size_t corner_count(const struct primitive *primitive)
{
    return primitive->has_indices ? primitive->indices.count : primitive->position.count;
}

static size_t triangle_count(const struct primitive *primitive)
{
    size_t corners = corner_count(primitive);

    if (primitive->source->mode == IRB_GLTF_TRIANGLES)
        return corners / 3;
    return corners < 3 ? 0 : corners - 2;
}

/* The three vertices of triangle t (glTF 2.0, 3.7.2.1), turned round where the node mirrors. */
static void triangle_corners(const struct primitive *primitive, size_t t, size_t v[3])
{
    size_t corner[3] = {3 * t, 3 * t + 1, 3 * t + 2};

    if (primitive->source->mode == IRB_GLTF_TRIANGLE_STRIP) {
        corner[0] = t;
        corner[1] = t + 1 + t % 2;
        corner[2] = t + 2 - t % 2;
    } else if (primitive->source->mode == IRB_GLTF_TRIANGLE_FAN) {
        corner[0] = t + 1;
        corner[1] = t + 2;
        corner[2] = 0;
    }
    for (int i = 0; i < 3; i++) {
        size_t from = corner[primitive->mirrored ? 2 - i : i];

        v[i] = primitive->has_indices ? gltf_array_index(&primitive->indices, from) : from;
    }
}

/* Judged on the rounded coordinates that the scene keeps. */
static bool is_degenerate(double p[3][3], double cross[3])
{
    double longest = 0;

    vec_triangle_cross(p[0], p[1], p[2], cross);
    for (int i = 0; i < 3; i++) {
        double edge[3];

        vec_sub(p[(i + 1) % 3], p[i], edge);
        longest = fmax(longest, vec_dot(edge, edge));
    }
    return !(vec_length(cross) > DEGENERATE_RATIO * longest);
}

/* Vertices are shared as in the file. */
static bool add_smooth(struct primitive *primitive, struct irb_error *err)
{
    struct irb_builder *builder = &primitive->loader->builder;
    long bad_before = primitive->loader->bad_normals;

    for (size_t v = 0; v < primitive->position.count; v++) {
        double position[3], normal[3], texcoord[2];

        if (!world_position(primitive, v, position, err) ||
            !texcoord_of(primitive, v, texcoord, err))
            return false;
        world_normal(primitive, v, normal);
        irb_builder_vertex(builder, position, normal, texcoord);
    }
    for (size_t t = 0; t < triangle_count(primitive) && !builder->failure; t++) {
        double p[3][3], cross[3];
        size_t v[3];

        triangle_corners(primitive, t, v);
        for (int i = 0; i < 3; i++) {
            v[i] += primitive->first_vertex;
            vec_from_float(builder->scene->positions + 3 * v[i], p[i]);
        }
        if (is_degenerate(p, cross))
            primitive->loader->degenerate++;
        else
            irb_builder_triangle(builder, (uint32_t)v[0], (uint32_t)v[1], (uint32_t)v[2]);
    }
    if (primitive->loader->bad_normals > bad_before)
        irb_builder_smooth_normals(builder, primitive->first_vertex, primitive->first_triangle,
                                   true);
    return true;
}

/* Every triangle has its own vertices, with its geometric normal. */
static bool add_flat(struct primitive *primitive, struct irb_error *err)
{
    struct irb_builder *builder = &primitive->loader->builder;

    for (size_t t = 0; t < triangle_count(primitive) && !builder->failure; t++) {
        double p[3][3], texcoord[3][2], normal[3];
        uint32_t corner[3];
        size_t v[3];

        triangle_corners(primitive, t, v);
        for (int i = 0; i < 3; i++) {
            if (!world_position(primitive, v[i], p[i], err) ||
                !texcoord_of(primitive, v[i], texcoord[i], err))
                return false;
            for (int axis = 0; axis < 3; axis++)
                p[i][axis] = (float)p[i][axis];
        }
        if (is_degenerate(p, normal)) {
            primitive->loader->degenerate++;
            continue;
        }
        vec_normalize(normal);
        for (int i = 0; i < 3; i++) {
            corner[i] = irb_builder_vertex(builder, p[i], normal, texcoord[i]);
            if (primitive->sources && !builder->failure)
                primitive->sources[corner[i] - primitive->first_vertex] = (uint32_t)v[i];
        }
        irb_builder_triangle(builder, corner[0], corner[1], corner[2]);
    }
    return true;
}

/* Morph targets and skin of the object that its vertices and triangles have become. */
static bool add_deformation(const struct primitive *primitive, struct irb_error *err)
{
    const struct irb_builder *builder = &primitive->loader->builder;
    const struct gltf_surface surface = {
        .source = primitive->source,
        .node = primitive->node,
        .world = primitive->node_world,
        .position = &primitive->position,
        .normal = primitive->has_normal ? &primitive->normal : NULL,
        .sources = primitive->sources,
        .first_vertex = primitive->first_vertex,
    };

    if (builder->failure || builder->scene->triangle_count == primitive->first_triangle)
        return true;
    return gltf_deform(primitive->loader, &surface, err);
}

static bool add_object(struct primitive *primitive, const char *name, int material,
                       struct irb_error *err)
{
    struct gltf_loader *loader = primitive->loader;
    const bool skinned = gltf_has_skin(loader->gltf, primitive->source, primitive->node);
    bool ok;

    primitive->world = skinned ? identity : primitive->node_world;
    primitive->mirrored = vec_normal_matrix(primitive->world, primitive->normal_matrix);
    primitive->deforms = skinned || primitive->source->target_count > 0;
    primitive->first_vertex = loader->builder.scene->vertex_count;
    primitive->first_triangle = loader->builder.scene->triangle_count;
    if (primitive->deforms && !primitive->has_normal) {
        primitive->sources = malloc((3 * triangle_count(primitive) + 1) * sizeof(uint32_t));
        if (!primitive->sources)
            return irb_fail(err, IRB_E_MEMORY, "out of memory");
    }
    irb_builder_object(&loader->builder, name, material);
    ok = primitive->has_normal ? add_smooth(primitive, err) : add_flat(primitive, err);
    ok = ok && (!primitive->deforms || add_deformation(primitive, err));
    free(primitive->sources);
    return ok;
}

static bool add_primitive(struct primitive *primitive, const char *name, struct irb_error *err)
{
    struct gltf_loader *loader = primitive->loader;
    const struct irb_gltf_primitive *source = primitive->source;
    int material;

    if (source->mode < IRB_GLTF_TRIANGLES || source->mode > IRB_GLTF_TRIANGLE_FAN) {
        loader->unlit_primitives++; /* points and lines have no area */
        return true;
    }
    if (!gltf_material(loader, source->material, &material, err) || !open_primitive(primitive, err))
        return false;
    if (source->mode == IRB_GLTF_TRIANGLES && corner_count(primitive) % 3 != 0)
        return irb_fail(err, IRB_E_INPUT, "has %zu corners, expected a multiple of 3",
                        corner_count(primitive));
    return loader->builder.failure /* reported at the end */ ||
           add_object(primitive, name, material, err);
}

bool gltf_mesh(struct gltf_loader *loader, int node, const double world[16], struct irb_error *err)
{
    const char *name = loader->gltf->nodes[node].name;
    const int index = loader->gltf->nodes[node].mesh;
    const struct irb_gltf_mesh *mesh;

    if (index >= loader->gltf->mesh_count)
        return irb_fail(err, IRB_E_INPUT, "mesh %d does not exist (the file has %d)", index,
                        loader->gltf->mesh_count);
    mesh = &loader->gltf->meshes[index];
    for (int i = 0; i < mesh->primitive_count; i++) {
        struct primitive primitive = {
            .loader = loader, .source = &mesh->primitives[i], .node = node, .node_world = world};

        if (!add_primitive(&primitive, name[0] ? name : mesh->name, err))
            return irb_error_prefix(err, "mesh %d '%s' primitive %d", index, mesh->name, i);
    }
    return true;
}
