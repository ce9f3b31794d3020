/* SPDX-License-Identifier: MIT */
const uint EMPTY = 0x7f800000u; /* bits of +Inf: a texel of an ISM without a surface */
