/* SPDX-License-Identifier: MIT
 *
 * A court of Sponza's kind: 22 x 8 m, open to the sky, between two storeys of round-arched
 * colonnades with galleries behind them; groin vaults below, beams above. Coloured curtains hang in
 * the lower arches, drapes over the balustrades. Walls, paving and cloth carry finely structured
 * textures. x runs along the court.
 */
#include "core/scene/builtin/geometry.h"

#include "core/scene/builtin/texture.h"
#include "core/scene/builtin/kit.h"

#include <math.h>

/* Metres. */
#define COURT_X 11.0 /* middle of the columns, from the court's middle */
#define COURT_Z 4.0
#define GALLERY 4.0 /* from the columns to the outer wall's face */
#define WALL_HALF 0.3
#define CLEAR (GALLERY - WALL_HALF) /* a gallery's width behind the arcade */
#define LOWER_IMPOST 3.4
#define UPPER_FLOOR 5.7
#define UPPER_IMPOST 8.5
#define CEILING 10.2
#define ROOF 10.6
#define ARCH_RADIUS 1.02
#define BALUSTRADE 0.95
enum { LONG_BAYS = 8, SHORT_BAYS = 3, TEXTURE_SIZE = 512 };

enum material {
    STONE,
    PLASTER,
    ASHLAR,
    BRICK,
    MARBLE,
    TERRACOTTA,
    WOOD,
    FRIEZE,
    RED,
    GREEN,
    BLUE,
    BRONZE,
    MATERIALS
};

static const struct {
    const char *name;
    float diffuse[3];
    int pattern; /* enum irb_pattern, -1 for none */
    double size; /* metres that the pattern spans */
} materials[MATERIALS] = {
    [STONE] = {"limestone", {0.58f, 0.52f, 0.42f}, -1, 1},
    [PLASTER] = {"plaster", {0.70f, 0.65f, 0.56f}, -1, 1},
    [ASHLAR] = {"ashlar", {1, 1, 1}, IRB_PATTERN_ASHLAR, 2},
    [BRICK] = {"brick", {1, 1, 1}, IRB_PATTERN_BRICK, 0.8},
    [MARBLE] = {"marble", {1, 1, 1}, IRB_PATTERN_MARBLE, 2},
    [TERRACOTTA] = {"terracotta", {0.52f, 0.24f, 0.14f}, -1, 1},
    [WOOD] = {"chestnut", {0.30f, 0.18f, 0.10f}, -1, 1},
    [FRIEZE] = {"frieze", {0.72f, 0.50f, 0.30f}, IRB_PATTERN_DAMASK, 0.5},
    [RED] = {"red cloth", {0.75f, 0.06f, 0.05f}, IRB_PATTERN_DAMASK, 0.5},
    [GREEN] = {"green cloth", {0.08f, 0.50f, 0.09f}, IRB_PATTERN_DAMASK, 0.5},
    [BLUE] = {"blue cloth", {0.06f, 0.13f, 0.65f}, IRB_PATTERN_DAMASK, 0.5},
    [BRONZE] = {"bronze", {0.35f, 0.22f, 0.11f}, -1, 1},
};

static void add_materials(struct irb_builder *builder)
{
    int textures[IRB_PATTERN_DAMASK + 1];

    for (int pattern = 0; pattern <= IRB_PATTERN_DAMASK; pattern++)
        textures[pattern] = irb_builder_pattern(builder, (enum irb_pattern)pattern, TEXTURE_SIZE);
    for (int i = 0; i < MATERIALS; i++) {
        int material = irb_builder_material(builder, materials[i].name, materials[i].diffuse);

        if (!builder->failure && materials[i].pattern >= 0)
            builder->scene->materials[material].diffuse_texture = textures[materials[i].pattern];
    }
}

/* One of the four colonnades; its frame has z from the court outwards and x along it. */
struct side {
    struct kit kit;
    double half;     /* half its length, to the corner piers' middle */
    double distance; /* of the columns' middle from the court's */
    int bays;
};

struct court {
    struct irb_builder *builder;
    struct side sides[4];
};

static struct kit with_material(const struct kit *kit, enum material material)
{
    struct kit changed = *kit;

    changed.texture_size = materials[material].size;
    return changed;
}

/* Begins an object and sets the texture scale of all four frames to its material's. */
static void begin(struct court *court, const char *name, enum material material)
{
    irb_builder_object(court->builder, name, material);
    for (int s = 0; s < 4; s++)
        court->sides[s].kit = with_material(&court->sides[s].kit, material);
}

static double column_x(const struct side *side, int i)
{
    return side->half * (2.0 * i / side->bays - 1);
}

/* The frame of a side turned so that its z faces the court, at `z` from the court's middle. */
static struct kit facing_court(const struct side *side, double x, double y, double z)
{
    return kit_place(&side->kit, x, y, z, 180);
}

/* ---- Shell ---- */

static void build_floors(struct court *court)
{
    const struct kit *kit = &court->sides[0].kit;
    const double x = COURT_X + GALLERY, z = COURT_Z + GALLERY;

    begin(court, "court paving", MARBLE);
    for (int i = -5; i < 5; i++)
        for (int j = -2; j < 2; j++)
            kit_floor(kit, 2.2 * i, 2.2 * (i + 1), 2 * j, 2 * (j + 1), 0, true);
    begin(court, "gallery paving", TERRACOTTA);
    for (int side = -1; side <= 1; side += 2) {
        double z0 = side < 0 ? -z : COURT_Z, x0 = side < 0 ? -x : COURT_X;

        kit_floor(kit, -x, x, z0, z0 + GALLERY, 0, true);
        kit_floor(kit, x0, x0 + GALLERY, -COURT_Z, COURT_Z, 0, true);
    }
}

/* A ring of four boxes round the court, from `inner` behind the columns' middle outwards. */
static void slab_ring(const struct kit *kit, double inner, double outer, double y0, double y1)
{
    const double x = COURT_X + inner, z = COURT_Z + inner;
    const double X = COURT_X + outer, Z = COURT_Z + outer;

    kit_box(kit, -X, X, y0, y1, z, Z);
    kit_box(kit, -X, X, y0, y1, -Z, -z);
    kit_box(kit, x, X, y0, y1, -z, z);
    kit_box(kit, -X, -x, y0, y1, -z, z);
}

static void build_shell(struct court *court)
{
    const struct kit *kit = &court->sides[0].kit;

    begin(court, "outer walls", BRICK);
    slab_ring(&court->sides[0].kit, GALLERY, GALLERY + 0.6, -0.5, ROOF - 0.1);
    begin(court, "upper floor", TERRACOTTA);
    slab_ring(kit, -WALL_HALF + 0.05, GALLERY + 0.1, UPPER_FLOOR - 0.3, UPPER_FLOOR);
    begin(court, "roof", TERRACOTTA);
    slab_ring(kit, -WALL_HALF + 0.05, GALLERY + 0.9, CEILING + 0.05, ROOF);
    begin(court, "ceiling", PLASTER);
    slab_ring(kit, -WALL_HALF + 0.1, GALLERY + 0.1, CEILING, CEILING + 0.1);
    begin(court, "beams", WOOD);
    for (int s = 0; s < 4; s++) {
        const struct side *side = &court->sides[s];

        for (int i = 0; i <= 2 * side->bays; i++) {
            double x = side->half * ((double)i / side->bays - 1);

            kit_box(&side->kit, x - 0.1, x + 0.1, CEILING - 0.26, CEILING + 0.05,
                    side->distance + 0.2, side->distance + GALLERY + 0.1);
        }
    }
}

/* ---- Colonnades ---- */

/* A storey's arcade: wall with arches from the impost to `top`, mouldings round the arches. */
static void storey_arcade(const struct side *side, double impost, double top)
{
    const double width = 2 * side->half / side->bays;
    const struct kit_opening arch = {width / 2, ARCH_RADIUS, impost, impost, 24};
    struct kit_profile moulding = {0};

    kit_profile_arc(&moulding, 0.12, 0, 0.05, 0.05, 0, 180, 4);
    for (int bay = 0; bay < side->bays; bay++) {
        struct kit at = facing_court(side, column_x(side, bay + 1), 0, side->distance - WALL_HALF);

        kit_arcade(&at, 0, width, impost, top, &arch, 2 * WALL_HALF);
        kit_arch(&at, &moulding, width / 2, impost, ARCH_RADIUS, ARCH_RADIUS, 0, 180, 24);
        kit_arch(&at, &moulding, width / 2, impost, ARCH_RADIUS + 0.13, ARCH_RADIUS + 0.13, 0, 180,
                 24);
    }
}

static void build_columns(struct court *court)
{
    for (int leaves = 0; leaves < 2; leaves++) {
        begin(court, leaves ? "capital leaves" : "columns", STONE);
        for (int s = 0; s < 4; s++) {
            const struct side *side = &court->sides[s];

            for (int i = 1; i < side->bays; i++) {
                double x = column_x(side, i), z = side->distance;

                if (leaves) {
                    kit_leaves(&side->kit, x, 0, z, LOWER_IMPOST + 0.02, 0.29, 8);
                    kit_leaves(&side->kit, x, UPPER_FLOOR, z, UPPER_IMPOST - UPPER_FLOOR + 0.02,
                               0.255, 8);
                    continue;
                }
                kit_column(&side->kit, x, -0.02, z, LOWER_IMPOST + 0.04, 0.29, 24);
                kit_column(&side->kit, x, UPPER_FLOOR - 0.02, z, UPPER_IMPOST - UPPER_FLOOR + 0.04,
                           0.255, 18);
            }
        }
    }
}

static void build_arcades(struct court *court)
{
    begin(court, "arcades", ASHLAR);
    for (int s = 0; s < 4; s++) {
        storey_arcade(&court->sides[s], LOWER_IMPOST, UPPER_FLOOR - 0.1);
        storey_arcade(&court->sides[s], UPPER_IMPOST, CEILING + 0.2);
    }
    for (int x = -1; x <= 1; x += 2)
        for (int z = -1; z <= 1; z += 2) {
            double cx = COURT_X * x, cz = COURT_Z * z;

            kit_box(&court->sides[0].kit, cx - 0.42, cx + 0.42, -0.1, CEILING + 0.2, cz - 0.42,
                    cz + 0.42);
        }
}

/* Along x at z = 0 of its frame, facing +z. */
static void cornice(const struct kit *kit, double half, double y, double h)
{
    struct kit_profile profile = {0};

    kit_profile_point(&profile, -0.15, y);
    kit_profile_point(&profile, 0.05, y);
    kit_profile_arc(&profile, 0.05, y + 0.35 * h, 0.1, 0.3 * h, -90, 90, 5);
    kit_profile_point(&profile, 0.24, y + 0.75 * h);
    kit_profile_point(&profile, 0.24, y + h);
    kit_profile_point(&profile, -0.15, y + h);
    kit_moulding(kit, &profile, -half, half);
}

static void build_cornices(struct court *court)
{
    begin(court, "cornices", STONE);
    for (int s = 0; s < 4; s++) {
        const struct side *side = &court->sides[s];
        struct kit at = facing_court(side, 0, 0, side->distance - WALL_HALF);

        cornice(&at, side->half, UPPER_FLOOR - 0.32, 0.34);
        cornice(&at, side->half, CEILING - 0.05, 0.67);
        for (int i = 0; i < 2 * (int)side->half * 3; i++) { /* dentils under the eaves */
            double x = -side->half + 0.5 + (i + 0.5) / 3;

            if (x < side->half - 0.4)
                kit_box(&at, x - 0.08, x + 0.08, CEILING - 0.2, CEILING - 0.02, -0.1, 0.14);
        }
    }
    begin(court, "frieze", FRIEZE);
    for (int s = 0; s < 4; s++) {
        const struct side *side = &court->sides[s];
        struct kit at = facing_court(side, 0, 0, side->distance - WALL_HALF);

        kit_box(&at, -side->half, side->half, UPPER_FLOOR - 0.84, UPPER_FLOOR - 0.36, -0.1, 0.02);
    }
}

static void build_balustrades(struct court *court)
{
    begin(court, "balustrades", PLASTER);
    for (int s = 0; s < 4; s++) {
        const struct side *side = &court->sides[s];
        const double z = side->distance, width = 2 * side->half / side->bays;

        for (int bay = 0; bay < side->bays; bay++) {
            double x = column_x(side, bay);

            kit_box(&side->kit, x + 0.1, x + width - 0.1, UPPER_FLOOR - 0.05, UPPER_FLOOR + 0.1,
                    z - 0.14, z + 0.14);
            kit_box(&side->kit, x + 0.1, x + width - 0.1, UPPER_FLOOR + BALUSTRADE - 0.12,
                    UPPER_FLOOR + BALUSTRADE, z - 0.15, z + 0.15);
            for (int i = 1; i < 7; i++)
                kit_baluster(&side->kit, x + width * (0.06 + 0.88 * i / 7), UPPER_FLOOR + 0.08, z,
                             BALUSTRADE - 0.18, 9);
        }
    }
}

/* ---- Galleries ---- */

/* Ribs spring from corbels on the outer wall. */
static void gallery_rib(const struct side *side, double x)
{
    const struct kit_profile rib = kit_bar(-0.12, 0.3, -0.16, 0.16);
    const double middle = side->distance + WALL_HALF + CLEAR / 2;
    const double wall = side->distance + GALLERY;
    struct kit across = kit_place(&side->kit, x, 0, middle, 90);

    kit_arch(&across, &rib, 0, LOWER_IMPOST, CLEAR / 2, 1.55, 0, 180, 24);
    kit_box(&side->kit, x - 0.2, x + 0.2, -0.1, LOWER_IMPOST - 0.25, wall - 0.18, wall + 0.1);
    kit_box(&side->kit, x - 0.27, x + 0.27, LOWER_IMPOST - 0.27, LOWER_IMPOST, wall - 0.26,
            wall + 0.1);
    kit_box(&side->kit, x - 0.25, x + 0.25, -0.1, 0.4, wall - 0.24, wall + 0.1);
    kit_box(&side->kit, x - 0.2, x + 0.2, UPPER_FLOOR - 0.1, CEILING - 0.2, wall - 0.15,
            wall + 0.1);
    kit_box(&side->kit, x - 0.26, x + 0.26, CEILING - 0.4, CEILING - 0.24, wall - 0.22, wall + 0.1);
}

static void build_vaults(struct court *court)
{
    begin(court, "gallery vaults", PLASTER);
    for (int s = 0; s < 4; s++) {
        const struct side *side = &court->sides[s];
        const double middle = side->distance + WALL_HALF + CLEAR / 2;
        const double half_bay = side->half / side->bays;

        for (int bay = 0; bay < side->bays; bay++) {
            struct kit at =
                kit_place(&side->kit, column_x(side, bay) + half_bay, LOWER_IMPOST, middle, 0);

            kit_groin_vault(&at, half_bay + 0.02, CLEAR / 2 + 0.04, 1.6, 8);
        }
        struct kit corner =
            kit_place(&side->kit, side->half + WALL_HALF + CLEAR / 2, LOWER_IMPOST, middle, 0);
        if (s < 2) { /* the long sides own the four corners */
            kit_groin_vault(&corner, CLEAR / 2 + 0.4, CLEAR / 2 + 0.4, 1.6, 8);
            corner =
                kit_place(&side->kit, -side->half - WALL_HALF - CLEAR / 2, LOWER_IMPOST, middle, 0);
            kit_groin_vault(&corner, CLEAR / 2 + 0.4, CLEAR / 2 + 0.4, 1.6, 8);
        }
    }
    begin(court, "gallery ribs", STONE);
    for (int s = 0; s < 4; s++)
        for (int i = 0; i <= court->sides[s].bays; i++)
            gallery_rib(&court->sides[s], column_x(&court->sides[s], i));
}

/* Doors below, blind windows above; boards and frames stand out of the brick. */
static void build_doors(struct court *court)
{
    begin(court, "doors", WOOD);
    for (int frame = 0; frame < 2; frame++) {
        if (frame)
            begin(court, "door frames", STONE);
        for (int s = 0; s < 4; s++) {
            const struct side *side = &court->sides[s];

            for (int bay = 0; bay < side->bays; bay += 2) {
                double x = (column_x(side, bay) + column_x(side, bay + 1)) / 2;
                struct kit at = facing_court(side, x, 0, side->distance + GALLERY);

                for (int storey = 0; storey < 2; storey++) {
                    double y = storey ? UPPER_FLOOR : 0, h = y + 2.2;

                    if (!frame) {
                        kit_box(&at, -0.55, 0.55, y - 0.05, h, -0.1, 0.04);
                        for (int panel = 0; panel < 4; panel++)
                            kit_box(&at, panel % 2 ? 0.06 : -0.48, panel % 2 ? 0.48 : -0.06,
                                    y + (panel / 2 ? 1.15 : 0.15), y + (panel / 2 ? 2.05 : 1.0),
                                    0.03, 0.07);
                        continue;
                    }
                    kit_box(&at, -0.72, -0.52, y - 0.05, h + 0.01, -0.1, 0.12);
                    kit_box(&at, 0.52, 0.72, y - 0.05, h + 0.01, -0.1, 0.12);
                    kit_box(&at, -0.82, 0.82, h - 0.02, h + 0.22, -0.1, 0.16);
                }
            }
        }
    }
}

/* ---- Cloth and ornament ---- */

static void build_cloth(struct court *court)
{
    static const enum material colours[3] = {RED, GREEN, BLUE};
    static const char *const curtains[3] = {"red curtains", "green curtains", "blue curtains"};

    for (int colour = 0; colour < 3; colour++) {
        begin(court, curtains[colour], colours[colour]);
        for (int s = 0; s < 2; s++) {
            const struct side *side = &court->sides[s];
            const double width = 2 * side->half / side->bays;

            for (int bay = 0; bay < side->bays; bay++) {
                double x = column_x(side, bay + 1), phase = bay + 2.5 * s;
                struct kit low =
                    facing_court(side, x - 0.34, LOWER_IMPOST - 0.12, side->distance + 0.05);
                struct kit high = facing_court(side, x - 0.6, UPPER_FLOOR + BALUSTRADE + 0.012,
                                               side->distance - WALL_HALF - 0.3);

                if ((bay + s) % 3 == colour && bay % 4 != 3)
                    kit_curtain(&low, width - 0.68, LOWER_IMPOST - 0.45, 0.11, 5, 0.35, phase, 50,
                                32);
                if ((bay + 2 * s + 1) % 3 == colour && bay % 2 == 1)
                    kit_curtain(&high, width - 1.2, 2.1, 0.05, 3.5, 0.05, phase, 36, 20);
            }
        }
    }
    begin(court, "curtain rods", BRONZE);
    for (int s = 0; s < 2; s++) {
        const struct side *side = &court->sides[s];

        kit_box(&side->kit, -side->half, side->half, LOWER_IMPOST - 0.14, LOWER_IMPOST - 0.1,
                side->distance - 0.07, side->distance - 0.03);
        kit_box(&side->kit, -side->half, side->half, UPPER_FLOOR + BALUSTRADE - 0.02,
                UPPER_FLOOR + BALUSTRADE + 0.02, side->distance - WALL_HALF - 0.32,
                side->distance - WALL_HALF - 0.28);
    }
}

static void build_ornament(struct court *court)
{
    begin(court, "lions", STONE);
    for (int s = 0; s < 4; s++) {
        const struct side *side = &court->sides[s];

        for (int i = 1; i < side->bays; i++) { /* in the spandrels, over the columns */
            struct kit at = facing_court(side, column_x(side, i), LOWER_IMPOST + 0.92,
                                         side->distance - WALL_HALF - 0.005);

            kit_lion(&at, 0.27, 24);
        }
        if (s >= 2) { /* a large one at each end of the court */
            struct kit at = facing_court(side, 0, 2.0, side->distance + GALLERY - 0.13);
            struct kit_profile frame = {0};

            kit_lion(&at, 0.75, 56);
            kit_profile_arc(&frame, 0.8, -0.02, 0.1, 0.12, 0, 180, 6);
            kit_arch(&at, &frame, 0, 0, 0.001, 0.001, 0, 360, 64);
            kit_box(&at, -1.1, 1.1, -1.3, 1.1, -0.2, -0.01);
        }
    }
    begin(court, "vases", TERRACOTTA);
    for (int i = 0; i < 8; i++) {
        double x = (i / 2 - 1.5) * 5.5, z = i % 2 ? 2.6 : -2.6;

        kit_vase(&court->sides[0].kit, x, 0.38, z, 1.0, 28);
    }
    begin(court, "plinths", STONE);
    for (int i = 0; i < 8; i++) {
        double x = (i / 2 - 1.5) * 5.5, z = i % 2 ? 2.6 : -2.6;

        kit_box(&court->sides[0].kit, x - 0.3, x + 0.3, -0.1, 0.35, z - 0.3, z + 0.3);
        kit_box(&court->sides[0].kit, x - 0.35, x + 0.35, 0.32, 0.4, z - 0.35, z + 0.35);
    }
}

struct irb_scene *irb_build_atrium(struct irb_error *err)
{
    struct irb_builder builder;

    irb_builder_begin(&builder, "atrium");
    add_materials(&builder);
    if (!builder.failure) {
        const struct kit kit = kit_begin(&builder, 1);
        struct court court = {&builder,
                              {{kit, COURT_X, COURT_Z, LONG_BAYS},
                               {kit_place(&kit, 0, 0, 0, 180), COURT_X, COURT_Z, LONG_BAYS},
                               {kit_place(&kit, 0, 0, 0, 90), COURT_Z, COURT_X, SHORT_BAYS},
                               {kit_place(&kit, 0, 0, 0, -90), COURT_Z, COURT_X, SHORT_BAYS}}};

        build_floors(&court);
        build_shell(&court);
        build_arcades(&court);
        build_columns(&court);
        build_cornices(&court);
        build_balustrades(&court);
        build_vaults(&court);
        build_doors(&court);
        build_cloth(&court);
        build_ornament(&court);
    }
    return irb_builder_finish(&builder, err);
}
