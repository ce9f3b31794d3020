/* SPDX-License-Identifier: MIT */
#include "core/scene/camera.h"

#include "core/scene/vec.h"

#include <string.h>

void camera_axes(const struct irb_camera *camera, double right[3], double up[3], double forward[3])
{
    double eye[3], target[3], hint[3];

    vec_from_float(camera->position, eye);
    vec_from_float(camera->target, target);
    vec_from_float(camera->up, hint);
    vec_sub(target, eye, forward);
    vec_normalize(forward);
    vec_cross(forward, hint, right);
    vec_normalize(right);
    vec_cross(right, forward, up);
}

/* In double and rounded once. */
static void view_matrix(const struct irb_camera *camera, float view[16])
{
    double eye[3], forward[3], right[3], up[3];

    vec_from_float(camera->position, eye);
    camera_axes(camera, right, up, forward);
    for (int column = 0; column < 3; column++) {
        view[4 * column + 0] = (float)right[column];
        view[4 * column + 1] = (float)up[column];
        view[4 * column + 2] = (float)-forward[column];
        view[4 * column + 3] = 0;
    }
    view[12] = (float)-vec_dot(right, eye);
    view[13] = (float)-vec_dot(up, eye);
    view[14] = (float)vec_dot(forward, eye);
    view[15] = 1;
}

void irb_camera_matrices(const struct irb_camera *camera, float aspect, float view[16],
                         float projection[16])
{
    double scale = 1 / tan(camera->vertical_fov / 2.0);
    double near = camera->z_near, far = camera->z_far;

    view_matrix(camera, view);
    memset(projection, 0, 16 * sizeof *projection);
    projection[0] = (float)(scale / aspect);
    projection[5] = (float)scale;
    projection[10] = (float)(-(far + near) / (far - near));
    projection[11] = -1;
    projection[14] = (float)(-2 * far * near / (far - near));
}

void irb_matrix_product(const float a[16], const float b[16], float out[16])
{
    for (int c = 0; c < 4; c++)
        for (int r = 0; r < 4; r++) {
            double sum = 0;
            for (int k = 0; k < 4; k++)
                sum += (double)a[4 * k + r] * b[4 * c + k];
            out[4 * c + r] = (float)sum;
        }
}

void irb_camera_hash(const struct irb_camera *camera, struct irb_hash *hash)
{
    irb_hash_string(hash, "camera 1");
    irb_hash_floats(hash, camera->position, 3);
    irb_hash_floats(hash, camera->target, 3);
    irb_hash_floats(hash, camera->up, 3);
    irb_hash_floats(hash, &camera->vertical_fov, 1);
    irb_hash_floats(hash, &camera->z_near, 1);
    irb_hash_floats(hash, &camera->z_far, 1);
}
