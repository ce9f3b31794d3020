/* SPDX-License-Identifier: MIT */
#include "core/scene/builtin/texture.h"

#include <math.h>
#include <stdlib.h>

/* ---- Noise ---- */

/* [0,1), from two lattice coordinates and a seed: three rounds of a 32-bit integer mix. */
static double lattice(int x, int y, unsigned seed)
{
    uint32_t h = (uint32_t)x * 0x9e3779b1u ^ (uint32_t)y * 0x85ebca6bu ^ seed * 0xc2b2ae35u;

    for (int round = 0; round < 3; round++) {
        h ^= h >> 15;
        h *= 0x2c1b3c6du;
        h ^= h >> 12;
    }
    return h * 0x1p-32;
}

static double smooth(double t)
{
    return t * t * (3 - 2 * t);
}

static double mix(double a, double b, double t)
{
    return a + (b - a) * t;
}

/* Value noise over [0,1)^2 that repeats, `cells` lattice cells a side. */
static double noise(double u, double v, int cells, unsigned seed)
{
    double x = u * cells, y = v * cells;
    int i = (int)floor(x), j = (int)floor(y);
    double s = smooth(x - i), t = smooth(y - j);
    int i0 = (i % cells + cells) % cells, j0 = (j % cells + cells) % cells;
    int i1 = (i0 + 1) % cells, j1 = (j0 + 1) % cells;

    return mix(mix(lattice(i0, j0, seed), lattice(i1, j0, seed), s),
               mix(lattice(i0, j1, seed), lattice(i1, j1, seed), s), t);
}

/* Five octaves, mean 1/2. */
static double turbulence(double u, double v, int cells, unsigned seed)
{
    double sum = 0, weight = 0.5;

    for (int octave = 0; octave < 5; octave++) {
        sum += weight * noise(u, v, cells << octave, seed + (unsigned)octave);
        weight /= 2;
    }
    return sum / (1 - weight * 2);
}

/* ---- Patterns: u, v in [0,1), sRGB-encoded colour in [0,1] ---- */

struct course {
    int row, column;
    double edge; /* distance to the nearest joint, in rows */
};

/* Rows of blocks, every other one shifted by half a block. */
static struct course find_course(double u, double v, int rows, int columns)
{
    struct course course = {.row = (int)floor(v * rows)};
    double x = u * columns + (course.row % 2 ? 0.5 : 0), y = v * rows - course.row;
    double aspect = (double)rows / columns;

    course.column = (int)floor(x) % columns;
    x -= floor(x);
    course.edge = fmin(fmin(x, 1 - x) * aspect, fmin(y, 1 - y));
    return course;
}

static void brick(double u, double v, double out[3])
{
    struct course at = find_course(u, v, 8, 4);
    double tone = lattice(at.column, at.row, 11), grain = turbulence(u, v, 16, 3);
    double mortar = 1 - smooth(fmin(1, fmax(0, (at.edge - 0.05 - 0.04 * grain) / 0.05)));
    const double red[3] = {0.66, 0.40, 0.29}, joint[3] = {0.74, 0.70, 0.63};
    const double shift[3] = {0.16, 0.12, 0.10};

    for (int c = 0; c < 3; c++)
        out[c] = mix(red[c] + shift[c] * (tone - 0.5) + 0.22 * (grain - 0.5), joint[c], mortar);
}

static void ashlar(double u, double v, double out[3])
{
    struct course at = find_course(u, v, 4, 2);
    double tone = lattice(at.column, at.row, 23), grain = turbulence(u, v, 24, 5);
    double wear = turbulence(u, v, 4, 9);
    double joint = 1 - smooth(fmin(1, fmax(0, (at.edge - 0.015) / 0.02)));
    const double stone[3] = {0.80, 0.74, 0.63};

    for (int c = 0; c < 3; c++)
        out[c] = (stone[c] + 0.1 * (tone - 0.5) + 0.16 * (grain - 0.5) + 0.14 * (wear - 0.5)) *
                 (1 - 0.35 * joint);
}

static void marble(double u, double v, double out[3])
{
    int i = (int)floor(2 * u), j = (int)floor(2 * v);
    double x = 2 * u - i, y = 2 * v - j;
    double warp = turbulence(u, v, 4, (unsigned)(31 + i + 2 * j));
    double vein = pow(1 - fabs(sin(M_PI * (3 * x + 2 * y + 5 * warp))), 6);
    double edge = fmin(fmin(x, 1 - x), fmin(y, 1 - y));
    double joint = 1 - smooth(fmin(1, fmax(0, (edge - 0.008) / 0.008)));
    const double light[3] = {0.86, 0.83, 0.77}, dark[3] = {0.48, 0.32, 0.27};
    bool is_dark = (i + j) % 2 == 1;

    for (int c = 0; c < 3; c++) {
        double base = (is_dark ? dark[c] : light[c]) + 0.12 * (warp - 0.5);

        out[c] = mix(base + (is_dark ? 0.28 : -0.24) * vein, 0.35, joint);
    }
}

/* A flower in the middle and one at the corners, between the lines of a lozenge grid. */
static void damask(double u, double v, double out[3])
{
    double weave = 0.04 * sin(2 * M_PI * 64 * u) * sin(2 * M_PI * 64 * v), value = 0;
    double line = fmin(fabs(fmod(u + v, 1) - 0.5), fabs(fmod(u - v + 1, 1) - 0.5));

    for (int flower = 0; flower < 2; flower++) {
        double x = flower ? u - 0.5 : u - round(u), y = flower ? v - 0.5 : v - round(v);
        double r = hypot(x, y), angle = atan2(y, x);
        double petals = 0.17 + 0.05 * cos(8 * angle), heart = 0.06;

        value = fmax(value, smooth(fmin(1, fmax(0, (petals - r) / 0.012))));
        value -= 0.7 * smooth(fmin(1, fmax(0, (0.02 - fabs(r - heart)) / 0.01)));
    }
    value = fmax(value, 1 - smooth(fmin(1, fmax(0, (line - 0.018) / 0.012))));
    for (int c = 0; c < 3; c++)
        out[c] = 0.72 + 0.24 * value + weave;
}

/* ---- Texture ---- */

typedef void (*pattern_fn)(double u, double v, double out[3]);

static const struct {
    const char *name;
    pattern_fn fn;
} patterns[] = {
    [IRB_PATTERN_BRICK] = {"brick", brick},
    [IRB_PATTERN_ASHLAR] = {"ashlar", ashlar},
    [IRB_PATTERN_MARBLE] = {"marble", marble},
    [IRB_PATTERN_DAMASK] = {"damask", damask},
};

int irb_builder_pattern(struct irb_builder *builder, enum irb_pattern pattern, int size)
{
    unsigned char *rgba = malloc(4 * (size_t)size * (size_t)size);

    if (!rgba) {
        builder->failure = IRB_E_MEMORY;
        return -1;
    }
    for (int y = 0; y < size; y++)
        for (int x = 0; x < size; x++) {
            unsigned char *texel = rgba + 4 * ((size_t)y * (size_t)size + (size_t)x);
            double colour[3];

            patterns[pattern].fn((x + 0.5) / size, (y + 0.5) / size, colour);
            for (int c = 0; c < 3; c++)
                texel[c] = (unsigned char)lrint(255 * fmin(1, fmax(0, colour[c])));
            texel[3] = 255;
        }
    return irb_builder_texture(builder, patterns[pattern].name, size, size, rgba);
}
