/* SPDX-License-Identifier: MIT
 *
 * Poisson-disk points on the unit disc (Cook 1986; thesis 5.3.3): no two of them are nearer than a
 * least distance, which is about as large as so many points allow. By Mitchell's best candidate
 * (1991): each point is the one of some random candidates that lies farthest from those before it,
 * so that every prefix of a set is spread out too; of some sets the one with the largest least
 * distance is taken.
 *
 * Does not: depend on the machine; the same seed gives the same points.
 */
#ifndef IRB_SAMPLING_POISSON_H
#define IRB_SAMPLING_POISSON_H

#include "core/sampling/sobol.h"

enum {
    IRB_POISSON_CANDIDATES = 16, /* of a point for each point before it */
    IRB_POISSON_SETS = 32,       /* of which the best is taken */
};

/* Candidate `number` of the seed, uniform over the unit disc: rejection from the square. */
static inline void irb_poisson_candidate(uint32_t seed, uint32_t number, float point[2])
{
    uint32_t attempt = 0;
    do {
        uint32_t bits = irb_hash_u32(seed, number) + attempt++;
        point[0] = 2 * irb_unit_float(irb_hash_u32(bits, 0)) - 1;
        point[1] = 2 * irb_unit_float(irb_hash_u32(bits, 1)) - 1;
    } while (point[0] * point[0] + point[1] * point[1] > 1);
}

/* Squared distance to the nearest of `count` points; 4, the disc's diameter squared, of none. */
static inline float irb_poisson_nearest(const float (*points)[2], int count, const float at[2])
{
    float nearest = 4;
    for (int i = 0; i < count; i++) {
        float x = points[i][0] - at[0], y = points[i][1] - at[1];
        nearest = x * x + y * y < nearest ? x * x + y * y : nearest;
    }
    return nearest;
}

/* One set of the seed; the squared least distance in it. */
static inline float irb_poisson_set(uint32_t seed, int count, float (*points)[2])
{
    uint32_t number = 0;
    float least = 4;
    for (int i = 0; i < count; i++) {
        float best = -1;
        for (int k = 0; k < IRB_POISSON_CANDIDATES * (i ? i : 1); k++) {
            float candidate[2];
            irb_poisson_candidate(seed, number++, candidate);
            float distance = irb_poisson_nearest((const float(*)[2])points, i, candidate);
            if (distance > best) {
                best = distance;
                points[i][0] = candidate[0];
                points[i][1] = candidate[1];
            }
        }
        least = best < least ? best : least;
    }
    return least;
}

/* `count` points of the unit disc. Cost grows with the cube of the count: meant for tens (16 take
 * about 5 ms). */
static inline void irb_poisson_disc(uint32_t seed, int count, float (*points)[2])
{
    uint32_t best = 0;
    float best_distance = -1;
    for (uint32_t set = 0; set < IRB_POISSON_SETS; set++) {
        float distance = irb_poisson_set(irb_hash_u32(seed, set), count, points);
        if (distance > best_distance) {
            best_distance = distance;
            best = set;
        }
    }
    irb_poisson_set(irb_hash_u32(seed, best), count, points);
}

#endif
