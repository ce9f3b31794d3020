/* SPDX-License-Identifier: MIT
 *
 * What the passes that work through lists leave for each other and for the statistics.
 */
layout(std430, binding = 3) buffer Lists {
    uint next_seed; /* Halton points taken so far */
    uint merged, split, seeded; /* in this frame */
    uint seed_number[CLUSTERS_MOST]; /* of the clusters on the re-seed list: their Halton point */
    uint free_clusters[CLUSTERS_MOST];
};
