/* SPDX-License-Identifier: MIT */
#include "core/frame/scene_gl.h"

#include "core/scene/deform.h"

#include <math.h>
#include <stdlib.h>

enum { ATTRIBUTES = 3, FLAT_NORMALS_BINDING = 0, DIFFUSE_MAP_UNIT = 0 };

/* Unit normals of `count` triangles in double precision, rounded once. Zero for degenerate ones,
 * which cover no pixel. */
static float *make_flat_normals(const struct irb_scene *scene, uint32_t first, uint32_t count)
{
    const float *positions = irb_scene_current_positions(scene);
    float *out = calloc((size_t)count + 1, 4 * sizeof *out);
    for (uint32_t t = 0; out && t < count; t++) {
        const uint32_t *index = scene->indices + 3 * ((size_t)first + t);
        const float *corner[3];
        double u[3], v[3], n[3], length;
        for (int i = 0; i < 3; i++)
            corner[i] = positions + 3 * (size_t)index[i];
        for (int i = 0; i < 3; i++) {
            u[i] = (double)corner[1][i] - corner[0][i];
            v[i] = (double)corner[2][i] - corner[0][i];
        }
        n[0] = u[1] * v[2] - u[2] * v[1];
        n[1] = u[2] * v[0] - u[0] * v[2];
        n[2] = u[0] * v[1] - u[1] * v[0];
        length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (int i = 0; i < 3 && length > 0; i++)
            out[4 * (size_t)t + (size_t)i] = (float)(n[i] / length);
    }
    return out;
}

static bool create_buffers(struct irb_scene_gl *out, struct irb_error *err)
{
    const struct irb_scene *scene = out->scene;
    const int64_t vertices = scene->vertex_count, triangles = scene->triangle_count;
    float *flat = make_flat_normals(scene, 0, scene->triangle_count);
    if (!flat)
        return irb_fail(err, IRB_E_MEMORY, "scene '%s': out of memory for %u triangle normals",
                        scene->name, scene->triangle_count);
    out->positions = irb_buffer_create(out->gl, "scene: positions", vertices * 12,
                                       irb_scene_current_positions(scene), err);
    out->normals = out->positions ? irb_buffer_create(out->gl, "scene: normals", vertices * 12,
                                                      irb_scene_current_normals(scene), err)
                                  : NULL;
    out->texcoords = out->normals ? irb_buffer_create(out->gl, "scene: texcoords", vertices * 8,
                                                      scene->texcoords, err)
                                  : NULL;
    out->indices = out->texcoords ? irb_buffer_create(out->gl, "scene: indices", triangles * 12,
                                                      scene->indices, err)
                                  : NULL;
    out->flat_normals =
        out->indices ? irb_buffer_create(out->gl, "scene: flat normals", triangles * 16, flat, err)
                     : NULL;
    free(flat);
    return out->flat_normals != NULL;
}

static void create_vertex_array(struct irb_scene_gl *out)
{
    const struct irb_gl_api *api = &out->gl->api;
    const struct irb_buffer *const buffers[ATTRIBUTES] = {out->positions, out->normals,
                                                          out->texcoords};
    static const GLint sizes[ATTRIBUTES] = {3, 3, 2};

    api->CreateVertexArrays(1, &out->vertex_array);
    for (GLuint i = 0; i < ATTRIBUTES; i++) {
        api->VertexArrayVertexBuffer(out->vertex_array, i, buffers[i]->id, 0,
                                     sizes[i] * (GLsizei)sizeof(float));
        api->EnableVertexArrayAttrib(out->vertex_array, i);
        api->VertexArrayAttribFormat(out->vertex_array, i, sizes[i], GL_FLOAT, GL_FALSE, 0);
        api->VertexArrayAttribBinding(out->vertex_array, i, i);
    }
    api->VertexArrayElementBuffer(out->vertex_array, out->indices->id);
}

static int mip_levels(int width, int height)
{
    int levels = 1;
    for (int side = width > height ? width : height; side > 1; side /= 2)
        levels++;
    return levels;
}

/* Rows as they are stored: row 0 is glTF's v = 0, which is GL's. */
static struct irb_texture *create_texture(struct irb_gl *gl, const struct irb_scene_texture *image,
                                          struct irb_error *err)
{
    struct irb_texture *texture = irb_texture_create(
        gl,
        &(struct irb_texture_desc){.name = image->name,
                                   .format = GL_SRGB8_ALPHA8,
                                   .width = image->width,
                                   .height = image->height,
                                   .levels = mip_levels(image->width, image->height),
                                   .linear = true,
                                   .repeat = true},
        err);
    if (!texture)
        return NULL;
    gl->api.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    gl->api.TextureSubImage2D(texture->id, 0, 0, 0, image->width, image->height, GL_RGBA,
                              GL_UNSIGNED_BYTE, image->rgba);
    gl->api.GenerateTextureMipmap(texture->id);
    return texture;
}

static bool create_textures(struct irb_scene_gl *out, struct irb_error *err)
{
    const struct irb_scene *scene = out->scene;
    if (!scene->texture_count)
        return true;
    out->textures = calloc((size_t)scene->texture_count, sizeof *out->textures);
    if (!out->textures)
        return irb_fail(err, IRB_E_MEMORY, "scene '%s': out of memory", scene->name);
    for (int i = 0; i < scene->texture_count; i++) {
        out->textures[i] = create_texture(out->gl, &scene->textures[i], err);
        if (!out->textures[i])
            return irb_error_prefix(err, "scene '%s'", scene->name);
    }
    return true;
}

/* ---- What deforms ---- */

static bool note_versions(struct irb_scene_gl *out, struct irb_error *err)
{
    const struct irb_deform *deform = out->scene->deform;
    if (!deform)
        return true;
    out->versions = calloc((size_t)deform->object_count, sizeof *out->versions);
    if (!out->versions)
        return irb_fail(err, IRB_E_MEMORY, "scene '%s': out of memory", out->scene->name);
    for (int i = 0; i < deform->object_count; i++)
        out->versions[i] = deform->objects[i].version;
    return true;
}

static bool upload_object(struct irb_scene_gl *out, const struct irb_deform_object *changed,
                          struct irb_error *err)
{
    const struct irb_scene *scene = out->scene;
    const struct irb_object *object = &scene->objects[changed->object];
    const size_t first = 3 * (size_t)changed->first_vertex;
    const int64_t offset = (int64_t)changed->first_vertex * 12;
    const int64_t bytes = (int64_t)changed->vertex_count * 12;
    float *flat = make_flat_normals(scene, object->first_triangle, object->triangle_count);
    if (!flat)
        return irb_fail(err, IRB_E_MEMORY, "scene '%s': out of memory for %u triangle normals",
                        scene->name, object->triangle_count);
    bool ok = irb_buffer_write(out->positions, offset, bytes,
                               irb_scene_current_positions(scene) + first, err) &&
              irb_buffer_write(out->normals, offset, bytes,
                               irb_scene_current_normals(scene) + first, err) &&
              irb_buffer_write(out->flat_normals, (int64_t)object->first_triangle * 16,
                               (int64_t)object->triangle_count * 16, flat, err);
    free(flat);
    return ok;
}

bool irb_scene_gl_update(struct irb_scene_gl *scene, struct irb_error *err)
{
    const struct irb_deform *deform = scene->scene->deform;
    for (int i = 0; deform && i < deform->object_count; i++) {
        if (scene->versions[i] == deform->objects[i].version)
            continue;
        if (!upload_object(scene, &deform->objects[i], err))
            return false;
        scene->versions[i] = deform->objects[i].version;
    }
    return true;
}

/* ---- The whole scene ---- */

struct irb_scene_gl *irb_scene_gl_create(struct irb_gl *gl, const struct irb_scene *scene,
                                         struct irb_error *err)
{
    struct irb_scene_gl *out = calloc(1, sizeof *out);
    if (!out) {
        irb_fail(err, IRB_E_MEMORY, "out of memory");
        return NULL;
    }
    out->scene = scene;
    out->gl = gl;
    for (int i = 0; i < scene->material_count; i++)
        out->masked = out->masked || scene->materials[i].alpha_cutoff > 0;
    if (create_buffers(out, err) && create_textures(out, err) && note_versions(out, err)) {
        create_vertex_array(out);
        if (irb_gl_check(gl, "scene: upload", err))
            return out;
    }
    irb_scene_gl_destroy(out);
    return NULL;
}

void irb_scene_gl_destroy(struct irb_scene_gl *scene)
{
    if (!scene)
        return;
    for (int i = 0; scene->textures && i < scene->scene->texture_count; i++)
        irb_texture_destroy(scene->textures[i]);
    free(scene->textures);
    free(scene->versions);
    irb_buffer_destroy(scene->positions);
    irb_buffer_destroy(scene->normals);
    irb_buffer_destroy(scene->texcoords);
    irb_buffer_destroy(scene->indices);
    irb_buffer_destroy(scene->flat_normals);
    if (scene->vertex_array)
        scene->gl->api.DeleteVertexArrays(1, &scene->vertex_array);
    free(scene);
}

/* Cofactors of the upper 3x3: the inverse transpose up to a factor, which normalising removes, and
 * defined for singular matrices too. Scaled to the largest entry against under- and overflow. */
static void normal_matrix_of(const float model[16], float out[16])
{
    double cofactor[3][3], largest = 0;
    for (int c = 0; c < 3; c++)
        for (int r = 0; r < 3; r++) {
            const float *u = model + 4 * ((c + 1) % 3), *v = model + 4 * ((c + 2) % 3);
            int p = (r + 1) % 3, q = (r + 2) % 3;
            cofactor[c][r] = (double)u[p] * v[q] - (double)u[q] * v[p];
            largest = fmax(largest, fabs(cofactor[c][r]));
        }
    for (int i = 0; i < 16; i++)
        out[i] = i == 15;
    for (int c = 0; c < 3 && largest > 0; c++)
        for (int r = 0; r < 3; r++)
            out[4 * c + r] = (float)(cofactor[c][r] / largest);
}

static void draw_object(const struct irb_scene_gl *scene, const struct irb_object *object,
                        const struct irb_program *program, int instances)
{
    const struct irb_gl_api *api = &scene->gl->api;
    const struct irb_material *material = &scene->scene->materials[object->material];
    const bool mapped = material->diffuse_texture >= 0;
    const float specular[4] = {material->specular[0], material->specular[1], material->specular[2],
                               material->exponent};
    float normal_matrix[16];

    normal_matrix_of(object->transform, normal_matrix);
    irb_program_mat4(program, "model", object->transform);
    irb_program_mat4(program, "normal_matrix", normal_matrix);
    irb_program_int(program, "first_triangle", (int)object->first_triangle);
    irb_program_vec3(program, "material_diffuse", material->diffuse);
    irb_program_vec4(program, "material_specular", specular);
    irb_program_int(program, "has_diffuse_map", mapped);
    api->BindTextureUnit(DIFFUSE_MAP_UNIT,
                         mapped ? scene->textures[material->diffuse_texture]->id : 0);
    api->DrawElementsInstanced(GL_TRIANGLES, (GLsizei)object->triangle_count * 3, GL_UNSIGNED_INT,
                               (const char *)NULL + (size_t)object->first_triangle * 12, instances);
}

static void draw_objects(const struct irb_scene_gl *scene, const struct irb_program *program,
                         bool masked, int instances)
{
    irb_program_use(program);
    irb_program_int(program, "diffuse_map", DIFFUSE_MAP_UNIT);
    for (int i = 0; i < scene->scene->object_count; i++) {
        const struct irb_object *object = &scene->scene->objects[i];
        const struct irb_material *material = &scene->scene->materials[object->material];
        if (!object->triangle_count || (material->alpha_cutoff > 0) != masked)
            continue;
        if (masked)
            irb_program_float(program, "alpha_cutoff", material->alpha_cutoff);
        draw_object(scene, object, program, instances);
    }
}

void irb_scene_gl_draw(const struct irb_scene_gl *scene, const struct irb_surface_program *program)
{
    scene->gl->api.Disable(GL_BLEND);
    irb_scene_gl_draw_instances(scene, program, 1);
}

void irb_scene_gl_draw_instances(const struct irb_scene_gl *scene,
                                 const struct irb_surface_program *program, int instances)
{
    const struct irb_gl_api *api = &scene->gl->api;

    api->Disable(GL_CULL_FACE);
    api->Disable(GL_SCISSOR_TEST);
    api->Disable(GL_STENCIL_TEST);
    api->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    api->PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, FLAT_NORMALS_BINDING, scene->flat_normals->id);
    api->BindVertexArray(scene->vertex_array);
    draw_objects(scene, program->opaque, false, instances);
    if (scene->masked)
        draw_objects(scene, program->masked, true, instances);
    api->BindVertexArray(0);
}

/* ---- Programs ---- */

bool irb_surface_program_create(struct irb_surface_program *out, struct irb_gl *gl,
                                const char *name, const char *fragment, struct irb_error *err)
{
    const struct irb_program_desc stages = {
        .name = name, .vertex = "frame/geometry.vert", .fragment = fragment};
    return irb_surface_program_create_stages(out, gl, &stages, err);
}

bool irb_surface_program_create_stages(struct irb_surface_program *out, struct irb_gl *gl,
                                       const struct irb_program_desc *stages, struct irb_error *err)
{
    *out = (struct irb_surface_program){.stages = *stages};
    out->opaque = irb_program_create(gl, stages, err);
    return out->opaque != NULL;
}

void irb_surface_program_destroy(struct irb_surface_program *program)
{
    irb_program_destroy(program->opaque);
    irb_program_destroy(program->masked);
    *program = (struct irb_surface_program){0};
}

bool irb_surface_program_prepare(struct irb_surface_program *program,
                                 const struct irb_scene_gl *scene, struct irb_error *err)
{
    static const char *const defines[] = {"ALPHA_MASK 1", NULL};
    struct irb_program_desc desc = program->stages;
    desc.defines = defines;
    if (scene->masked && !program->masked)
        program->masked = irb_program_create(scene->gl, &desc, err);
    return !scene->masked || program->masked;
}
