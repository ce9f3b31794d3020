/* SPDX-License-Identifier: MIT
 *
 * Hierarchical sample warping (Clarberg et al. 2005; thesis 4.5, algorithm 5.3): a point of the
 * unit square walks down a pyramid of sums; at each node it is split first by rows, then by
 * columns, in proportion to the sums, and stretched. A node with sum 0 is never entered.
 *
 * The pyramid (core/lights/pyramid.h): level 0 has side x side values, side a power of two, padded
 * with 0; each further level sums 2 x 2 of the one before; levels lie one after the other, the
 * single total at the end.
 */
#include "sampling/halton.glsl"

layout(std430, binding = 2) readonly buffer Pyramid { float pyramid[]; };
uniform int pyramid_levels;     /* log2(side) + 1 */
uniform int pyramid_resolution; /* of the map, at most side */

int pyramid_offset(int level)
{
    /* sum of 4^j for j = levels-1 down to levels-level */
    int all = (1 << (2 * pyramid_levels)) - 1;
    int rest = (1 << (2 * (pyramid_levels - level))) - 1;
    return (all - rest) / 3;
}

float pyramid_total()
{
    return pyramid[pyramid_offset(pyramid_levels - 1)];
}

/* Splits [0,1) in proportion to two sums, not both 0: true and x stretched for the low part. A part
 * with sum 0 is not taken, whatever the division rounds to. */
bool take_low(inout float x, float low_sum, float high_sum)
{
    float low_share = low_sum / (low_sum + high_sum);
    bool low = !(high_sum > 0.0) || (low_sum > 0.0 && x < low_share);
    x = low ? x / low_share : (x - low_share) / (1.0 - low_share);
    x = clamp(x, 0.0, BELOW_ONE);
    return low;
}

/* Walks from the root, whose sum is not 0, down to `level`: the node there, and the point within
 * it. */
ivec2 descend(inout vec2 point, int level, out float value)
{
    ivec2 node = ivec2(0);
    value = pyramid_total();
    for (int l = pyramid_levels - 2; l >= level; l--) {
        int side = 1 << (pyramid_levels - 1 - l);
        int corner = pyramid_offset(l) + 2 * node.y * side + 2 * node.x;
        vec2 low = vec2(pyramid[corner], pyramid[corner + 1]);
        vec2 high = vec2(pyramid[corner + side], pyramid[corner + side + 1]);
        bool is_low = take_low(point.y, low.x + low.y, high.x + high.y);
        vec2 row = is_low ? low : high;
        bool is_left = take_low(point.x, row.x, row.y);
        node = 2 * node + ivec2(is_left ? 0 : 1, is_low ? 0 : 1);
        value = is_left ? row.x : row.y;
    }
    return node;
}

/* The texel under the warped point and its probability; probability 0 where the total is 0. */
ivec2 warp(vec2 point, out float probability)
{
    float total = pyramid_total(), value;
    probability = 0.0;
    if (!(total > 0.0))
        return ivec2(0);
    ivec2 node = descend(point, 0, value);
    probability = value / total;
    return node;
}

/* Texels that a point keeps off the border of its node, so that rounding does not carry it into the
 * next, which may be dark. */
const float NODE_MARGIN = 1.0 / 512.0;

/* The point, in [0,1)^2 of the map, after `levels` levels from that of 2 x 2 nodes down (clamped to
 * those there are); within its last node it keeps its place, in the part of the node that lies on
 * the map. A map whose total is 0 leaves the point where it is. */
vec2 warp_levels(vec2 point, int levels)
{
    if (!(pyramid_total() > 0.0))
        return point;
    float value;
    int level = pyramid_levels - 1 - clamp(levels, 0, pyramid_levels - 1);
    ivec2 node = descend(point, level, value), corner = node << level;
    vec2 extent = vec2(min(ivec2(1 << level), ivec2(pyramid_resolution) - corner));
    vec2 place = clamp(point * extent, vec2(NODE_MARGIN), extent - NODE_MARGIN);
    return (vec2(corner) + place) / float(pyramid_resolution);
}
