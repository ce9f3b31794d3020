/* SPDX-License-Identifier: MIT
 *
 * Geometry of the built-in scenes; see irb_builtins for their sources. Each is NULL only when
 * memory is out.
 */
#ifndef IRB_SCENE_BUILTIN_GEOMETRY_H
#define IRB_SCENE_BUILTIN_GEOMETRY_H

#include "core/scene/builder.h"

struct irb_scene *irb_build_cornell(struct irb_error *err);
struct irb_scene *irb_build_cornell_objects(struct irb_error *err);
struct irb_scene *irb_build_cornell_cloth(struct irb_error *err);
struct irb_scene *irb_build_sphere(struct irb_error *err);
struct irb_scene *irb_build_squares(struct irb_error *err);
struct irb_scene *irb_build_furnace(struct irb_error *err);
struct irb_scene *irb_build_hall(struct irb_error *err);
struct irb_scene *irb_build_atrium(struct irb_error *err);
struct irb_scene *irb_build_doorway(struct irb_error *err);
struct irb_scene *irb_build_corridor(struct irb_error *err);

/* A sphere of `slices` x `stacks` facets with analytic unit normals that point inwards or outwards;
 * the poles lie on the y axis. Triangles: 2 slices (stacks - 1). */
void irb_builder_sphere(struct irb_builder *builder, const double centre[3], double radius,
                        int slices, int stacks, bool inwards);

/* A tube around the (2,3) torus knot with four twisted strands, `around` facets around the tube and
 * `along` along it, smooth normals outwards. Its lowest point has the y of `foot`, its axis stands
 * on it; `height` metres tall. Triangles: 2 along around. */
void irb_builder_knot(struct irb_builder *builder, const double foot[3], double height, int along,
                      int around);

/* An object that waves in the wind by two morph targets, and the animation of their weights: 2 s a
 * period, from 0 to 120 s. Last, since it ends the scene's motion. 4608 triangles, about (0.1,
 * 0.08, 0.15) to (0.46, 0.37, 0.44). */
void irb_builder_cloth(struct irb_builder *builder, const char *name, int material);

#endif
