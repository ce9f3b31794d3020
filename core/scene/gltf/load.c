/* SPDX-License-Identifier: MIT */
#include "core/scene/gltf/load.h"

#include "core/base/fs.h"
#include "core/base/str.h"
#include "core/scene/motion.h"
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
    for (int i = 0; i < gltf->used_count; i++)
        if (strstr(gltf->used[i], "lights_image_based"))
            irb_warn(loader->log, "%s: environment light (%s) is dropped", loader->path,
                     gltf->used[i]);
    if (gltf->animation_count > 1)
        irb_warn(loader->log, "%s: of %d animations the first is used", loader->path,
                 gltf->animation_count);
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
}

/* ---- Nodes ---- */

static void local_matrix(const struct irb_gltf_node *node, double out[16])
{
    struct irb_motion_node local = {.has_matrix = node->has_matrix};

    memcpy(local.matrix, node->matrix, sizeof local.matrix);
    memcpy(local.translation, node->translation, sizeof local.translation);
    memcpy(local.rotation, node->rotation, sizeof local.rotation);
    memcpy(local.scale, node->scale, sizeof local.scale);
    irb_motion_local(&local, out);
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
    int *parents;        /* of each node, or -1 */
    int *order;          /* nodes as they were visited, parents first */
    int visited;
};

static const double identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/* `parent` is -1 for the roots. */
static bool push_nodes(const struct irb_gltf *gltf, struct walk *walk, const int *nodes, int count,
                       int parent, struct irb_error *err)
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
        walk->parents[node] = parent;
        irb_motion_multiply(parent < 0 ? identity : walk->world[parent], local, walk->world[node]);
        if (!check_matrix(walk->world[node], node, gltf->nodes[node].name, err))
            return false;
        walk->stack[walk->depth++] = node;
    }
    return true;
}

/* Remembers the node of the objects that its mesh has become. */
static bool note_objects(struct gltf_loader *loader, int node)
{
    int count = loader->builder.failure ? 0 : loader->builder.scene->object_count;
    int *grown;

    if (count > loader->object_capacity) {
        grown = realloc(loader->object_nodes, 2 * (size_t)count * sizeof *grown);
        if (!grown)
            return false;
        for (int i = loader->object_capacity; i < 2 * count; i++)
            grown[i] = -1;
        loader->object_nodes = grown;
        loader->object_capacity = 2 * count;
    }
    for (int i = loader->first_object; i < count; i++)
        loader->object_nodes[i] = node;
    loader->first_object = count;
    if (count > 0 && loader->builder.scene->objects[count - 1].triangle_count == 0)
        loader->first_object--; /* its place goes to the next object */
    return true;
}

static bool visit_nodes(struct gltf_loader *loader, struct walk *walk, struct irb_error *err)
{
    const struct irb_gltf *gltf = loader->gltf;

    if (!push_nodes(gltf, walk, gltf->roots, gltf->root_count, -1, err))
        return false;
    while (walk->depth > 0) {
        int index = walk->stack[--walk->depth];
        const struct irb_gltf_node *node = &gltf->nodes[index];

        walk->order[walk->visited++] = index;
        gltf_light(loader, node, walk->world[index]);
        gltf_camera(loader, node, walk->world[index]);
        if (node->mesh >= 0 && !gltf_mesh(loader, index, walk->world[index], err))
            return false;
        if (!note_objects(loader, index))
            return irb_fail(err, IRB_E_MEMORY, "out of memory");
        if (!push_nodes(gltf, walk, node->children, node->child_count, index, err))
            return false;
    }
    return gltf_motion(loader, walk->order, walk->visited, walk->parents, err);
}

static bool add_nodes(struct gltf_loader *loader, struct irb_error *err)
{
    size_t count = (size_t)loader->gltf->node_count;
    struct walk walk = {.stack = malloc((count + 1) * sizeof *walk.stack),
                        .seen = calloc(count + 1, sizeof *walk.seen),
                        .world = malloc((count + 1) * sizeof *walk.world),
                        .parents = malloc((count + 1) * sizeof *walk.parents),
                        .order = malloc((count + 1) * sizeof *walk.order)};
    bool ok;

    if (!walk.stack || !walk.seen || !walk.world || !walk.parents || !walk.order)
        ok = irb_fail(err, IRB_E_MEMORY, "out of memory for %zu nodes", count);
    else
        ok = visit_nodes(loader, &walk, err);
    free(walk.stack);
    free(walk.seen);
    free(walk.world);
    free(walk.parents);
    free(walk.order);
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
    if (!loader->builder.failure)
        gltf_warn_about_lights(loader);
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
    loader.lights_placed = calloc((size_t)loader.gltf->light_count + 1, sizeof(bool));
    if (!loader.materials || !loader.textures || !loader.lights_placed)
        irb_fail(err, IRB_E_MEMORY, "out of memory");
    else if (check_asset(loader.gltf, err))
        scene = convert(&loader, err);
    if (!scene)
        irb_error_prefix(err, "%s", path);
    free(loader.materials);
    free(loader.textures);
    free(loader.lights_placed);
    free(loader.object_nodes);
    irb_gltf_destroy(loader.gltf);
    return scene;
}
