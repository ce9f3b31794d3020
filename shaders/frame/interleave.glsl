/* SPDX-License-Identifier: MIT
 *
 * Where pixels stand in the split buffers of core/frame/interleave.h (thesis 3.2.3, 5.3.3). TILES_X
 * and TILES_Y are n and m: constants, since division by what is not one is slow.
 */
uniform ivec2 interleave_tile; /* w, h: pixels of a tile */

const ivec2 INTERLEAVE_TILES = ivec2(TILES_X, TILES_Y);

ivec2 split_of(ivec2 pixel)
{
    return (pixel % INTERLEAVE_TILES) * interleave_tile + pixel / INTERLEAVE_TILES;
}

/* Pixel of a place in a tile; outside the image for padding. */
ivec2 pixel_of(ivec2 tile, ivec2 place)
{
    return place * INTERLEAVE_TILES + tile;
}
