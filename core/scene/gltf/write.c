/* SPDX-License-Identifier: MIT */
#include "core/scene/gltf/write.h"

#include "core/base/fs.h"
#include "core/base/str.h"
#include "core/image/imageio.h"
#include "core/scene/camera.h"
#include "core/scene/vec.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* glTF's spot falls off between two angles; this share of the outer one is as good as a step. */
#define HARD_EDGE 0.999

enum { GLB_MAGIC = 0x46546c67, GLB_JSON = 0x4e4f534a, GLB_BIN = 0x004e4942 };
enum { ARRAY_BUFFER = 34962, ELEMENT_ARRAY_BUFFER = 34963 };

struct writer {
    const struct irb_scene *scene;
    struct irb_str bin, views, accessors, meshes, nodes, images;
    int view_count, node_count;
    uint32_t *place;    /* of a scene's vertex in the object that is written */
    uint32_t *vertices; /* the scene's vertices that the object uses, in order of first use */
    bool *used;
};

/* ---- Pieces of JSON ---- */

/* Nine digits bring every float back exactly. */
static void numbers(struct irb_str *out, const double *values, int count)
{
    for (int i = 0; i < count; i++)
        irb_str_printf(out, "%s%.9g", i > 0 ? "," : "[", values[i]);
    irb_str_printf(out, "]");
}

static const char *comma(const struct irb_str *list)
{
    return list->length > 0 ? ",\n" : "";
}

/* Appends bytes, padded to 4, and a view on them; its index. */
static int add_view(struct writer *writer, const void *data, size_t size, int target)
{
    size_t offset = writer->bin.length;

    irb_str_append(&writer->bin, data, size);
    irb_str_append(&writer->bin, "\0\0\0", (4 - size % 4) % 4);
    irb_str_printf(&writer->views, "%s{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu",
                   comma(&writer->views), offset, size);
    if (target)
        irb_str_printf(&writer->views, ",\"target\":%d", target);
    irb_str_printf(&writer->views, "}");
    return writer->view_count++;
}

/* ---- Meshes ---- */

/* A float attribute of the object's `count` vertices; positions get the bounds that glTF wants. */
static bool add_attribute(struct writer *writer, const float *values, int components,
                          uint32_t count)
{
    float *packed = malloc((size_t)count * (size_t)components * sizeof *packed);
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    int view;

    if (!packed)
        return false;
    for (uint32_t v = 0; v < count; v++)
        for (int c = 0; c < components; c++) {
            float value = values[(size_t)components * writer->vertices[v] + (size_t)c];

            packed[(size_t)components * v + (size_t)c] = value;
            low[c] = fmin(low[c], value);
            high[c] = fmax(high[c], value);
        }
    view =
        add_view(writer, packed, (size_t)count * (size_t)components * sizeof *packed, ARRAY_BUFFER);
    free(packed);
    irb_str_printf(&writer->accessors,
                   "%s{\"bufferView\":%d,\"componentType\":5126,\"count\":%u,\"type\":\"VEC%d\"",
                   comma(&writer->accessors), view, count, components);
    if (values == irb_scene_current_positions(writer->scene)) {
        irb_str_printf(&writer->accessors, ",\"min\":");
        numbers(&writer->accessors, low, 3);
        irb_str_printf(&writer->accessors, ",\"max\":");
        numbers(&writer->accessors, high, 3);
    }
    irb_str_printf(&writer->accessors, "}");
    return true;
}

/* Renumbers the vertices that the object uses; writes its indices; the number of vertices. */
static bool add_indices(struct writer *writer, const struct irb_object *object, uint32_t *count)
{
    const uint32_t *index = writer->scene->indices + 3 * (size_t)object->first_triangle;
    size_t corners = 3 * (size_t)object->triangle_count;
    uint32_t *packed = malloc(corners * sizeof *packed);

    if (!packed)
        return false;
    *count = 0;
    for (size_t i = 0; i < corners; i++) {
        if (!writer->used[index[i]]) {
            writer->used[index[i]] = true;
            writer->place[index[i]] = *count;
            writer->vertices[(*count)++] = index[i];
        }
        packed[i] = writer->place[index[i]];
    }
    for (uint32_t v = 0; v < *count; v++)
        writer->used[writer->vertices[v]] = false;
    irb_str_printf(&writer->accessors,
                   "%s{\"bufferView\":%d,\"componentType\":5125,\"count\":%zu,\"type\":\"SCALAR\"}",
                   comma(&writer->accessors),
                   add_view(writer, packed, corners * sizeof *packed, ELEMENT_ARRAY_BUFFER),
                   corners);
    free(packed);
    return true;
}

static void add_node(struct writer *writer, const char *name, const double matrix[16],
                     const char *what)
{
    irb_str_printf(&writer->nodes, "%s{\"name\":", comma(&writer->nodes));
    irb_str_json_string(&writer->nodes, name);
    if (matrix) {
        irb_str_printf(&writer->nodes, ",\"matrix\":");
        numbers(&writer->nodes, matrix, 16);
    }
    irb_str_printf(&writer->nodes, ",%s}", what);
    writer->node_count++;
}

static bool add_object(struct writer *writer, int number)
{
    static const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const struct irb_scene *scene = writer->scene;
    const struct irb_object *object = &scene->objects[number];
    double matrix[16];
    char mesh[32];
    uint32_t count;

    if (!add_indices(writer, object, &count) || /* accessor 4 number, then the attributes */
        !add_attribute(writer, irb_scene_current_positions(scene), 3, count) ||
        !add_attribute(writer, irb_scene_current_normals(scene), 3, count) ||
        !add_attribute(writer, scene->texcoords, 2, count))
        return false;
    irb_str_printf(&writer->meshes, "%s{\"name\":", comma(&writer->meshes));
    irb_str_json_string(&writer->meshes, object->name);
    irb_str_printf(&writer->meshes,
                   ",\"primitives\":[{\"indices\":%d,\"attributes\":{\"POSITION\":%d,\"NORMAL\":%d,"
                   "\"TEXCOORD_0\":%d},\"material\":%d}]}",
                   4 * number, 4 * number + 1, 4 * number + 2, 4 * number + 3, object->material);
    for (int i = 0; i < 16; i++)
        matrix[i] = object->transform[i];
    snprintf(mesh, sizeof mesh, "\"mesh\":%d", number);
    add_node(writer, object->name,
             memcmp(object->transform, identity, sizeof identity) == 0 ? NULL : matrix, mesh);
    return true;
}

/* ---- Materials and textures ---- */

static void write_materials(const struct irb_scene *scene, struct irb_str *out)
{
    irb_str_printf(out, ",\n\"materials\":[");
    for (int i = 0; i < scene->material_count; i++) {
        const struct irb_material *material = &scene->materials[i];
        const double colour[4] = {material->diffuse[0], material->diffuse[1], material->diffuse[2],
                                  1};

        irb_str_printf(out, "%s{\"name\":", i > 0 ? ",\n" : "\n");
        irb_str_json_string(out, material->name);
        irb_str_printf(out, ",\"doubleSided\":true,\"pbrMetallicRoughness\":{\"baseColorFactor\":");
        numbers(out, colour, 4);
        irb_str_printf(out, ",\"metallicFactor\":0,\"roughnessFactor\":1");
        if (material->diffuse_texture >= 0)
            irb_str_printf(out, ",\"baseColorTexture\":{\"index\":%d}", material->diffuse_texture);
        irb_str_printf(out, "}}");
    }
    irb_str_printf(out, "]");
}

static bool add_image(struct writer *writer, int number, struct irb_error *err)
{
    const struct irb_scene_texture *texture = &writer->scene->textures[number];
    unsigned char *png;
    size_t size;

    if (!irb_png_encode(texture->name, texture->rgba, texture->width, texture->height, &png, &size,
                        err))
        return false;
    irb_str_printf(&writer->images, "%s{\"mimeType\":\"image/png\",\"bufferView\":%d,\"name\":",
                   comma(&writer->images), add_view(writer, png, size, 0));
    irb_str_json_string(&writer->images, texture->name);
    irb_str_printf(&writer->images, "}");
    free(png);
    return true;
}

/* ---- Camera and light ---- */

/* A frame that looks along -z. */
static void frame_matrix(const double right[3], const double up[3], const double forward[3],
                         const float position[3], double out[16])
{
    memset(out, 0, 16 * sizeof *out);
    for (int i = 0; i < 3; i++) {
        out[i] = right[i];
        out[4 + i] = up[i];
        out[8 + i] = -forward[i];
        out[12 + i] = position[i];
    }
    out[15] = 1;
}

static void add_camera(struct writer *writer, const struct irb_camera *camera, struct irb_str *out)
{
    double forward[3], right[3], up[3], matrix[16];

    camera_axes(camera, right, up, forward);
    frame_matrix(right, up, forward, camera->position, matrix);
    add_node(writer, "camera", matrix, "\"camera\":0");
    irb_str_printf(out,
                   ",\n\"cameras\":[{\"name\":\"camera\",\"type\":\"perspective\",\"perspective\":"
                   "{\"yfov\":%.9g,\"znear\":%.9g",
                   camera->vertical_fov, camera->z_near);
    if (camera->z_far > camera->z_near) /* else infinite */
        irb_str_printf(out, ",\"zfar\":%.9g", camera->z_far);
    irb_str_printf(out, "}}]");
}

static void add_light(struct writer *writer, const struct irb_light *light, struct irb_str *out)
{
    const float *rgb = light->intensity;
    double peak = fmax(rgb[0], fmax(rgb[1], rgb[2])), scale = peak > 0 ? 1 / peak : 0;
    const double colour[3] = {rgb[0] * scale, rgb[1] * scale, rgb[2] * scale};
    bool spot = light->type == IRB_LIGHT_SPOT;
    float basis[2][3];
    double right[3], up[3], direction[3], matrix[16];

    irb_light_basis(light, basis[0], basis[1]);
    vec_from_float(basis[0], right);
    vec_from_float(basis[1], up);
    vec_from_float(light->direction, direction);
    frame_matrix(right, up, direction, light->position, matrix);
    add_node(writer, "light", matrix, "\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}");
    irb_str_printf(out,
                   ",\n\"extensionsUsed\":[\"KHR_lights_punctual\"],\n\"extensions\":"
                   "{\"KHR_lights_punctual\":{\"lights\":[{\"name\":\"light\",\"type\":\"%s\","
                   "\"color\":",
                   irb_light_type_names[light->type]);
    numbers(out, colour, 3);
    irb_str_printf(out, ",\"intensity\":%.9g", peak);
    if (spot)
        irb_str_printf(out,
                       ",\"spot\":{\"innerConeAngle\":%.9g,\"outerConeAngle\":%.9g},\"extras\":"
                       "{\"falloff\":\"%s\"}}]}}",
                       light->falloff == IRB_FALLOFF_SMOOTH ? light->inner
                                                            : HARD_EDGE * light->outer,
                       light->outer, irb_falloff_names[light->falloff]);
    else
        irb_str_printf(out, ",\"extras\":{\"half_width\":%.9g}}]}}", light->half_width);
}

/* ---- The file ---- */

static bool add_all(struct writer *writer, struct irb_error *err)
{
    for (int i = 0; i < writer->scene->object_count; i++)
        if (!add_object(writer, i))
            return irb_fail(err, IRB_E_MEMORY, "out of memory");
    for (int i = 0; i < writer->scene->texture_count; i++)
        if (!add_image(writer, i, err))
            return false;
    return true;
}

static void write_json(struct writer *writer, const struct irb_camera *camera,
                       const struct irb_light *light, struct irb_str *json)
{
    irb_str_printf(json, "{\"asset\":{\"version\":\"2.0\",\"generator\":\"irbench\"}");
    write_materials(writer->scene, json);
    if (camera)
        add_camera(writer, camera, json);
    if (light)
        add_light(writer, light, json);
    if (writer->images.length > 0) {
        irb_str_printf(json, ",\n\"textures\":[");
        for (int i = 0; i < writer->scene->texture_count; i++)
            irb_str_printf(json, "%s{\"source\":%d}", i > 0 ? "," : "", i);
        irb_str_printf(json, "],\n\"images\":[%s]", writer->images.text);
    }
    irb_str_printf(json, ",\n\"scene\":0,\"scenes\":[{\"name\":");
    irb_str_json_string(json, writer->scene->name);
    irb_str_printf(json, ",\"nodes\":[");
    for (int i = 0; i < writer->node_count; i++)
        irb_str_printf(json, "%s%d", i > 0 ? "," : "", i);
    irb_str_printf(json, "]}],\n\"nodes\":[\n%s],\n\"meshes\":[\n%s],\n\"accessors\":[\n%s],\n",
                   irb_str_text(&writer->nodes), irb_str_text(&writer->meshes),
                   irb_str_text(&writer->accessors));
    irb_str_printf(json, "\"bufferViews\":[\n%s],\n\"buffers\":[{\"byteLength\":%zu}]}\n",
                   irb_str_text(&writer->views), writer->bin.length);
    irb_str_append(json, "   ", (4 - json->length % 4) % 4);
}

static void append_u32(struct irb_str *out, uint32_t value)
{
    const char bytes[4] = {(char)(value & 255), (char)(value >> 8 & 255), (char)(value >> 16 & 255),
                           (char)(value >> 24)};

    irb_str_append(out, bytes, 4);
}

static bool write_glb(const char *path, const struct irb_str *json, const struct irb_str *bin,
                      struct irb_error *err)
{
    size_t size = 12 + 8 + json->length + 8 + bin->length;
    struct irb_str file = {0};
    bool ok;

    if (size > UINT32_MAX)
        return irb_fail(err, IRB_E_INPUT, "would have %zu bytes, a .glb at most %u", size,
                        UINT32_MAX);
    append_u32(&file, GLB_MAGIC);
    append_u32(&file, 2);
    append_u32(&file, (uint32_t)size);
    append_u32(&file, (uint32_t)json->length);
    append_u32(&file, GLB_JSON);
    irb_str_append(&file, json->text, json->length);
    append_u32(&file, (uint32_t)bin->length);
    append_u32(&file, GLB_BIN);
    irb_str_append(&file, irb_str_text(bin), bin->length);
    ok = irb_fs_write(path, file.text, file.length, err);
    irb_str_free(&file);
    return ok;
}

static void free_writer(struct writer *writer)
{
    struct irb_str *strings[] = {&writer->bin,    &writer->views, &writer->accessors,
                                 &writer->meshes, &writer->nodes, &writer->images};

    for (size_t i = 0; i < sizeof strings / sizeof *strings; i++)
        irb_str_free(strings[i]);
    free(writer->place);
    free(writer->vertices);
    free(writer->used);
}

bool irb_scene_export(const struct irb_scene *scene, const struct irb_camera *camera,
                      const struct irb_light *light, const char *path, struct irb_error *err)
{
    size_t count = (size_t)scene->vertex_count + 1;
    struct writer writer = {.scene = scene,
                            .place = malloc(count * sizeof(uint32_t)),
                            .vertices = malloc(count * sizeof(uint32_t)),
                            .used = calloc(count, sizeof(bool))};
    struct irb_str json = {0};
    bool ok;

    if (!writer.place || !writer.vertices || !writer.used)
        ok = irb_fail(err, IRB_E_MEMORY, "%s: out of memory", path);
    else if (!add_all(&writer, err))
        ok = irb_error_prefix(err, "%s", path);
    else {
        write_json(&writer, camera, light, &json);
        ok = write_glb(path, &json, &writer.bin, err);
    }
    irb_str_free(&json);
    free_writer(&writer);
    return ok;
}
