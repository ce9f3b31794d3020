/* SPDX-License-Identifier: MIT */
#include "tests/score/flip_brute.h"

#include <math.h>
#include <stdlib.h>

enum { MAX_SIDE = 64 };

static const double pi = 3.14159265358979323846;
static const double white[3] = {0.950428545, 1.0, 1.088900371};

struct kernel {
    int radius;
    double w[MAX_SIDE][MAX_SIDE];
};

/* XYZ of linear sRGB, from the primaries' chromaticities and the white point. */
static void rgb_to_xyz(const double rgb[3], double xyz[3])
{
    static const double m[3][3] = {{0.412386563, 0.357591135, 0.180450847},
                                   {0.212636822, 0.715182982, 0.072180196},
                                   {0.019330621, 0.119197164, 0.950372587}};
    for (int i = 0; i < 3; i++)
        xyz[i] = m[i][0] * rgb[0] + m[i][1] * rgb[1] + m[i][2] * rgb[2];
}

/* Cramer's rule on the matrix above: no second set of numbers. */
static void xyz_to_rgb(const double xyz[3], double rgb[3])
{
    double column[3][3];
    for (int c = 0; c < 3; c++) {
        double unit[3] = {c == 0, c == 1, c == 2};
        rgb_to_xyz(unit, column[c]);
    }
    double det[4];
    for (int k = 0; k < 4; k++) {
        const double *a = k == 1 ? xyz : column[0], *b = k == 2 ? xyz : column[1];
        const double *c = k == 3 ? xyz : column[2];
        det[k] = a[0] * (b[1] * c[2] - b[2] * c[1]) - b[0] * (a[1] * c[2] - a[2] * c[1]) +
                 c[0] * (a[1] * b[2] - a[2] * b[1]);
    }
    for (int i = 0; i < 3; i++)
        rgb[i] = det[i + 1] / det[0];
}

static void rgb_to_ycxcz(const float *in, double out[3])
{
    double rgb[3] = {in[0], in[1], in[2]}, xyz[3];
    rgb_to_xyz(rgb, xyz);
    double x = xyz[0] / white[0], y = xyz[1] / white[1], z = xyz[2] / white[2];
    out[0] = 116 * y - 16;
    out[1] = 500 * (x - y);
    out[2] = 200 * (y - z);
}

static double lab_f(double t)
{
    double d = 6.0 / 29;
    return t > d * d * d ? cbrt(t) : t / (3 * d * d) + 4.0 / 29;
}

static void rgb_to_hunt(const double rgb[3], double lab[3])
{
    double xyz[3];
    rgb_to_xyz(rgb, xyz);
    double fx = lab_f(xyz[0] / white[0]), fy = lab_f(xyz[1] / white[1]);
    double fz = lab_f(xyz[2] / white[2]);
    lab[0] = 116 * fy - 16;
    lab[1] = 0.01 * lab[0] * 500 * (fx - fy);
    lab[2] = 0.01 * lab[0] * 200 * (fy - fz);
}

static void ycxcz_to_hunt(const double c[3], double lab[3])
{
    double y = (c[0] + 16) / 116, rgb[3];
    double xyz[3] = {white[0] * (y + c[1] / 500), white[1] * y, white[2] * (y - c[2] / 200)};
    xyz_to_rgb(xyz, rgb);
    for (int i = 0; i < 3; i++)
        rgb[i] = fmin(1, fmax(0, rgb[i]));
    rgb_to_hunt(rgb, lab);
}

static double hyab_power(const double a[3], const double b[3])
{
    return pow(fabs(a[0] - b[0]) + hypot(a[1] - b[1], a[2] - b[2]), 0.7);
}

static void csf(struct kernel *k, double a1, double b1, double a2, double b2, double ppd)
{
    double sum = 0;
    k->radius = (int)ceil(3 * sqrt(0.04 / (2 * pi * pi)) * ppd);
    for (int y = -k->radius; y <= k->radius; y++)
        for (int x = -k->radius; x <= k->radius; x++) {
            double d2 = (x * x + y * y) / (ppd * ppd);
            double w = a1 * sqrt(pi / b1) * exp(-pi * pi * d2 / b1) +
                       a2 * sqrt(pi / b2) * exp(-pi * pi * d2 / b2);
            k->w[y + k->radius][x + k->radius] = w;
            sum += w;
        }
    for (int y = 0; y <= 2 * k->radius; y++)
        for (int x = 0; x <= 2 * k->radius; x++)
            k->w[y][x] /= sum;
}

/* order 1: edges, 2: points; along x, or along y. */
static void detector(struct kernel *k, int order, bool vertical, double ppd)
{
    double sigma = 0.5 * 0.082 * ppd, positive = 0, negative = 0;
    k->radius = (int)ceil(3 * sigma);
    for (int y = -k->radius; y <= k->radius; y++)
        for (int x = -k->radius; x <= k->radius; x++) {
            double g = exp(-(x * x + y * y) / (2 * sigma * sigma)), t = vertical ? y : x;
            double w = order == 1 ? -t * g : (t * t / (sigma * sigma) - 1) * g;
            k->w[y + k->radius][x + k->radius] = w;
            *(w > 0 ? &positive : &negative) += fabs(w);
        }
    for (int y = 0; y <= 2 * k->radius; y++)
        for (int x = 0; x <= 2 * k->radius; x++)
            k->w[y][x] /= k->w[y][x] > 0 ? positive : negative;
}

static int clamp(int v, int size)
{
    return v < 0 ? 0 : v >= size ? size - 1 : v;
}

/* Channel c of the 3-channel plane under the kernel centred at (x, y), edges clamped. */
static double at(const double *plane, int width, int height, int c, const struct kernel *k, int x,
                 int y)
{
    double sum = 0;
    for (int j = -k->radius; j <= k->radius; j++)
        for (int i = -k->radius; i <= k->radius; i++) {
            int index = clamp(y + j, height) * width + clamp(x + i, width);
            sum += k->w[j + k->radius][i + k->radius] * plane[3 * index + c];
        }
    return sum;
}

struct kernels {
    struct kernel csf[3], edge[2], point[2];
};

static void pixel_features(const double *plane, int w, int h, const struct kernels *k, int x, int y,
                           double lab[3], double *edge, double *point)
{
    double colour[3];
    for (int c = 0; c < 3; c++)
        colour[c] = at(plane, w, h, c, &k->csf[c], x, y);
    ycxcz_to_hunt(colour, lab);
    /* detectors see (Y + 16)/116; their weights sum to 0 */
    *edge =
        hypot(at(plane, w, h, 0, &k->edge[0], x, y), at(plane, w, h, 0, &k->edge[1], x, y)) / 116;
    *point =
        hypot(at(plane, w, h, 0, &k->point[0], x, y), at(plane, w, h, 0, &k->point[1], x, y)) / 116;
}

void flip_brute(const struct irb_image *test, const struct irb_image *reference, double ppd,
                double *out)
{
    struct kernels *k = malloc(sizeof *k);
    csf(&k->csf[0], 1, 0.0047, 0, 1e-5, ppd);
    csf(&k->csf[1], 1, 0.0053, 0, 1e-5, ppd);
    csf(&k->csf[2], 34.1, 0.04, 13.5, 0.025, ppd);
    for (int i = 0; i < 2; i++) {
        detector(&k->edge[i], 1, i, ppd);
        detector(&k->point[i], 2, i, ppd);
    }
    int w = test->width, h = test->height;
    const struct irb_image *image[2] = {test, reference};
    double *plane[2];
    for (int i = 0; i < 2; i++) {
        plane[i] = malloc(3 * irb_image_pixels(test) * sizeof **plane);
        for (size_t p = 0; p < irb_image_pixels(test); p++)
            rgb_to_ycxcz(image[i]->data + 3 * p, plane[i] + 3 * p);
    }
    double green[3], blue[3];
    rgb_to_hunt((double[3]){0, 1, 0}, green);
    rgb_to_hunt((double[3]){0, 0, 1}, blue);
    double cmax = hyab_power(green, blue), knee = 0.4 * cmax;
    for (int y = 0; y < h; y++)
        for (int x = 0; x < w; x++) {
            double lab[2][3], edge[2], point[2];
            for (int i = 0; i < 2; i++)
                pixel_features(plane[i], w, h, k, x, y, lab[i], &edge[i], &point[i]);
            double c = hyab_power(lab[0], lab[1]);
            c = c < knee ? c * 0.95 / knee : 0.95 + (c - knee) / (cmax - knee) * 0.05;
            double f = fmax(fabs(edge[0] - edge[1]), fabs(point[0] - point[1]));
            out[y * w + x] = pow(c, 1 - sqrt(f / sqrt(2)));
        }
    for (int i = 0; i < 2; i++)
        free(plane[i]);
    free(k);
}
