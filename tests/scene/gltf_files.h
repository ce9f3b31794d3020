/* SPDX-License-Identifier: MIT
 *
 * Writes small glTF files into a temporary folder: one mesh with one primitive, whatever a test
 * wants to get wrong. Include after compare.h.
 */
#ifndef IRB_TESTS_SCENE_GLTF_FILES_H
#define IRB_TESTS_SCENE_GLTF_FILES_H

#include "core/base/fs.h"
#include "core/base/str.h"
#include "core/scene/scene.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* A unit right triangle in the plane z = 0. */
static const float one_triangle[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};

/* An accessor of its own. */
struct test_array {
    const void *data;
    size_t size;
    int component;    /* 5126, ... */
    const char *type; /* "VEC3", ... */
    int count;
};

/* Zero fields give: one_triangle, no indices, TRIANGLES, one node with the mesh, no material. */
struct test_gltf {
    const float *positions, *normals, *texcoords; /* 3, 3 and 2 a vertex */
    int vertices;
    const void *indices;
    int index_count, index_component; /* 5121, 5123, 5125 */
    int mode;                         /* 0: TRIANGLES */
    const char *nodes;                /* contents of "nodes", NULL: {"mesh":0} */
    const char *roots;                /* contents of the scene's "nodes", NULL: 0 */
    const char *primitive;            /* added to the primitive: ",\"material\":0" */
    const char *top;                  /* added at the top level: ",\"materials\":[...]" */
    int claimed_vertices;             /* count written in the accessor, 0: the true one */
    const char *attributes;           /* added to the attributes: ",\"JOINTS_0\":1" */
    const char *mesh;                 /* added to the mesh: ",\"weights\":[1]" */
    const struct test_array *extra;   /* accessors that come after those of the above */
    int extra_count;
};

static char *test_folder(void)
{
    char *folder = irb_strdup("/tmp/irb-scene-XXXXXX");

    if (!mkdtemp(folder))
        fail_msg("no temporary folder");
    return folder;
}

static void remove_folder(char *folder)
{
    DIR *dir = opendir(folder);
    struct dirent *entry;

    while (dir && (entry = readdir(dir))) {
        char *path = irb_asprintf("%s/%s", folder, entry->d_name);

        unlink(path);
        free(path);
    }
    if (dir)
        closedir(dir);
    rmdir(folder);
    free(folder);
}

static void write_file(const char *path, const void *data, size_t size)
{
    struct irb_error err = {0};

    REQUIRE_OK(irb_fs_write(path, data, size, &err));
}

/* JSON of the accessors and views, and the bytes that they describe. */
struct test_arrays {
    struct irb_str accessors, views, bytes;
    int count;
};

static void add_array(struct test_arrays *arrays, const void *data, size_t size, int component,
                      const char *type, int count)
{
    static const char padding[4] = {0};
    const char *comma = arrays->count > 0 ? "," : "";

    irb_str_printf(&arrays->views, "%s{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}", comma,
                   arrays->bytes.length, size);
    irb_str_printf(&arrays->accessors,
                   "%s{\"bufferView\":%d,\"componentType\":%d,\"count\":%d,\"type\":\"%s\"}", comma,
                   arrays->count, component, count, type);
    irb_str_append(&arrays->bytes, data, size);
    irb_str_append(&arrays->bytes, padding, (4 - arrays->bytes.length % 4) % 4);
    arrays->count++;
}

static void add_vertices(const struct test_gltf *gltf, struct test_arrays *arrays,
                         struct irb_str *primitive)
{
    const float *positions = gltf->positions ? gltf->positions : one_triangle;
    int vertices = gltf->vertices ? gltf->vertices : 3;
    size_t n = (size_t)vertices;

    add_array(arrays, positions, n * 12, 5126, "VEC3",
              gltf->claimed_vertices ? gltf->claimed_vertices : vertices);
    irb_str_printf(primitive, "{\"attributes\":{\"POSITION\":0");
    if (gltf->normals) {
        irb_str_printf(primitive, ",\"NORMAL\":%d", arrays->count);
        add_array(arrays, gltf->normals, n * 12, 5126, "VEC3", vertices);
    }
    if (gltf->texcoords) {
        irb_str_printf(primitive, ",\"TEXCOORD_0\":%d", arrays->count);
        add_array(arrays, gltf->texcoords, n * 8, 5126, "VEC2", vertices);
    }
    irb_str_printf(primitive, "%s}", gltf->attributes ? gltf->attributes : "");
}

static void add_indices(const struct test_gltf *gltf, struct test_arrays *arrays,
                        struct irb_str *primitive)
{
    size_t size = gltf->index_component == 5121 ? 1 : gltf->index_component == 5123 ? 2 : 4;

    if (gltf->indices) {
        irb_str_printf(primitive, ",\"indices\":%d", arrays->count);
        add_array(arrays, gltf->indices, (size_t)gltf->index_count * size, gltf->index_component,
                  "SCALAR", gltf->index_count);
    }
}

/* `uri` NULL leaves the buffer to a .glb's second chunk. */
static void make_json(const struct test_gltf *gltf, const char *uri, struct irb_str *json,
                      struct irb_str *bytes)
{
    struct test_arrays arrays = {0};
    struct irb_str primitive = {0};

    add_vertices(gltf, &arrays, &primitive);
    add_indices(gltf, &arrays, &primitive);
    for (int i = 0; i < gltf->extra_count; i++)
        add_array(&arrays, gltf->extra[i].data, gltf->extra[i].size, gltf->extra[i].component,
                  gltf->extra[i].type, gltf->extra[i].count);
    irb_str_printf(&primitive, ",\"mode\":%d%s}", gltf->mode ? gltf->mode : 4,
                   gltf->primitive ? gltf->primitive : "");
    irb_str_printf(json,
                   "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[%s]}],"
                   "\"nodes\":[%s],\"meshes\":[{\"name\":\"shape\",\"primitives\":[%s]%s}],"
                   "\"accessors\":[%s],\"bufferViews\":[%s],\"buffers\":[{\"byteLength\":%zu",
                   gltf->roots ? gltf->roots : "0", gltf->nodes ? gltf->nodes : "{\"mesh\":0}",
                   irb_str_text(&primitive), gltf->mesh ? gltf->mesh : "",
                   irb_str_text(&arrays.accessors), irb_str_text(&arrays.views),
                   arrays.bytes.length);
    if (uri)
        irb_str_printf(json, ",\"uri\":\"%s\"", uri);
    irb_str_printf(json, "}]%s}", gltf->top ? gltf->top : "");
    *bytes = arrays.bytes;
    irb_str_free(&arrays.accessors);
    irb_str_free(&arrays.views);
    irb_str_free(&primitive);
}

/* folder/shape.gltf and folder/shape.bin; the path of the first, which the caller frees. */
__attribute__((unused)) static char *write_gltf(const char *folder, const struct test_gltf *gltf)
{
    char *path = irb_asprintf("%s/shape.gltf", folder), *bin = irb_asprintf("%s/shape.bin", folder);
    struct irb_str json = {0}, bytes;

    make_json(gltf, "shape.bin", &json, &bytes);
    write_file(path, json.text, json.length);
    write_file(bin, bytes.text, bytes.length);
    irb_str_free(&json);
    irb_str_free(&bytes);
    free(bin);
    return path;
}

static void append_u32(struct irb_str *str, size_t value)
{
    unsigned char bytes[4] = {(unsigned char)value, (unsigned char)(value >> 8),
                              (unsigned char)(value >> 16), (unsigned char)(value >> 24)};

    irb_str_append(str, (const char *)bytes, 4);
}

/* folder/shape.glb, cut to its first `keep` bytes (0: all). */
__attribute__((unused)) static char *write_glb(const char *folder, const struct test_gltf *gltf,
                                               size_t keep)
{
    char *path = irb_asprintf("%s/shape.glb", folder);
    struct irb_str json = {0}, bytes, file = {0};

    make_json(gltf, NULL, &json, &bytes);
    irb_str_append(&json, "   ", (4 - json.length % 4) % 4);
    irb_str_append(&file, "glTF", 4);
    append_u32(&file, 2);
    append_u32(&file, 12 + 8 + json.length + 8 + bytes.length);
    append_u32(&file, json.length);
    irb_str_append(&file, "JSON", 4);
    irb_str_append(&file, json.text, json.length);
    append_u32(&file, bytes.length);
    irb_str_append(&file, "BIN\0", 4);
    irb_str_append(&file, bytes.text, bytes.length);
    write_file(path, file.text, keep > 0 && keep < file.length ? keep : file.length);
    irb_str_free(&json);
    irb_str_free(&bytes);
    irb_str_free(&file);
    return path;
}

#endif
