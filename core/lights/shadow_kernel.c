/* SPDX-License-Identifier: MIT */
#include "core/lights/shadow_kernel.h"

#include "core/sampling/poisson.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SETS = 64, DIRECTIONS = 64 };

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Share of the unit disc's area below t along any axis. */
static double area_below(double t)
{
    t = fmin(fmax(t, -1), 1);
    return 0.5 + (t * sqrt(1 - t * t) + asin(t)) / M_PI;
}

double irb_shadow_kernel_departure(int count, float (*points)[2])
{
    double worst = 0, along[IRB_SHADOW_TAPS_MOST];
    for (int k = 0; k < DIRECTIONS; k++) {
        double angle = 2 * M_PI * k / DIRECTIONS;
        for (int i = 0; i < count; i++)
            along[i] = points[i][0] * cos(angle) + points[i][1] * sin(angle);
        qsort(along, (size_t)count, sizeof *along, compare);
        for (int i = 0; i < count; i++) {
            double area = area_below(along[i]);
            worst = fmax(worst, fmax(area - (double)i / count, (i + 1.0) / count - area));
        }
    }
    return worst;
}

/* Mean square of the radii to 1/2, the disc's, as far as all points stay inside. */
static void scale(int count, float (*points)[2])
{
    double sum = 0, most = 0;
    for (int i = 0; i < count; i++) {
        double r2 = (double)points[i][0] * points[i][0] + (double)points[i][1] * points[i][1];
        sum += r2;
        most = fmax(most, r2);
    }
    double factor = sum > 0 ? fmin(sqrt(0.5 * count / sum), 1 / sqrt(most)) : 1;
    for (int i = 0; i < count; i++)
        for (int c = 0; c < 2; c++)
            points[i][c] = (float)(factor * points[i][c]);
}

void irb_shadow_kernel(int count, float (*points)[2])
{
    float set[IRB_SHADOW_TAPS_MOST][2];
    double least = INFINITY;
    for (uint32_t seed = 0; seed < SETS && count > 1; seed++) {
        irb_poisson_set(seed, count, set);
        scale(count, set);
        double departure = irb_shadow_kernel_departure(count, set);
        if (departure < least) {
            memcpy(points, set, (size_t)count * sizeof *set);
            least = departure;
        }
    }
    if (count <= 1)
        points[0][0] = points[0][1] = 0;
}
