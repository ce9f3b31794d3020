/* SPDX-License-Identifier: MIT
 *
 * The list of built-in scenes, with their default views.
 */
#include "core/scene/builtin.h"

#include "core/scene/builtin_geometry.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A failed allocation leaves the animation without keys, which irb_animation_validate refuses. */
static void set_view(struct irb_animation *animation, const struct irb_light_key *light,
                     const struct irb_camera_key *camera)
{
    animation->light_keys = malloc(sizeof *light);
    animation->camera_keys = malloc(sizeof *camera);
    if (!animation->light_keys || !animation->camera_keys) {
        irb_animation_destroy(animation);
        return;
    }
    *animation->light_keys = *light;
    *animation->camera_keys = *camera;
    animation->light_key_count = 1;
    animation->camera_key_count = 1;
}

/* Full angle in degrees whose tangent, halved, is `ratio`. */
static float fov_of(double ratio)
{
    return (float)(2 * atan(ratio) * 180 / M_PI);
}

/* The published camera: (278, 273, -800) mm, looking along +z, 35 mm lens, 25 x 25 mm film. The
 * lamp is ours: a downward spot just below the middle of the ceiling, with the thesis's falloff. */
static void cornell_view(struct irb_animation *animation)
{
    const struct irb_light_key light = {.position = {0.278f, 0.54f, 0.2796f},
                                        .target = {0.278f, 0, 0.2796f},
                                        .intensity = {1, 1, 1},
                                        .cone = 50};
    const struct irb_camera_key camera = {.position = {0.278f, 0.273f, -0.8f},
                                          .target = {0.278f, 0.273f, 0},
                                          .up = {0, 1, 0},
                                          .fov = fov_of(12.5 / 35)};

    *animation = (struct irb_animation){.falloff = IRB_FALLOFF_COSINE};
    set_view(animation, &light, &camera);
}

/* Bounce 1 is the same everywhere, so the view only has to avoid symmetry. */
static void sphere_view(struct irb_animation *animation)
{
    const struct irb_light_key light = {.position = {0.1f, 0.3f, 0.05f},
                                        .target = {0.3f, -1, 0.2f},
                                        .intensity = {10, 10, 10},
                                        .cone = 35};
    const struct irb_camera_key camera = {
        .position = {-0.2f, 0.1f, 0.6f}, .target = {0.1f, -0.1f, -1}, .up = {0, 1, 0}, .fov = 70};

    *animation = (struct irb_animation){0};
    set_view(animation, &light, &camera);
}

/* The beam starts halfway and lights exactly the lower square; the camera sees exactly the upper
 * one, from 0.99 m below it: fov = 2 atan(0.5/0.99). */
static void squares_view(struct irb_animation *animation)
{
    const struct irb_light_key light = {
        .position = {0, 0.5f, 0}, .target = {0, 0, 0}, .intensity = {10, 10, 10}, .cone = 45};
    const struct irb_camera_key camera = {.position = {0, 0.01f, 0},
                                          .target = {0, 1, 0},
                                          .up = {0, 0, -1},
                                          .fov = fov_of(0.5 / 0.99)};

    *animation =
        (struct irb_animation){.light_type = IRB_LIGHT_DIRECTIONAL, .beam_half_width = 0.5f};
    set_view(animation, &light, &camera);
}

static void furnace_view(struct irb_animation *animation)
{
    const struct irb_light_key light = {.position = {0.5f, 0.6f, 0.45f},
                                        .target = {0.4f, 0, 0.5f},
                                        .intensity = {10, 10, 10},
                                        .cone = 40};
    const struct irb_camera_key camera = {
        .position = {0.1f, 0.8f, 0.95f}, .target = {0.6f, 0.3f, 0}, .up = {0, 1, 0}, .fov = 70};

    *animation = (struct irb_animation){0};
    set_view(animation, &light, &camera);
}

const struct irb_builtin irb_builtins[] = {
    {"cornell", "Cornell box, measured geometry, short and tall block, closed ceiling, no lamp",
     "Cornell University Program of Computer Graphics, measured data (mm, here x 1e-3); "
     "reflectances: linear Rec.709 values of the measured spectra as commonly published",
     irb_build_cornell, cornell_view},
    {"cornell-objects", "Cornell box with a sphere and a finely detailed torus knot",
     "box as cornell; sphere and knot ours, after the scene of the ACRSM thesis (which has a "
     "horse)",
     irb_build_cornell_objects, cornell_view},
    {"sphere", "inside of a unit sphere, albedo 0.5: every bounce is uniform",
     "integrating sphere: E after n bounces = albedo^n P/(4 pi R^2)", irb_build_sphere,
     sphere_view},
    {"squares", "two parallel unit squares 1 m apart, albedo 0.5, the lower one lit by a beam",
     "mean E on the upper = albedo E F12, form factor F12 = 0.19982", irb_build_squares,
     squares_view},
    {"furnace", "inside of a closed unit cube, albedo 0.5",
     "mean E after n bounces over the whole inner area = albedo^n P/A, A = 6 m2", irb_build_furnace,
     furnace_view},
    {NULL, NULL, NULL, NULL, NULL},
};

const struct irb_builtin *irb_builtin_find(const char *name)
{
    for (const struct irb_builtin *builtin = irb_builtins; builtin->name; builtin++)
        if (strcmp(builtin->name, name) == 0)
            return builtin;
    return NULL;
}
