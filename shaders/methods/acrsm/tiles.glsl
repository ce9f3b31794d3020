/* SPDX-License-Identifier: MIT
 *
 * The RSM in tiles of TILE_SIDE x TILE_SIDE texels, so that mapping looks at the clusters of a tile
 * only, and averaging at the tiles of a cluster only.
 */
#define TILE_SIDE 32
#define CLUSTER_WORDS (CLUSTERS_MOST / 32) /* bits for all clusters */

int tiles_a_row(int resolution)
{
    return (resolution + TILE_SIDE - 1) / TILE_SIDE;
}

/* Words with a bit for each tile. */
int tile_words(int resolution)
{
    int tiles = tiles_a_row(resolution);
    return (tiles * tiles + 31) / 32;
}
