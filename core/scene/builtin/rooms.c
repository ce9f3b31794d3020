/* SPDX-License-Identifier: MIT
 *
 * Rooms that the light reaches only by a detour: `doorway` (a dark hall next to a lit room, the
 * door between them ajar; after the door scene of Veach 1997) and `corridor` (L-shaped, the lamp
 * round the corner). Both are built of solid slabs that run into each other, so that nothing leaks.
 */
#include "core/scene/builtin/geometry.h"

#include "core/scene/builtin/kit.h"

#include <math.h>

struct paint {
    const char *name;
    float diffuse[3];
};

static void add_paints(struct irb_builder *builder, const struct paint *paints, int count)
{
    for (int i = 0; i < count; i++)
        irb_builder_material(builder, paints[i].name, paints[i].diffuse);
}

/* ---- Furniture ---- */

static void table(const struct kit *kit, double length, double width, double height)
{
    const double x = length / 2, z = width / 2, leg = 0.07;

    kit_box(kit, -x, x, height - 0.04, height, -z, z);
    kit_box(kit, -x + 0.05, x - 0.05, height - 0.12, height - 0.03, -z + 0.05, z - 0.05);
    for (int i = 0; i < 4; i++) {
        double lx = i & 1 ? x - 0.04 - leg : -x + 0.04, lz = i & 2 ? z - 0.04 - leg : -z + 0.04;

        kit_box(kit, lx, lx + leg, 0, height - 0.05, lz, lz + leg);
    }
}

/* Seat 0.45 m high; the back is at -z. */
static void chair(const struct kit *kit)
{
    for (int i = 0; i < 4; i++) {
        double x = i & 1 ? 0.17 : -0.21, z = i & 2 ? 0.16 : -0.2;

        kit_box(kit, x, x + 0.04, 0, i & 2 ? 0.44 : 0.95, z, z + 0.04);
    }
    kit_box(kit, -0.22, 0.22, 0.42, 0.46, -0.21, 0.21);
    for (int rail = 0; rail < 3; rail++)
        kit_box(kit, -0.19, 0.19, 0.56 + 0.14 * rail, 0.64 + 0.14 * rail, -0.19, -0.17);
}

/* A leaf whose hinge is the y axis, x from 0 to `width`; panels on both sides. */
static void door_leaf(const struct kit *kit, double width, double height)
{
    kit_box(kit, 0, width, 0.01, height, -0.022, 0.022);
    for (int panel = 0; panel < 4; panel++) {
        double x0 = panel & 1 ? width / 2 + 0.05 : 0.1,
               x1 = panel & 1 ? width - 0.1 : width / 2 - 0.05;
        double y0 = panel & 2 ? 1.05 : 0.18, y1 = panel & 2 ? height - 0.15 : 0.9;

        kit_box(kit, x0, x1, y0, y1, -0.035, 0.035);
    }
}

static void door_knobs(const struct kit *kit, double width)
{
    const struct kit_profile knob = {7,
                                     {{0.0, -0.1},
                                      {0.025, -0.09},
                                      {0.03, -0.07},
                                      {0.01, -0.05},
                                      {0.01, 0.05},
                                      {0.03, 0.07},
                                      {0.025, 0.09}}};
    struct kit_section sections[17] = {0};

    for (int i = 0; i <= 16; i++) { /* turned around z */
        double t = 2 * M_PI * (i % 16) / 16;

        sections[i] = (struct kit_section){{width - 0.07, 1, 0}, {cos(t), sin(t), 0}, {0, 0, 1}};
    }
    struct kit_profile closed = knob;
    kit_profile_point(&closed, 0, 0.1);
    kit_sweep(kit, &closed, sections, 17);
}

/* Jambs and lintel round an opening `width` wide from x = 0, `depth` through the wall. */
static void door_frame(const struct kit *kit, double width, double height, double z0, double z1)
{
    kit_box(kit, -0.1, 0.02, -0.02, height + 0.02, z0, z1);
    kit_box(kit, width - 0.02, width + 0.1, -0.02, height + 0.02, z0, z1);
    kit_box(kit, -0.12, width + 0.12, height, height + 0.12, z0 - 0.01, z1 + 0.01);
}

/* Four boards with an open front at +z. */
static void bookcase(const struct kit *kit, double width, double height)
{
    kit_box(kit, 0, width, 0, height, 0, 0.03);
    kit_box(kit, 0, 0.04, 0, height + 0.01, 0.01, 0.35);
    kit_box(kit, width - 0.04, width, 0, height + 0.01, 0.01, 0.35);
    for (int shelf = 0; shelf <= 4; shelf++)
        kit_box(kit, 0.01, width - 0.01, height * shelf / 4 - (shelf == 4 ? 0.02 : -0.02),
                height * shelf / 4 + (shelf == 4 ? 0.02 : 0.05), 0.01, 0.34);
}

/* Books of one of three colours: heights and depths follow a fixed irregular sequence. */
static void books(const struct kit *kit, double width, double height, int colour)
{
    int number = 0;

    for (int shelf = 0; shelf < 4; shelf++) {
        double x = 0.06;

        while (x < width - 0.3) {
            double turn = fmod(0.618034 * number, 1), thick = 0.025 + 0.03 * turn;
            double y = height * shelf / 4 + 0.04, h = 0.24 + 0.1 * fmod(0.41 * number + 0.3, 1);

            if (number % 3 == colour && number % 11 != 7)
                kit_box(kit, x, x + thick - 0.001, y, y + h, 0.05, 0.24 + 0.06 * turn);
            x += thick;
            number++;
        }
    }
}

/* ---- Doorway ---- */

/* Metres: the hall is 0 <= x <= HALL, the lit room lies behind the wall at x = HALL. */
#define HALL 7.0
#define PARTITION 0.2
#define ROOM_END 11.0
#define DEPTH 5.4
#define CEILING 3.2
#define DOOR_Z 1.9 /* of the opening's left jamb */
#define DOOR_WIDTH 1.0
#define DOOR_HEIGHT 2.1
#define DOOR_TURN 50.0 /* degrees by which the door is open, into the lit room */
#define SLAB 0.3       /* thickness of floors and outer walls */

enum doorway_material {
    D_WALL,
    D_ROOM,
    D_FLOOR,
    D_CEILING,
    D_WOOD,
    D_RED,
    D_BLUE,
    D_WHITE,
    D_BRASS
};

static const struct paint doorway_paints[] = {
    [D_WALL] = {"hall walls", {0.66f, 0.62f, 0.54f}},
    [D_ROOM] = {"room walls", {0.80f, 0.72f, 0.52f}},
    [D_FLOOR] = {"floor boards", {0.42f, 0.27f, 0.16f}},
    [D_CEILING] = {"ceiling", {0.80f, 0.80f, 0.78f}},
    [D_WOOD] = {"walnut", {0.28f, 0.16f, 0.09f}},
    [D_RED] = {"red", {0.60f, 0.10f, 0.08f}},
    [D_BLUE] = {"blue", {0.12f, 0.20f, 0.52f}},
    [D_WHITE] = {"china", {0.80f, 0.80f, 0.80f}},
    [D_BRASS] = {"brass", {0.60f, 0.45f, 0.18f}},
};

static void doorway_shell(const struct kit *kit, struct irb_builder *builder)
{
    const double end = ROOM_END + SLAB, wall = HALL + PARTITION, top = CEILING + 0.05;

    irb_builder_object(builder, "floor", D_FLOOR);
    kit_box(kit, -SLAB, end, -SLAB, 0, -SLAB, DEPTH + SLAB);
    irb_builder_object(builder, "ceiling", D_CEILING);
    kit_box(kit, -SLAB, end, CEILING, CEILING + SLAB, -SLAB, DEPTH + SLAB);
    irb_builder_object(builder, "hall walls", D_WALL);
    kit_box(kit, -SLAB, 0, -0.05, top, -SLAB, DEPTH + SLAB);
    kit_box(kit, -0.05, wall - 0.05, -0.05, top, -SLAB, 0);
    kit_box(kit, -0.05, wall - 0.05, -0.05, top, DEPTH, DEPTH + SLAB);
    kit_box(kit, HALL, wall, -0.05, top, -0.05, DOOR_Z);
    kit_box(kit, HALL, wall, -0.05, top, DOOR_Z + DOOR_WIDTH, DEPTH + 0.05);
    kit_box(kit, HALL, wall, DOOR_HEIGHT, top, DOOR_Z - 0.05, DOOR_Z + DOOR_WIDTH + 0.05);
    irb_builder_object(builder, "room walls", D_ROOM);
    kit_box(kit, ROOM_END, end, -0.05, top, -SLAB, DEPTH + SLAB);
    kit_box(kit, wall - 0.08, ROOM_END + 0.05, -0.05, top, -SLAB, 0.01);
    kit_box(kit, wall - 0.08, ROOM_END + 0.05, -0.05, top, DEPTH - 0.01, DEPTH + SLAB);
    irb_builder_object(builder, "beams and skirting", D_WOOD);
    for (int i = 0; i < 5; i++)
        kit_box(kit, 0.7 + 1.35 * i, 0.9 + 1.35 * i, CEILING - 0.2, top, -0.05, DEPTH + 0.05);
    kit_box(kit, -0.05, HALL + 0.05, -0.05, 0.14, -0.05, 0.02);
    kit_box(kit, -0.05, HALL + 0.05, -0.05, 0.14, DEPTH - 0.02, DEPTH + 0.05);
    kit_box(kit, HALL - 0.02, HALL + 0.05, -0.05, 0.14, -0.05, DOOR_Z - 0.08);
    kit_box(kit, HALL - 0.02, HALL + 0.05, -0.05, 0.14, DOOR_Z + DOOR_WIDTH + 0.08, DEPTH + 0.05);
}

static void doorway_door(const struct kit *kit, struct irb_builder *builder)
{
    /* x of the frame runs along -z from the hinge at the far jamb */
    struct kit opening = kit_place(kit, HALL + PARTITION, 0, DOOR_Z + DOOR_WIDTH, 90);
    struct kit hinge = kit_place(&opening, 0.025, 0, 0.03, -DOOR_TURN);

    irb_builder_object(builder, "door", D_WOOD);
    door_leaf(&hinge, DOOR_WIDTH - 0.05, DOOR_HEIGHT - 0.02);
    irb_builder_object(builder, "door frame", D_WHITE);
    door_frame(&opening, DOOR_WIDTH, DOOR_HEIGHT - 0.01, -PARTITION - 0.03, 0.03);
    irb_builder_object(builder, "door knobs", D_BRASS);
    door_knobs(&hinge, DOOR_WIDTH - 0.05);
}

static void doorway_wood(const struct kit *kit, struct irb_builder *builder)
{
    struct kit at;

    irb_builder_object(builder, "furniture", D_WOOD);
    at = kit_place(kit, 4.6, 0, 3.55, 12);
    table(&at, 1.5, 0.8, 0.75);
    at = kit_place(kit, 4.4, 0, 2.85, -20);
    chair(&at);
    at = kit_place(kit, 3.5, 0, 3.7, 100);
    chair(&at);
    at = kit_place(kit, 2.2, 0, DEPTH, 180);
    bookcase(&at, 1.6, 2.2);
    at = kit_place(kit, 4.3, 0, 0.12, 0);
    kit_bench(&at, 1.5, 0.45, 0.9);
    at = kit_place(kit, 9.6, 0, 4.4, 30);
    chair(&at);
}

static void doorway_things(const struct kit *kit, struct irb_builder *builder)
{
    static const double ball[3] = {5.3, 0.3, 1.75}, small_ball[3] = {5.05, 0.86, 3.3};
    static const double knot[3] = {6.25, 0.6, 4.6};
    struct kit shelf = kit_place(kit, 2.2, 0, DEPTH, 180), hanging;

    irb_builder_object(builder, "vases", D_WHITE);
    kit_vase(kit, 4.35, 0.75, 3.6, 0.35, 48);
    kit_vase(kit, 6.5, 0, 1.1, 0.9, 64);
    irb_builder_object(builder, "balls", D_RED);
    irb_builder_sphere(builder, ball, 0.3, 64, 32, false);
    irb_builder_sphere(builder, small_ball, 0.11, 48, 24, false);
    irb_builder_object(builder, "pedestal", D_WHITE);
    kit_box(kit, 5.98, 6.52, 0, 0.55, 4.33, 4.87);
    kit_box(kit, 5.94, 6.56, 0.52, 0.6, 4.29, 4.91);
    irb_builder_object(builder, "knot", D_BRASS);
    irb_builder_knot(builder, knot, 0.75, 384, 20);
    for (int colour = 0; colour < 3; colour++) {
        static const enum doorway_material covers[3] = {D_RED, D_BLUE, D_WHITE};

        irb_builder_object(builder, "books", covers[colour]);
        books(&shelf, 1.6, 2.2, colour);
    }
    irb_builder_object(builder, "carpet", D_RED);
    kit_box(kit, 2.0, 5.9, -0.01, 0.012, 1.5, 2.7);
    irb_builder_object(builder, "curtain", D_BLUE);
    hanging = kit_place(kit, 0.9, 2.7, 0.16, 0);
    kit_curtain(&hanging, 1.5, 2.6, 0.06, 6, 0.1, 0, 96, 48);
}

struct irb_scene *irb_build_doorway(struct irb_error *err)
{
    struct irb_builder builder;

    irb_builder_begin(&builder, "doorway");
    add_paints(&builder, doorway_paints, sizeof doorway_paints / sizeof *doorway_paints);
    if (!builder.failure) {
        const struct kit kit = kit_begin(&builder, 1);

        doorway_shell(&kit, &builder);
        doorway_door(&kit, &builder);
        doorway_wood(&kit, &builder);
        doorway_things(&kit, &builder);
    }
    return irb_builder_finish(&builder, err);
}

/* ---- Corridor ---- */

/* Metres: one leg along z from 0, one along x, WIDTH wide; they meet at the far end. */
#define WIDTH 2.6
#define LEG 14.0
#define HEIGHT 3.0
#define WAINSCOT 1.1

enum corridor_material { C_WALL, C_WAINSCOT, C_FLOOR, C_CEILING, C_WOOD, C_DOOR, C_RED, C_STONE };

static const struct paint corridor_paints[] = {
    [C_WALL] = {"plaster", {0.78f, 0.74f, 0.62f}},
    [C_WAINSCOT] = {"green panels", {0.18f, 0.36f, 0.22f}},
    [C_FLOOR] = {"tiles", {0.52f, 0.48f, 0.42f}},
    [C_CEILING] = {"ceiling", {0.82f, 0.82f, 0.80f}},
    [C_WOOD] = {"oak", {0.36f, 0.22f, 0.11f}},
    [C_DOOR] = {"blue doors", {0.14f, 0.22f, 0.44f}},
    [C_RED] = {"red carpet", {0.55f, 0.07f, 0.06f}},
    [C_STONE] = {"pilasters", {0.66f, 0.62f, 0.56f}},
};

/* A straight piece of wall: x from 0 to `length` at z = 0, facing +z. */
struct run {
    struct kit kit;
    double length;
    bool has_doors;
};

enum { RUNS = 4 };

/* The outer and inner walls of both legs. */
static void corridor_runs(const struct kit *kit, struct run runs[RUNS])
{
    const double inner = LEG - WIDTH;

    struct kit first = kit_place(kit, 0, 0, 0, 90), last = kit_place(kit, LEG, 0, inner, 0);

    /* all measured from the legs' closed ends, so that what faces each other lines up */
    runs[0] = (struct run){kit_mirror_x(&first), LEG, true};
    runs[1] = (struct run){kit_place(kit, WIDTH, 0, 0, -90), inner, true};
    runs[2] = (struct run){kit_place(kit, LEG, 0, LEG, 180), LEG, true};
    runs[3] = (struct run){kit_mirror_x(&last), inner, true};
}

/* The solid between the legs has its near corner at (WIDTH, LEG - WIDTH). */
static void corridor_shell(const struct kit *kit, struct irb_builder *builder)
{
    const double far = LEG + SLAB, inner = LEG - WIDTH, top = HEIGHT + 0.05;

    irb_builder_object(builder, "floor", C_FLOOR);
    kit_box(kit, -SLAB, far, -SLAB, 0, -SLAB, far);
    irb_builder_object(builder, "ceiling", C_CEILING);
    kit_box(kit, -SLAB, far, HEIGHT, HEIGHT + SLAB, -SLAB, far);
    irb_builder_object(builder, "walls", C_WALL);
    kit_box(kit, -SLAB, 0, -0.05, top, -SLAB, far);
    kit_box(kit, -0.05, far, -0.05, top, LEG, far);
    kit_box(kit, -0.05, WIDTH + 0.05, -0.05, top, -SLAB, 0);
    kit_box(kit, LEG, far, -0.05, top, inner - 0.05, LEG + 0.05);
    kit_box(kit, WIDTH, far, -0.05, top, -SLAB, inner);
    irb_builder_object(builder, "carpet", C_RED);
    kit_box(kit, 0.75, 1.85, -0.01, 0.012, 0.6, LEG - 0.75);
    kit_box(kit, 1.84, LEG - 0.6, -0.01, 0.0115, LEG - 1.85, LEG - 0.75);
}

#define DOOR_STEP 4.0 /* between doors along a wall */

static double door_x(int i)
{
    return 1.6 + DOOR_STEP * i;
}

static bool door_fits(const struct run *run, int i)
{
    return run->has_doors && door_x(i) + 1.3 < run->length;
}

/* Panelled wainscot between the doors, with its rail. */
static void wainscot(const struct run *run)
{
    double x = -0.02;

    for (int i = 0; x < run->length; i++) {
        double next = door_fits(run, i) ? door_x(i) - 0.1 : run->length;

        kit_box(&run->kit, x, next, -0.02, WAINSCOT, -0.05, 0.03);
        kit_box(&run->kit, x, next, WAINSCOT - 0.02, WAINSCOT + 0.06, -0.05, 0.06);
        kit_box(&run->kit, x, next, -0.02, 0.14, -0.05, 0.05);
        x = next == run->length ? run->length : door_x(i) + 1.0;
    }
}

static void corridor_walls(const struct run runs[RUNS], struct irb_builder *builder)
{
    irb_builder_object(builder, "wainscot", C_WAINSCOT);
    for (int r = 0; r < RUNS; r++)
        wainscot(&runs[r]);
    irb_builder_object(builder, "doors", C_DOOR);
    for (int r = 0; r < RUNS; r++)
        for (int i = 0; door_fits(&runs[r], i); i++) {
            struct kit at = kit_place(&runs[r].kit, door_x(i), 0, -0.01, 0);

            door_leaf(&at, 0.9, 2.1);
        }
    irb_builder_object(builder, "door frames", C_WOOD);
    for (int r = 0; r < RUNS; r++)
        for (int i = 0; door_fits(&runs[r], i); i++) {
            struct kit at = kit_place(&runs[r].kit, door_x(i), 0, 0, 0);

            door_frame(&at, 0.9, 2.1, -0.05, 0.07);
        }
    irb_builder_object(builder, "pilasters", C_STONE);
    for (int r = 0; r < RUNS; r++)
        for (int i = 0; door_x(i) + 2.6 < runs[r].length; i++) {
            const struct kit *kit = &runs[r].kit;
            double x = door_x(i) + 2.3;

            kit_box(kit, x, x + 0.36, -0.02, HEIGHT + 0.02, -0.05, 0.16);
            kit_box(kit, x - 0.05, x + 0.41, -0.02, 0.3, -0.05, 0.21);
            kit_box(kit, x - 0.05, x + 0.41, HEIGHT - 0.36, HEIGHT - 0.2, -0.05, 0.21);
            if (x < LEG - WIDTH - 0.5) /* beams from wall to wall, none over the corner */
                kit_box(kit, x, x + 0.36, HEIGHT - 0.22, HEIGHT + 0.02, -0.05, WIDTH / 2 + 0.01);
        }
}

static void corridor_things(const struct kit *kit, const struct run runs[RUNS],
                            struct irb_builder *builder)
{
    irb_builder_object(builder, "benches", C_WOOD);
    for (int r = 0; r < RUNS; r++)
        for (int i = 0; i < 2; i++) {
            struct kit at = kit_place(&runs[r].kit, door_x(i) + 2.85, 0, 0.12, 0);

            kit_bench(&at, 0.95, 0.45, 0.9);
        }
    irb_builder_object(builder, "vases", C_STONE);
    kit_vase(kit, 0.5, 0, LEG - 0.5, 1.0, 64);
    kit_vase(kit, WIDTH - 0.4, 0, 0.5, 0.8, 48);
    kit_vase(kit, LEG - 0.5, 0, LEG - 0.5, 0.9, 48);
}

struct irb_scene *irb_build_corridor(struct irb_error *err)
{
    struct irb_builder builder;

    irb_builder_begin(&builder, "corridor");
    add_paints(&builder, corridor_paints, sizeof corridor_paints / sizeof *corridor_paints);
    if (!builder.failure) {
        const struct kit kit = kit_begin(&builder, 1);
        struct run runs[RUNS];

        corridor_runs(&kit, runs);
        corridor_shell(&kit, &builder);
        corridor_walls(runs, &builder);
        corridor_things(&kit, runs, &builder);
    }
    return irb_builder_finish(&builder, err);
}
