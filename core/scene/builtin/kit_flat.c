/* SPDX-License-Identifier: MIT */
#include "core/scene/builtin/kit.h"

#include "core/scene/vec.h"

#include <string.h>

/* A triangle whose height is below this share of its longest side has no area in float
 * coordinates; the glTF loader draws the same line. */
#define DEGENERATE_RATIO 0x1p-24

/* ---- Frames ---- */

struct kit kit_begin(struct irb_builder *builder, double texture_size)
{
    return (struct kit){.builder = builder,
                        .axes = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                        .texture_size = texture_size};
}

static void to_world(const struct kit *kit, const double local[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] =
            kit->axes[0][i] * local[0] + kit->axes[1][i] * local[1] + kit->axes[2][i] * local[2];
}

struct kit kit_place(const struct kit *parent, double x, double y, double z, double turn)
{
    const double at[3] = {x, y, z};
    double c = cos(turn * M_PI / 180), s = sin(turn * M_PI / 180);
    struct kit kit = *parent;
    double offset[3];

    if (fmod(turn, 90) == 0) {
        c = round(c);
        s = round(s);
    }
    to_world(parent, at, offset);
    for (int i = 0; i < 3; i++) {
        kit.origin[i] += offset[i];
        kit.axes[0][i] = c * parent->axes[0][i] - s * parent->axes[2][i];
        kit.axes[2][i] = s * parent->axes[0][i] + c * parent->axes[2][i];
    }
    return kit;
}

struct kit kit_mirror_z(const struct kit *parent)
{
    struct kit kit = *parent;

    for (int i = 0; i < 3; i++)
        kit.axes[2][i] = -kit.axes[2][i];
    return kit;
}

struct kit kit_mirror_x(const struct kit *parent)
{
    struct kit kit = *parent;

    for (int i = 0; i < 3; i++)
        kit.axes[0][i] = -kit.axes[0][i];
    return kit;
}

/* ---- Building blocks ---- */

uint32_t kit_vertex(const struct kit *kit, const double position[3], const double normal[3],
                    double u, double v)
{
    const double texcoord[2] = {u / kit->texture_size, v / kit->texture_size};
    double p[3], n[3];

    to_world(kit, position, p);
    to_world(kit, normal, n);
    for (int i = 0; i < 3; i++)
        p[i] += kit->origin[i];
    vec_normalize(n);
    return irb_builder_vertex(kit->builder, p, n, texcoord);
}

void kit_triangle(const struct kit *kit, uint32_t a, uint32_t b, uint32_t c)
{
    const struct irb_scene *scene = kit->builder->scene;
    const uint32_t v[3] = {a, b, c};
    double p[3][3], cross[3], towards = 0, longest = 0;

    if (kit->builder->failure)
        return;
    for (int i = 0; i < 3; i++)
        vec_from_float(scene->positions + 3 * (size_t)v[i], p[i]);
    vec_triangle_cross(p[0], p[1], p[2], cross);
    for (int i = 0; i < 3; i++) {
        double edge[3], normal[3];

        vec_sub(p[(i + 1) % 3], p[i], edge);
        longest = fmax(longest, vec_dot(edge, edge));
        vec_from_float(scene->normals + 3 * (size_t)v[i], normal);
        towards += vec_dot(normal, cross);
    }
    if (!(vec_length(cross) > DEGENERATE_RATIO * longest))
        return;
    irb_builder_triangle(kit->builder, a, towards < 0 ? c : b, towards < 0 ? b : c);
}

/* ---- Flat pieces ---- */

void kit_quad(const struct kit *kit, const double corners[4][3])
{
    double normal[3];
    uint32_t v[4];
    int axis = 0;

    vec_triangle_cross(corners[0], corners[1], corners[2], normal);
    if (vec_length(normal) == 0) /* the sill lies on the floor, say */
        vec_triangle_cross(corners[0], corners[2], corners[3], normal);
    if (vec_length(normal) == 0)
        return;
    for (int i = 1; i < 3; i++)
        axis = fabs(normal[i]) > fabs(normal[axis]) ? i : axis;
    for (int i = 0; i < 4; i++) /* the plane of the two other axes; y points up on walls */
        v[i] = kit_vertex(kit, corners[i], normal, corners[i][axis == 0 ? 2 : 0],
                          -corners[i][axis == 1 ? 2 : 1]);
    kit_triangle(kit, v[0], v[1], v[2]);
    kit_triangle(kit, v[0], v[2], v[3]);
}

void kit_floor(const struct kit *kit, double x0, double x1, double z0, double z1, double y, bool up)
{
    const double corners[4][3] = {
        {x0, y, up ? z1 : z0}, {x1, y, up ? z1 : z0}, {x1, y, up ? z0 : z1}, {x0, y, up ? z0 : z1}};

    kit_quad(kit, corners);
}

void kit_box(const struct kit *kit, double x0, double x1, double y0, double y1, double z0,
             double z1)
{
    const double faces[4][4][3] = {
        {{x0, y0, z1}, {x1, y0, z1}, {x1, y1, z1}, {x0, y1, z1}},
        {{x1, y0, z0}, {x0, y0, z0}, {x0, y1, z0}, {x1, y1, z0}},
        {{x1, y0, z1}, {x1, y0, z0}, {x1, y1, z0}, {x1, y1, z1}},
        {{x0, y0, z0}, {x0, y0, z1}, {x0, y1, z1}, {x0, y1, z0}},
    };

    for (int face = 0; face < 4; face++)
        kit_quad(kit, faces[face]);
    kit_floor(kit, x0, x1, z0, z1, y1, true);
    kit_floor(kit, x0, x1, z0, z1, y0, false);
}

/* ---- Walls with a round-headed opening ---- */

static void arch_point(const struct kit_opening *opening, int i, double out[2])
{
    double t = M_PI * i / opening->segments;

    out[0] = opening->centre - opening->radius * cos(t);
    out[1] = opening->spring + opening->radius * sin(t);
    if (i == 0 || i == opening->segments) /* exactly on the jambs */
        out[1] = opening->spring;
    if (i == opening->segments)
        out[0] = opening->centre + opening->radius;
}

static void upright(const struct kit *kit, double x0, double x1, double y0, double y1, double z)
{
    const double corners[4][3] = {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};

    kit_quad(kit, corners);
}

/* The wall around the opening at one z, faced +z; split at sill and spring so that every edge is
 * met by the same vertices on both sides. */
static void face(const struct kit *kit, double x0, double x1, double y0, double y1,
                 const struct kit_opening *opening, double z)
{
    const double left = opening->centre - opening->radius,
                 right = opening->centre + opening->radius;
    const double heights[4] = {y0, opening->sill, opening->spring, y1};

    for (int i = 0; i < 3; i++) {
        upright(kit, x0, left, heights[i], heights[i + 1], z);
        upright(kit, right, x1, heights[i], heights[i + 1], z);
    }
    upright(kit, left, right, y0, opening->sill, z);
    for (int i = 0; i < opening->segments; i++) {
        double p[2], q[2];

        arch_point(opening, i, p);
        arch_point(opening, i + 1, q);
        const double corners[4][3] = {
            {p[0], p[1], z}, {q[0], q[1], z}, {q[0], y1, z}, {p[0], y1, z}};
        kit_quad(kit, corners);
    }
}

/* Jambs and the arch's underside, from z = 0 to -depth; the sill too where there is wall below. */
static void reveal(const struct kit *kit, const struct kit_opening *opening, double depth,
                   bool has_sill)
{
    const double left = opening->centre - opening->radius,
                 right = opening->centre + opening->radius;
    struct kit_section sections[2] = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                      {{0, 0, -depth}, {1, 0, 0}, {0, 1, 0}}};
    struct kit_profile profile = {0};

    kit_profile_point(&profile, left, opening->sill);
    for (int i = 0; i <= opening->segments; i++) {
        double p[2];

        arch_point(opening, i, p);
        kit_profile_point(&profile, p[0], p[1]);
    }
    kit_profile_point(&profile, right, opening->sill);
    if (has_sill)
        kit_profile_point(&profile, left, opening->sill);
    kit_sweep(kit, &profile, sections, 2);
}

void kit_panel(const struct kit *kit, double x0, double x1, double y0, double y1,
               const struct kit_opening *opening, double depth)
{
    face(kit, x0, x1, y0, y1, opening, 0);
    reveal(kit, opening, depth, opening->sill > y0);
}

void kit_arcade(const struct kit *kit, double x0, double x1, double y0, double y1,
                const struct kit_opening *opening, double depth)
{
    struct kit_opening behind = *opening;
    struct kit back = kit_place(kit, 0, 0, 0, 180);

    behind.centre = -opening->centre;
    kit_panel(kit, x0, x1, y0, y1, opening, depth);
    face(&back, -x1, -x0, y0, y1, &behind, depth);
}

void kit_pane(const struct kit *kit, const struct kit_opening *opening, double depth)
{
    upright(kit, opening->centre - opening->radius, opening->centre + opening->radius,
            opening->sill, opening->spring, -depth);
    for (int i = 0; i < opening->segments; i++) {
        double p[2], q[2];

        arch_point(opening, i, p);
        arch_point(opening, i + 1, q);
        const double corners[4][3] = {{p[0], opening->spring, -depth},
                                      {q[0], opening->spring, -depth},
                                      {q[0], q[1], -depth},
                                      {p[0], p[1], -depth}};
        kit_quad(kit, corners);
    }
}
