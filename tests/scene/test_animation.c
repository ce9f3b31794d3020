/* SPDX-License-Identifier: MIT */
#include "core/scene/animation.h"
#include "core/scene/builtin.h"

#include "tests/support/compare.h"

#include <string.h>

static const struct irb_camera_key still = {
    .position = {0.5f, 0.5f, 0.9f}, .target = {0.5f, 0.5f, 0}, .up = {0, 2, 0}, .fov = 60};

/* The furnace: near, far and beam need bounds. */
static int make_scene(void **state)
{
    struct irb_error err;

    *state = irb_builtin_find("furnace")->build(&err);
    return *state ? 0 : -1;
}

static int free_scene(void **state)
{
    irb_scene_destroy(*state);
    return 0;
}

static struct irb_animation animation_of(struct irb_light_key *keys, int count,
                                         struct irb_camera_key *camera,
                                         enum irb_interpolation interpolation)
{
    struct irb_animation animation = {.light_interpolation = interpolation,
                                      .camera_interpolation = interpolation,
                                      .light_keys = keys,
                                      .light_key_count = count,
                                      .camera_keys = camera,
                                      .camera_key_count = 1};

    return animation;
}

/* Keys whose x is a function of the frame. */
static void fill_keys(struct irb_light_key *keys, const float *frames, int count,
                      double (*x)(double))
{
    for (int i = 0; i < count; i++)
        keys[i] = (struct irb_light_key){.frame = frames[i],
                                         .position = {(float)x(frames[i]), 0, 0},
                                         .target = {0, -5, 0},
                                         .intensity = {1, 1, 1},
                                         .cone = 30};
}

static double x_at(const struct irb_animation *animation, const struct irb_scene *scene,
                   double frame)
{
    struct irb_light light;

    irb_animation_light(animation, scene, (float)frame, &light);
    return light.position[0];
}

static double line(double t)
{
    return 3 * t - 4;
}

static double parabola(double t)
{
    return t * t;
}

static double wave(double t)
{
    return sin(t);
}

static void straight_motion_stays_straight_with_uneven_keys(void **state)
{
    static const float frames[] = {0, 1, 5, 7, 20};
    struct irb_camera_key camera = still;
    struct irb_light_key keys[5];
    struct irb_animation animation = animation_of(keys, 5, &camera, IRB_LINEAR);

    fill_keys(keys, frames, 5, line);
    for (int kind = 0; kind < 2; kind++) {
        animation.light_interpolation = (enum irb_interpolation)kind;
        for (double t = 0; t <= 20; t += 0.25)
            REQUIRE_NEAR(x_at(&animation, *state, t), line(t), 1e-5);
    }
}

/* Central differences are exact for a parabola, so its inner segments come back exactly. */
static void catmull_rom_reproduces_a_parabola(void **state)
{
    static const float frames[] = {0, 1, 2, 3, 4};
    struct irb_camera_key camera = still;
    struct irb_light_key keys[5];
    struct irb_animation animation = animation_of(keys, 5, &camera, IRB_CATMULL_ROM);

    fill_keys(keys, frames, 5, parabola);
    for (double t = 1; t <= 3; t += 0.125)
        REQUIRE_NEAR(x_at(&animation, *state, t), t * t, 1e-6);
}

static void catmull_rom_passes_smoothly_through_its_keys(void **state)
{
    static const float frames[] = {0, 1, 2.5f, 3, 6};
    struct irb_camera_key camera = still;
    struct irb_light_key keys[5];
    struct irb_animation animation = animation_of(keys, 5, &camera, IRB_CATMULL_ROM);
    const double h = 1.0 / 64;

    fill_keys(keys, frames, 5, wave);
    for (int i = 0; i < 5; i++)
        REQUIRE_NEAR(x_at(&animation, *state, frames[i]), keys[i].position[0], 0);
    for (int i = 1; i < 4; i++) {
        double before = x_at(&animation, *state, frames[i] - h);
        double at = x_at(&animation, *state, frames[i]);
        double after = x_at(&animation, *state, frames[i] + h);

        REQUIRE_NEAR((after - at) / h, (at - before) / h, 0.1); /* a kink would differ by ~1 */
    }
}

static void frames_outside_the_keys_are_clamped(void **state)
{
    static const float frames[] = {2, 8};
    struct irb_camera_key camera = still;
    struct irb_light_key keys[2];
    struct irb_animation animation = animation_of(keys, 2, &camera, IRB_CATMULL_ROM);

    fill_keys(keys, frames, 2, line);
    REQUIRE_NEAR(x_at(&animation, *state, -16), line(2), 0);
    REQUIRE_NEAR(x_at(&animation, *state, 0), line(2), 0);
    REQUIRE_NEAR(x_at(&animation, *state, 1e6), line(8), 0);
    keys[0].frame = -4; /* settle frames equal frame 0, not the key before it */
    REQUIRE_NEAR(x_at(&animation, *state, -3), x_at(&animation, *state, 0), 0);
}

static void intensity_and_angles_do_not_overshoot(void **state)
{
    static const float frames[] = {0, 1, 2, 3};
    struct irb_camera_key camera = still;
    struct irb_light_key keys[4];
    struct irb_animation animation = animation_of(keys, 4, &camera, IRB_CATMULL_ROM);

    fill_keys(keys, frames, 4, line);
    keys[0].intensity[0] = keys[1].intensity[0] = 0;
    keys[2].intensity[0] = keys[3].intensity[0] = 10;
    keys[2].cone = keys[3].cone = 89;
    for (double t = 0; t <= 3; t += 0.0625) {
        struct irb_light light;

        irb_animation_light(&animation, *state, (float)t, &light);
        REQUIRE_CMP(light.intensity[0], >=, 0);
        REQUIRE_CMP(light.intensity[0], <=, 10);
        REQUIRE_CMP(light.outer, <=, 89 * M_PI / 180 + 1e-6);
    }
}

static void light_has_a_unit_direction_even_where_target_meets_position(void **state)
{
    struct irb_light_key keys[2] = {{.frame = 0,
                                     .position = {-1, 0, 0},
                                     .target = {1, 0, 0},
                                     .intensity = {1, 1, 1},
                                     .cone = 30},
                                    {.frame = 2,
                                     .position = {1, 0, 0},
                                     .target = {-1, 0, 0},
                                     .intensity = {1, 1, 1},
                                     .cone = 30}};
    struct irb_camera_key camera = still;
    struct irb_animation animation = animation_of(keys, 2, &camera, IRB_LINEAR);
    struct irb_light light;

    irb_animation_light(&animation, *state, 1, &light);
    REQUIRE_NEAR(light.direction[0], 1, 1e-6);
    REQUIRE_NEAR(light.outer, M_PI / 6, 1e-6);
}

static void near_and_far_hold_the_room(void **state)
{
    struct irb_light_key key;
    struct irb_camera_key camera = still;
    struct irb_animation animation = animation_of(&key, 1, &camera, IRB_LINEAR);
    struct irb_camera out;

    fill_keys(&key, (const float[]){0}, 1, line);
    irb_animation_camera(&animation, *state, 0, &out);
    REQUIRE_CMP(out.z_near, <=, 1e-3 * sqrt(3));
    REQUIRE_CMP(out.z_near, >=, 1e-4 * sqrt(3) * 0.999);
    REQUIRE_REL(out.z_far, 1.01 * sqrt(0.25 + 0.25 + 0.81), 1e-5);
    REQUIRE_NEAR(out.up[1], 1, 1e-7);
    REQUIRE_REL(out.vertical_fov, M_PI / 3, 1e-6);
    animation.z_near = 0.25f;
    animation.z_far = 7;
    irb_animation_camera(&animation, *state, 0, &out);
    REQUIRE_NEAR(out.z_near, 0.25, 0);
    REQUIRE_NEAR(out.z_far, 7, 0);
}

static void a_beam_without_width_covers_the_scene(void **state)
{
    struct irb_scene *scene = *state;
    struct irb_light_key key;
    struct irb_camera_key camera = still;
    struct irb_animation animation = animation_of(&key, 1, &camera, IRB_LINEAR);
    struct irb_light light;

    fill_keys(&key, (const float[]){0}, 1, line);
    memcpy(key.position, (const float[3]){5, 6, 7}, sizeof key.position);
    memcpy(key.target, (const float[3]){0, 0, 1}, sizeof key.target);
    animation.light_type = IRB_LIGHT_DIRECTIONAL;
    irb_animation_light(&animation, scene, 0, &light);
    for (uint32_t v = 0; v < scene->vertex_count; v++) {
        float e[3], to_light[3], distance;

        irb_light_incident(&light, scene->positions + 3 * v, e, to_light, &distance);
        REQUIRE_NEAR(e[0], 1, 0);
    }
}

/* ---- What is refused ---- */

static void require_refused(const struct irb_animation *animation, const char *expected)
{
    struct irb_error err = {0};

    if (irb_animation_validate(animation, &err))
        fail_msg("accepted, expected a message with \"%s\"", expected);
    REQUIRE_CMP(err.code, ==, IRB_E_INPUT);
    if (!strstr(err.message, expected))
        fail_msg("message \"%s\" lacks \"%s\"", err.message, expected);
}

/* Sets one float of the second light key or the camera key, looks, and puts it back. */
static void require_value_refused(const struct irb_animation *animation, float *field, float value,
                                  const char *expected)
{
    float kept = *field;

    *field = value;
    require_refused(animation, expected);
    *field = kept;
}

static void validation_names_key_and_field(void **state)
{
    static const float frames[] = {0, 4};
    struct irb_camera_key camera = still;
    struct irb_light_key keys[2];
    struct irb_animation animation = animation_of(keys, 2, &camera, IRB_LINEAR);
    struct irb_error err = {0};
    (void)state;

    fill_keys(keys, frames, 2, line);
    REQUIRE_OK(irb_animation_validate(&animation, &err));
    require_value_refused(&animation, &keys[1].frame, 0, "light key 1: frame 0");
    require_value_refused(&animation, &keys[1].frame, NAN, "light key 1: frame");
    require_value_refused(&animation, &keys[1].position[2], INFINITY, "light key 1: position");
    require_value_refused(&animation, &keys[0].target[1], NAN, "light key 0: target");
    require_value_refused(&animation, &keys[1].intensity[1], -1, "light key 1: intensity");
    require_value_refused(&animation, &keys[1].intensity[1], NAN, "light key 1: intensity");
    require_value_refused(&animation, &keys[0].cone, 0, "light key 0: cone");
    require_value_refused(&animation, &keys[0].cone, 90, "found 90");
    require_value_refused(&animation, &keys[0].cone, NAN, "light key 0: cone");
    require_value_refused(&animation, &keys[0].inner, 30, "light key 0: inner");
    require_value_refused(&animation, &keys[0].inner, -1, "light key 0: inner");
    require_value_refused(&animation, &camera.fov, 180, "camera key 0: fov");
    require_value_refused(&animation, &camera.fov, 0, "camera key 0: fov");
    require_value_refused(&animation, &camera.up[1], 0, "camera key 0: up");
    require_value_refused(&animation, &camera.up[0], NAN, "camera key 0: up");
    require_value_refused(&animation, &camera.target[2], 0.9f, "same point");
    require_value_refused(&animation, &animation.z_near, -1, "near");
    require_value_refused(&animation, &animation.z_far, NAN, "far");
    require_value_refused(&animation, &animation.beam_half_width, -1, "beam");
    animation.z_near = 2;
    require_value_refused(&animation, &animation.z_far, 1, "near must be below far");
}

static void validation_refuses_missing_keys_and_a_parallel_up(void **state)
{
    struct irb_camera_key camera = still;
    struct irb_light_key key;
    struct irb_animation animation = animation_of(&key, 1, &camera, IRB_LINEAR);
    (void)state;

    fill_keys(&key, (const float[]){0}, 1, line);
    memcpy(camera.up, (const float[3]){0, 0, -3}, sizeof camera.up);
    require_refused(&animation, "parallel");
    animation.camera_key_count = 0;
    require_refused(&animation, "camera: no keys");
    animation.light_key_count = 0;
    require_refused(&animation, "light: no keys");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(straight_motion_stays_straight_with_uneven_keys),
        cmocka_unit_test(catmull_rom_reproduces_a_parabola),
        cmocka_unit_test(catmull_rom_passes_smoothly_through_its_keys),
        cmocka_unit_test(frames_outside_the_keys_are_clamped),
        cmocka_unit_test(intensity_and_angles_do_not_overshoot),
        cmocka_unit_test(light_has_a_unit_direction_even_where_target_meets_position),
        cmocka_unit_test(near_and_far_hold_the_room),
        cmocka_unit_test(a_beam_without_width_covers_the_scene),
        cmocka_unit_test(validation_names_key_and_field),
        cmocka_unit_test(validation_refuses_missing_keys_and_a_parallel_up),
    };

    return cmocka_run_group_tests(tests, make_scene, free_scene);
}
