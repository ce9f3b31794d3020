/* SPDX-License-Identifier: MIT
 *
 * The architectural scenes by brute force: their sizes, that no ray leaves them but through the
 * court's open sky, that what a ray meets first faces it, and that no lit place is seen where
 * there must be none.
 */
#include "core/scene/builtin.h"
#include "core/scene/vec.h"

#include "tests/support/compare.h"

#include <string.h>
#include <time.h>

static struct irb_scene *build(const char *name)
{
    struct irb_error err = {0};
    struct irb_scene *scene = irb_scene_load(name, NULL, &err);

    if (!scene)
        fail_msg("%s: %s", name, err.message);
    return scene;
}

struct hit {
    double distance; /* INFINITY for none */
    double facing;   /* cosine between the triangle's front and the way back */
    const struct irb_object *object;
};

/* Moeller and Trumbore 1997, both sides. */
static void meet_triangle(const struct irb_scene *scene, uint32_t triangle, const double from[3],
                          const double way[3], const struct irb_object *object, struct hit *hit)
{
    double p[3][3], ab[3], ac[3], normal[3], s[3], q[3], h[3], determinant, u, v, t;

    for (int i = 0; i < 3; i++)
        vec_from_float(scene->positions + 3 * (size_t)scene->indices[3 * (size_t)triangle + i],
                       p[i]);
    vec_sub(p[1], p[0], ab);
    vec_sub(p[2], p[0], ac);
    vec_cross(way, ac, h);
    determinant = vec_dot(ab, h);
    if (determinant == 0)
        return;
    vec_sub(from, p[0], s);
    u = vec_dot(s, h) / determinant;
    if (u < 0 || u > 1)
        return;
    vec_cross(s, ab, q);
    v = vec_dot(way, q) / determinant;
    t = vec_dot(ac, q) / determinant;
    if (v < 0 || u + v > 1 || t < 1e-6 || t >= hit->distance)
        return;
    vec_cross(ab, ac, normal);
    *hit = (struct hit){t, -vec_dot(normal, way) / vec_length(normal), object};
}

/* The boxes of objects spare most triangles. */
struct boxes {
    const struct irb_scene *scene;
    double min[64][3], max[64][3];
};

static void find_boxes(const struct irb_scene *scene, struct boxes *boxes)
{
    boxes->scene = scene;
    REQUIRE_CMP(scene->object_count, <=, 64);
    for (int o = 0; o < scene->object_count; o++) {
        const struct irb_object *object = &scene->objects[o];

        for (int axis = 0; axis < 3; axis++) {
            boxes->min[o][axis] = INFINITY;
            boxes->max[o][axis] = -INFINITY;
        }
        for (size_t i = 0; i < 3 * (size_t)object->triangle_count; i++) {
            const float *p = scene->positions +
                             3 * (size_t)scene->indices[3 * (size_t)object->first_triangle + i];

            for (int axis = 0; axis < 3; axis++) {
                boxes->min[o][axis] = fmin(boxes->min[o][axis], p[axis]);
                boxes->max[o][axis] = fmax(boxes->max[o][axis], p[axis]);
            }
        }
    }
}

static bool meets_box(const struct boxes *boxes, int o, const double from[3], const double way[3],
                      double limit)
{
    double near = 0, far = limit;

    for (int axis = 0; axis < 3; axis++) {
        double a = (boxes->min[o][axis] - 1e-6 - from[axis]) / way[axis];
        double b = (boxes->max[o][axis] + 1e-6 - from[axis]) / way[axis];

        near = fmax(near, fmin(a, b));
        far = fmin(far, fmax(a, b));
    }
    return near <= far;
}

static struct hit first_hit(const struct boxes *boxes, const double from[3], const double way[3])
{
    struct hit hit = {INFINITY, 0, NULL};

    for (int o = 0; o < boxes->scene->object_count; o++) {
        const struct irb_object *object = &boxes->scene->objects[o];

        if (!meets_box(boxes, o, from, way, hit.distance))
            continue;
        for (uint32_t t = 0; t < object->triangle_count; t++)
            meet_triangle(boxes->scene, object->first_triangle + t, from, way, object, &hit);
    }
    return hit;
}

/* Even over the sphere (a Fibonacci lattice); no component is zero. */
static void direction(int i, int count, double way[3])
{
    double z = 1 - (2.0 * i + 1) / count, r = sqrt(1 - z * z), phi = i * 2.399963229728653;

    way[0] = r * cos(phi) + 1e-9;
    way[1] = z;
    way[2] = r * sin(phi) + 1e-9;
}

static bool is_cloth(const struct irb_object *object)
{
    static const char *const sheets[] = {"curtain", "banners", "leaves"};

    for (size_t i = 0; i < sizeof sheets / sizeof *sheets; i++)
        if (strstr(object->name, sheets[i]))
            return true;
    return false;
}

/* Whether a ray leaves through the atrium's sky: 22 x 8 m at the height of the roof. */
static bool reaches_sky(const double from[3], const double way[3])
{
    double t = (10.6 - from[1]) / way[1];

    return way[1] > 0 && fabs(from[0] + t * way[0]) < 11 && fabs(from[2] + t * way[2]) < 4;
}

static void require_tight(const struct irb_scene *scene, const double from[3], int count)
{
    static struct boxes boxes; /* too large for the stack of a small machine */
    bool open = strcmp(scene->name, "atrium") == 0;

    find_boxes(scene, &boxes);
    for (int i = 0; i < count; i++) {
        double way[3];
        struct hit hit;

        direction(i, count, way);
        hit = first_hit(&boxes, from, way);
        if (!hit.object && !(open && reaches_sky(from, way)))
            fail_msg("%s: the ray from (%g, %g, %g) along (%g, %g, %g) leaves", scene->name,
                     from[0], from[1], from[2], way[0], way[1], way[2]);
        if (hit.object && !is_cloth(hit.object) && !(hit.facing > 0))
            fail_msg("%s: the ray from (%g, %g, %g) along (%g, %g, %g) meets the back of '%s'",
                     scene->name, from[0], from[1], from[2], way[0], way[1], way[2],
                     hit.object->name);
    }
}

static void no_ray_finds_a_crack(void **state)
{
    static const struct {
        const char *scene;
        double points[4][3];
    } places[] = {
        {"hall", {{-10, 8, 0.3}, {7, 14, 0.4}, {-8, 2, 6.4}, {14, 5, -1}}},
        {"atrium", {{-9.6, 2.1, -1.4}, {3, 2, 6.3}, {-13.2, 2.2, 6.1}, {8, 7.6, -5.8}}},
        {"doorway", {{3, 1.6, 2.2}, {8.6, 2.5, 4.4}, {6.4, 0.3, 2.3}, {0.4, 3, 5}}},
        {"corridor", {{1.3, 1.6, 1}, {1.3, 0.5, 12.7}, {8, 2.6, 12.7}, {13.2, 1, 13}}},
    };
    (void)state;

    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        struct irb_scene *scene = build(places[i].scene);

        for (int p = 0; p < 4; p++)
            require_tight(scene, places[i].points[p], 200);
        irb_scene_destroy(scene);
    }
}

static void sizes_are_what_is_documented(void **state)
{
    static const struct {
        const char *scene;
        double triangles, size[3]; /* within 15 % */
    } expected[] = {
        {"hall", 75000, {40, 30, 17}},
        {"atrium", 260000, {31.5, 11, 17.5}},
    };
    (void)state;

    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        struct irb_scene *scene = build(expected[i].scene);

        REQUIRE_REL(scene->triangle_count, expected[i].triangles, 0.15);
        for (int axis = 0; axis < 3; axis++)
            REQUIRE_REL(scene->bounds_max[axis] - scene->bounds_min[axis], expected[i].size[axis],
                        0.15);
        irb_scene_destroy(scene);
    }
}

static double seconds(void)
{
    struct timespec now;

    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void they_load_in_under_two_seconds(void **state)
{
    static const char *const names[] = {"hall", "atrium"};
    (void)state;

    for (int i = 0; i < 2; i++) {
        double start = seconds();

        irb_scene_destroy(build(names[i]));
        print_message("%s: %.3f s\n", names[i], seconds() - start);
        REQUIRE_CMP(seconds() - start, <, 2);
    }
}

/* What the spot can reach directly lies in the other room, or round the corner: no point of the
 * camera's own room that the light's rays meet first. */
static void the_light_stays_behind_the_door(void **state)
{
    static struct boxes boxes;
    struct irb_scene *scene = build("doorway");
    const struct irb_builtin *builtin = irb_builtin_find("doorway");
    struct irb_animation animation;
    struct irb_light light;
    double from[3], lit = 0, inside = 0;
    (void)state;

    find_boxes(scene, &boxes);
    builtin->view(&animation);
    irb_animation_light(&animation, scene, 0, &light);
    vec_from_float(light.position, from);
    for (int i = 0; i < 4000; i++) {
        double way[3], axis[3];
        struct hit hit;

        direction(i, 4000, way);
        vec_from_float(light.direction, axis);
        if (irb_light_falloff(&light, vec_dot(way, axis)) == 0)
            continue;
        hit = first_hit(&boxes, from, way);
        assert_non_null(hit.object);
        lit++;
        inside += from[0] + hit.distance * way[0] < 7.0;
    }
    REQUIRE_CMP(lit, >, 100);
    REQUIRE_NEAR(inside, 0, 0);
    irb_animation_destroy(&animation);
    irb_scene_destroy(scene);
}

/* Textures: the right number of texels, varied, opaque; only where a material names them. */
static void atrium_is_finely_structured(void **state)
{
    struct irb_scene *scene = build("atrium");
    (void)state;

    REQUIRE_CMP(scene->texture_count, ==, 4);
    for (int i = 0; i < scene->texture_count; i++) {
        const struct irb_scene_texture *texture = &scene->textures[i];
        size_t count = (size_t)texture->width * (size_t)texture->height;
        double sum = 0, squares = 0;

        for (size_t t = 0; t < count; t++) {
            double green = texture->rgba[4 * t + 1];

            assert_int_equal(texture->rgba[4 * t + 3], 255);
            sum += green;
            squares += green * green;
        }
        REQUIRE_CMP(sqrt(squares / (double)count - pow(sum / (double)count, 2)), >, 5);
    }
    irb_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sizes_are_what_is_documented),
        cmocka_unit_test(they_load_in_under_two_seconds),
        cmocka_unit_test(no_ray_finds_a_crack),
        cmocka_unit_test(the_light_stays_behind_the_door),
        cmocka_unit_test(atrium_is_finely_structured),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
