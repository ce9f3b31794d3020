/* SPDX-License-Identifier: MIT
 *
 * A cathedral of Sibenik's kind: a nave of six bays between aisles, a crossing with transepts under
 * an octagonal drum and a dome, a raised choir and a polygonal apse. 40 x 17 x 30 m; x runs from
 * the west door to the apse, z across.
 *
 * The inside is one closed surface in the sense that a ray cannot leave it; its pieces run into
 * each other behind ribs, piers and cornices.
 */
#include "core/scene/builtin/geometry.h"

#include "core/scene/builtin/kit.h"

#include <math.h>
#include <stdlib.h>

/* The plan, metres. */
#define WEST (-19.5)    /* inner face of the west wall */
#define BAY 3.75        /* of the nave and its aisles */
#define CROSSING 7.0    /* x of the crossing's middle */
#define CHOIR 10.6      /* where the choir's walls begin */
#define APSE 15.5       /* x of the apse's middle */
#define NAVE_HALF 3.6   /* to the arcades' faces, and of the crossing */
#define AISLE 4.4       /* back of the arcades */
#define OUTER 8.0       /* inner face of the aisles' outer walls and of the transepts */
#define THICKNESS 0.8   /* of the arcades */
#define IMPOST 5.0      /* where arcades and aisle vaults spring */
#define STRING 9.0      /* string course below the clerestory */
#define SPRING 12.5     /* of the high vaults */
#define HIGH_WALL 13.0  /* the walls end behind the vaults */
#define VAULT_HALF 3.62 /* high vaults start just behind the walls' faces */
#define DRUM 16.1       /* foot of the drum: the pendentives' circle */
#define DOME 20.7       /* springing of the dome */
#define DOME_RISE 5.0
#define LANTERN_RADIUS 0.7
#define LANTERN 25.55
#define LANTERN_TOP 29.0
#define PLATFORM 0.6 /* of the choir */
enum { BAYS = 6 };

enum material {
    STONE,
    PALE,
    DARK,
    LIGHT,
    GLASS,
    WOOD,
    RED_MARBLE,
    RED_CLOTH,
    BLUE_CLOTH,
    GOLD,
    MATERIALS
};

static const struct {
    const char *name;
    float diffuse[3];
} materials[MATERIALS] = {
    [STONE] = {"limestone", {0.62f, 0.57f, 0.48f}},
    [PALE] = {"plaster", {0.76f, 0.73f, 0.66f}},
    [DARK] = {"dark marble", {0.16f, 0.13f, 0.13f}},
    [LIGHT] = {"light marble", {0.68f, 0.63f, 0.55f}},
    [GLASS] = {"window", {0.30f, 0.42f, 0.55f}},
    [WOOD] = {"oak", {0.27f, 0.15f, 0.07f}},
    [RED_MARBLE] = {"red marble", {0.48f, 0.17f, 0.12f}},
    [RED_CLOTH] = {"red cloth", {0.60f, 0.05f, 0.05f}},
    [BLUE_CLOTH] = {"blue cloth", {0.06f, 0.12f, 0.50f}},
    [GOLD] = {"gold", {0.75f, 0.52f, 0.16f}},
};

static const struct kit_opening clerestory = {BAY / 2, 0.6, 9.7, 11.1, 16};
static const struct kit_opening aisle_window = {BAY / 2, 0.55, 2.0, 4.0, 16};
static const struct kit_opening arcade_arch = {BAY / 2, 1.45, IMPOST, IMPOST, 24};
static const struct kit_opening aisle_arch = {0, 1.5, 0, IMPOST, 32};
static const struct kit_opening chapel = {0, 1.1, 0.9, 3.8, 24};
static const struct kit_opening high_window = {0, 0.75, 6.5, 10.2, 24};
static const struct kit_opening transept_window = {0, 1.3, 5.0, 10.0, 32};
static const struct kit_opening apse_window = {0, 0.45, 5.2, 9.2, 16};
static const struct kit_opening drum_window = {0, 0.5, 17.0, 19.0, 16};
static const struct kit_opening portal = {0, 1.5, 0, 3.4, 32};
static const struct kit_opening west_window = {0, 1.5, 8.4, 10.8, 32};
static const struct kit_opening aisle_west = {0, 0.6, 2.0, 4.0, 16};

static double bay_start(int bay)
{
    return WEST + BAY * bay;
}

/* ---- Walls with windows ---- */

/* A wall of the building that faces +z of its frame, with a niche; panes are a later object. */
struct wall {
    struct kit frame;
    double x0, x1, y0, y1;
    const struct kit_opening *niche;
    double depth;
    enum material pane;
};

enum { MAX_WALLS = 64 };

struct walls {
    struct wall list[MAX_WALLS];
    int count;
};

static void add_wall(struct walls *walls, struct kit frame, double half, double y0, double y1,
                     const struct kit_opening *niche, enum material pane)
{
    if (walls->count < MAX_WALLS)
        walls->list[walls->count++] = (struct wall){
            frame, niche->centre - half, niche->centre + half, y0, y1, niche, 0.5, pane};
}

/* Both sides look alike: `side` has its z towards the outer wall. */
static void add_side_walls(struct walls *walls, const struct kit *side)
{
    for (int bay = 0; bay < BAYS; bay++) { /* turned by 180: faces the nave, x runs back */
        double end = bay_start(bay + 1);

        add_wall(walls, kit_place(side, end, 0, NAVE_HALF, 180), BAY / 2, STRING, HIGH_WALL,
                 &clerestory, GLASS);
        add_wall(walls, kit_place(side, end, 0, OUTER, 180), BAY / 2, -0.1, 7.2, &aisle_window,
                 GLASS);
    }
    add_wall(walls, kit_place(side, CROSSING, 0, OUTER, 180), 4.0, -0.1, HIGH_WALL + 4,
             &transept_window, GLASS);
    add_wall(walls, kit_place(side, CHOIR, 0, 6.0, -90), 2.6, -0.1, HIGH_WALL, &chapel, RED_MARBLE);
    add_wall(walls, kit_place(side, 13.3, 0, NAVE_HALF, 180), 2.9, -0.1, HIGH_WALL, &high_window,
             GLASS);
    add_wall(walls, kit_place(side, WEST, 0, 6.2, 90), 1.9, -0.1, 7.2, &aisle_west, GLASS);
}

static void add_middle_walls(struct walls *walls, const struct kit *kit)
{
    const double apse_half = NAVE_HALF * tan(M_PI / 10) + 0.02;
    const double drum_half = NAVE_HALF * tan(M_PI / 8) + 0.02;

    for (int i = 0; i < 5; i++) {
        double angle = -72 + 36.0 * i;
        struct kit centre = kit_place(kit, APSE, 0, 0, angle);

        add_wall(walls, kit_place(&centre, NAVE_HALF, 0, 0, -90), apse_half, 0, HIGH_WALL,
                 &apse_window, GLASS);
    }
    for (int i = 0; i < 8; i++) {
        struct kit centre = kit_place(kit, CROSSING, 0, 0, 45 * i);

        add_wall(walls, kit_place(&centre, NAVE_HALF, 0, 0, -90), drum_half, DRUM + 0.05,
                 DOME + 0.1, &drum_window, GLASS);
    }
    add_wall(walls, kit_place(kit, WEST, 0, 0, 90), 4.4, -0.1, 7.5, &portal, WOOD);
    add_wall(walls, kit_place(kit, WEST, 0, 0, 90), 4.4, 7.5, 17, &west_window, GLASS);
}

static void build_walls(const struct walls *walls, struct irb_builder *builder)
{
    irb_builder_object(builder, "walls", STONE);
    for (int i = 0; i < walls->count; i++) {
        const struct wall *wall = &walls->list[i];

        kit_panel(&wall->frame, wall->x0, wall->x1, wall->y0, wall->y1, wall->niche, wall->depth);
    }
    for (int material = 0; material < MATERIALS; material++) {
        irb_builder_object(builder, material == GLASS ? "windows" : "doors", material);
        for (int i = 0; i < walls->count; i++)
            if ((int)walls->list[i].pane == material)
                kit_pane(&walls->list[i].frame, walls->list[i].niche, walls->list[i].depth);
    }
}

/* Round mouldings that frame the larger openings. */
static void build_frames(const struct walls *walls, struct irb_builder *builder)
{
    irb_builder_object(builder, "window frames", PALE);
    for (int i = 0; i < walls->count; i++) {
        const struct wall *wall = &walls->list[i];
        const struct kit_opening *niche = wall->niche;
        const double r = niche->radius, w = 0.14;
        struct kit_profile ring = {0};
        struct kit at = kit_place(&wall->frame, niche->centre, 0, 0, 0);

        kit_profile_arc(&ring, w / 2, -0.02, w / 2, 0.1, 0, 180, 3);
        kit_arch(&at, &ring, 0, niche->spring, r, r, 0, 180, 12);
        for (int side = -1; side <= 1; side += 2)
            kit_box(&at, side > 0 ? r : -r - w, side > 0 ? r + w : -r, niche->sill, niche->spring,
                    -0.05, 0.07);
        if (niche->sill > 0)
            kit_box(&at, -r - 0.25, r + 0.25, niche->sill - 0.14, niche->sill, -0.1, 0.14);
    }
}

/* ---- Floor ---- */

/* Slabs of one metre in two marbles; the rows and columns of bays that they form are ours. */
static void build_floor(const struct kit *kit, struct irb_builder *builder)
{
    for (int colour = 0; colour < 2; colour++) {
        irb_builder_object(builder, colour ? "dark slabs" : "light slabs", colour ? DARK : LIGHT);
        for (int i = -21; i < 13; i++)
            for (int j = -9; j < 9; j++)
                if (((i + j) & 1) == colour)
                    kit_floor(kit, i, i + 1, j, j + 1, 0, true);
    }
    irb_builder_object(builder, "choir steps", RED_MARBLE);
    struct kit foot = kit_place(kit, CHOIR - 0.2, 0, 0, 0);
    kit_steps(&foot, 4, PLATFORM / 4, 0.35, -4.2, 4.2, APSE + 4.2 - CHOIR);
}

/* ---- Arcades and aisles ---- */

static void build_columns(const struct kit sides[2], struct irb_builder *builder)
{
    irb_builder_object(builder, "columns", STONE);
    for (int s = 0; s < 2; s++)
        for (int k = 0; k < BAYS; k++)
            kit_column(&sides[s], bay_start(k), 0, 4.0, IMPOST + 0.02, 0.4, 18);
    irb_builder_object(builder, "capital leaves", STONE);
    for (int s = 0; s < 2; s++)
        for (int k = 0; k < BAYS; k++)
            kit_leaves(&sides[s], bay_start(k), 0, 4.0, IMPOST + 0.02, 0.4, 8);
}

static void build_arcades(const struct kit sides[2], struct irb_builder *builder)
{
    struct kit_profile moulding = {0};

    kit_profile_arc(&moulding, 0.15, 0, 0.08, 0.09, 0, 180, 4);
    irb_builder_object(builder, "arcades", STONE);
    for (int s = 0; s < 2; s++) {
        for (int bay = 0; bay < BAYS; bay++) {
            struct kit at = kit_place(&sides[s], bay_start(bay + 1), 0, NAVE_HALF, 180);

            kit_arcade(&at, 0, BAY, IMPOST, STRING + 0.1, &arcade_arch, THICKNESS);
            for (int order = 0; order < 2; order++)
                kit_arch(&at, &moulding, BAY / 2, IMPOST, 1.4 + 0.22 * order, 1.4 + 0.22 * order, 0,
                         180, 24);
        }
        struct kit end = kit_place(&sides[s], CROSSING - NAVE_HALF, 0, 6.2, 90);
        kit_arcade(&end, -1.85, 1.85, 0, HIGH_WALL, &aisle_arch, THICKNESS);
    }
}

static void build_aisle_vaults(const struct kit sides[2], struct irb_builder *builder)
{
    const struct kit_profile rib = kit_bar(-0.18, 0.3, -0.22, 0.22);

    irb_builder_object(builder, "aisle vaults", PALE);
    for (int s = 0; s < 2; s++)
        for (int bay = 0; bay < BAYS; bay++) {
            struct kit at = kit_place(&sides[s], bay_start(bay) + BAY / 2, IMPOST, 6.2, 0);

            kit_groin_vault(&at, BAY / 2 + 0.02, 1.85, 1.85, 6);
        }
    irb_builder_object(builder, "aisle ribs", STONE);
    for (int s = 0; s < 2; s++)
        for (int k = 0; k < BAYS; k++) {
            struct kit at = kit_place(&sides[s], bay_start(k), 0, 6.2, 90);

            kit_arch(&at, &rib, 0, IMPOST, 1.8, 1.8, 0, 180, 24);
            kit_box(&sides[s], bay_start(k) - 0.3, bay_start(k) + 0.3, 0, IMPOST - 0.3, 7.75, 8.05);
            kit_box(&sides[s], bay_start(k) - 0.4, bay_start(k) + 0.4, IMPOST - 0.32, IMPOST + 0.02,
                    7.65, 8.05);
            kit_box(&sides[s], bay_start(k) - 0.38, bay_start(k) + 0.38, -0.1, 0.45, 7.68, 8.05);
        }
}

/* ---- High vaults, crossing, dome ---- */

/* A barrel along +x of its frame, from x = 0. */
static void barrel(const struct kit *kit, double length)
{
    struct kit along = kit_place(kit, 0, 0, 0, 90);
    const struct kit_profile inner = {2, {{0, length}, {0, 0}}};

    kit_arch(&along, &inner, 0, SPRING, VAULT_HALF, VAULT_HALF, 0, 180, 40);
}

static void build_high_vaults(const struct kit *kit, struct irb_builder *builder)
{
    struct kit_profile half_dome = {0};
    struct kit at;

    irb_builder_object(builder, "high vaults", PALE);
    at = kit_place(kit, WEST - 0.1, 0, 0, 0);
    barrel(&at, CROSSING - NAVE_HALF - 0.1 - WEST + 0.1);
    at = kit_place(kit, CHOIR + 0.1, 0, 0, 0);
    barrel(&at, APSE - CHOIR);
    for (int side = 0; side < 2; side++) {
        struct kit arm = kit_place(kit, CROSSING, 0, 0, side ? 90 : -90);

        at = kit_place(&arm, NAVE_HALF + 0.1, 0, 0, 0);
        barrel(&at, OUTER - NAVE_HALF);
    }
    kit_profile_arc(&half_dome, 0, SPRING, VAULT_HALF, VAULT_HALF, 90, -2, 16);
    kit_lathe(kit, &half_dome, APSE, 0, -90, 90, 32);
    at = kit_place(kit, CROSSING, SPRING, 0, 0);
    kit_pendentives(&at, NAVE_HALF, 16);
}

/* A transverse arch in the plane x = 0 of its frame, with the pilasters that carry it. */
static void transverse_arch(const struct kit *kit, double half_width)
{
    struct kit across = kit_place(kit, 0, 0, 0, 90);
    const double w = half_width;
    struct kit_profile rib = {0};

    /* the way round with its outside on the right: down the soffit, back above the vault */
    kit_profile_point(&rib, 0.2, w);
    kit_profile_point(&rib, -0.2, w);
    kit_profile_arc(&rib, -0.2, w - 0.1, 0.08, 0.08, 90, 270, 3);
    kit_profile_arc(&rib, -0.2, -w + 0.1, 0.08, 0.08, 90, 270, 3);
    kit_profile_point(&rib, -0.2, -w);
    kit_profile_point(&rib, 0.2, -w);
    kit_arch(&across, &rib, 0, SPRING, NAVE_HALF, NAVE_HALF, 0, 180, 26);
}

static void pilaster(const struct kit *kit, double half_width, double foot)
{
    const double w = half_width;

    for (int side = 0; side < 2; side++) {
        struct kit at = kit_place(kit, 0, 0, 0, 180 * side);

        kit_box(&at, -w, w, foot, SPRING, 3.4, 3.75);
        kit_box(&at, -w - 0.1, w + 0.1, SPRING - 0.45, SPRING - 0.05, 3.28, 3.75);
        kit_box(&at, -w - 0.06, w + 0.06, SPRING - 0.62, SPRING - 0.5, 3.34, 3.75);
        if (foot < 1) {
            kit_box(&at, -w - 0.1, w + 0.1, foot - 0.1, foot + 0.4, 3.3, 3.75);
            continue;
        }
        for (int i = 0; i < 3; i++) /* a corbel, stepping back downwards */
            kit_box(&at, -w - 0.08 + 0.07 * i, w + 0.08 - 0.07 * i, foot - 0.16 * (i + 1),
                    foot - 0.16 * i + 0.01, 3.34 + 0.07 * i, 3.75);
    }
}

static void build_ribs(const struct kit *kit, struct irb_builder *builder)
{
    irb_builder_object(builder, "transverse arches", STONE);
    for (int k = 0; k < BAYS; k++) {
        struct kit at = kit_place(kit, bay_start(k), 0, 0, 0);

        transverse_arch(&at, 0.25);
        pilaster(&at, 0.25, IMPOST + 1.9);
    }
    for (int side = 0; side < 4; side++) { /* around the crossing */
        struct kit arm = kit_place(kit, CROSSING, 0, 0, 90 * side);
        struct kit at = kit_place(&arm, NAVE_HALF + 0.38, 0, 0, 0);

        transverse_arch(&at, 0.4);
        pilaster(&at, 0.4, 0);
    }
    struct kit at = kit_place(kit, APSE + 0.1, 0, 0, 0);
    transverse_arch(&at, 0.3);
    pilaster(&at, 0.3, PLATFORM);
    irb_builder_object(builder, "crossing piers", STONE);
    for (int x = -1; x <= 1; x += 2)
        for (int z = -1; z <= 1; z += 2) {
            double cx = CROSSING + 4.12 * x, cz = 4.12 * z;

            kit_box(kit, cx - 0.5, cx + 0.5, -0.1, HIGH_WALL, cz - 0.5, cz + 0.5);
        }
}

/* A solid ring whose inner side is moulded. */
static void ring(const struct kit *kit, double x, double inner, double outer, double y, double h,
                 double from, double to, int slices)
{
    struct kit_profile profile = {0};

    kit_profile_point(&profile, outer, y + h);
    kit_profile_point(&profile, inner, y + h);
    kit_profile_point(&profile, inner, y + 0.7 * h);
    kit_profile_arc(&profile, inner + 0.12, y + 0.4 * h, 0.1, 0.25 * h, 90, 270, 5);
    kit_profile_point(&profile, inner + 0.14, y);
    kit_profile_point(&profile, outer, y);
    kit_profile_point(&profile, outer, y + h);
    kit_lathe(kit, &profile, x, 0, from, to, slices);
}

static void build_dome(const struct kit *kit, struct irb_builder *builder)
{
    const double top = acos(LANTERN_RADIUS / VAULT_HALF) * 180 / M_PI;
    struct kit_profile shell = {0}, lantern = {0};
    const struct kit_profile rib = kit_bar(-0.12, 0.1, -0.11, 0.11);

    irb_builder_object(builder, "dome", PALE);
    kit_profile_arc(&shell, 0, DOME, VAULT_HALF, DOME_RISE, top, 0, 20);
    kit_lathe(kit, &shell, CROSSING, 0, 0, 360, 64);
    kit_profile_arc(&lantern, 0, LANTERN_TOP - LANTERN_RADIUS, LANTERN_RADIUS, LANTERN_RADIUS, 90,
                    0, 8);
    kit_profile_point(&lantern, LANTERN_RADIUS, LANTERN - 0.1);
    kit_lathe(kit, &lantern, CROSSING, 0, 0, 360, 32);
    irb_builder_object(builder, "dome ribs", STONE);
    for (int i = 0; i < 8; i++) {
        struct kit at = kit_place(kit, CROSSING, 0, 0, 22.5 + 45 * i);
        struct kit colonnette = kit_place(&at, NAVE_HALF / cos(M_PI / 8) - 0.1, 0, 0, 0);
        const struct kit_profile shaft = {
            4, {{0.2, DRUM}, {0.14, DRUM + 0.5}, {0.14, DOME - 0.5}, {0.22, DOME}}};

        kit_arch(&at, &rib, 0, DOME, VAULT_HALF, DOME_RISE, 0, top, 16);
        kit_lathe(&colonnette, &shaft, 0, 0, 0, 360, 10);
    }
    ring(kit, CROSSING, 3.3, 4.2, DRUM - 0.1, 0.4, 0, 360, 48);
    ring(kit, CROSSING, 3.3, 4.2, DOME - 0.25, 0.45, 0, 360, 48);
    ring(kit, CROSSING, 0.5, 1.1, LANTERN - 0.3, 0.35, 0, 360, 32);
    ring(kit, APSE, 3.35, 4.1, SPRING - 0.3, 0.42, -90, 90, 48);
}

/* ---- Cornices ---- */

/* Along x at z = 0 of its frame, facing +z. */
static void cornice(const struct kit *kit, double x0, double x1, double y, double h)
{
    struct kit_profile profile = {0};

    kit_profile_point(&profile, -0.1, y);
    kit_profile_point(&profile, 0.05, y);
    kit_profile_arc(&profile, 0.05, y + 0.35 * h, 0.1, 0.3 * h, -90, 90, 5);
    kit_profile_point(&profile, 0.22, y + 0.75 * h);
    kit_profile_point(&profile, 0.22, y + h);
    kit_profile_point(&profile, -0.1, y + h);
    kit_moulding(kit, &profile, x0, x1);
}

static void build_cornices(const struct kit sides[2], struct irb_builder *builder)
{
    irb_builder_object(builder, "cornices", PALE);
    for (int s = 0; s < 2; s++) {
        struct kit nave = kit_place(&sides[s], 0, 0, NAVE_HALF, 180);
        struct kit outer = kit_place(&sides[s], 0, 0, OUTER, 180);

        cornice(&nave, -(CROSSING - 4.0), -WEST + 0.1, STRING - 0.15, 0.35);
        cornice(&nave, -(CROSSING - 4.0), -WEST + 0.1, SPRING - 0.4, 0.4);
        cornice(&nave, -APSE - 0.3, -CHOIR, SPRING - 0.4, 0.4);
        cornice(&outer, -(CROSSING + 4.0), -(CROSSING - 4.0), SPRING - 0.4, 0.4);
        for (int x = -1; x <= 1; x += 2) { /* the transept's side walls */
            struct kit wall = kit_place(&sides[s], CROSSING + NAVE_HALF * x, 0, 0, -90 * x);

            cornice(&wall, x > 0 ? 3.9 : -OUTER, x > 0 ? OUTER : -3.9, SPRING - 0.4, 0.4);
        }
    }
}

/* ---- Furniture ---- */

static void build_benches(const struct kit sides[2], struct irb_builder *builder)
{
    irb_builder_object(builder, "benches", WOOD);
    for (int s = 0; s < 2; s++)
        for (int row = 0; row < 13; row++) {
            struct kit at = kit_place(&sides[s], -13.5 + 1.1 * row, 0, 0.9, 90);

            at = kit_place(&at, -2.2, 0, 0, 0);
            kit_bench(&at, 2.2, 0.45, 0.95);
        }
}

static void build_altar(const struct kit *kit, struct irb_builder *builder)
{
    struct kit east = kit_place(kit, 14.2, PLATFORM, 0, 0);

    irb_builder_object(builder, "altar", LIGHT);
    kit_box(&east, -0.5, 0.5, -0.05, 0.95, -1.3, 1.3);
    kit_box(&east, -0.62, 0.62, 0.95, 1.07, -1.45, 1.45);
    kit_box(&east, -1.6, 1.4, -0.1, 0.15, -2.2, 2.2);
    irb_builder_object(builder, "altar cloth", RED_CLOTH);
    kit_box(&east, -0.64, -0.5, 0.35, 1.09, -1.0, 1.0);
    kit_box(&east, -0.64, 0.6, 1.05, 1.09, -1.0, 1.0);
    kit_floor(kit, WEST + 0.5, CHOIR - 0.2, -0.6, 0.6, 0.01, true);
    irb_builder_object(builder, "candlesticks", GOLD);
    for (int i = 0; i < 6; i++)
        kit_baluster(&east, 0.2, 1.06, -1.1 + 0.44 * i, 0.7, 8);
    irb_builder_object(builder, "font", RED_MARBLE);
    kit_vase(kit, -16.5, 0, -2.2, 1.2, 24);
}

static void build_banners(const struct kit sides[2], struct irb_builder *builder)
{
    for (int colour = 0; colour < 2; colour++) {
        irb_builder_object(builder, colour ? "blue banners" : "red banners",
                           colour ? BLUE_CLOTH : RED_CLOTH);
        for (int s = 0; s < 2; s++)
            for (int bay = 0; bay < BAYS; bay++) {
                struct kit at = kit_place(&sides[s], bay_start(bay + 1) - BAY / 2 + 0.7,
                                          STRING - 0.25, NAVE_HALF - 0.16, 180);

                if ((bay + s) % 2 == colour)
                    kit_curtain(&at, 1.4, 1.95, 0.035, 3, 0, bay + 3.0 * s, 24, 8);
            }
    }
}

struct irb_scene *irb_build_hall(struct irb_error *err)
{
    struct irb_builder builder;
    struct walls *walls = calloc(1, sizeof *walls);

    irb_builder_begin(&builder, "hall");
    if (!walls)
        builder.failure = IRB_E_MEMORY;
    for (int i = 0; i < MATERIALS; i++)
        irb_builder_material(&builder, materials[i].name, materials[i].diffuse);
    if (!builder.failure) {
        const struct kit kit = kit_begin(&builder, 1);
        const struct kit sides[2] = {kit, kit_mirror_z(&kit)};

        add_side_walls(walls, &sides[0]);
        add_side_walls(walls, &sides[1]);
        add_middle_walls(walls, &kit);
        build_walls(walls, &builder);
        build_frames(walls, &builder);
        build_floor(&kit, &builder);
        build_columns(sides, &builder);
        build_arcades(sides, &builder);
        build_aisle_vaults(sides, &builder);
        build_high_vaults(&kit, &builder);
        build_ribs(&kit, &builder);
        build_dome(&kit, &builder);
        build_cornices(sides, &builder);
        build_benches(sides, &builder);
        build_altar(&kit, &builder);
        build_banners(sides, &builder);
    }
    free(walls);
    return irb_builder_finish(&builder, err);
}
