/* SPDX-License-Identifier: MIT */
#include "core/scene/builtin/kit.h"

#include "core/scene/vec.h"

#include <string.h>

/* A vertex normal farther than this from its triangle's is a crease. */
#define CREASE_COSINE 0.2

static bool is_mirrored(const struct kit *kit)
{
    double cross[3];

    vec_cross(kit->axes[0], kit->axes[1], cross);
    return vec_dot(cross, kit->axes[2]) < 0;
}

/* Normals follow from the winding here, so that kit_triangle must not turn it: it sees the cross
 * product of the triangle itself. */
static void sheet_triangle(const struct kit *kit, uint32_t a, uint32_t b, uint32_t c)
{
    struct irb_scene *scene = kit->builder->scene;
    const uint32_t v[3] = {a, b, c};
    double p[3][3], cross[3];

    if (kit->builder->failure)
        return;
    for (int i = 0; i < 3; i++)
        vec_from_float(scene->positions + 3 * (size_t)v[i], p[i]);
    vec_triangle_cross(p[0], p[1], p[2], cross);
    vec_normalize(cross);
    for (int i = 0; i < 3; i++)
        vec_to_float(cross, scene->normals + 3 * (size_t)v[i]);
    kit_triangle(kit, a, b, c);
}

/* Where a crease is so sharp that a mean normal would look away from its triangle, that triangle
 * gets its own, flat. */
static void flatten_creases(const struct kit *kit, uint32_t first_triangle)
{
    struct irb_scene *scene = kit->builder->scene;

    for (uint32_t t = first_triangle; t < scene->triangle_count && !kit->builder->failure; t++) {
        double p[3][3], cross[3], normal[3], texcoord[3][2], least = INFINITY;
        uint32_t corner[3];

        for (int i = 0; i < 3; i++) {
            corner[i] = scene->indices[3 * (size_t)t + i];
            vec_from_float(scene->positions + 3 * (size_t)corner[i], p[i]);
            for (int c = 0; c < 2; c++)
                texcoord[i][c] = scene->texcoords[2 * (size_t)corner[i] + c];
        }
        vec_triangle_cross(p[0], p[1], p[2], cross);
        vec_normalize(cross);
        for (int i = 0; i < 3; i++) {
            vec_from_float(scene->normals + 3 * (size_t)corner[i], normal);
            least = fmin(least, vec_dot(normal, cross));
        }
        for (int i = 0; i < 3 && least < CREASE_COSINE; i++) {
            uint32_t v = irb_builder_vertex(kit->builder, p[i], cross, texcoord[i]);

            scene->indices[3 * (size_t)t + i] = v;
        }
    }
}

void kit_sheet(const struct kit *kit, kit_sheet_fn fn, const void *shape, int columns, int rows,
               double width, double height)
{
    static const double none[3] = {0, 0, 0};
    uint32_t first_vertex, first_triangle, row = (uint32_t)columns + 1;
    bool mirrored = is_mirrored(kit);

    if (kit->builder->failure)
        return;
    first_vertex = kit->builder->scene->vertex_count;
    first_triangle = kit->builder->scene->triangle_count;
    for (int j = 0; j <= rows; j++)
        for (int i = 0; i <= columns; i++) {
            double p[3], u = (double)i / columns, v = (double)j / rows;

            fn(shape, u, v, p);
            kit_vertex(kit, p, none, u * width, -v * height);
        }
    for (int j = 0; j < rows; j++)
        for (int i = 0; i < columns; i++) {
            uint32_t a = first_vertex + (uint32_t)j * row + (uint32_t)i, b = a + 1, c = b + row,
                     d = a + row;

            sheet_triangle(kit, a, mirrored ? c : b, mirrored ? b : c);
            sheet_triangle(kit, a, mirrored ? d : c, mirrored ? c : d);
        }
    irb_builder_smooth_normals(kit->builder, first_vertex, first_triangle, false);
    flatten_creases(kit, first_triangle);
}

/* ---- Vaults ---- */

struct web {
    double a, b, rise;
};

/* One of the four webs: the barrel along z, between the diagonals, over z in [0, b]. */
static void web_point(const void *shape, double u, double v, double out[3])
{
    const struct web *web = shape;
    double across = (1 - 2 * u) * (1 - v);

    out[0] = web->a * across;
    out[1] = web->rise * sqrt(fmax(0, 1 - across * across));
    out[2] = web->b * (1 - v);
}

void kit_groin_vault(const struct kit *kit, double a, double b, double rise, int segments)
{
    const struct web along = {a, b, rise}, across = {b, a, rise};

    for (int quarter = 0; quarter < 4; quarter++) {
        struct kit web = kit_place(kit, 0, 0, 0, 90 * quarter);
        const struct web *shape = quarter % 2 ? &across : &along;

        kit_sheet(&web, web_point, shape, 2 * segments, segments, 2 * shape->a, shape->b);
    }
}

/* Azimuths within 45 degrees of +x; from the square's edge (v = 0) up to the circle. Pendentives
 * meet in the arches' crowns. */
static void pendentive_point(const void *shape, double u, double v, double out[3])
{
    double half = *(const double *)shape, angle = (u - 0.5) * M_PI / 2;
    double edge = half / cos(angle), radius = edge + (half - edge) * v;

    out[0] = radius * cos(angle);
    out[1] = sqrt(fmax(0, 2 * half * half - radius * radius));
    out[2] = radius * sin(angle);
}

void kit_pendentives(const struct kit *kit, double half, int segments)
{
    for (int quarter = 0; quarter < 4; quarter++) {
        struct kit side = kit_place(kit, 0, 0, 0, 90 * quarter);

        kit_sheet(&side, pendentive_point, &half, 2 * segments, segments / 2, 2 * half, half);
    }
}

/* ---- Cloth ---- */

struct cloth {
    double width, height, depth, folds, gather, phase;
};

/* Folds deepen and wander downwards; two incommensurable waves keep them from looking alike. */
static void cloth_point(const void *shape, double u, double v, double out[3])
{
    const struct cloth *cloth = shape;
    double drop = 1 - v, turn = 2 * M_PI * cloth->folds * u + cloth->phase;
    double sway = 0.35 * sin(2.3 * drop + cloth->phase);
    double waist = 1 - cloth->gather * exp(-pow((drop - 0.68) / 0.22, 2));

    out[0] = cloth->width * (0.5 + (u - 0.5) * waist) + 0.1 * cloth->depth * sin(turn + 1.3);
    out[1] = -cloth->height * drop - 0.02 * cloth->height * drop * sin(turn / 2);
    out[2] = cloth->depth * (0.35 + 0.65 * drop) *
             (sin(turn + sway) + 0.4 * sin(1.618 * turn - sway + 0.7 * drop));
}

void kit_curtain(const struct kit *kit, double width, double height, double depth, double folds,
                 double gather, double phase, int columns, int rows)
{
    const struct cloth cloth = {width, height, depth, folds, gather, phase};

    kit_sheet(kit, cloth_point, &cloth, columns, rows, width, height);
}

/* ---- Relief ---- */

/* A round bump of the mask: at (x, y), so wide, so high; in plate radii. */
struct bump {
    double x, y, width_x, width_y, height;
};

static const struct bump lion_bumps[] = {
    {0, 0.05, 0.50, 0.55, 0.34},                                      /* skull */
    {0, -0.22, 0.24, 0.20, 0.30},                                     /* muzzle */
    {0, 0.02, 0.09, 0.24, 0.16},                                      /* bridge of the nose */
    {0, -0.13, 0.13, 0.07, 0.12},                                     /* nose */
    {-0.12, -0.27, 0.11, 0.10, 0.1},                                  /* cheeks */
    {0.12, -0.27, 0.11, 0.10, 0.1},    {0, -0.40, 0.13, 0.035, -0.2}, /* mouth */
    {0, -0.50, 0.12, 0.07, 0.12},                                     /* chin */
    {-0.20, 0.13, 0.085, 0.05, -0.16},                                /* eyes */
    {0.20, 0.13, 0.085, 0.05, -0.16},  {-0.20, 0.13, 0.045, 0.04, 0.09},
    {0.20, 0.13, 0.045, 0.04, 0.09},   {-0.21, 0.25, 0.15, 0.045, 0.13}, /* brows */
    {0.21, 0.25, 0.15, 0.045, 0.13},   {-0.43, 0.43, 0.10, 0.11, 0.2},   /* ears */
    {0.43, 0.43, 0.10, 0.11, 0.2},     {-0.43, 0.41, 0.05, 0.06, -0.12},
    {0.43, 0.41, 0.05, 0.06, -0.12},
};

static void lion_point(const void *shape, double u, double v, double out[3])
{
    double size = *(const double *)shape;
    double s = 2 * u - 1, t = 2 * v - 1;
    /* the square onto the disc, smoothly: no pole in the middle of the face */
    double x = s * sqrt(1 - t * t / 2), y = t * sqrt(1 - s * s / 2);
    double r = hypot(x, y), angle = atan2(x, y), height = 0;
    double mane = exp(-pow((r - 0.72) / 0.17, 2));

    for (size_t i = 0; i < sizeof lion_bumps / sizeof *lion_bumps; i++) {
        const struct bump *bump = &lion_bumps[i];

        height += bump->height * exp(-pow((x - bump->x) / bump->width_x, 2) -
                                     pow((y - bump->y) / bump->width_y, 2));
    }
    height += mane * (0.13 + 0.055 * cos(22 * angle + 9 * r) + 0.04 * cos(13 * angle - 14 * r));
    height *= fmin(1, 5 * (1 - r)); /* the rim lies in the wall */
    out[0] = size * x;
    out[1] = size * y;
    out[2] = size * height;
}

void kit_lion(const struct kit *kit, double radius, int segments)
{
    kit_sheet(kit, lion_point, &radius, segments, segments, 2 * radius, 2 * radius);
}
