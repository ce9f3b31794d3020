/* SPDX-License-Identifier: MIT
 *
 * A scene with points, lights on its surfaces and an atlas, for tests of imperfect shadow maps.
 * Include after compare.h.
 */
#ifndef IRB_TESTS_LIGHTS_ISM_WORLD_H
#define IRB_TESTS_LIGHTS_ISM_WORLD_H

#include "tests/lights/ism_fixture.h"

enum { SIZE = 64, MOST_LIGHTS = 64 };

static inline struct irb_ism_settings default_settings(void)
{
    return (struct irb_ism_settings){.splatter = IRB_ISM_ATOMIC,
                                     .splat_factor = 1,
                                     .splat_scale = 1,
                                     .splat_size = IRB_ISM_SIZE_SURFACE,
                                     .splat_most = 5,
                                     .near = 0.001f,
                                     .f_min = 5,
                                     .f_max = 32,
                                     .smoothstep = 3};
}

struct world {
    struct irb_gl *gl; /* borrowed */
    struct irb_scene *scene;
    struct irb_scene_gl *scene_gl;
    struct irb_point_list list;
    struct irb_points *points;
    struct fixture_light lights[MOST_LIGHTS];
    struct irb_virtual_lights view;
    struct irb_ism *ism;
};

/* Lights on surfaces of the scene, on the side of its middle, each with flux 1. */
static inline void place_lights(struct world *w, int count, uint64_t seed)
{
    struct irb_error err = {0};
    struct irb_point_list list;
    struct irb_points_desc desc = {.kind = IRB_POINTS_AREA, .count = 97 * count + 1, .seed = seed};
    REQUIRE_OK(irb_points_generate(w->scene, &desc, &list, &err));
    fixture_corners *corners = fixture_place_corners(w->scene, w->scene->positions);
    memset(w->lights, 0, sizeof w->lights);
    for (int l = 0; l < count; l++) {
        struct fixture_light *light = &w->lights[l];
        const struct irb_point *point = &list.points[97 * l];
        double at[3], area[3], to_middle = 0, length = 0;
        fixture_place_point((const fixture_corners *)corners, point, at);
        fixture_area_vector((const double(*)[3])corners[point->triangle], area);
        for (int k = 0; k < 3; k++) {
            double middle = 0.5 * ((double)w->scene->bounds_min[k] + w->scene->bounds_max[k]);
            to_middle += (middle - at[k]) * area[k];
            length += area[k] * area[k];
        }
        for (int k = 0; k < 3; k++) {
            light->position[k] = (float)at[k];
            light->normal[k] = (float)(area[k] / sqrt(length) * (to_middle < 0 ? -1 : 1));
            light->flux[k] = 1;
        }
    }
    free(corners);
    irb_point_list_destroy(&list);
    w->view = fixture_lights(w->gl, w->lights, count);
}

static inline void create_world(struct world *w, struct irb_gl *gl, struct irb_scene *scene,
                                struct irb_points_desc desc, int lights)
{
    struct irb_error err = {0};
    w->gl = gl;
    w->scene = scene;
    REQUIRE_OK(w->scene_gl = irb_scene_gl_create(gl, scene, &err));
    REQUIRE_OK(irb_points_generate(scene, &desc, &w->list, &err));
    REQUIRE_OK(w->points = irb_points_create(gl, w->scene_gl, &desc, &err));
    REQUIRE_OK(w->ism = irb_ism_create(gl, SIZE, MOST_LIGHTS, &err));
    assert_int_equal(w->ism->maps_a_row, 8);
    place_lights(w, lights, 11);
}

/* The coloured box and its two blocks, 20000 random points. */
static inline void create_cornell(struct world *w, struct irb_gl *gl, int lights)
{
    create_world(w, gl, fixture_scene("cornell"),
                 (struct irb_points_desc){.kind = IRB_POINTS_AREA, .count = 20000, .seed = 3},
                 lights);
}

static inline void destroy_world(struct world *w)
{
    irb_ism_destroy(w->ism);
    irb_points_destroy(w->points);
    irb_point_list_destroy(&w->list);
    irb_buffer_destroy((struct irb_buffer *)w->view.buffer);
    irb_scene_gl_destroy(w->scene_gl);
    irb_scene_destroy(w->scene);
}

static inline struct fixture_maps splat(const struct world *w,
                                        const struct irb_ism_settings *settings)
{
    struct irb_error err = {0};
    const bool dynamic = settings->splatter == IRB_ISM_TESSELLATION;
    REQUIRE_OK(
        irb_ism_splat(w->ism, w->scene_gl, dynamic ? NULL : w->points, &w->view, settings, &err));
    return fixture_maps_read(w->ism);
}

static inline struct fixture_maps expect(const struct world *w,
                                         const struct irb_ism_settings *settings)
{
    const bool even = settings->splat_size == IRB_ISM_SIZE_EVEN;
    const struct fixture_splat s = {w->scene, settings, w->lights, 0,
                                    even ? w->list.area / (double)w->list.count : 0};
    return fixture_splat_list(&s, &w->list, irb_scene_current_positions(w->scene), SIZE,
                              w->view.count);
}

/* Ties may differ in 1e-4 of the texels. */
static inline void require_splat(const struct world *w, const struct irb_ism_settings *settings)
{
    struct fixture_maps found = splat(w, settings), expected = expect(w, settings);
    fixture_require_maps(&found, &expected, 0, 1e-4);
    REQUIRE_CMP((double)expected.splats, >, 1000);
    fixture_maps_destroy(&found);
    fixture_maps_destroy(&expected);
}

static inline void require_equal(const struct fixture_maps *a, const struct fixture_maps *b)
{
    assert_int_equal(a->count, b->count);
    assert_memory_equal(a->distance, b->distance, 4 * fixture_map_texel(a, a->count, 0, 0));
}

/* Other lights in place of those that there are. */
static inline void replace_lights(struct world *w, int count)
{
    irb_buffer_destroy((struct irb_buffer *)w->view.buffer);
    w->view = fixture_lights(w->gl, w->lights, count);
}

#endif
