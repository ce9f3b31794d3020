/* SPDX-License-Identifier: MIT
 *
 * Built-in scenes against closed forms and, for the Cornell box, the published coordinates.
 */
#include "core/scene/builtin.h"

#include "tests/support/compare.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static struct irb_scene *build(const char *name)
{
    struct irb_error err = {0};
    struct irb_scene *scene = irb_scene_load(name, NULL, &err);

    if (!scene)
        fail_msg("%s: %s", name, err.message);
    return scene;
}

static const float *corner(const struct irb_scene *scene, uint32_t triangle, int i)
{
    return scene->positions + 3 * (size_t)scene->indices[3 * (size_t)triangle + i];
}

static void triangle_cross(const struct irb_scene *scene, uint32_t triangle, double out[3])
{
    const float *a = corner(scene, triangle, 0), *b = corner(scene, triangle, 1),
                *c = corner(scene, triangle, 2);
    double u[3], v[3];

    for (int i = 0; i < 3; i++) {
        u[i] = (double)b[i] - a[i];
        v[i] = (double)c[i] - a[i];
    }
    for (int i = 0; i < 3; i++)
        out[i] = u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3];
}

static const struct irb_object *object(const struct irb_scene *scene, const char *name)
{
    for (int i = 0; i < scene->object_count; i++)
        if (strcmp(scene->objects[i].name, name) == 0)
            return &scene->objects[i];
    fail_msg("no object '%s'", name);
    return NULL;
}

static double area_of(const struct irb_scene *scene, const struct irb_object *part)
{
    double area = 0;

    for (uint32_t t = 0; t < part->triangle_count; t++) {
        double c[3];

        triangle_cross(scene, part->first_triangle + t, c);
        area += sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]) / 2;
    }
    return area;
}

/* By the divergence theorem; negative where the surface faces inwards. */
static double volume_of(const struct irb_scene *scene, const struct irb_object *part)
{
    double volume = 0;

    for (uint32_t t = 0; t < part->triangle_count; t++) {
        const float *a = corner(scene, part->first_triangle + t, 0);
        double c[3];

        triangle_cross(scene, part->first_triangle + t, c);
        volume += (a[0] * c[0] + a[1] * c[1] + a[2] * c[2]) / 6;
    }
    return volume;
}

/* ---- Every one ---- */

static void require_sound_vertices(const struct irb_scene *scene)
{
    for (uint32_t v = 0; v < scene->vertex_count; v++) {
        const float *p = scene->positions + 3 * (size_t)v, *n = scene->normals + 3 * (size_t)v;

        for (int i = 0; i < 3; i++) {
            REQUIRE_CMP(p[i], >=, scene->bounds_min[i]); /* also refuses NaN */
            REQUIRE_CMP(p[i], <=, scene->bounds_max[i]);
        }
        REQUIRE_NEAR(sqrt((double)n[0] * n[0] + (double)n[1] * n[1] + (double)n[2] * n[2]), 1,
                     1e-6);
    }
}

/* Shading normals lie on the side from which the corners run counter-clockwise. */
static void require_sound_triangles(const struct irb_scene *scene)
{
    for (uint32_t t = 0; t < scene->triangle_count; t++) {
        double c[3];

        triangle_cross(scene, t, c);
        for (int i = 0; i < 3; i++) {
            uint32_t v = scene->indices[3 * (size_t)t + i];
            const float *n = scene->normals + 3 * (size_t)v;

            REQUIRE_CMP(v, <, scene->vertex_count);
            REQUIRE_CMP(n[0] * c[0] + n[1] * c[1] + n[2] * c[2], >, 0);
        }
    }
}

static void require_sound_objects(const struct irb_scene *scene)
{
    uint32_t next = 0;

    for (int i = 0; i < scene->object_count; i++) {
        const struct irb_object *part = &scene->objects[i];

        REQUIRE_CMP(part->first_triangle, ==, next);
        REQUIRE_CMP(part->triangle_count, >, 0);
        REQUIRE_CMP(part->material, >=, 0);
        REQUIRE_CMP(part->material, <, scene->material_count);
        next += part->triangle_count;
    }
    REQUIRE_CMP(next, ==, scene->triangle_count);
}

static void each_is_sound_and_has_a_valid_view(void **state)
{
    (void)state;
    for (const struct irb_builtin *builtin = irb_builtins; builtin->name; builtin++) {
        struct irb_scene *scene = build(builtin->name), *again = build(builtin->name);
        struct irb_animation animation;
        struct irb_error err = {0};

        print_message("%s: %u triangles\n", builtin->name, scene->triangle_count);
        require_sound_vertices(scene);
        require_sound_triangles(scene);
        require_sound_objects(scene);
        assert_string_equal(irb_scene_key(scene).hex, irb_scene_key(again).hex);
        builtin->view(&animation);
        REQUIRE_OK(irb_animation_validate(&animation, &err));
        irb_animation_destroy(&animation);
        irb_scene_destroy(scene);
        irb_scene_destroy(again);
    }
}

static void an_unknown_name_is_refused_with_the_nearest(void **state)
{
    struct irb_error err = {0};
    (void)state;

    assert_null(irb_scene_load("cornel", NULL, &err));
    REQUIRE_CMP(err.code, ==, IRB_E_INPUT);
    assert_non_null(strstr(err.message, "did you mean 'cornell'?"));
}

/* ---- Closedness ---- */

static int compare_positions(const void *a, const void *b, void *scene)
{
    const float *p =
        ((const struct irb_scene *)scene)->positions + 3 * (size_t) * (const uint32_t *)a;
    const float *q =
        ((const struct irb_scene *)scene)->positions + 3 * (size_t) * (const uint32_t *)b;

    for (int i = 0; i < 3; i++)
        if (p[i] != q[i])
            return p[i] < q[i] ? -1 : 1;
    return 0;
}

/* The number of each vertex's place; vertices at one place share it. */
static uint32_t *weld(struct irb_scene *scene)
{
    uint32_t *order = malloc(scene->vertex_count * sizeof *order);
    uint32_t *place = malloc(scene->vertex_count * sizeof *place);

    for (uint32_t v = 0; v < scene->vertex_count; v++)
        order[v] = v;
    qsort_r(order, scene->vertex_count, sizeof *order, compare_positions, scene);
    for (uint32_t i = 0; i < scene->vertex_count; i++)
        place[order[i]] = i > 0 && compare_positions(&order[i], &order[i - 1], scene) == 0
                              ? place[order[i - 1]]
                              : i;
    free(order);
    return place;
}

static int compare_edges(const void *a, const void *b)
{
    uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;

    return (x > y) - (x < y);
}

/* Every edge belongs to two triangles that run along it in opposite directions. */
static void require_closed(struct irb_scene *scene, const struct irb_object *part)
{
    uint32_t *place = weld(scene);
    size_t count = 3 * (size_t)part->triangle_count;
    uint64_t *edges = malloc(count * sizeof *edges), *reversed = malloc(count * sizeof *edges);

    for (size_t i = 0; i < count; i++) {
        const uint32_t *index = scene->indices + 3 * ((size_t)part->first_triangle + i / 3);
        uint64_t a = place[index[i % 3]], b = place[index[(i + 1) % 3]];

        edges[i] = a << 32 | b;
        reversed[i] = b << 32 | a;
    }
    qsort(edges, count, sizeof *edges, compare_edges);
    qsort(reversed, count, sizeof *reversed, compare_edges);
    for (size_t i = 0; i < count; i++) {
        assert_true(edges[i] == reversed[i]);
        assert_true(i == 0 || edges[i] != edges[i - 1]);
    }
    free(place);
    free(edges);
    free(reversed);
}

/* ---- Analytic scenes ---- */

static void sphere_is_a_closed_unit_sphere(void **state)
{
    struct irb_scene *scene = build("sphere");
    const struct irb_object *part = &scene->objects[0];
    (void)state;

    REQUIRE_REL(area_of(scene, part), 4 * M_PI, 1e-4);
    REQUIRE_REL(volume_of(scene, part), -4 * M_PI / 3, 2e-4);
    require_closed(scene, part);
    for (uint32_t v = 0; v < scene->vertex_count; v++)
        for (int i = 0; i < 3; i++)
            REQUIRE_NEAR(scene->normals[3 * v + i], -scene->positions[3 * v + i], 1e-7);
    REQUIRE_NEAR(scene->materials[part->material].diffuse[1], 0.5, 0);
    irb_scene_destroy(scene);
}

static void furnace_is_a_closed_unit_cube(void **state)
{
    struct irb_scene *scene = build("furnace");
    const struct irb_object *part = &scene->objects[0];
    (void)state;

    REQUIRE_NEAR(area_of(scene, part), 6, 1e-12);
    REQUIRE_NEAR(volume_of(scene, part), -1, 1e-12);
    require_closed(scene, part);
    irb_scene_destroy(scene);
}

static void default_light(const char *name, const struct irb_scene *scene, struct irb_light *light,
                          struct irb_camera *camera)
{
    struct irb_animation animation;

    irb_builtin_find(name)->view(&animation);
    irb_animation_light(&animation, scene, 0, light);
    irb_animation_camera(&animation, scene, 0, camera);
    irb_animation_destroy(&animation);
}

/* Corners of the upper square at the corners of a square image; the beam lights the lower only. */
static void squares_fill_the_image_and_the_beam(void **state)
{
    struct irb_scene *scene = build("squares");
    struct irb_light light;
    struct irb_camera camera;
    float view[16], projection[16];
    (void)state;

    REQUIRE_NEAR(area_of(scene, object(scene, "lower")), 1, 0);
    REQUIRE_NEAR(area_of(scene, object(scene, "upper")), 1, 0);
    default_light("squares", scene, &light, &camera);
    irb_camera_matrices(&camera, 1, view, projection);
    for (uint32_t v = 0; v < scene->vertex_count; v++) {
        const float *p = scene->positions + 3 * v;
        bool upper = p[1] == 1;
        float inside[3] = {p[0] * 0.9999f, p[1], p[2] * 0.9999f}, e[3], to_light[3], distance;
        double x = view[0] * p[0] + view[4] * p[1] + view[8] * p[2] + view[12];
        double y = view[1] * p[0] + view[5] * p[1] + view[9] * p[2] + view[13];
        double z = view[2] * p[0] + view[6] * p[1] + view[10] * p[2] + view[14];

        if (upper) {
            REQUIRE_NEAR(fabs(projection[0] * x / -z), 1, 1e-6);
            REQUIRE_NEAR(fabs(projection[5] * y / -z), 1, 1e-6);
        }
        irb_light_incident(&light, inside, e, to_light, &distance);
        REQUIRE_NEAR(e[0], upper ? 0 : light.intensity[0], 0);
    }
    REQUIRE_NEAR(light.half_width, 0.5, 0);
    irb_scene_destroy(scene);
}

/* ---- Cornell box ---- */

static void cornell_has_the_published_measures(void **state)
{
    struct irb_scene *scene = build("cornell");
    struct irb_light light;
    struct irb_camera camera;
    (void)state;

    REQUIRE_CMP(scene->triangle_count, ==, 30); /* 5 walls, 2 blocks of 5 faces */
    REQUIRE_REL(area_of(scene, object(scene, "floor")), (0.5528 + 0.5496) / 2 * 0.5592, 1e-6);
    REQUIRE_REL(area_of(scene, object(scene, "ceiling")), 0.556 * 0.5592, 1e-6);
    REQUIRE_REL(area_of(scene, object(scene, "right wall")), 0.5592 * 0.5488, 1e-6);
    REQUIRE_REL(scene->bounds_max[0], 0.556, 1e-6);
    REQUIRE_REL(scene->bounds_max[1], 0.5488, 1e-6);
    REQUIRE_REL(scene->bounds_max[2], 0.5592, 1e-6);
    REQUIRE_NEAR(scene->materials[object(scene, "left wall")->material].diffuse[0], 0.63, 1e-6);
    REQUIRE_NEAR(scene->materials[object(scene, "right wall")->material].diffuse[1], 0.45, 1e-6);
    default_light("cornell", scene, &light, &camera);
    REQUIRE_REL(tan(camera.vertical_fov / 2.0), 12.5 / 35, 1e-6);
    REQUIRE_CMP(light.position[1], <, scene->bounds_max[1]);
    irb_scene_destroy(scene);
}

static bool is_corner(const struct irb_scene *scene, const struct irb_object *part,
                      const double mm[3])
{
    for (uint32_t t = 0; t < part->triangle_count; t++)
        for (int i = 0; i < 3; i++) {
            const float *p = corner(scene, part->first_triangle + t, i);

            if (fabs(p[0] - mm[0] * 1e-3) + fabs(p[1] - mm[1] * 1e-3) + fabs(p[2] - mm[2] * 1e-3) <
                1e-7)
                return true;
        }
    return false;
}

/* A few corners as the university's page prints them. */
static void cornell_has_the_published_corners(void **state)
{
    static const struct {
        const char *object;
        double mm[3];
    } published[] = {
        {"floor", {552.8, 0, 0}},         {"floor", {549.6, 0, 559.2}},
        {"ceiling", {556, 548.8, 559.2}}, {"back wall", {0, 548.8, 559.2}},
        {"left wall", {556, 548.8, 0}},   {"right wall", {0, 0, 559.2}},
        {"short block", {130, 165, 65}},  {"short block", {82, 165, 225}},
        {"short block", {240, 0, 272}},   {"short block", {290, 0, 114}},
        {"tall block", {423, 330, 247}},  {"tall block", {265, 330, 296}},
        {"tall block", {314, 0, 456}},    {"tall block", {472, 0, 406}},
    };
    struct irb_scene *scene = build("cornell");
    (void)state;

    for (size_t i = 0; i < sizeof published / sizeof *published; i++)
        if (!is_corner(scene, object(scene, published[i].object), published[i].mm))
            fail_msg("%s lacks (%g, %g, %g)", published[i].object, published[i].mm[0],
                     published[i].mm[1], published[i].mm[2]);
    irb_scene_destroy(scene);
}

/* Walls face the middle of the room, blocks away from their own. */
static void cornell_faces_the_right_way(void **state)
{
    struct irb_scene *scene = build("cornell");
    static const double room[3] = {0.278, 0.274, 0.28}, small[3] = {0.186, 0.08, 0.169},
                        tall[3] = {0.3685, 0.16, 0.3515};
    (void)state;

    for (int i = 0; i < scene->object_count; i++) {
        const struct irb_object *part = &scene->objects[i];
        bool is_short = strcmp(part->name, "short block") == 0;
        bool is_block = is_short || strcmp(part->name, "tall block") == 0;
        const double *middle = is_short ? small : is_block ? tall : room;

        for (uint32_t t = 0; t < part->triangle_count; t++) {
            const float *a = corner(scene, part->first_triangle + t, 0);
            double c[3], towards = 0;

            triangle_cross(scene, part->first_triangle + t, c);
            for (int axis = 0; axis < 3; axis++)
                towards += (middle[axis] - a[axis]) * c[axis];
            if (is_block)
                REQUIRE_CMP(towards, <, 0);
            else
                REQUIRE_CMP(towards, >, 0);
        }
    }
    irb_scene_destroy(scene);
}

/* ---- Objects ---- */

enum { KNOT_AROUND = 24 };

/* Mean and farthest point of one ring of the knot's tube; vertices run around it first. */
static double knot_ring(const float *positions, int ring, double centre[3])
{
    const float *first = positions + 3 * (size_t)(ring * KNOT_AROUND);
    double radius = 0;

    for (int i = 0; i < 3; i++) {
        centre[i] = 0;
        for (int v = 0; v < KNOT_AROUND; v++)
            centre[i] += first[3 * v + i] / (double)KNOT_AROUND;
    }
    for (int v = 0; v < KNOT_AROUND; v++)
        radius = fmax(radius, hypot(hypot(first[3 * v] - centre[0], first[3 * v + 1] - centre[1]),
                                    first[3 * v + 2] - centre[2]));
    return radius;
}

/* Rings far apart along the knot keep clear of each other. */
static void require_no_self_contact(const float *positions, int rings)
{
    for (int a = 0; a < rings; a++)
        for (int b = a + 1; b < rings; b++) {
            double p[3], q[3], r = knot_ring(positions, a, p), s = knot_ring(positions, b, q);
            int apart = b - a < rings - (b - a) ? b - a : rings - (b - a);

            if (apart >= rings / 8)
                REQUIRE_CMP(hypot(hypot(p[0] - q[0], p[1] - q[1]), p[2] - q[2]), >, r + s);
        }
}

static void cornell_objects_stand_free_in_the_box(void **state)
{
    struct irb_scene *scene = build("cornell-objects");
    const struct irb_object *ball = object(scene, "sphere"), *knot = object(scene, "knot");
    uint32_t first = scene->indices[3 * (size_t)knot->first_triangle];
    int rings = (int)(scene->vertex_count - first) / KNOT_AROUND;
    double lowest = 1;
    (void)state;

    REQUIRE_CMP(knot->triangle_count, >=, 15000);
    REQUIRE_CMP(knot->triangle_count, <=, 25000);
    require_closed(scene, knot);
    require_closed(scene, ball);
    REQUIRE_CMP(volume_of(scene, knot), >, 0);
    REQUIRE_REL(volume_of(scene, ball), 4 * M_PI / 3 * 1e-3, 5e-3);
    require_no_self_contact(scene->positions + 3 * (size_t)first, rings);
    for (uint32_t v = first; v < scene->vertex_count; v++) {
        const float *p = scene->positions + 3 * (size_t)v;

        lowest = fmin(lowest, p[1]);
        REQUIRE_CMP(hypot(hypot(p[0] - 0.17, p[1] - 0.1), p[2] - 0.16), >, 0.1);
        REQUIRE_CMP(p[0], >, 0.05);
        REQUIRE_CMP(p[0], <, 0.549);
        REQUIRE_CMP(p[2], >, 0.05);
        REQUIRE_CMP(p[2], <, 0.559);
    }
    REQUIRE_NEAR(lowest, 0, 1e-9);
    irb_scene_destroy(scene);
}

static void key_and_bounds_follow_the_transform(void **state)
{
    struct irb_scene *scene = build("squares");
    struct irb_key rest = irb_scene_key(scene);
    float min[3], max[3];
    (void)state;

    scene->objects[1].transform[13] = 2; /* the upper square, 2 m up */
    irb_scene_current_bounds(scene, min, max);
    REQUIRE_NEAR(max[1], 3, 0);
    REQUIRE_NEAR(min[1], 0, 0);
    REQUIRE_REL(irb_scene_diagonal(scene), sqrt(3), 1e-6);
    assert_string_not_equal(irb_scene_key(scene).hex, rest.hex);
    irb_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_is_sound_and_has_a_valid_view),
        cmocka_unit_test(an_unknown_name_is_refused_with_the_nearest),
        cmocka_unit_test(sphere_is_a_closed_unit_sphere),
        cmocka_unit_test(furnace_is_a_closed_unit_cube),
        cmocka_unit_test(squares_fill_the_image_and_the_beam),
        cmocka_unit_test(cornell_has_the_published_measures),
        cmocka_unit_test(cornell_has_the_published_corners),
        cmocka_unit_test(cornell_faces_the_right_way),
        cmocka_unit_test(cornell_objects_stand_free_in_the_box),
        cmocka_unit_test(key_and_bounds_follow_the_transform),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
