/* SPDX-License-Identifier: MIT
 *
 * The RSM reordered by the sorted keys, so that a cluster's texels lie side by side: 3 vec4 each,
 *     position; area | normal; 0 | flux; 0.
 */
#define RECORD_VECTORS 3

layout(std430, binding = 5) buffer Records { vec4 records[]; };
