/* SPDX-License-Identifier: MIT */
#include "core/scene/builtin/kit.h"

#include "core/scene/vec.h"

/* Proportions of a column in radii of its shaft's foot, after Vignola's Corinthian order where it
 * gives them; the leaves are simplified. */
#define PLINTH_HALF 1.4
#define PLINTH_HEIGHT 0.5
#define BASE_HEIGHT 0.55
#define NECK 0.85 /* radius of the shaft's top */
#define CAPITAL_HEIGHT 2.0
#define ABACUS_HALF 1.4
#define ABACUS_HEIGHT 0.3

/* Two tori with a scotia between, from radius 1.3 down to the shaft. */
static void attic_base(struct kit_profile *profile, double y, double r)
{
    kit_profile_point(profile, 1.1 * r, y);
    kit_profile_arc(profile, 1.2 * r, y + 0.12 * r, 0.16 * r, 0.12 * r, -90, 90, 6);
    kit_profile_arc(profile, 1.22 * r, y + 0.33 * r, 0.14 * r, 0.09 * r, 270, 90, 5);
    kit_profile_arc(profile, 1.1 * r, y + 0.5 * r, 0.1 * r, 0.08 * r, -90, 90, 5);
    kit_profile_point(profile, r, y + BASE_HEIGHT * r + 0.05 * r);
}

/* The bell under the abacus. */
static void capital(struct kit_profile *profile, double y, double r)
{
    const double neck = NECK * r, height = (CAPITAL_HEIGHT - ABACUS_HEIGHT) * r;

    kit_profile_arc(profile, neck, y, 0.1 * r, 0.08 * r, -90, 90, 4); /* astragal */
    for (int i = 0; i <= 6; i++) {
        double t = i / 6.0;

        kit_profile_point(profile, neck + 0.48 * r * t * t * t, y + 0.08 * r + t * height);
    }
    kit_profile_point(profile, 0.2 * r, y + 0.08 * r + height);
}

void kit_column(const struct kit *kit, double x, double y, double z, double height, double radius,
                int slices)
{
    const double r = radius, plinth = PLINTH_HALF * r, abacus = ABACUS_HALF * r;
    const double foot = y + PLINTH_HEIGHT * r, top = y + height;
    const double shaft = foot + (BASE_HEIGHT + 0.05) * r, neck = top - CAPITAL_HEIGHT * r;
    struct kit_profile profile = {0};

    kit_box(kit, x - plinth, x + plinth, y, foot, z - plinth, z + plinth);
    kit_box(kit, x - abacus, x + abacus, top - ABACUS_HEIGHT * r, top, z - abacus, z + abacus);
    attic_base(&profile, foot, r);
    for (int i = 1; i < 5; i++) { /* entasis: the taper grows with the square of the height */
        double t = i / 5.0;

        kit_profile_point(&profile, r * (1 - (1 - NECK) * t * t), shaft + (neck - shaft) * t);
    }
    capital(&profile, neck, r);
    kit_lathe(kit, &profile, x, z, 0, 360, slices);
}

struct leaf {
    double inner, outer, height, width;
};

/* Rises along the bell, then curls over; u across, v up. */
static void leaf_point(const void *shape, double u, double v, double out[3])
{
    const struct leaf *leaf = shape;
    double s = 2 * u - 1, width = leaf->width * sqrt(fmax(0, 1 - pow(v, 4))) * (1 - 0.25 * v);
    double curl = v < 0.6 ? 0 : (v - 0.6) / 0.4;
    double out_by = leaf->inner + (leaf->outer - leaf->inner) * pow(v, 3);

    out[0] = width * s;
    out[1] = leaf->height * (v - 0.3 * curl * curl);
    out[2] = out_by * (1 + 0.02 * cos(3 * M_PI * s)) - 0.12 * leaf->width * s * s;
}

void kit_leaves(const struct kit *kit, double x, double y, double z, double height, double radius,
                int count)
{
    const double r = radius, foot = y + height - (CAPITAL_HEIGHT - 0.08) * r;

    for (int row = 0; row < 2; row++) {
        const struct leaf leaf = {(NECK + 0.06 + 0.02 * row) * r, (1.12 + 0.22 * row) * r,
                                  (0.85 + 0.7 * row) * r, M_PI * r / count};

        for (int i = 0; i < count; i++) {
            struct kit at = kit_place(kit, x, foot, z, 360 * (i + 0.5 * row) / count);

            kit_sheet(&at, leaf_point, &leaf, 3, 5, 2 * leaf.width, leaf.height);
        }
    }
}

void kit_baluster(const struct kit *kit, double x, double y, double z, double height, int slices)
{
    const double h = height, half = 0.11 * h;
    struct kit_profile profile = {0};

    kit_box(kit, x - half, x + half, y, y + 0.09 * h, z - half, z + half);
    kit_box(kit, x - half, x + half, y + 0.91 * h, y + h, z - half, z + half);
    kit_profile_point(&profile, 0.09 * h, y + 0.08 * h);
    kit_profile_point(&profile, 0.05 * h, y + 0.15 * h);
    for (int i = 0; i <= 7; i++) { /* the belly, low, and the neck above it */
        double t = i / 7.0;

        kit_profile_point(&profile, h * (0.05 + 0.075 * sin(M_PI * pow(t, 0.7)) * (1 - 0.35 * t)),
                          y + h * (0.17 + 0.6 * t));
    }
    kit_profile_arc(&profile, 0.06 * h, y + 0.8 * h, 0.03 * h, 0.025 * h, -90, 90, 3);
    kit_profile_point(&profile, 0.09 * h, y + 0.92 * h);
    kit_lathe(kit, &profile, x, z, 0, 360, slices);
}

void kit_vase(const struct kit *kit, double x, double y, double z, double height, int slices)
{
    static const double outline[][2] = {
        /* radius, height: up the outside, down the inside */
        {0.00, 0.00}, {0.26, 0.00}, {0.26, 0.04}, {0.22, 0.07}, {0.12, 0.12}, {0.10, 0.17},
        {0.13, 0.21}, {0.24, 0.28}, {0.35, 0.38}, {0.41, 0.50}, {0.41, 0.60}, {0.36, 0.70},
        {0.27, 0.78}, {0.22, 0.84}, {0.22, 0.89}, {0.27, 0.94}, {0.34, 0.97}, {0.34, 1.00},
        {0.30, 1.00}, {0.23, 0.94}, {0.18, 0.88}, {0.18, 0.83}, {0.24, 0.75}, {0.33, 0.66},
        {0.36, 0.55}, {0.33, 0.42}, {0.20, 0.30}, {0.00, 0.26}};
    struct kit_profile profile = {0};

    for (size_t i = 0; i < sizeof outline / sizeof *outline; i++)
        kit_profile_point(&profile, height * outline[i][0], y + height * outline[i][1]);
    kit_lathe(kit, &profile, x, z, 0, 360, slices);
}

void kit_steps(const struct kit *kit, int steps, double rise, double going, double z0, double z1,
               double x_end)
{
    for (int i = 0; i < steps; i++) /* each block reaches into the floor below it */
        kit_box(kit, i * going, x_end + 0.01 * i, (i - 0.5) * rise, (i + 1) * rise, z0 - 0.01 * i,
                z1 + 0.01 * i);
}

void kit_bench(const struct kit *kit, double length, double seat, double back)
{
    const double board = 0.05;

    kit_box(kit, 0, length, seat - board, seat, 0, 0.42);
    kit_box(kit, 0, length, seat + 0.12, back, -0.06, -0.06 + board);
    for (int end = 0; end < 2; end++) {
        double x = end ? length - 0.06 : 0.01;

        kit_box(kit, x, x + board, 0, seat - 0.01, -0.05, 0.4);
        kit_box(kit, x, x + board, seat - 0.02, back - 0.02, -0.04, -0.02);
    }
}
