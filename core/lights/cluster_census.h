/* SPDX-License-Identifier: MIT
 *
 * What a cluster map (cluster_map.h) leaves uncovered: sums over the RSM, from left to right in
 * each row, then over the rows.
 */
#ifndef IRB_LIGHTS_CLUSTER_CENSUS_H
#define IRB_LIGHTS_CLUSTER_CENSUS_H

#include "core/frame/rsm.h"
#include "core/gl/program.h"

struct irb_cluster_census {
    int lit, uncovered;    /* texels that reflect flux; those of them without a cluster */
    double flux;           /* W, mean of the channels: of all texels */
    double uncovered_flux; /* W: of those without a cluster */
};

struct irb_cluster_counter {
    struct irb_gl *gl; /* borrowed */
    struct irb_buffer *rows;
    struct irb_program *program[2]; /* by the RSM's layout; made when first asked for */
};

/* For RSMs and maps of `resolution` texels a side. On failure nothing is left. */
bool irb_cluster_counter_create(struct irb_cluster_counter *counter, struct irb_gl *gl,
                                int resolution, struct irb_error *err);
void irb_cluster_counter_destroy(struct irb_cluster_counter *counter); /* what it holds */

/* map: its red channel is the cluster map. Waits for the GPU. Same input, same sums. */
bool irb_cluster_count(struct irb_cluster_counter *counter, const struct irb_rsm *rsm,
                       const struct irb_texture *map, struct irb_cluster_census *out,
                       struct irb_error *err);

#endif
