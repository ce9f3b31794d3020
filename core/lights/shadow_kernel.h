/* SPDX-License-Identifier: MIT
 *
 * The static kernel of a soft shadow's taps: Poisson-disk points on the unit disc (thesis 5.3.3).
 */
#ifndef IRB_LIGHTS_SHADOW_KERNEL_H
#define IRB_LIGHTS_SHADOW_KERNEL_H

enum { IRB_SHADOW_TAPS_MOST = 64 };

/* `count` points, 1..IRB_SHADOW_TAPS_MOST. Best candidates (core/sampling/poisson.h) crowd the rim,
 * and a filter of such taps takes penumbrae for wider than they are; so sets are scaled to the mean
 * square radius of the disc, 1/2, and of several the one with the least departure below is taken.
 * One point is the centre. Always the same points. Source of scaling and choice: ours. */
void irb_shadow_kernel(int count, float (*points)[2]);

/* Largest difference between the share of points on one side of a straight line, which is what a
 * blocker's edge looks like, and the share of the disc's area there: over 64 directions of the line
 * and all its places, in [0,1]. */
double irb_shadow_kernel_departure(int count, float (*points)[2]);

#endif
