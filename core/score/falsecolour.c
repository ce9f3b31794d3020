/* SPDX-License-Identifier: MIT */
#include "core/score/falsecolour.h"

#include <math.h>

/* Every ninth of the scale, sRGB; between them it is close to linear. */
static const unsigned char magma[10][3] = {
    {0x00, 0x00, 0x04}, {0x18, 0x0f, 0x3e}, {0x45, 0x10, 0x77}, {0x72, 0x1f, 0x81},
    {0x9f, 0x2f, 0x7f}, {0xcd, 0x40, 0x71}, {0xf1, 0x60, 0x5d}, {0xfd, 0x95, 0x67},
    {0xfe, 0xc9, 0x8d}, {0xfc, 0xfd, 0xbf},
};

static const float not_a_number[3] = {0, 1, 0};

static void magma_colour(double t, float out[3])
{
    enum { STEPS = sizeof magma / sizeof *magma - 1 };
    int i = (int)(t * STEPS);
    if (i >= STEPS)
        i = STEPS - 1;
    double f = t * STEPS - i;
    for (int c = 0; c < 3; c++)
        out[c] = (float)(((1 - f) * magma[i][c] + f * magma[i + 1][c]) / 255);
}

/* The inverse of CIELab's f (CIE 15:2004). */
static double lab_inverse(double t)
{
    const double delta = 6.0 / 29;
    return t > delta ? t * t * t : 3 * delta * delta * (t - 4.0 / 29);
}

/* IEC 61966-2-1. */
static double srgb_encode(double v)
{
    if (!(v > 0))
        return 0;
    if (v >= 1)
        return 1;
    return v <= 0.0031308 ? 12.92 * v : 1.055 * pow(v, 1 / 2.4) - 0.055;
}

static void lab_to_srgb(const double lab[3], float out[3])
{
    double y = (lab[0] + 16) / 116;
    /* relative to the white point D65 */
    double xn = lab_inverse(y + lab[1] / 500), yn = lab_inverse(y),
           zn = lab_inverse(y - lab[2] / 200);
    /* inverse of linear sRGB to X/Xn, Y/Yn, Z/Zn (IEC 61966-2-1 primaries, D65) */
    out[0] = (float)srgb_encode(3.080341988 * xn - 1.537398969 * yn - 0.542943019 * zn);
    out[1] = (float)srgb_encode(-0.921178396 * xn + 1.875929984 * yn + 0.045248412 * zn);
    out[2] = (float)srgb_encode(0.052881293 * xn - 0.204011206 * yn + 1.151129913 * zn);
}

/* Ends of equal lightness and nearly equal chroma, inside sRGB (source: ours). */
static void signed_colour(double t, float out[3])
{
    static const double neutral[3] = {96, 0, 0}, blue[3] = {38, 18, -56}, red[3] = {38, 56, 36};
    const double *end = t < 0 ? blue : red;
    double f = fabs(t), lab[3];
    for (int c = 0; c < 3; c++)
        lab[c] = (1 - f) * neutral[c] + f * end[c];
    lab_to_srgb(lab, out);
}

static bool colour(const struct irb_image *map, double maximum, double lowest,
                   void (*scale)(double, float[3]), struct irb_image *rgb, struct irb_error *err)
{
    if (!irb_image_create(rgb, map->width, map->height, 3, err))
        return false;
    for (size_t i = 0; i < irb_image_pixels(map); i++) {
        float *out = rgb->data + 3 * i;
        double t = map->data[i * (size_t)map->channels] / maximum;
        if (isnan(t))
            for (int c = 0; c < 3; c++)
                out[c] = not_a_number[c];
        else
            scale(t < lowest ? lowest : t > 1 ? 1 : t, out);
    }
    return true;
}

bool irb_falsecolour(const struct irb_image *map, double maximum, struct irb_image *rgb,
                     struct irb_error *err)
{
    return colour(map, maximum, 0, magma_colour, rgb, err);
}

bool irb_falsecolour_signed(const struct irb_image *map, double maximum, struct irb_image *rgb,
                            struct irb_error *err)
{
    return colour(map, maximum, -1, signed_colour, rgb, err);
}
