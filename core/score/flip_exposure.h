/* SPDX-License-Identifier: MIT
 *
 * The ACES tone map as HDR-FLIP uses it. Private to core/score.
 */
#ifndef IRB_SCORE_FLIP_EXPOSURE_H
#define IRB_SCORE_FLIP_EXPOSURE_H

/* (a0 x^2 + a1 x)/(b0 x^2 + b1 x + b2): Narkowicz's fit of ACES (2015), with the exposure of 0.6
 * that the fit contains taken out (2021 paper, section 4). */
#define IRB_ACES_A0 (0.6 * 0.6 * 2.51)
#define IRB_ACES_A1 (0.6 * 0.03)
#define IRB_ACES_B0 (0.6 * 0.6 * 2.43)
#define IRB_ACES_B1 (0.6 * 0.59)
#define IRB_ACES_B2 0.14

/* x >= 0 and below 1e18, so that its square is finite. */
static inline float irb_aces(float x)
{
    float v = x * ((float)IRB_ACES_A0 * x + (float)IRB_ACES_A1) /
              (x * ((float)IRB_ACES_B0 * x + (float)IRB_ACES_B1) + (float)IRB_ACES_B2);
    return v > 1 ? 1 : v;
}

#endif
