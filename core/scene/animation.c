/* SPDX-License-Identifier: MIT */
#include "core/scene/animation.h"

#include "core/scene/vec.h"

#include <stdlib.h>
#include <string.h>

/* The nearest plane, as a share of the scene's diagonal: 4 mm in a 40 m hall. Depth is 32-bit float
 * and only orders surfaces; positions are stored apart. */
#define NEAR_SHARE 1e-4
/* Beyond the farthest corner, so that rounding never cuts it. */
#define FAR_MARGIN 1.01
/* sin of the smallest angle between view and up that still gives a stable frame. */
#define PARALLEL_SINE 1e-4

void irb_animation_destroy(struct irb_animation *animation)
{
    free(animation->light_keys);
    free(animation->camera_keys);
    *animation = (struct irb_animation){0};
}

/* ---- Validation ---- */

static bool all_finite(const float *values, int count)
{
    for (int i = 0; i < count; i++)
        if (!isfinite(values[i]))
            return false;
    return true;
}

static bool check_pose(const char *what, int key, const float position[3], const float target[3],
                       struct irb_error *err)
{
    if (!all_finite(position, 3))
        return irb_fail(err, IRB_E_INPUT, "%s key %d: position is not finite", what, key);
    if (!all_finite(target, 3))
        return irb_fail(err, IRB_E_INPUT, "%s key %d: target is not finite", what, key);
    if (memcmp(position, target, 3 * sizeof(float)) == 0)
        return irb_fail(err, IRB_E_INPUT,
                        "%s key %d: position and target are the same point (%g, %g, %g)", what, key,
                        position[0], position[1], position[2]);
    return true;
}

static bool check_frame(const char *what, int key, float frame, float previous,
                        struct irb_error *err)
{
    if (!isfinite(frame))
        return irb_fail(err, IRB_E_INPUT, "%s key %d: frame is not finite", what, key);
    if (key > 0 && !(frame > previous))
        return irb_fail(err, IRB_E_INPUT,
                        "%s key %d: frame %g does not come after frame %g of key %d", what, key,
                        frame, previous, key - 1);
    return true;
}

static bool check_light_key(const struct irb_animation *animation, int i, struct irb_error *err)
{
    const struct irb_light_key *key = &animation->light_keys[i];

    if (!check_frame("light", i, key->frame, i > 0 ? key[-1].frame : 0, err) ||
        !check_pose("light", i, key->position, key->target, err))
        return false;
    for (int c = 0; c < 3; c++)
        if (!isfinite(key->intensity[c]) || key->intensity[c] < 0)
            return irb_fail(err, IRB_E_INPUT,
                            "light key %d: intensity must be finite and not negative, found %g", i,
                            key->intensity[c]);
    if (animation->light_type == IRB_LIGHT_DIRECTIONAL)
        return true;
    if (!(key->cone > 0 && key->cone < 90))
        return irb_fail(err, IRB_E_INPUT,
                        "light key %d: cone (half-angle) must lie in (0, 90) degrees, found %g", i,
                        key->cone);
    if (!(key->inner >= 0 && key->inner < key->cone))
        return irb_fail(err, IRB_E_INPUT,
                        "light key %d: inner must lie in [0, cone = %g) degrees, found %g", i,
                        key->cone, key->inner);
    return true;
}

/* sin of the angle between the view and up; 0 where one of them has no direction. */
static double up_sine(const double position[3], const double target[3], const double up_vector[3])
{
    double view[3], up[3] = {up_vector[0], up_vector[1], up_vector[2]}, cross[3];

    vec_sub(target, position, view);
    if (!vec_normalize(view) || !vec_normalize(up))
        return 0;
    vec_cross(view, up, cross);
    return vec_length(cross);
}

static bool check_camera_key(const struct irb_animation *animation, int i, struct irb_error *err)
{
    const struct irb_camera_key *key = &animation->camera_keys[i];
    double position[3], target[3], up[3];

    if (!check_frame("camera", i, key->frame, i > 0 ? key[-1].frame : 0, err) ||
        !check_pose("camera", i, key->position, key->target, err))
        return false;
    if (!all_finite(key->up, 3) || (key->up[0] == 0 && key->up[1] == 0 && key->up[2] == 0))
        return irb_fail(err, IRB_E_INPUT, "camera key %d: up must be a finite vector and not zero",
                        i);
    vec_from_float(key->position, position);
    vec_from_float(key->target, target);
    vec_from_float(key->up, up);
    if (up_sine(position, target, up) < PARALLEL_SINE)
        return irb_fail(err, IRB_E_INPUT,
                        "camera key %d: up (%g, %g, %g) is parallel to the view; give another up",
                        i, key->up[0], key->up[1], key->up[2]);
    if (!(key->fov > 0 && key->fov < 180))
        return irb_fail(err, IRB_E_INPUT,
                        "camera key %d: fov must lie in (0, 180) degrees, found %g", i, key->fov);
    return true;
}

static bool check_settings(const struct irb_animation *animation, struct irb_error *err)
{
    float near = animation->z_near, far = animation->z_far, beam = animation->beam_half_width;

    if (!(near >= 0) || !isfinite(near) || !(far >= 0) || !isfinite(far))
        return irb_fail(err, IRB_E_INPUT,
                        "camera: near and far must be finite and not negative, found %g and %g",
                        near, far);
    if (near > 0 && far > 0 && !(near < far))
        return irb_fail(err, IRB_E_INPUT, "camera: near must be below far, found %g and %g", near,
                        far);
    if (!(beam >= 0) || !isfinite(beam))
        return irb_fail(err, IRB_E_INPUT,
                        "light: beam half width must be finite and not negative, found %g", beam);
    return true;
}

bool irb_animation_validate(const struct irb_animation *animation, struct irb_error *err)
{
    if (animation->light_key_count < 1)
        return irb_fail(err, IRB_E_INPUT, "light: no keys, expected at least one");
    if (animation->camera_key_count < 1)
        return irb_fail(err, IRB_E_INPUT, "camera: no keys, expected at least one");
    for (int i = 0; i < animation->light_key_count; i++)
        if (!check_light_key(animation, i, err))
            return false;
    for (int i = 0; i < animation->camera_key_count; i++)
        if (!check_camera_key(animation, i, err))
            return false;
    return check_settings(animation, err);
}

static double radians(double degrees)
{
    return degrees * (M_PI / 180);
}

/* ---- Light ---- */

static float beam_for_scene(const struct irb_light *light, const struct irb_scene *scene)
{
    float bounds[2][3], basis[2][3];
    double half = 0;

    irb_scene_current_bounds(scene, bounds[0], bounds[1]);
    irb_light_basis(light, basis[0], basis[1]);
    for (int corner = 0; corner < 8; corner++) {
        double offset[3];

        for (int i = 0; i < 3; i++)
            offset[i] = (double)bounds[(corner >> i) & 1][i] - light->position[i];
        for (int side = 0; side < 2; side++) {
            double axis[3];

            vec_from_float(basis[side], axis);
            half = fmax(half, fabs(vec_dot(offset, axis)));
        }
    }
    return (float)(half * FAR_MARGIN);
}

void irb_light_fit(struct irb_light *light, const struct irb_scene *scene)
{
    if (light->type == IRB_LIGHT_DIRECTIONAL && !(light->half_width > 0))
        light->half_width = beam_for_scene(light, scene);
}

/* Unit vector from position to target; where interpolation made them meet, key 1's of the segment.
 */
static void light_direction(const struct irb_light_key *key, const double position[3],
                            const double target[3], float direction[3])
{
    double d[3], from[3], to[3];

    vec_sub(target, position, d);
    if (!vec_normalize(d)) {
        vec_from_float(key->position, from);
        vec_from_float(key->target, to);
        vec_sub(to, from, d);
        vec_normalize(d);
    }
    vec_to_float(d, direction);
}

void irb_animation_light(const struct irb_animation *animation, const struct irb_scene *scene,
                         float frame, struct irb_light *out)
{
    const struct irb_light_key *keys = animation->light_keys;
    const size_t stride = sizeof *keys;
    enum irb_interpolation kind = animation->light_interpolation;
    struct irb_key_segment at =
        irb_keys_find(&keys->frame, stride, animation->light_key_count, frame);
    double position[3], target[3];

    *out = (struct irb_light){.type = animation->light_type, .falloff = animation->falloff};
    for (int i = 0; i < 3; i++) {
        position[i] = irb_keys_value(&at, kind, &keys->position[i], stride, false);
        target[i] = irb_keys_value(&at, kind, &keys->target[i], stride, false);
        out->intensity[i] = (float)irb_keys_value(&at, kind, &keys->intensity[i], stride, true);
    }
    vec_to_float(position, out->position);
    light_direction(&keys[at.keys[1]], position, target, out->direction);
    out->outer = (float)radians(irb_keys_value(&at, kind, &keys->cone, stride, true));
    out->inner = (float)radians(irb_keys_value(&at, kind, &keys->inner, stride, true));
    if (out->type == IRB_LIGHT_DIRECTIONAL)
        out->half_width = animation->beam_half_width;
    irb_light_fit(out, scene);
}

/* ---- Camera ---- */

void irb_camera_fit(struct irb_camera *camera, const struct irb_scene *scene)
{
    bool far_is_given = camera->z_far > 0;
    float bounds[2][3];
    double farthest = 0;

    irb_scene_current_bounds(scene, bounds[0], bounds[1]);
    for (int corner = 0; corner < 8; corner++) {
        double offset[3];

        for (int i = 0; i < 3; i++)
            offset[i] = (double)bounds[(corner >> i) & 1][i] - camera->position[i];
        farthest = fmax(farthest, vec_length(offset));
    }
    if (!(camera->z_near > 0))
        camera->z_near = (float)(NEAR_SHARE * irb_scene_diagonal(scene));
    if (!(camera->z_near > 0)) /* a scene without extent */
        camera->z_near = (float)(NEAR_SHARE * (farthest > 0 ? farthest : 1));
    if (!far_is_given)
        camera->z_far = (float)(farthest * FAR_MARGIN);
    if (!(camera->z_far > camera->z_near)) {
        if (far_is_given)
            camera->z_near = (float)(camera->z_far * NEAR_SHARE);
        else
            camera->z_far = 2 * camera->z_near;
    }
}

/* The interpolated pose where it gives a frame, else the segment's first key. */
static void set_pose(const struct irb_camera_key *key, const double position[3],
                     const double target[3], const double up[3], struct irb_camera *out)
{
    double unit[3] = {up[0], up[1], up[2]};

    if (up_sine(position, target, up) >= PARALLEL_SINE / 2) {
        vec_to_float(position, out->position);
        vec_to_float(target, out->target);
    } else {
        memcpy(out->position, key->position, sizeof out->position);
        memcpy(out->target, key->target, sizeof out->target);
        vec_from_float(key->up, unit);
    }
    vec_normalize(unit);
    vec_to_float(unit, out->up);
}

void irb_animation_camera(const struct irb_animation *animation, const struct irb_scene *scene,
                          float frame, struct irb_camera *out)
{
    const struct irb_camera_key *keys = animation->camera_keys;
    const size_t stride = sizeof *keys;
    enum irb_interpolation kind = animation->camera_interpolation;
    struct irb_key_segment at =
        irb_keys_find(&keys->frame, stride, animation->camera_key_count, frame);
    double position[3], target[3], up[3];

    *out = (struct irb_camera){0};
    for (int i = 0; i < 3; i++) {
        position[i] = irb_keys_value(&at, kind, &keys->position[i], stride, false);
        target[i] = irb_keys_value(&at, kind, &keys->target[i], stride, false);
        up[i] = irb_keys_value(&at, kind, &keys->up[i], stride, false);
    }
    set_pose(&keys[at.keys[1]], position, target, up, out);
    out->vertical_fov = (float)radians(irb_keys_value(&at, kind, &keys->fov, stride, true));
    out->z_near = animation->z_near;
    out->z_far = animation->z_far;
    irb_camera_fit(out, scene);
}
