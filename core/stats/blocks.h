/* SPDX-License-Identifier: MIT
 *
 * Blocks of frames: what stands for independent units where a sequence was rendered with one seed
 * only, once. Neighbouring frames are alike, the means of long stretches of them hardly: batch
 * means (Davison and Hinkley 1997, section 8.2.3; Schmeiser 1982, Operations Research 30: more than
 * 20 to 30 hardly narrow an interval). Seeds are better wherever there are any: they need no long
 * sequence.
 *
 * Rule. The frames' correlation r from one to the next is taken from the series. Were it of first
 * order, the mean of L frames would have the variance v/L (1 - b/L) with b = 2 r/(1 - r^2) frames:
 * blocks make the interval too narrow by about b/L. A block has 32 frames or 7 b, what is more
 * (the same at r = 0.8, where b/L is 0.14). A sequence of 48 frames or more has three blocks in any
 * case, of 16 frames at least, as the interval from three units has room for what these leave out.
 * Shorter ones have none. These numbers are ours, chosen by the table. No series is refused for its
 * r: of equally slow ones that would leave those that happen to vary least (at 48 frames and r =
 * 0.9, 85 % instead of 92 %).
 *
 * Coverage of the 95 % intervals of irb_mean_interval over AR(1) frames, %, 8000 trials
 * (1000 frames: 4000):
 *
 *     frames   r = 0        0.5          0.8          0.9          0.95
 *       48     95.7         96.0         94.5         92.1         86.3
 *       64     96.1         96.2         95.2         92.9         88.7
 *       96     96.1         95.7         95.7         94.4         91.1
 *      128     95.3         95.4         94.8         94.4         92.8
 *      256     95.3         94.8         93.7         94.4         94.3
 *     1000     95.0         94.2         94.0         93.6         94.2
 *
 * Frames slower than 0.8 need a longer sequence, as a short one does not show how slow they are.
 * Each frame as a unit of its own covers 74 % at r = 0.5 and 48 % at 0.8 (test_blocks).
 *
 * An interval from blocks is about the mean over more frames like these. What an animation itself
 * does to the error counts as spread, so it is wide where seeds would tell that nothing is random.
 */
#ifndef IRB_STATS_BLOCKS_H
#define IRB_STATS_BLOCKS_H

enum {
    IRB_BLOCKS_LEAST_FRAMES = 48, /* shorter sequences have no blocks */
    IRB_BLOCKS_MOST = 20,
};

/* Writes the means of the default blocks of `count` finite frames, in their order, to `means`
 * (IRB_BLOCKS_MOST of them at most) and returns how many, 3 or more; 0 where the series is too
 * short. Blocks differ by a frame where their number doesn't divide the count: their mean is then
 * not quite that of the frames. */
int irb_blocks(const double *frames, int count, double *means);

/* The same for irb_ratio_interval: the blocks of two series are the same frames, and as long as the
 * correlation of their ratio asks for. What an animation does to both alike falls out. */
int irb_blocks_pair(const double *a, const double *b, int count, double *means_a, double *means_b);

#endif
