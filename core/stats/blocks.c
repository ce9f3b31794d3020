/* SPDX-License-Identifier: MIT */
#include "core/stats/blocks.h"

enum { BLOCK_FRAMES = 32 };

static int blocks_of(int frames)
{
    int blocks = frames / BLOCK_FRAMES;
    if (frames < IRB_BLOCKS_LEAST_FRAMES)
        return 0;
    return blocks < 3 ? 3 : blocks > IRB_BLOCKS_MOST ? IRB_BLOCKS_MOST : blocks;
}

int irb_blocks(const double *frames, int count, double *means)
{
    const int blocks = blocks_of(count);
    for (int b = 0; b < blocks; b++) {
        int first = (int)((long long)count * b / blocks);
        int end = (int)((long long)count * (b + 1) / blocks);
        double sum = 0;
        for (int i = first; i < end; i++)
            sum += frames[i] - frames[first];
        means[b] = frames[first] + sum / (end - first);
    }
    return blocks;
}
