/* SPDX-License-Identifier: MIT
 *
 * Pieces of architecture for the built-in scenes: flat pieces (kit_flat.c), profiles swept along
 * lines, arcs and circles (kit_sweep.c), curved sheets (kit_sheet.c) and what is put together from
 * them (kit_parts.c). Metres and degrees; every piece is made in the kit's own frame.
 *
 * Winding follows the normals, in mirrored frames too. Triangles without area (at poles, at the
 * ends of vaults) are left out. Texture coordinates are metres along the surface over
 * `texture_size`. Pieces that meet are meant to run into each other: shared edges are not welded.
 */
#ifndef IRB_SCENE_KIT_H
#define IRB_SCENE_KIT_H

#include "core/scene/builder.h"

struct kit {
    struct irb_builder *builder;
    double origin[3];
    double axes[3][3];   /* unit, perpendicular; left-handed where mirrored */
    double texture_size; /* metres that a texture spans */
};

struct kit kit_begin(struct irb_builder *builder, double texture_size);
/* A frame at (x, y, z) of `parent`, turned about y: +90 takes x to -z and z to x. Quarter turns
 * are exact. */
struct kit kit_place(const struct kit *parent, double x, double y, double z, double turn);
/* The frame with z (or x) reversed. */
struct kit kit_mirror_z(const struct kit *parent);
struct kit kit_mirror_x(const struct kit *parent);

/* ---- Building blocks of the pieces ---- */

uint32_t kit_vertex(const struct kit *kit, const double position[3], const double normal[3],
                    double u, double v); /* u, v in metres */
/* Turned so that it faces along its vertices' normals. */
void kit_triangle(const struct kit *kit, uint32_t a, uint32_t b, uint32_t c);

/* ---- Flat pieces ---- */

/* Faces the side from which the corners run counter-clockwise (in a frame that is not mirrored). */
void kit_quad(const struct kit *kit, const double corners[4][3]);
/* Horizontal, at height y, facing up (or down). */
void kit_floor(const struct kit *kit, double x0, double x1, double z0, double z1, double y,
               bool up);
void kit_box(const struct kit *kit, double x0, double x1, double y0, double y1, double z0,
             double z1);

/* A round-headed opening: 2 `radius` wide around `centre`, straight from `sill` to `spring`. */
struct kit_opening {
    double centre, radius, sill, spring;
    int segments; /* of the half circle */
};
/* The wall x0..x1, y0..y1 at z = 0 that faces +z, with an opening `depth` deep behind it. */
void kit_panel(const struct kit *kit, double x0, double x1, double y0, double y1,
               const struct kit_opening *opening, double depth);
/* The same wall with a second face at z = -depth, so that the opening leads through. */
void kit_arcade(const struct kit *kit, double x0, double x1, double y0, double y1,
                const struct kit_opening *opening, double depth);
/* What closes a panel's opening: a flat pane at z = -depth that faces +z. */
void kit_pane(const struct kit *kit, const struct kit_opening *opening, double depth);

/* ---- Swept profiles ---- */

enum { KIT_PROFILE_POINTS = 96 };

/* A polyline in the plane (a, b) of a section. The surface faces the right-hand side of the way
 * along it: up the b axis means facing +a. Joints flatter than 40 degrees are shaded smooth. */
struct kit_profile {
    int count;
    double points[KIT_PROFILE_POINTS][2];
};

void kit_profile_point(struct kit_profile *profile, double a, double b);
/* Points on an ellipse, from angle `from` to `to` (0 is +a, 90 is +b), both included. */
void kit_profile_arc(struct kit_profile *profile, double a, double b, double radius_a,
                     double radius_b, double from, double to, int segments);
/* A closed rectangle that faces outwards. */
struct kit_profile kit_bar(double a0, double a1, double b0, double b1);

struct kit_section {
    double origin[3], a[3], b[3]; /* a and b unit and perpendicular */
};

/* Along a row of sections; a closed path repeats its first section at the end. */
void kit_sweep(const struct kit *kit, const struct kit_profile *profile,
               const struct kit_section *sections, int count);
/* Around the vertical through (x, 0, z): a is the radius, b the height. */
void kit_lathe(const struct kit *kit, const struct kit_profile *profile, double x, double z,
               double from, double to, int slices);
/* Along an upright elliptic arc in the plane of x and y around (x, y): a is the distance beyond the
 * ellipse, b is z. */
void kit_arch(const struct kit *kit, const struct kit_profile *profile, double x, double y,
              double radius_x, double radius_y, double from, double to, int segments);
/* Straight along x: a is z, b is y. Faces +z where the profile runs upwards. */
void kit_moulding(const struct kit *kit, const struct kit_profile *profile, double x0, double x1);

/* ---- Curved sheets ---- */

/* The point at (u, v) in [0,1]^2; the sheet faces d/du x d/dv. */
typedef void (*kit_sheet_fn)(const void *shape, double u, double v, double out[3]);
void kit_sheet(const struct kit *kit, kit_sheet_fn fn, const void *shape, int columns, int rows,
               double width, double height); /* the last two: metres of texture */

/* The underside of two barrel vaults that cross over the bay [-a,a] x [-b,b]; crown at `rise`. */
void kit_groin_vault(const struct kit *kit, double a, double b, double rise, int segments);
/* The four spherical triangles between a square of half side `half` at y = 0 and the circle inside
 * it at y = half. */
void kit_pendentives(const struct kit *kit, double half, int segments);
/* Cloth that hangs from (0,0,0)..(width,0,0) down to y = -height in `folds` waves; gathered
 * below by the share `gather`. Faces +z. */
void kit_curtain(const struct kit *kit, double width, double height, double depth, double folds,
                 double gather, double phase, int columns, int rows);
/* A lion's mask on a round plate in the plane z = 0, facing +z. */
void kit_lion(const struct kit *kit, double radius, int segments);

/* ---- Parts ---- */

/* Square plinth, Attic base, swelling shaft, capital with two rows of leaves, abacus; `radius` is
 * the shaft's at its foot. */
void kit_column(const struct kit *kit, double x, double y, double z, double height, double radius,
                int slices);
void kit_leaves(const struct kit *kit, double x, double y, double z, double height, double radius,
                int count); /* the leaves that go with it, an object of their own: thin sheets */
void kit_baluster(const struct kit *kit, double x, double y, double z, double height, int slices);
void kit_vase(const struct kit *kit, double x, double y, double z, double height, int slices);
/* A flight of `steps` whose lowest edge lies at x = 0 and that climbs towards +x. */
void kit_steps(const struct kit *kit, int steps, double rise, double going, double z0, double z1,
               double x_end);
/* A bench that faces +z, x from 0 to `length`. */
void kit_bench(const struct kit *kit, double length, double seat, double back);

#endif
