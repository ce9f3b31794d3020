/* SPDX-License-Identifier: MIT */
#include "core/stats/blocks.h"

#include "core/stats/interval.h"
#include "core/stats/mean.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

enum { LEAST_BLOCK = 32 }; /* frames; see the header */

/* In units of the frames that a block's variance seems short by; see the header. */
static const double BLOCK_LENGTH = 7;

/* Of each frame with the one before, less the bias that the unknown mean makes (Marriott and Pope
 * 1954). */
static double correlation_of(const double *frames, int count)
{
    double mean = irb_mean(frames, count), squares = 0, products = 0, last = 0;
    for (int i = 0; i < count; i++) {
        double now = frames[i] - mean;
        squares += now * now;
        products += now * last;
        last = now;
    }
    double r = squares > 0 ? products / squares : 0;
    return fmin(fmax(0, r + (1 + 4 * r) / count), 0.999);
}

static int blocks_of(const double *frames, int count)
{
    if (count < IRB_BLOCKS_LEAST_FRAMES)
        return 0;
    double r = correlation_of(frames, count);
    double length = 2 * r / (1 - r * r);
    int blocks = (int)(count / fmax(LEAST_BLOCK, BLOCK_LENGTH * length));
    if (blocks < IRB_INTERVAL_LEAST_UNITS)
        return IRB_INTERVAL_LEAST_UNITS;
    return blocks < IRB_BLOCKS_MOST ? blocks : IRB_BLOCKS_MOST;
}

static void block_means(const double *frames, int count, int blocks, double *means)
{
    for (int b = 0; b < blocks; b++) {
        int first = (int)((long long)count * b / blocks);
        int end = (int)((long long)count * (b + 1) / blocks);
        means[b] = irb_mean(frames + first, end - first);
    }
}

int irb_blocks(const double *frames, int count, double *means)
{
    const int blocks = blocks_of(frames, count);
    block_means(frames, count, blocks, means);
    return blocks;
}

/* What each frame does to the logarithm of mean(a)/mean(b); false where there is none. */
static bool influence_of(const double *a, const double *b, int count, double *influence)
{
    double mean_a = irb_mean(a, count), mean_b = irb_mean(b, count);
    if (!(mean_a > 0 && mean_b > 0))
        return false;
    for (int i = 0; i < count; i++)
        influence[i] = a[i] / mean_a - b[i] / mean_b;
    return true;
}

int irb_blocks_pair(const double *a, const double *b, int count, double *means_a, double *means_b)
{
    if (count < IRB_BLOCKS_LEAST_FRAMES)
        return 0;
    double *influence = malloc((size_t)count * sizeof *influence);
    if (!influence)
        return 0;
    int blocks = blocks_of(influence_of(a, b, count, influence) ? influence : a, count);
    free(influence);
    block_means(a, count, blocks, means_a);
    block_means(b, count, blocks, means_b);
    return blocks;
}
