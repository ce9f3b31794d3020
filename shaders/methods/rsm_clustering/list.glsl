/* SPDX-License-Identifier: MIT
 *
 * The clusters that take part, listed by their cells of the regular grid over the RSM (Prutkin et
 * al. 2012, section 4), row by row of cells, by number within a cell: 3 vec4 each,
 *     centre; number (bits) | normal; 0 | colour; 0.
 */
#define LIST_VECTORS 3

layout(std430, binding = 3) buffer List { vec4 listed[]; };
/* Of each cell the index of its first entry; how many there are at the end. */
layout(std430, binding = 4) buffer Cells { uint cell_starts[]; };

uniform int cells; /* a side */
