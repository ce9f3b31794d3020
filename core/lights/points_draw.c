/* SPDX-License-Identifier: MIT */
#include "core/lights/points_mask.h"
#include "core/lights/points_parts.h"
#include "core/lights/tessellation.h"

#include <stdlib.h>

enum { WEIGHT_ONE = 65535 };

/* Number `i` of the sequence SplitMix64 (Steele, Lea and Flood 2014). */
static uint64_t random_bits(uint64_t seed, uint64_t i)
{
    uint64_t z = seed + (i + 1) * 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

/* Uniform in [0,1). */
static double random_unit(uint64_t seed, uint64_t i)
{
    return (double)(random_bits(seed, i) >> 11) * 0x1p-53;
}

/* Uniform over the triangle of 16-bit weights: the square is folded along its diagonal (Turk 1990,
 * "Generating random points in triangles", method 1). */
static struct irb_point random_point(uint32_t triangle, uint64_t bits)
{
    unsigned u = bits & WEIGHT_ONE, v = bits >> 16 & WEIGHT_ONE;
    if (u + v > WEIGHT_ONE) {
        u = WEIGHT_ONE - u;
        v = WEIGHT_ONE - v;
    }
    return (struct irb_point){triangle, (uint16_t)u, (uint16_t)v};
}

/* Draws triangles by inverting the cumulative distribution, with a table of where to begin (Chen
 * and Asau 1974). Entries are triangles in the order of objects. */
struct weight_table {
    uint32_t count;
    uint32_t *triangles, *begin, *hits;
    int *objects;
    double *cumulative; /* weight of all entries up to and with this one; zeroes do not occur */
};

static void destroy_table(struct weight_table *table)
{
    free(table->triangles);
    free(table->objects);
    free(table->begin);
    free(table->hits);
    free(table->cumulative);
}

double irb_points_weight(const struct irb_scene *scene, const struct irb_points_desc *desc,
                         uint32_t triangle)
{
    double edges[3];
    const double area = irb_triangle_size(scene, triangle, edges);
    return area > 0 && desc->weights ? (double)desc->weights[triangle] : area;
}

static bool make_table(const struct irb_scene *scene, const struct irb_points_desc *desc,
                       struct weight_table *table)
{
    const size_t most = (size_t)scene->triangle_count + 1;
    double sum = 0;
    *table = (struct weight_table){.triangles = malloc(most * sizeof *table->triangles),
                                   .objects = malloc(most * sizeof *table->objects),
                                   .begin = malloc(most * sizeof *table->begin),
                                   .hits = calloc(most, sizeof *table->hits),
                                   .cumulative = malloc(most * sizeof *table->cumulative)};
    if (!table->triangles || !table->objects || !table->begin || !table->hits || !table->cumulative)
        return false;
    for (int o = 0; o < scene->object_count; o++)
        for (uint32_t i = 0; i < scene->objects[o].triangle_count; i++) {
            const uint32_t triangle = scene->objects[o].first_triangle + i;
            const double weight = irb_points_weight(scene, desc, triangle);
            if (!(weight > 0) || table->count + 1 >= most)
                continue;
            sum += weight;
            table->triangles[table->count] = triangle;
            table->objects[table->count] = o;
            table->cumulative[table->count++] = sum;
        }
    for (uint32_t i = 0, entry = 0; i < table->count; i++) {
        while (table->cumulative[entry] <= sum * i / table->count && entry + 1 < table->count)
            entry++;
        table->begin[i] = entry;
    }
    return true;
}

static uint32_t draw_entry(const struct weight_table *table, double unit)
{
    const uint32_t last = table->count - 1;
    const double at = unit * table->cumulative[last];
    uint32_t slot = (uint32_t)(unit * table->count);
    uint32_t entry = table->begin[slot < last ? slot : last];
    while (entry < last && table->cumulative[entry] <= at)
        entry++;
    while (entry > 0 && table->cumulative[entry - 1] > at)
        entry--; /* where rounding put the table's entry one too far */
    return entry;
}

/* Triangles first, then the points of each: independent draws in the order of triangles, or with
 * weights each triangle's own. */
static void draw(const struct irb_scene *scene, const struct irb_points_desc *desc,
                 struct weight_table *table, struct irb_points_sink *sink)
{
    const uint64_t triangle_seed = random_bits(desc->seed, 0),
                   point_seed = random_bits(desc->seed, 1);
    uint64_t drawn = 0;
    for (uint64_t i = 0; i < sink->most; i++)
        table->hits[draw_entry(table, random_unit(triangle_seed, i))]++;
    for (uint32_t entry = 0; entry < table->count; entry++) {
        const uint32_t triangle = table->triangles[entry];
        const struct irb_points_mask mask =
            irb_points_mask(scene, &scene->objects[table->objects[entry]], triangle);
        const uint64_t own_seed = random_bits(point_seed, triangle);
        for (uint32_t k = 0; k < table->hits[entry]; k++) {
            const uint64_t bits =
                desc->weights ? random_bits(own_seed, k) : random_bits(point_seed, drawn++);
            const struct irb_point point = random_point(triangle, bits);
            if (!(mask.cutoff > 0) || !irb_points_mask_cuts(&mask, point.u, point.v))
                sink->points[sink->count++] = point;
        }
    }
}

bool irb_points_draw(const struct irb_scene *scene, const struct irb_points_desc *desc,
                     struct irb_points_sink *sink, float *density, struct irb_error *err)
{
    struct weight_table table;
    bool ok = make_table(scene, desc, &table);
    const double sum = ok && table.count ? table.cumulative[table.count - 1] : 0;
    if (sum > 0)
        draw(scene, desc, &table, sink);
    for (uint32_t i = 0; ok && i < table.count; i++) {
        const double before = i ? table.cumulative[i - 1] : 0;
        density[table.triangles[i]] =
            (float)((double)sink->most * (table.cumulative[i] - before) / sum);
    }
    destroy_table(&table);
    return ok || irb_fail(err, IRB_E_MEMORY, "points: out of memory");
}
