/* SPDX-License-Identifier: MIT
 *
 * Writes a scene as one .glb file (glTF 2.0) that any renderer can read, so that the same geometry,
 * camera and light can be rendered elsewhere.
 *
 * One mesh and node an object (its current transform as the node's matrix), with current positions
 * and normals, texture coordinates and indices; materials with the diffuse reflectance as base
 * colour, metallic 0, roughness 1, double-sided; textures as PNG inside the file. Camera:
 * perspective, the full vertical angle. Light: KHR_lights_punctual, whose numbers are written one
 * to one: spot intensity in W/sr where glTF says candela, directional in W/m2 where it says lux (no
 * factor of 683), colour = channels over the largest channel.
 *
 * What glTF cannot say is written as `extras` of the light and lost to other renderers: the
 * falloffs `constant` and `cosine` (they get a hard edge, inner = 0.999 outer; `cosine` is
 * moreover brighter on the axis by 1/cos(outer)), and the width of a directional beam. k_s,
 * animations, morph targets and skins are not written: the file shows the pose that the scene is
 * in.
 */
#ifndef IRB_SCENE_GLTF_WRITE_H
#define IRB_SCENE_GLTF_WRITE_H

#include "core/scene/light.h"
#include "core/scene/scene.h"

/* `camera` and `light` may be NULL. Equal scenes give equal files. IRB_E_IO when the file cannot be
 * written, IRB_E_INPUT when it would exceed the 4 GiB of a .glb, IRB_E_USAGE for a scene with
 * textures in a build without OpenImageIO. */
bool irb_scene_export(const struct irb_scene *scene, const struct irb_camera *camera,
                      const struct irb_light *light, const char *path, struct irb_error *err);

#endif
