/* SPDX-License-Identifier: MIT
 *
 * Scenes made by code. Each has a documented source, a default camera and a default light, so
 * that a config may say just `scene: cornell`.
 */
#ifndef IRB_SCENE_BUILTIN_H
#define IRB_SCENE_BUILTIN_H

#include "core/scene/animation.h"
#include "core/scene/scene.h"

struct irb_builtin {
    const char *name;   /* "cornell" */
    const char *doc;    /* one line */
    const char *source; /* where geometry and reflectance come from, or the closed form it tests */
    /* Builds the scene; NULL on failure. */
    struct irb_scene *(*build)(struct irb_error *err);
    /* Fills camera and light with the scene's default view (single keys). */
    void (*view)(struct irb_animation *animation);
    bool animated; /* has an animation of its own, which `animation:` in a config plays */
};

/* All of them, ended by a NULL name. */
extern const struct irb_builtin irb_builtins[];
const struct irb_builtin *irb_builtin_find(const char *name); /* NULL when there is none */

#endif
