/* SPDX-License-Identifier: MIT
 *
 * Evaluation (thesis 4.8, 5.3.1).
 */
#include "methods/acrsm/clusters.h"

#include <math.h>

/* Clusters of the random order that are evaluated; k/3 in whole clusters, as in the thesis, for the
 * share that a float holds of a third. */
static int selected_of(const struct acrsm_clusters *c, float share)
{
    int count = (int)floor((double)share * c->active * (1 + 1e-6));
    return count < c->active ? count : c->active;
}

/* By the map: the square in bands of ACRSM_GROUP rows, one a lane. */
static bool dispatch_bands(struct acrsm_clusters *c, const struct irb_program *program, int side,
                           struct irb_error *err)
{
    const int width = side < c->resolution ? side : c->resolution;
    return acrsm_dispatch_parts(c, program, (side + ACRSM_GROUP - 1) / ACRSM_GROUP,
                                IRB_LOOP_ROUNDS_MOST / (width + 2), err);
}

static bool verify(struct acrsm_clusters *c, const struct acrsm_settings *s, struct irb_error *err)
{
    const bool by_map = s->neighbours == ACRSM_NEIGHBOURS_MAP;
    const struct irb_program *program =
        acrsm_program(c, by_map ? ACRSM_EVALUATE_MAP : ACRSM_EVALUATE, err);
    const double texels = fmin((double)s->square * s->neighbourhood, 2.0 * c->resolution);
    const int side = texels > 1 ? (int)texels : 1;
    if (!program)
        return false;
    irb_program_use(program);
    c->gl->api.BindTextureUnit(0, c->map->id);
    irb_program_int(program, "cluster_map", 0);
    irb_program_int(program, "active_count", c->active);
    irb_program_int(program, "side", side);
    irb_program_uint(program, "seed", acrsm_frame_seed(c));
    if (by_map)
        return dispatch_bands(c, program, side, err);
    acrsm_dispatch(c, c->active);
    return true;
}

static bool merge_and_split(struct acrsm_clusters *c, const struct irb_rsm *rsm,
                            const struct acrsm_settings *s, struct irb_error *err)
{
    const struct irb_program *program = acrsm_program(c, ACRSM_MERGE_SPLIT, err);
    if (!program)
        return false;
    irb_program_use(program);
    int unit = irb_rsm_bind(rsm, program, 0);
    c->gl->api.BindTextureUnit((GLuint)unit, c->map->id);
    irb_program_int(program, "cluster_map", unit);
    irb_program_int(program, "selected", selected_of(c, s->share));
    irb_program_float(program, "merge_threshold", s->merge);
    irb_program_float(program, "split_threshold", s->split);
    irb_program_float(program, "split_radius", s->split_radius);
    irb_program_int(program, "reseed", s->reseed);
    irb_program_uint(program, "seed", acrsm_frame_seed(c));
    acrsm_dispatch(c, 1);
    return true;
}

/* The first frame has nothing to evaluate; the map is not written yet. */
bool acrsm_evaluate(struct acrsm_clusters *c, const struct irb_rsm *rsm,
                    const struct acrsm_settings *s, struct irb_error *err)
{
    static const uint32_t none[2] = {0};
    if (!s->adaptive || !c->lit_once)
        return irb_buffer_write(c->lists, ACRSM_MERGED_OFFSET, sizeof none, none, err);
    acrsm_bind_buffers(c);
    return verify(c, s, err) && merge_and_split(c, rsm, s, err) &&
           irb_gl_check(c->gl, "acrsm: evaluate", err);
}
