/* SPDX-License-Identifier: MIT
 *
 * Blocks of frames: what stands for independent units where a sequence was rendered with one seed
 * only, once. Neighbouring frames are alike, means of long stretches of them hardly.
 */
#ifndef IRB_STATS_BLOCKS_H
#define IRB_STATS_BLOCKS_H

enum {
    IRB_BLOCKS_LEAST_FRAMES = 64, /* shorter sequences have no blocks */
    IRB_BLOCKS_MOST = 20,
};

/* Writes the means of the default blocks of `count` finite frames, in their order, to `means`
 * (IRB_BLOCKS_MOST of them at most) and returns how many; 0 where the series is too short, or too
 * slow for its length. */
int irb_blocks(const double *frames, int count, double *means);

#endif
