/* SPDX-License-Identifier: MIT
 *
 * Lights, their rasterised shadow maps, and what a texel of those stands for, worked out in double
 * precision. Include after compare.h.
 */
#ifndef IRB_TESTS_LIGHTS_RASTER_FIXTURE_H
#define IRB_TESTS_LIGHTS_RASTER_FIXTURE_H

#include "core/lights/raster_maps.h"
#include "tests/frame/fixture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct fixture_light {
    float position[4], normal[4], flux[4];
};

/* 0 <= u < 1: the same numbers on every machine (splitmix64). */
static inline double fixture_random(uint64_t *state)
{
    uint64_t z = (*state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

/* Uniform on the sphere; on the upper half with `upper`. */
static inline void fixture_random_direction(uint64_t *state, bool upper, double out[3])
{
    double z = 2 * fixture_random(state) - 1, phi = 2 * M_PI * fixture_random(state);
    out[2] = upper ? fabs(z) : z;
    out[0] = sqrt(1 - z * z) * cos(phi);
    out[1] = sqrt(1 - z * z) * sin(phi);
}

static inline void fixture_random_normal(uint64_t *state, float out[3])
{
    double n[3];
    fixture_random_direction(state, false, n);
    for (int i = 0; i < 3; i++)
        out[i] = (float)n[i];
}

/* A view of the lights in a buffer of whole blocks, which is the caller's. */
static inline struct irb_virtual_lights
fixture_lights(struct irb_gl *gl, const struct fixture_light *lights, int count)
{
    struct irb_error err = {0};
    int blocks = count > 0 ? (count + IRB_VPL_BLOCK - 1) / IRB_VPL_BLOCK : 1;
    struct fixture_light *padded = calloc((size_t)blocks * IRB_VPL_BLOCK, sizeof *padded);
    if (count)
        memcpy(padded, lights, (size_t)count * sizeof *padded);
    struct irb_buffer *buffer = irb_buffer_create(
        gl, "lights", (int64_t)blocks * IRB_VPL_BLOCK * IRB_VPL_BYTES, padded, &err);
    REQUIRE_OK(buffer);
    free(padded);
    return (struct irb_virtual_lights){.buffer = buffer, .count = count};
}

/* Columns tangent, bitangent, normal in double precision (Duff et al. 2017). test_raster_maps
 * checks that the shaders' frame is this one. */
static inline void fixture_light_frame(const float n[3], double out[3][3])
{
    double x = n[0], y = n[1], z = n[2], s = z >= 0 ? 1 : -1, a = -1 / (s + z), b = x * y * a;
    const double frame[3][3] = {
        {1 + s * x * x * a, s * b, -s * x}, {b, s + y * y * a, -y}, {x, y, z}};
    memcpy(out, frame, sizeof frame);
}

static inline void fixture_to_world(const double frame[3][3], const double d[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = frame[0][i] * d[0] + frame[1][i] * d[1] + frame[2][i] * d[2];
}

/* The unit direction, in the light's frame, that texel (x, y) of a face stands for; y from the
 * bottom. false for a paraboloid's texel that the unit disc does not touch. */
static inline bool fixture_texel_direction(enum irb_raster_projection projection, int size,
                                           int face, int x, int y, double out[3])
{
    double u = (2 * x + 1.0) / size - 1, v = (2 * y + 1.0) / size - 1, length = 0;
    if (projection == IRB_RASTER_HEMICUBE) {
        /* centres of the sides' squares: +-x, +-y */
        double side = v < 0 ? -1 : 1;
        out[0] = face == 0 ? u : face == 1 ? side : side * u;
        out[1] = face == 0 ? v : face == 1 ? side * u : side;
        out[2] = face == 0 ? 1 : fabs(v);
    } else {
        double r = hypot(u, v), rim = 1 - 1.0 / size;
        double scale = r > rim ? rim / r : 1;
        double least_u = fmax(fabs(u) - 1.0 / size, 0), least_v = fmax(fabs(v) - 1.0 / size, 0);
        if (hypot(least_u, least_v) > 1)
            return false;
        u *= scale;
        v *= scale;
        out[0] = 2 * u;
        out[1] = 2 * v;
        out[2] = 1 - u * u - v * v;
    }
    for (int i = 0; i < 3; i++)
        length += out[i] * out[i];
    for (int i = 0; i < 3; i++)
        out[i] /= sqrt(length);
    return true;
}

/* Distance in a map that was read back. */
static inline float fixture_texel(const struct irb_raster_maps *maps, const struct irb_image *image,
                                  int map, int face, int x, int y)
{
    int layer = map * maps->faces + face;
    return image->data[((size_t)layer * (size_t)maps->size + (size_t)(maps->size - 1 - y)) *
                           (size_t)maps->size +
                       (size_t)x];
}

#endif
