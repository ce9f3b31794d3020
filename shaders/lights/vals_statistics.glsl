/* SPDX-License-Identifier: MIT */
layout(std430, binding = 3) buffer Statistics
{
    uint in_use;     /* VALs with VPLs */
    uint iterations; /* of the frame so far */
    uint converged;  /* 1: the last one changed nothing */
} statistics;
