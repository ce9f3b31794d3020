/* SPDX-License-Identifier: MIT
 *
 * Hierarchical sample warping (Clarberg et al. 2005): a point of the unit square walks down a
 * pyramid of sums; at each node it is split first by rows, then by columns, in proportion to the
 * sums, and stretched. A node with sum 0 is never entered.
 *
 * The pyramid: level 0 has side x side values, side a power of two, padded with 0; each further
 * level sums 2 x 2 of the one before; levels lie one after the other, the single total at the end.
 */
layout(std430, binding = 2) readonly buffer Pyramid { float pyramid[]; };
uniform int pyramid_levels; /* log2(side) + 1 */

int pyramid_offset(int level)
{
    /* sum of 4^j for j = levels-1 down to levels-level */
    int all = (1 << (2 * pyramid_levels)) - 1;
    int rest = (1 << (2 * (pyramid_levels - level))) - 1;
    return (all - rest) / 3;
}

/* Splits [0,1) at `low_share`: true and x stretched for the low part. */
bool take_low(inout float x, float low_share)
{
    bool low = x < low_share;
    x = low ? x / low_share : (x - low_share) / (1.0 - low_share);
    x = min(x, BELOW_ONE);
    return low;
}

/* The texel under the warped point and its probability; probability 0 where the total is 0. */
ivec2 warp(vec2 point, out float probability)
{
    float total = pyramid[pyramid_offset(pyramid_levels - 1)];
    probability = 0.0;
    if (!(total > 0.0))
        return ivec2(0);
    ivec2 node = ivec2(0);
    float value = total;
    for (int level = pyramid_levels - 2; level >= 0; level--) {
        int side = 1 << (pyramid_levels - 1 - level);
        int corner = pyramid_offset(level) + 2 * node.y * side + 2 * node.x;
        vec2 low = vec2(pyramid[corner], pyramid[corner + 1]);
        vec2 high = vec2(pyramid[corner + side], pyramid[corner + side + 1]);
        float low_sum = low.x + low.y, high_sum = high.x + high.y;
        bool is_low = take_low(point.y, low_sum / (low_sum + high_sum));
        vec2 row = is_low ? low : high;
        bool is_left = take_low(point.x, row.x / (row.x + row.y));
        node = 2 * node + ivec2(is_left ? 0 : 1, is_low ? 0 : 1);
        value = is_left ? row.x : row.y;
    }
    probability = value / total;
    return node;
}
