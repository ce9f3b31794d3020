/* SPDX-License-Identifier: MIT
 *
 * Lights and cameras of glTF files.
 */
#include "core/scene/gltf/load.h"

#include "core/scene/vec.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Axis of a node in the world, unit; false where the node is flat along it. */
static bool axis_of(const double world[16], int axis, double sign, float out[3])
{
    double d[3];

    for (int i = 0; i < 3; i++)
        d[i] = sign * world[4 * axis + i];
    if (!vec_normalize(d))
        return false;
    vec_to_float(d, out);
    return true;
}

static void copy_name(char out[64], const char *own, const char *node)
{
    snprintf(out, 64, "%s", own[0] ? own : node);
}

/* Room for one more; NULL (and a failure of the builder) when memory is out. */
static void *grow(struct gltf_loader *loader, void *list, int count, size_t size)
{
    void *grown = loader->builder.failure ? NULL : realloc(list, ((size_t)count + 1) * size);

    if (!grown)
        loader->builder.failure = IRB_E_MEMORY;
    return grown;
}

/* What the file says about falloff and beam in our own extras; else glTF's smooth falloff. */
static void set_shape(const struct irb_gltf_light *source, struct irb_light *light)
{
    light->falloff = IRB_FALLOFF_SMOOTH;
    for (int i = 0; irb_falloff_names[i]; i++)
        if (strcmp(source->falloff, irb_falloff_names[i]) == 0)
            light->falloff = (enum irb_falloff)i;
    light->outer = (float)source->outer;
    light->inner = (float)source->inner;
    light->half_width = (float)source->half_width;
}

static bool light_is_valid(const struct irb_gltf_light *source)
{
    bool ok = isfinite(source->intensity) && source->intensity >= 0;

    for (int c = 0; c < 3; c++)
        ok = ok && isfinite(source->color[c]) && source->color[c] >= 0;
    if (strcmp(source->type, "spot") == 0)
        ok = ok && source->inner >= 0 && source->inner < source->outer && source->outer < M_PI / 2;
    return ok;
}

void gltf_light(struct gltf_loader *loader, const struct irb_gltf_node *node,
                const double world[16])
{
    struct irb_scene *scene = loader->builder.scene;
    const struct irb_gltf_light *source;
    struct irb_scene_light found = {0}, *grown;
    bool spot;

    if (node->light < 0 || node->light >= loader->gltf->light_count || loader->builder.failure)
        return;
    source = &loader->gltf->lights[node->light];
    loader->lights_placed[node->light] = true;
    copy_name(found.name, source->name, node->name);
    spot = strcmp(source->type, "spot") == 0;
    if ((!spot && strcmp(source->type, "directional") != 0) || !light_is_valid(source) ||
        !axis_of(world, 2, -1, found.light.direction)) {
        irb_warn(loader->log,
                 "%s: light %d '%s' (%s) is dropped: expected a spot (outer angle below 90 "
                 "degrees) or directional light with finite values",
                 loader->path, node->light, found.name, source->type);
        return;
    }
    found.light.type = spot ? IRB_LIGHT_SPOT : IRB_LIGHT_DIRECTIONAL;
    for (int i = 0; i < 3; i++) {
        found.light.position[i] = (float)world[12 + i];
        found.light.intensity[i] = (float)(source->color[i] * source->intensity);
    }
    set_shape(source, &found.light);
    grown = grow(loader, scene->lights, scene->light_count, sizeof *grown);
    if (!grown)
        return;
    scene->lights = grown;
    grown[scene->light_count++] = found;
}

void gltf_camera(struct gltf_loader *loader, const struct irb_gltf_node *node,
                 const double world[16])
{
    struct irb_scene *scene = loader->builder.scene;
    const struct irb_gltf_camera *source;
    struct irb_scene_camera found = {0}, *grown;
    float forward[3];

    if (node->camera < 0 || node->camera >= loader->gltf->camera_count || loader->builder.failure)
        return;
    source = &loader->gltf->cameras[node->camera];
    copy_name(found.name, source->name, node->name);
    if (!source->perspective || !(source->yfov > 0 && source->yfov < M_PI) ||
        !axis_of(world, 2, -1, forward) || !axis_of(world, 1, 1, found.camera.up)) {
        irb_warn(loader->log, "%s: camera %d '%s' is dropped: expected a perspective camera",
                 loader->path, node->camera, found.name);
        return;
    }
    for (int i = 0; i < 3; i++) {
        found.camera.position[i] = (float)world[12 + i];
        found.camera.target[i] = (float)(world[12 + i] + (double)forward[i]);
    }
    found.camera.vertical_fov = (float)source->yfov;
    found.camera.z_near = (float)source->znear;
    found.camera.z_far = (float)source->zfar;
    grown = grow(loader, scene->cameras, scene->camera_count, sizeof *grown);
    if (!grown)
        return;
    scene->cameras = grown;
    grown[scene->camera_count++] = found;
}

/* One primary light a trial; the others are said, never silently left out. */
void gltf_warn_about_lights(const struct gltf_loader *loader)
{
    const struct irb_gltf *gltf = loader->gltf;
    const struct irb_scene *scene = loader->builder.scene;

    for (int i = 0; i < gltf->light_count; i++)
        if (!loader->lights_placed[i])
            irb_warn(loader->log, "%s: light %d '%s' (%s) stands in no node and is dropped",
                     loader->path, i, gltf->lights[i].name, gltf->lights[i].type);
    for (int i = 1; i < scene->light_count; i++)
        irb_warn(loader->log,
                 "%s: light '%s' (%s) is left out, one light is used at a time: '%s', unless the "
                 "experiment names another",
                 loader->path, scene->lights[i].name,
                 irb_light_type_names[scene->lights[i].light.type], scene->lights[0].name);
}
