/* SPDX-License-Identifier: MIT
 *
 * Virtual lights and shadow maps that tests make themselves: maps are filled on the CPU, in double
 * precision, with the distances that a function of the test's gives, so that shading is looked at
 * without any splatting.
 */
#ifndef IRB_TESTS_LIGHTS_SHADE_SCENE_H
#define IRB_TESTS_LIGHTS_SHADE_SCENE_H

#include "core/lights/ism.h"
#include "core/lights/virtual_light.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* As core/lights/virtual_light.h lays it out. */
struct shade_light {
    float position[3], area;
    float normal[3], unused_normal;
    float flux[3], unused_flux;
};

/* From a point in a unit direction to the nearest surface, m; INFINITY where there is none. */
typedef double shade_distance_fn(const void *scene, const double from[3], const double along[3]);

/* Whole blocks; NULL on failure. */
static inline struct irb_buffer *shade_lights_upload(struct irb_gl *gl,
                                                     const struct shade_light *lights, int count,
                                                     struct irb_error *err)
{
    const size_t blocks = (size_t)(count + IRB_VPL_BLOCK - 1) / IRB_VPL_BLOCK;
    const size_t bytes = (blocks ? blocks : 1) * IRB_VPL_BLOCK * IRB_VPL_BYTES;
    char *padded = calloc(1, bytes);
    if (!padded)
        return NULL;
    memcpy(padded, lights, (size_t)count * sizeof *lights);
    struct irb_buffer *buffer = irb_buffer_create(gl, "lights", (int64_t)bytes, padded, err);
    free(padded);
    return buffer;
}

/* The light's frame as shaders/lights/paraboloid.glsl documents it: tangent, bitangent, normal. */
static inline void shade_frame(const float normal[3], double frame[3][3])
{
    double x = normal[0], y = normal[1], z = normal[2], s = z >= 0 ? 1 : -1;
    double a = -1 / (s + z), b = x * y * a;
    const double axes[3][3] = {
        {1 + s * x * x * a, s * b, -s * x}, {b, s + y * y * a, -y}, {x, y, z}};
    memcpy(frame, axes, sizeof axes);
}

/* An atlas of `count` maps, to be filled; ism->atlas is the caller's to destroy. False on failure.
 */
static inline bool shade_maps_create(struct irb_ism *ism, struct irb_gl *gl, int map_size,
                                     int count, struct irb_error *err)
{
    const int row = (int)ceil(sqrt(count > 0 ? count : 1));
    const struct irb_texture_desc atlas = {
        .name = "atlas", .format = GL_R32UI, .width = row * map_size, .height = row * map_size};
    *ism = (struct irb_ism){
        .gl = gl, .map_size = map_size, .maps_a_row = row, .capacity = row * row, .count = count};
    return (ism->atlas = irb_texture_create(gl, &atlas, err)) != NULL;
}

/* Fills a light's map: the distance in the direction of each texel's centre; texels outside the
 * disc are empty. `texels` gets a copy where it isn't NULL. */
static inline void shade_map_fill(const struct irb_ism *ism, int map,
                                  const struct shade_light *light, shade_distance_fn *distance,
                                  const void *scene, float *texels)
{
    const int size = ism->map_size;
    float *out = malloc((size_t)size * (size_t)size * sizeof *out);
    double frame[3][3], from[3];
    shade_frame(light->normal, frame);
    for (int c = 0; c < 3; c++)
        from[c] = light->position[c];
    for (int i = 0; i < size * size; i++) {
        double x = (i % size + 0.5) / size * 2 - 1, y = (i / size + 0.5) / size * 2 - 1;
        double r2 = x * x + y * y, along[3];
        for (int c = 0; c < 3; c++)
            along[c] =
                (2 * x * frame[0][c] + 2 * y * frame[1][c] + (1 - r2) * frame[2][c]) / (1 + r2);
        out[i] = r2 < 1 ? (float)distance(scene, from, along) : INFINITY;
    }
    ism->gl->api.TextureSubImage2D(ism->atlas->id, 0, map % ism->maps_a_row * size,
                                   map / ism->maps_a_row * size, size, size, GL_RED_INTEGER,
                                   GL_UNSIGNED_INT, out);
    if (texels)
        memcpy(texels, out, (size_t)size * (size_t)size * sizeof *out);
    free(out);
}

#endif
