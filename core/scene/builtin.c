/* SPDX-License-Identifier: MIT
 *
 * The list of built-in scenes, with their default views.
 */
#include "core/scene/builtin.h"

#include "core/scene/builtin/geometry.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Copies the keys. A failed allocation leaves the animation without keys, which
 * irb_animation_validate refuses. */
static void set_keys(struct irb_animation *animation, const struct irb_light_key *lights,
                     int light_count, const struct irb_camera_key *camera)
{
    animation->light_keys = malloc((size_t)light_count * sizeof *lights);
    animation->camera_keys = malloc(sizeof *camera);
    if (!animation->light_keys || !animation->camera_keys) {
        irb_animation_destroy(animation);
        return;
    }
    memcpy(animation->light_keys, lights, (size_t)light_count * sizeof *lights);
    *animation->camera_keys = *camera;
    animation->light_key_count = light_count;
    animation->camera_key_count = 1;
}

static void set_view(struct irb_animation *animation, const struct irb_light_key *light,
                     const struct irb_camera_key *camera)
{
    set_keys(animation, light, 1, camera);
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

/* ---- Architecture: the lights move, frames as in the keys; a longer run holds the last ---- */

#define KEYS(keys) keys, sizeof(keys) / sizeof *(keys)

/* A spot under the vault that wanders along the nave's floor and up its south arcade. */
static void hall_view(struct irb_animation *animation)
{
    static const struct irb_light_key lights[] = {
        {0, {-3, 11.5f, -0.5f}, {-8, 0, 1.5f}, {900, 820, 680}, 34, 0},
        {30, {-3, 11.5f, -0.5f}, {-2, 0, 1}, {900, 820, 680}, 34, 0},
        {60, {-3, 11.5f, -0.5f}, {3, 2, -3.5f}, {900, 820, 680}, 34, 0},
        {90, {-3, 11.5f, -0.5f}, {-5, 5, -3.6f}, {900, 820, 680}, 34, 0},
    };
    static const struct irb_camera_key camera = {
        .position = {-17.8f, 3.4f, 1.3f}, .target = {4, 6.2f, -0.6f}, .up = {0, 1, 0}, .fov = 62};

    *animation = (struct irb_animation){.light_interpolation = IRB_CATMULL_ROM,
                                        .falloff = IRB_FALLOFF_COSINE};
    set_keys(animation, KEYS(lights), &camera);
}

/* The sun, from the morning's slanting light to noon's: 600 W/m2 of sunlight's colour, scaled. */
static void atrium_view(struct irb_animation *animation)
{
    static const struct irb_light_key lights[] = {
        {.frame = 0, {-6, 24, -7}, {0.5f, 2, 1.5f}, {10, 9.2f, 7.8f}},
        {.frame = 45, {0, 26, -4}, {0.5f, 2, 1}, {10, 9.5f, 8.6f}},
        {.frame = 90, {7, 24, 3}, {0.5f, 2, -0.5f}, {10, 9.2f, 7.8f}},
    };
    static const struct irb_camera_key camera = {
        .position = {-9.6f, 2.1f, -1.4f}, .target = {4, 3.7f, 1.0f}, .up = {0, 1, 0}, .fov = 65};

    *animation = (struct irb_animation){.light_interpolation = IRB_CATMULL_ROM,
                                        .light_type = IRB_LIGHT_DIRECTIONAL,
                                        .beam_half_width = 11.5f};
    set_keys(animation, KEYS(lights), &camera);
}

/* The patch of light in the further room moves from its back wall to its floor. */
static void doorway_view(struct irb_animation *animation)
{
    static const struct irb_light_key lights[] = {
        {0, {8.6f, 2.9f, 4.4f}, {11, 1.0f, 2.1f}, {30, 26, 20}, 38, 0},
        {45, {8.6f, 2.9f, 4.4f}, {9.6f, 0, 2.2f}, {30, 26, 20}, 38, 0},
        {90, {8.6f, 2.9f, 4.4f}, {9.2f, 0.6f, 0}, {30, 26, 20}, 38, 0},
    };
    static const struct irb_camera_key camera = {
        .position = {1.0f, 1.65f, 0.8f}, .target = {5.2f, 1.0f, 3.3f}, .up = {0, 1, 0}, .fov = 58};

    *animation = (struct irb_animation){.light_interpolation = IRB_CATMULL_ROM,
                                        .falloff = IRB_FALLOFF_COSINE};
    set_keys(animation, KEYS(lights), &camera);
}

/* The lamp walks along the leg that the camera cannot see, towards the corner. */
static void corridor_view(struct irb_animation *animation)
{
    static const struct irb_light_key lights[] = {
        {0, {6.5f, 2.6f, 12.7f}, {0.6f, 0.9f, 12.6f}, {70, 64, 52}, 30, 0},
        {45, {4.5f, 2.6f, 12.9f}, {0.2f, 1.3f, 12.2f}, {70, 64, 52}, 30, 0},
        {90, {3.2f, 2.6f, 13.1f}, {1.2f, 0, 12.4f}, {70, 64, 52}, 30, 0},
    };
    static const struct irb_camera_key camera = {
        .position = {1.5f, 1.6f, 3.4f}, .target = {1.15f, 1.3f, 13}, .up = {0, 1, 0}, .fov = 60};

    *animation = (struct irb_animation){.light_interpolation = IRB_CATMULL_ROM,
                                        .falloff = IRB_FALLOFF_COSINE};
    set_keys(animation, KEYS(lights), &camera);
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
    {"cornell-cloth",
     "Cornell box with a cloth that waves in the wind; animation 0 to 120 s, 2 s a wave",
     "box as cornell; cloth ours: height over its plane A t sin(2 pi (a s + b t) - w time), by two "
     "morph targets",
     irb_build_cornell_cloth, cornell_view, .animated = true},
    {"sphere", "inside of a unit sphere, albedo 0.5: every bounce is uniform",
     "integrating sphere: E after n bounces = albedo^n P/(4 pi R^2)", irb_build_sphere,
     sphere_view},
    {"squares", "two parallel unit squares 1 m apart, albedo 0.5, the lower one lit by a beam",
     "mean E on the upper = albedo E F12, form factor F12 = 0.19982", irb_build_squares,
     squares_view},
    {"furnace", "inside of a closed unit cube, albedo 0.5",
     "mean E after n bounces over the whole inner area = albedo^n P/A, A = 6 m2", irb_build_furnace,
     furnace_view},
    {"hall", "cathedral: nave, aisles, crossing under a dome, apse; 40 x 17 x 30 m, stone",
     "ours, after the kind of Sibenik's cathedral (the thesis's scene); reflectances ours",
     irb_build_hall, hall_view},
    {"atrium", "court between two-storey colonnades, coloured curtains, fine textures, sunlit",
     "ours, after the kind of the Sponza palace's atrium; reflectances and textures ours",
     irb_build_atrium, atrium_view},
    {"doorway", "dark hall lit only through a door that is ajar",
     "ours, after the door scene of Veach 1997; reflectances ours", irb_build_doorway,
     doorway_view},
    {"corridor", "L-shaped corridor, the lamp round the corner", "ours", irb_build_corridor,
     corridor_view},
    {0},
};

const struct irb_builtin *irb_builtin_find(const char *name)
{
    for (const struct irb_builtin *builtin = irb_builtins; builtin->name; builtin++)
        if (strcmp(builtin->name, name) == 0)
            return builtin;
    return NULL;
}
