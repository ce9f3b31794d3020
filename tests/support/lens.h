/* SPDX-License-Identifier: MIT
 *
 * Overlapping discs, for shadows of round things.
 */
#ifndef IRB_TESTS_SUPPORT_LENS_H
#define IRB_TESTS_SUPPORT_LENS_H

#include <math.h>

/* Area that two circles of radii a and b share. */
static inline double lens(double a, double b, double distance)
{
    if (distance >= a + b)
        return 0;
    if (distance <= fabs(a - b))
        return M_PI * fmin(a, b) * fmin(a, b);
    double x = (distance * distance + a * a - b * b) / (2 * distance);
    double y = sqrt(fmax(0, a * a - x * x));
    return a * a * acos(x / a) + b * b * acos((distance - x) / b) - distance * y;
}

#endif
