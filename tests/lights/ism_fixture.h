/* SPDX-License-Identifier: MIT
 *
 * A point-by-point splatter in double precision, from core/lights/ism.h's description, and how an
 * atlas compares with it. Include after compare.h.
 */
#ifndef IRB_TESTS_LIGHTS_ISM_FIXTURE_H
#define IRB_TESTS_LIGHTS_ISM_FIXTURE_H

#include "core/lights/ism.h"
#include "tests/lights/points_fixture.h"
#include "tests/lights/raster_fixture.h"

static const uint32_t fixture_empty = 0x7f800000u;

/* Maps one after the other, rows from the bottom. */
struct fixture_maps {
    int size, count;
    float *distance;  /* INFINITY where empty */
    bool *tie;        /* texels of splats whose place, size or being there hangs on rounding */
    long splats, cut; /* drawn; of them, cut at a map's border */
};

static inline size_t fixture_map_texel(const struct fixture_maps *maps, int map, int x, int y)
{
    return ((size_t)map * (size_t)maps->size + (size_t)y) * (size_t)maps->size + (size_t)x;
}

static inline struct fixture_maps fixture_maps_create(int size, int count)
{
    struct fixture_maps maps = {.size = size, .count = count};
    const size_t texels = fixture_map_texel(&maps, count, 0, 0);
    maps.distance = malloc((texels + 1) * sizeof *maps.distance);
    maps.tie = calloc(texels + 1, sizeof *maps.tie);
    for (size_t i = 0; i < texels; i++)
        maps.distance[i] = INFINITY;
    return maps;
}

static inline void fixture_maps_destroy(struct fixture_maps *maps)
{
    free(maps->distance);
    free(maps->tie);
}

/* The maps in use, read back. */
static inline struct fixture_maps fixture_maps_read(const struct irb_ism *ism)
{
    struct fixture_maps maps = fixture_maps_create(ism->map_size, ism->count);
    const size_t side = (size_t)ism->atlas->width;
    float *atlas = malloc(side * side * 4);
    ism->gl->api.MemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    ism->gl->api.GetTextureImage(ism->atlas->id, 0, GL_RED_INTEGER, GL_UNSIGNED_INT,
                                 (GLsizei)(side * side * 4), atlas);
    for (int m = 0; m < maps.count; m++)
        for (int y = 0; y < maps.size; y++)
            memcpy(&maps.distance[fixture_map_texel(&maps, m, 0, y)],
                   &atlas[((size_t)(m / ism->maps_a_row * maps.size + y)) * side +
                          (size_t)(m % ism->maps_a_row * maps.size)],
                   (size_t)maps.size * 4);
    /* what is not in use is empty */
    for (size_t i = 0; i < side * side; i++) {
        int column = (int)(i % side) / maps.size, row = (int)(i / side) / maps.size;
        if (row * ism->maps_a_row + column >= ism->count)
            assert_true(isinf(atlas[i]));
    }
    free(atlas);
    return maps;
}

struct fixture_splat {
    const struct irb_scene *scene;
    const struct irb_ism_settings *settings;
    const struct fixture_light *lights;
    double slack; /* m: how far off points may be beyond rounding */
    double even;  /* m2: area that every point stands for; 0: its own */
};

static inline void fixture_draw(struct fixture_maps *maps, int map, const int corner[2], int side,
                                double distance, bool tie)
{
    const int grown = tie ? 1 : 0;
    maps->splats++;
    maps->cut += corner[0] < 0 || corner[1] < 0 || corner[0] + side > maps->size ||
                 corner[1] + side > maps->size;
    for (int y = corner[1] - grown; y < corner[1] + side + grown; y++)
        for (int x = corner[0] - grown; x < corner[0] + side + grown; x++) {
            if (x < 0 || y < 0 || x >= maps->size || y >= maps->size)
                continue;
            size_t i = fixture_map_texel(maps, map, x, y);
            maps->tie[i] = maps->tie[i] || tie;
            if (x >= corner[0] && x < corner[0] + side && y >= corner[1] && y < corner[1] + side)
                maps->distance[i] = fminf(maps->distance[i], (float)distance);
        }
}

/* How far a number is from a whole one. */
static inline double fixture_fraction(double x)
{
    return fabs(x - floor(x + 0.5));
}

/* One point into one map. area: its share of the surface along the surface's normal, m2. */
static inline void fixture_splat_point(struct fixture_maps *maps, const struct fixture_splat *splat,
                                       int map, const double at[3], const double area[3])
{
    const struct irb_ism_settings *s = splat->settings;
    const struct fixture_light *light = &splat->lights[map];
    const double near = fmax((double)s->near * (double)irb_scene_diagonal(splat->scene),
                             (double)s->near_radii * sqrt((double)light->position[3] / M_PI));
    double frame[3][3], d[3], local[3] = {0}, r = 0, facing = 0, corner[2];
    int whole[2];
    if (!(light->flux[0] > 0 || light->flux[1] > 0 || light->flux[2] > 0))
        return;
    fixture_light_frame(light->normal, frame);
    for (int i = 0; i < 3; i++)
        d[i] = at[i] - light->position[i];
    r = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++)
            local[i] += frame[i][k] * d[k] / r;
        facing += area[i] * d[i] / r;
    }
    bool tie = fabs(local[2] - 1e-3) < 2e-5 + splat->slack / r || fabs(r - near) < 1e-5 * near;
    if (!tie && !(local[2] > 1e-3 && r >= near))
        return;
    /* solid angle, to the disc's area by the Jacobian, to texels, to a splat's share */
    facing = splat->even > 0 ? splat->even : fabs(facing);
    double texels = facing / (r * r) / pow(1 + local[2], 2) * pow(maps->size / 2.0, 2) *
                    maps->count / (double)s->splat_factor * pow((double)s->splat_scale, 2);
    double side = fmin(fmax(floor(sqrt(texels) + 0.5), 1), s->splat_most);
    tie = tie ||
          fixture_fraction(sqrt(texels) + 0.5) < (1e-4 + splat->slack / r) * (1 + sqrt(texels));
    for (int i = 0; i < 2; i++) {
        corner[i] = (local[i] / (1 + local[2]) + 1) / 2 * maps->size - (side - 1) / 2;
        whole[i] = (int)floor(corner[i]);
        tie = tie ||
              fixture_fraction(corner[i]) < maps->size * (1e-6 * fmax(1, 1 / r) + splat->slack / r);
    }
    if (local[2] > 1e-3 && r >= near)
        fixture_draw(maps, map, whole, (int)side, r, tie);
    else /* may be there: ties only */
        fixture_draw(maps, map, whole, (int)side, INFINITY, true);
}

static inline uint32_t fixture_mix(uint32_t h)
{
    h = (h ^ h >> 16) * 0x85ebca6bu;
    h = (h ^ h >> 13) * 0xc2b2ae35u;
    return h ^ h >> 16;
}

/* Point number `index` into maps index + j mod N. */
static inline void fixture_splat_maps(struct fixture_maps *maps, const struct fixture_splat *splat,
                                      uint32_t index, uint32_t random, const double at[3],
                                      const double area[3])
{
    const double factor = splat->settings->splat_factor, whole = floor(factor);
    int times = (int)whole + ((double)(random >> 8) < (factor - whole) * 0x1p24);
    for (int j = 0; j < times; j++)
        fixture_splat_point(maps, splat, (int)((index + (uint32_t)j) % (uint32_t)maps->count), at,
                            area);
}

/* A whole set. */
static inline struct fixture_maps fixture_splat_list(const struct fixture_splat *splat,
                                                     const struct irb_point_list *list,
                                                     const float *positions, int size, int lights)
{
    struct fixture_maps maps = fixture_maps_create(size, lights);
    fixture_corners *corners = fixture_place_corners(splat->scene, positions);
    for (uint64_t i = 0; i < list->count && lights; i++) {
        const struct irb_point *p = &list->points[i];
        double at[3], area[3];
        fixture_place_point((const fixture_corners *)corners, p, at);
        fixture_area_vector((const double(*)[3])corners[p->triangle], area);
        for (int k = 0; k < 3; k++)
            area[k] /= (double)list->density[p->triangle];
        fixture_splat_maps(&maps, splat, (uint32_t)i, fixture_mix((uint32_t)i), at, area);
    }
    free(corners);
    return maps;
}

/* Every texel within 1e-5 (and `slack` m) of the expected distance, but for at most `share` of
 * them, each of which a tie explains. */
static inline void fixture_require_maps(const struct fixture_maps *found,
                                        const struct fixture_maps *expected, double slack,
                                        double share)
{
    long differ = 0, texels = (long)fixture_map_texel(expected, expected->count, 0, 0);
    assert_int_equal(found->count, expected->count);
    for (long i = 0; i < texels; i++) {
        const double f = found->distance[i], e = expected->distance[i];
        if (f == e || fabs(f - e) <= 1e-5 * e + slack)
            continue;
        differ++;
        if (!expected->tie[i])
            fail_msg("texel %ld of map %ld holds %.9g, expected %.9g",
                     i % (expected->size * expected->size), i / (expected->size * expected->size),
                     f, e);
    }
    REQUIRE_CMP((double)differ, <=, share * (double)texels);
}

#endif
