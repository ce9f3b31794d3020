/* SPDX-License-Identifier: MIT */
#include "core/lights/points_mask.h"

#include <math.h>

struct irb_points_mask irb_points_mask(const struct irb_scene *scene,
                                       const struct irb_object *object, uint32_t triangle)
{
    const struct irb_material *material = &scene->materials[object->material];
    struct irb_points_mask mask = {.cutoff = material->alpha_cutoff};
    if (material->diffuse_texture >= 0)
        mask.texture = &scene->textures[material->diffuse_texture];
    for (size_t i = 0; i < 3; i++)
        mask.texcoords[i] = scene->texcoords + 2 * (size_t)scene->indices[3 * (size_t)triangle + i];
    return mask;
}

/* Texel below `x` (in texels from the first centre), wrapped; its weight against the next one. */
static int wrap(double x, int size, double *weight)
{
    const double low = floor(x);
    *weight = 1 - (x - low);
    const double turns = floor(low / size);
    const int texel = (int)(low - turns * size);
    return texel < size ? texel : 0;
}

static double alpha_at(const struct irb_scene_texture *texture, const double at[2])
{
    double weight[2], alpha = 0;
    if (!isfinite(at[0]) || !isfinite(at[1]))
        return 1;
    const int x = wrap(at[0] * texture->width - 0.5, texture->width, &weight[0]);
    const int y = wrap(at[1] * texture->height - 0.5, texture->height, &weight[1]);
    for (int k = 0; k < 4; k++) {
        const size_t column = (size_t)(x + k % 2) % (size_t)texture->width;
        const size_t row = (size_t)(y + k / 2) % (size_t)texture->height;
        alpha += (k % 2 ? 1 - weight[0] : weight[0]) * (k / 2 ? 1 - weight[1] : weight[1]) *
                 texture->rgba[4 * (row * (size_t)texture->width + column) + 3] / 255.0;
    }
    return alpha;
}

bool irb_points_mask_cuts(const struct irb_points_mask *mask, unsigned u, unsigned v)
{
    const double weights[3] = {(65535.0 - u - v) / 65535.0, u / 65535.0, v / 65535.0};
    double at[2] = {0, 0};
    if (!(mask->cutoff > 0))
        return false;
    for (int i = 0; i < 3; i++)
        for (int c = 0; c < 2; c++)
            at[c] += weights[i] * (double)mask->texcoords[i][c];
    return (mask->texture ? alpha_at(mask->texture, at) : 1) < (double)mask->cutoff;
}
