/* SPDX-License-Identifier: MIT
 *
 * Place of a tile's first VPL in the order by tiles; that of `tiles` is the end.
 */
int first_of_tile(int tile, int vpl_count, int tiles)
{
    return tile * (vpl_count / tiles) + min(tile, vpl_count % tiles);
}
