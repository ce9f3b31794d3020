/* SPDX-License-Identifier: MIT */
#include "core/score/reproject.h"

#include <math.h>
#include <stdlib.h>

static const float position_tolerance = 0.01f; /* of the distance to the camera; source: ours */
static const float normal_tolerance = 0.9063f; /* cos 25 degrees; source: ours */

/* column-major 4x4 times (x, y, z, 1) */
static void transform(const float m[16], const float p[3], float out[4])
{
    for (int r = 0; r < 4; r++)
        out[r] = m[r] * p[0] + m[4 + r] * p[1] + m[8 + r] * p[2] + m[12 + r];
}

static void multiply(const float a[16], const float b[16], float out[16])
{
    for (int c = 0; c < 4; c++)
        for (int r = 0; r < 4; r++) {
            float sum = 0;
            for (int k = 0; k < 4; k++)
                sum += a[4 * k + r] * b[4 * c + k];
            out[4 * c + r] = sum;
        }
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
                   const struct irb_camera *previous_camera, struct irb_error *err)
{
    int width = current->width, height = current->height;
    size_t pixels = (size_t)width * (size_t)height;
    *out = (struct irb_reprojection){.width = width, .height = height};
    out->source = malloc(pixels * sizeof *out->source);
    if (!out->source)
        return irb_fail(err, IRB_E_MEMORY, "no memory to reproject %zu pixels", pixels);
    float view[16], projection[16], view_projection[16];
    irb_camera_matrices(previous_camera, (float)width / (float)height, view, projection);
    multiply(projection, view, view_projection);
    for (size_t i = 0; i < pixels; i++) {
        const float *position = current->position.data + 4 * i;
        int32_t j = position[3] > 0 ? project(view_projection, position, width, height) : -1;
        out->source[i] = j >= 0 && same_surface(current, i, previous, (size_t)j) ? j : -1;
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
