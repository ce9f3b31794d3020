/* SPDX-License-Identifier: MIT
 *
 * The command export-scene: a scene as a .glb for other renderers.
 */
#include "core/cli/cli.h"
#include "core/scene/builtin.h"
#include "core/scene/gltf/write.h"

#include <string.h>
#include <strings.h>

static bool is_glb(const char *path)
{
    size_t length = strlen(path);

    return length > 4 && strcasecmp(path + length - 4, ".glb") == 0;
}

/* Camera and light of a built-in's default view at frame 0, or the first that the file holds. */
static bool export_with_view(const struct irb_builtin *builtin, const struct irb_scene *scene,
                             const char *path, struct irb_error *err)
{
    struct irb_animation animation = {0};
    struct irb_camera camera;
    struct irb_light light;
    bool ok;

    if (!builtin)
        return irb_scene_export(scene, irb_scene_camera_find(scene, NULL),
                                irb_scene_light_find(scene, NULL), path, err);
    builtin->view(&animation);
    ok = irb_animation_validate(&animation, err);
    if (ok) {
        irb_animation_camera(&animation, scene, 0, &camera);
        irb_animation_light(&animation, scene, 0, &light);
        ok = irb_scene_export(scene, &camera, &light, path, err);
    }
    irb_animation_destroy(&animation);
    return ok;
}

bool irb_command_export_scene(struct irb_cli *cli, struct irb_error *err)
{
    const char *name = cli->arguments[0], *path = cli->arguments[1];
    struct irb_scene *scene;
    bool ok;

    if (!is_glb(path))
        return irb_fail(err, IRB_E_USAGE, "export-scene: expected a file name in .glb, found '%s'",
                        path);
    scene = irb_scene_load(name, &cli->log, err);
    if (!scene)
        return false;
    ok = export_with_view(irb_builtin_find(name), scene, path, err);
    if (ok)
        irb_info(&cli->log, "%s: %u triangles, %d materials, %d textures", path,
                 scene->triangle_count, scene->material_count, scene->texture_count);
    irb_scene_destroy(scene);
    return ok;
}
