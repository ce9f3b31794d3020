/* SPDX-License-Identifier: MIT
 *
 * The cluster map: the number of each texel's cluster, or why it has none.
 */
const uint UNLIT = 0xffffffffu; /* no flux: of no cluster */
const uint LOST = 0xfffffffeu;  /* lit, but no cluster within reach */
