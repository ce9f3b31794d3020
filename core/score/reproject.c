/* SPDX-License-Identifier: MIT */
#include "core/score/reproject.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const float position_tolerance = 0.01f; /* of the distance to the camera; source: ours */
static const float normal_tolerance = 0.9063f; /* cos 25 degrees; source: ours */

/* Of the magnitudes that a point passes through between world and rest: 16 roundings of a float.
 * Source: ours. */
static const double box_margin = 16 * 0x1p-24;

/* column-major 4x4 times (x, y, z, 1) */
static void transform(const float m[16], const float p[3], float out[4])
{
    for (int r = 0; r < 4; r++)
        out[r] = m[r] * p[0] + m[4 + r] * p[1] + m[8 + r] * p[2] + m[12 + r];
}

/* Index of the pixel that the point falls on, or -1. */
static int32_t project(const float view_projection[16], const float position[3], int width,
                       int height)
{
    float clip[4];
    transform(view_projection, position, clip);
    if (!(clip[3] > 0))
        return -1;
    float x = floorf((clip[0] / clip[3] * 0.5f + 0.5f) * (float)width);
    float y = floorf((0.5f - clip[1] / clip[3] * 0.5f) * (float)height);
    if (!(x >= 0 && x < (float)width && y >= 0 && y < (float)height))
        return -1;
    return (int32_t)y * width + (int32_t)x;
}

/* Inverse of an affine matrix, by cofactors; false where it has none. */
static bool invert(const float m[16], double out[16])
{
    double cofactor[3][3], determinant = 0; /* [column][row] */
    for (int c = 0; c < 3; c++)
        for (int r = 0; r < 3; r++) {
            const float *u = m + 4 * ((c + 1) % 3), *v = m + 4 * ((c + 2) % 3);
            int p = (r + 1) % 3, q = (r + 2) % 3;
            cofactor[c][r] = (double)u[p] * v[q] - (double)u[q] * v[p];
        }
    for (int r = 0; r < 3; r++)
        determinant += m[r] * cofactor[0][r];
    if (determinant == 0 || !isfinite(1 / determinant))
        return false;
    memset(out, 0, 16 * sizeof *out);
    out[15] = 1;
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 3; column++) {
            out[4 * column + row] = cofactor[row][column] / determinant;
            out[12 + row] -= cofactor[row][column] / determinant * m[12 + column];
        }
    return true;
}

void irb_moved_object_set(struct irb_moved_object *out, const float previous[16],
                          const float current[16], const float low[3], const float high[3])
{
    memcpy(out->low, low, sizeof out->low);
    memcpy(out->high, high, sizeof out->high);
    out->visible[0] = invert(previous, out->to_rest[0]);
    out->visible[1] = invert(current, out->to_rest[1]);
}

static bool in_box(const struct irb_moved_object *object, int frame, const float position[3])
{
    const double *m = object->to_rest[frame];
    if (!object->visible[frame])
        return false;
    for (int i = 0; i < 3; i++) {
        double size = fabs((double)object->low[i]) + fabs((double)object->high[i]);
        double p = m[i] * position[0] + m[4 + i] * position[1] + m[8 + i] * position[2] + m[12 + i];
        /* the rounding of the way there and back scales with the largest of its terms */
        double margin =
            box_margin * (size + fabs(m[i] * position[0]) + fabs(m[4 + i] * position[1]) +
                          fabs(m[8 + i] * position[2]) + fabs(m[12 + i]));
        if (p < object->low[i] - margin || p > object->high[i] + margin)
            return false;
    }
    return true;
}

static bool in_any_box(const struct irb_moved_object *moved, int count, int frame,
                       const float position[3])
{
    for (int i = 0; i < count; i++)
        if (in_box(&moved[i], frame, position))
            return true;
    return false;
}

static bool same_surface(const struct irb_gbuffer_image *current, size_t i,
                         const struct irb_gbuffer_image *previous, size_t j)
{
    const float *p = current->position.data + 4 * i, *q = previous->position.data + 4 * j;
    const float *n = current->normal.data + 4 * i, *m = previous->normal.data + 4 * j;
    if (q[3] <= 0)
        return false;
    float apart = hypotf(hypotf(p[0] - q[0], p[1] - q[1]), p[2] - q[2]);
    return apart <= position_tolerance * m[3] &&
           n[0] * m[0] + n[1] * m[1] + n[2] * m[2] >= normal_tolerance;
}

bool irb_reproject(struct irb_reprojection *out, const struct irb_gbuffer_image *current,
                   const struct irb_gbuffer_image *previous,
                   const struct irb_camera *previous_camera, const struct irb_moved_object *moved,
                   int moved_count, struct irb_error *err)
{
    int width = current->width, height = current->height;
    size_t pixels = (size_t)width * (size_t)height;
    *out = (struct irb_reprojection){.width = width, .height = height};
    out->source = malloc(pixels * sizeof *out->source);
    if (!out->source)
        return irb_fail(err, IRB_E_MEMORY, "no memory to reproject %zu pixels", pixels);
    float view[16], projection[16], view_projection[16];
    irb_camera_matrices(previous_camera, (float)width / (float)height, view, projection);
    irb_matrix_product(projection, view, view_projection);
    for (size_t i = 0; i < pixels; i++) {
        const float *position = current->position.data + 4 * i;
        int32_t j = position[3] > 0 ? project(view_projection, position, width, height) : -1;
        bool found = j >= 0 && same_surface(current, i, previous, (size_t)j) &&
                     !in_any_box(moved, moved_count, 1, position) &&
                     !in_any_box(moved, moved_count, 0, previous->position.data + 4 * (size_t)j);
        out->source[i] = found ? j : -1;
    }
    return true;
}

void irb_reprojection_destroy(struct irb_reprojection *reprojection)
{
    free(reprojection->source);
    *reprojection = (struct irb_reprojection){0};
}

bool irb_reprojection_apply(const struct irb_reprojection *reprojection,
                            const struct irb_image *image, struct irb_image *warped,
                            struct irb_error *err)
{
    if (!irb_image_create(warped, image->width, image->height, image->channels, err))
        return false;
    size_t channels = (size_t)image->channels;
    for (size_t i = 0; i < irb_image_pixels(image); i++) {
        int32_t j = reprojection->source[i];
        for (size_t c = 0; j >= 0 && c < channels; c++)
            warped->data[channels * i + c] = image->data[channels * (size_t)j + c];
    }
    return true;
}
