/* SPDX-License-Identifier: MIT */
#include "core/scene/gltf_load.h"

#include "core/base/fs.h"
#include "core/base/str.h"
#include "core/scene/vec.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A .glb counts its bytes in 32 bits. */
#define MAX_FILE_SIZE ((size_t)1 << 32)
/* Parsers recurse over JSON, so its depth is bounded before they see it. Scenes need about 8. */
enum { MAX_JSON_DEPTH = 128 };
enum { GLB_HEADER = 12, GLB_CHUNK_HEADER = 8 };

/* ---- Before tinygltf sees the file ---- */

static uint32_t u32_at(const char *data, size_t offset)
{
    const unsigned char *p = (const unsigned char *)data + offset;

    return p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

static bool check_json_depth(const char *json, size_t size, struct irb_error *err)
{
    bool in_string = false;
    int depth = 0;

    for (size_t i = 0; i < size; i++) {
        char c = json[i];

        if (in_string && c == '\\')
            i++;
        else if (c == '"')
            in_string = !in_string;
        else if (!in_string && (c == '{' || c == '['))
            depth++;
        else if (!in_string && (c == '}' || c == ']'))
            depth--;
        if (depth > MAX_JSON_DEPTH)
            return irb_fail(err, IRB_E_INPUT, "JSON is nested deeper than %d levels",
                            MAX_JSON_DEPTH);
    }
    return true;
}

static bool check_glb(const char *data, size_t size, struct irb_error *err)
{
    uint32_t length, json_length;

    if (size < GLB_HEADER + GLB_CHUNK_HEADER)
        return irb_fail(err, IRB_E_INPUT, "truncated: %zu bytes, a .glb has at least %d", size,
                        GLB_HEADER + GLB_CHUNK_HEADER);
    if (u32_at(data, 4) != 2)
        return irb_fail(err, IRB_E_INPUT, "glTF version %u, expected 2", u32_at(data, 4));
    length = u32_at(data, 8);
    if (length > size)
        return irb_fail(err, IRB_E_INPUT, "truncated: the header says %u bytes, the file has %zu",
                        length, size);
    json_length = u32_at(data, GLB_HEADER);
    if (json_length > size - GLB_HEADER - GLB_CHUNK_HEADER)
        return irb_fail(err, IRB_E_INPUT,
                        "the JSON chunk claims %u bytes, more than the file of %zu", json_length,
                        size);
    return check_json_depth(data + GLB_HEADER + GLB_CHUNK_HEADER, json_length, err);
}

static char *folder_of(const char *path)
{
    const char *slash = strrchr(path, '/');

    if (!slash)
        return irb_strdup(".");
    return irb_asprintf("%.*s/.", (int)(slash - path), path); /* "/." where path is "/x.glb" */
}

static const struct irb_gltf *read_gltf(const char *path, struct irb_error *err)
{
    const struct irb_gltf *gltf = NULL;
    char *data, *folder;
    size_t size;
    bool binary;

    if (!irb_fs_read(path, MAX_FILE_SIZE - 1, &data, &size, err))
        return NULL;
    folder = folder_of(path);
    binary = size >= 4 && memcmp(data, "glTF", 4) == 0;
    if (size == 0)
        irb_fail(err, IRB_E_INPUT, "%s: the file is empty", path);
    else if (binary ? !check_glb(data, size, err) : !check_json_depth(data, size, err))
        irb_error_prefix(err, "%s", path);
    else if (!(gltf = irb_gltf_parse(data, size, binary, folder, err)))
        irb_error_prefix(err, "%s", path);
    free(folder);
    free(data);
    return gltf;
}

/* ---- What the file asks for ---- */

/* Extensions that change nothing that is read here, or whose loss is warned about. */
static bool extension_is_known(const char *name)
{
    static const char *const known[] = {"KHR_lights_punctual", "KHR_mesh_quantization",
                                        "KHR_texture_transform"};

    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strcmp(name, known[i]) == 0)
            return true;
    return strncmp(name, "KHR_materials_", 14) == 0;
}

static bool check_asset(const struct irb_gltf *gltf, struct irb_error *err)
{
    if (strncmp(gltf->version, "2.", 2) != 0)
        return irb_fail(err, IRB_E_INPUT, "glTF version '%s', expected 2.0", gltf->version);
    for (int i = 0; i < gltf->required_count; i++)
        if (!extension_is_known(gltf->required[i]))
            return irb_fail(err, IRB_E_INPUT, "requires the extension %s, which is not supported",
                            gltf->required[i]);
    return true;
}

static void warn_about_dropped(const struct gltf_loader *loader)
{
    const struct irb_gltf *gltf = loader->gltf;

    if (gltf->remark[0])
        irb_warn(loader->log, "%s: %s", loader->path, gltf->remark);
    for (int i = 0; i < gltf->light_count; i++)
        irb_warn(loader->log,
                 "%s: light %d '%s' (%s) is dropped, the light comes from the "
                 "experiment",
                 loader->path, i, gltf->lights[i].name, gltf->lights[i].type);
    for (int i = 0; i < gltf->used_count; i++)
        if (strstr(gltf->used[i], "lights_image_based"))
            irb_warn(loader->log, "%s: environment light (%s) is dropped", loader->path,
                     gltf->used[i]);
    if (gltf->camera_count > 0)
        irb_warn(loader->log, "%s: %d cameras are dropped, the camera comes from the experiment",
                 loader->path, gltf->camera_count);
    if (gltf->animation_count > 0)
        irb_warn(loader->log, "%s: %d animations are dropped, the scene stays at rest",
                 loader->path, gltf->animation_count);
}

static void warn_about_counts(const struct gltf_loader *loader)
{
    const char *path = loader->path;

    if (loader->degenerate > 0)
        irb_warn(loader->log, "%s: %ld degenerate triangles were dropped", path,
                 loader->degenerate);
    if (loader->bad_normals > 0)
        irb_warn(loader->log, "%s: %ld normals without direction were replaced by the geometry's",
                 path, loader->bad_normals);
    if (loader->unlit_primitives > 0)
        irb_warn(loader->log, "%s: %ld primitives of points or lines were dropped", path,
                 loader->unlit_primitives);
    if (loader->morphs > 0)
        irb_warn(loader->log, "%s: morph targets of %ld primitives are ignored", path,
                 loader->morphs);
    if (loader->skins > 0)
        irb_warn(loader->log, "%s: skins of %ld nodes are ignored", path, loader->skins);
}

/* ---- Nodes ---- */

static void multiply(const double a[16], const double b[16], double out[16])
{
    for (int column = 0; column < 4; column++)
        for (int row = 0; row < 4; row++) {
            double sum = 0;

            for (int k = 0; k < 4; k++)
                sum += a[4 * k + row] * b[4 * column + k];
            out[4 * column + row] = sum;
        }
}

/* T * R * S (glTF 2.0, 3.5.3). */
static void local_matrix(const struct irb_gltf_node *node, double out[16])
{
    const double *s = node->scale, *t = node->translation, *q = node->rotation;
    double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    double x = 0, y = 0, z = 0, w = 1;

    if (node->has_matrix) {
        memcpy(out, node->matrix, sizeof node->matrix);
        return;
    }
    if (length > 0) {
        x = q[0] / length;
        y = q[1] / length;
        z = q[2] / length;
        w = q[3] / length;
    }
    const double columns[4][4] = {{s[0] * (1 - 2 * (y * y + z * z)), s[0] * 2 * (x * y + z * w),
                                   s[0] * 2 * (x * z - y * w), 0},
                                  {s[1] * 2 * (x * y - z * w), s[1] * (1 - 2 * (x * x + z * z)),
                                   s[1] * 2 * (y * z + x * w), 0},
                                  {s[2] * 2 * (x * z + y * w), s[2] * 2 * (y * z - x * w),
                                   s[2] * (1 - 2 * (x * x + y * y)), 0},
                                  {t[0], t[1], t[2], 1}};
    memcpy(out, columns, sizeof columns);
}

static bool check_matrix(const double m[16], int node, const char *name, struct irb_error *err)
{
    for (int i = 0; i < 16; i++)
        if (!isfinite(m[i]))
            return irb_fail(err, IRB_E_INPUT, "node %d '%s': transform is not finite", node, name);
    return true;
}

/* A stack of nodes to visit instead of recursion: files may chain a hundred thousand. */
struct walk {
    int *stack;
    int depth;
    bool *seen;
    double (*world)[16]; /* of each node that was pushed */
};

static const double identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

static bool push_nodes(const struct irb_gltf *gltf, struct walk *walk, const int *nodes, int count,
                       const double parent[16], struct irb_error *err)
{
    for (int i = count - 1; i >= 0; i--) { /* so that they come off in the file's order */
        double local[16];
        int node = nodes[i];

        if (node < 0 || node >= gltf->node_count)
            return irb_fail(err, IRB_E_INPUT, "node %d does not exist (the file has %d)", node,
                            gltf->node_count);
        if (walk->seen[node])
            return irb_fail(err, IRB_E_INPUT,
                            "node %d '%s' is reached twice; nodes must form trees", node,
                            gltf->nodes[node].name);
        walk->seen[node] = true;
        local_matrix(&gltf->nodes[node], local);
        multiply(parent, local, walk->world[node]);
        if (!check_matrix(walk->world[node], node, gltf->nodes[node].name, err))
            return false;
        walk->stack[walk->depth++] = node;
    }
    return true;
}

static bool visit_nodes(struct gltf_loader *loader, struct walk *walk, struct irb_error *err)
{
    const struct irb_gltf *gltf = loader->gltf;

    if (!push_nodes(gltf, walk, gltf->roots, gltf->root_count, identity, err))
        return false;
    while (walk->depth > 0) {
        int index = walk->stack[--walk->depth];
        const struct irb_gltf_node *node = &gltf->nodes[index];

        loader->skins += node->skin >= 0;
        if (node->mesh >= 0 && !gltf_mesh(loader, node->mesh, node->name, walk->world[index], err))
            return false;
        if (!push_nodes(gltf, walk, node->children, node->child_count, walk->world[index], err))
            return false;
    }
    return true;
}

static bool add_nodes(struct gltf_loader *loader, struct irb_error *err)
{
    size_t count = (size_t)loader->gltf->node_count;
    struct walk walk = {.stack = malloc((count + 1) * sizeof *walk.stack),
                        .seen = calloc(count + 1, sizeof *walk.seen),
                        .world = malloc((count + 1) * sizeof *walk.world)};
    bool ok;

    if (!walk.stack || !walk.seen || !walk.world)
        ok = irb_fail(err, IRB_E_MEMORY, "out of memory for %zu nodes", count);
    else
        ok = visit_nodes(loader, &walk, err);
    free(walk.stack);
    free(walk.seen);
    free(walk.world);
    return ok;
}

/* ---- The whole file ---- */

/* "a/b/sponza.glb" -> "sponza" */
static void name_of(const char *path, char name[64])
{
    const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path;
    const char *dot = strrchr(base, '.');

    snprintf(name, 64, "%.*s", dot && dot > base ? (int)(dot - base) : (int)strlen(base), base);
}

static int *unset_slots(int count)
{
    int *slots = malloc(((size_t)count + 1) * sizeof *slots);

    for (int i = 0; slots && i <= count; i++)
        slots[i] = -1;
    return slots;
}

static struct irb_scene *convert(struct gltf_loader *loader, struct irb_error *err)
{
    struct irb_scene *scene;
    char name[64];

    name_of(loader->path, name);
    irb_builder_begin(&loader->builder, name);
    warn_about_dropped(loader);
    if (!add_nodes(loader, err)) {
        irb_builder_abandon(&loader->builder);
        return NULL;
    }
    warn_about_counts(loader);
    scene = irb_builder_finish(&loader->builder, err);
    if (scene && scene->triangle_count == 0) {
        irb_scene_destroy(scene);
        irb_fail(err, IRB_E_INPUT, "empty scene: no triangles in its %d nodes and %d meshes",
                 loader->gltf->node_count, loader->gltf->mesh_count);
        return NULL;
    }
    return scene;
}

struct irb_scene *irb_gltf_load(const char *path, struct irb_log *log, struct irb_error *err)
{
    struct gltf_loader loader = {.path = path, .log = log, .gltf = read_gltf(path, err)};
    struct irb_scene *scene = NULL;

    if (!loader.gltf)
        return NULL;
    loader.materials = unset_slots(loader.gltf->material_count);
    loader.textures = unset_slots(loader.gltf->image_count);
    if (!loader.materials || !loader.textures)
        irb_fail(err, IRB_E_MEMORY, "out of memory");
    else if (check_asset(loader.gltf, err))
        scene = convert(&loader, err);
    if (!scene)
        irb_error_prefix(err, "%s", path);
    free(loader.materials);
    free(loader.textures);
    irb_gltf_destroy(loader.gltf);
    return scene;
}
