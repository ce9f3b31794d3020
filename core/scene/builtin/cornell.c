/* SPDX-License-Identifier: MIT
 *
 * The Cornell box as measured at the Cornell University Program of Computer Graphics
 * (https://www.graphics.cornell.edu/online/box/data.html). Coordinates are the published ones in
 * millimetres, y up, z into the room; they become metres here. The walls are not exactly square and
 * the red one not exactly flat: a quad is the triangles (0,1,2), (0,2,3). No front wall; the
 * ceiling has no opening, because the light of a trial is a spot and not the box's lamp.
 */
#include "core/scene/builtin/geometry.h"

#define METRES_PER_MM 1e-3

/* Linear Rec.709 values of the measured spectra, as commonly published. */
static const float white[3] = {0.725f, 0.71f, 0.68f};
static const float red[3] = {0.63f, 0.065f, 0.05f};
static const float green[3] = {0.14f, 0.45f, 0.091f};
static const float blue[3] = {0.15f, 0.25f, 0.6f}; /* ours */

enum { WHITE, RED, GREEN };

struct wall {
    const char *name;
    int material;
    double corners[4][3]; /* mm, counter-clockwise seen from inside the room */
};

static const struct wall walls[] = {
    {"floor", WHITE, {{552.8, 0, 0}, {0, 0, 0}, {0, 0, 559.2}, {549.6, 0, 559.2}}},
    {"ceiling", WHITE, {{556, 548.8, 0}, {556, 548.8, 559.2}, {0, 548.8, 559.2}, {0, 548.8, 0}}},
    {"back wall",
     WHITE,
     {{549.6, 0, 559.2}, {0, 0, 559.2}, {0, 548.8, 559.2}, {556, 548.8, 559.2}}},
    {"right wall", GREEN, {{0, 0, 559.2}, {0, 0, 0}, {0, 548.8, 0}, {0, 548.8, 559.2}}},
    {"left wall", RED, {{552.8, 0, 0}, {549.6, 0, 559.2}, {556, 548.8, 559.2}, {556, 548.8, 0}}},
};

struct block {
    const char *name;
    double faces[5][4][3]; /* mm, counter-clockwise seen from outside; no bottom */
};

static const struct block blocks[] = {
    {"short block",
     {{{130, 165, 65}, {82, 165, 225}, {240, 165, 272}, {290, 165, 114}},
      {{290, 0, 114}, {290, 165, 114}, {240, 165, 272}, {240, 0, 272}},
      {{130, 0, 65}, {130, 165, 65}, {290, 165, 114}, {290, 0, 114}},
      {{82, 0, 225}, {82, 165, 225}, {130, 165, 65}, {130, 0, 65}},
      {{240, 0, 272}, {240, 165, 272}, {82, 165, 225}, {82, 0, 225}}}},
    {"tall block",
     {{{423, 330, 247}, {265, 330, 296}, {314, 330, 456}, {472, 330, 406}},
      {{423, 0, 247}, {423, 330, 247}, {472, 330, 406}, {472, 0, 406}},
      {{472, 0, 406}, {472, 330, 406}, {314, 330, 456}, {314, 0, 456}},
      {{314, 0, 456}, {314, 330, 456}, {265, 330, 296}, {265, 0, 296}},
      {{265, 0, 296}, {265, 330, 296}, {423, 330, 247}, {423, 0, 247}}}},
};

static void add_quad_mm(struct irb_builder *builder, const double mm[4][3])
{
    double metres[4][3];

    for (int corner = 0; corner < 4; corner++)
        for (int i = 0; i < 3; i++)
            metres[corner][i] = mm[corner][i] * METRES_PER_MM;
    irb_builder_quad(builder, (const double(*)[3])metres);
}

/* Materials and walls. */
static void begin_box(struct irb_builder *builder, const char *name)
{
    irb_builder_begin(builder, name);
    irb_builder_material(builder, "white", white); /* WHITE, RED, GREEN */
    irb_builder_material(builder, "red", red);
    irb_builder_material(builder, "green", green);
    for (size_t i = 0; i < sizeof walls / sizeof *walls; i++) {
        irb_builder_object(builder, walls[i].name, walls[i].material);
        add_quad_mm(builder, walls[i].corners);
    }
}

struct irb_scene *irb_build_cornell(struct irb_error *err)
{
    struct irb_builder builder;

    begin_box(&builder, "cornell");
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++) {
        irb_builder_object(&builder, blocks[i].name, WHITE);
        for (int face = 0; face < 5; face++)
            add_quad_mm(&builder, blocks[i].faces[face]);
    }
    return irb_builder_finish(&builder, err);
}

/* Where the blocks stood: a sphere near the front, the knot behind. Sizes are ours, metres. */
struct irb_scene *irb_build_cornell_objects(struct irb_error *err)
{
    static const double sphere_centre[3] = {0.17, 0.1, 0.16};
    static const double knot_foot[3] = {0.355, 0, 0.345};
    struct irb_builder builder;

    begin_box(&builder, "cornell-objects");
    irb_builder_object(&builder, "sphere", WHITE);
    irb_builder_sphere(&builder, sphere_centre, 0.1, 96, 48, false);
    irb_builder_object(&builder, "knot", WHITE);
    irb_builder_knot(&builder, knot_foot, 0.3, 448, 24);
    return irb_builder_finish(&builder, err);
}

/* Instead of the blocks a cloth that leans towards the camera, and waves. */
struct irb_scene *irb_build_cornell_cloth(struct irb_error *err)
{
    struct irb_builder builder;

    begin_box(&builder, "cornell-cloth");
    irb_builder_cloth(&builder, "cloth", irb_builder_material(&builder, "blue", blue));
    return irb_builder_finish(&builder, err);
}
