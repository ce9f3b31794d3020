/* SPDX-License-Identifier: MIT
 *
 * Carrying clusters from frame to frame, seeding and importance warping (thesis 4.4, 4.5, 5.3.1).
 */
#include "methods/acrsm/clusters.h"

#include "core/sampling/halton.h"

#include <string.h>

/* Halton points that a sequence may take until it gets to those of another seed. Sequences begin in
 * the first half of all, so that what follows is exact, too. */
enum { POINTS_APART = 1 << 14, SEQUENCES = IRB_HALTON_POINTS / POINTS_APART / 2 };

static struct acrsm_light_pose pose_of(const struct irb_rsm *rsm)
{
    struct acrsm_light_pose pose;
    memcpy(pose.position, rsm->light_position, sizeof pose.position);
    memcpy(pose.right, rsm->right, sizeof pose.right);
    memcpy(pose.up, rsm->up, sizeof pose.up);
    memcpy(pose.direction, rsm->direction, sizeof pose.direction);
    return pose;
}

/* The rotation that takes one light's axes to the other's; column-major. */
static void rotation(const struct acrsm_light_pose *from, const struct acrsm_light_pose *to,
                     float matrix[16])
{
    memset(matrix, 0, 16 * sizeof *matrix);
    matrix[15] = 1;
    for (int column = 0; column < 3; column++)
        for (int row = 0; row < 3; row++)
            matrix[4 * column + row] =
                (float)((double)to->right[row] * from->right[column] +
                        (double)to->up[row] * from->up[column] +
                        (double)to->direction[row] * from->direction[column]);
}

bool acrsm_carry(struct acrsm_clusters *c, const struct irb_rsm *rsm,
                 const struct acrsm_settings *s, struct irb_error *err)
{
    const struct acrsm_light_pose now = pose_of(rsm), before = c->pose;
    const bool rests = c->lit_once && !memcmp(&now, &before, sizeof now);
    const bool in_light = s->space == ACRSM_SPACE_LIGHT;
    float motion[16];

    c->pose = now;
    /* in the world a change of the cone alone moves places in the image, too */
    if (!c->lit_once || (rests && in_light)) {
        c->lit_once = true;
        return true;
    }
    const struct irb_program *program =
        acrsm_program(c, in_light ? ACRSM_CARRY_LIGHT : ACRSM_CARRY_WORLD, err);
    if (!program)
        return false;
    rotation(&before, &now, motion);
    acrsm_bind_buffers(c);
    irb_program_use(program);
    irb_rsm_bind(rsm, program, 0);
    irb_program_int(program, "active_count", c->active);
    irb_program_mat4(program, "motion", motion);
    irb_program_vec3(program, "last_light_position", before.position);
    acrsm_dispatch(c, c->active);
    return irb_gl_check(c->gl, "acrsm: carry", err);
}

static bool list_seeds(struct acrsm_clusters *c, const struct acrsm_settings *s,
                       struct irb_error *err)
{
    const struct irb_program *program = acrsm_program(c, ACRSM_RESEED, err);
    if (!program)
        return false;
    irb_program_use(program);
    irb_program_int(program, "active_count", c->active);
    irb_program_int(program, "tiles", s->tiles);
    irb_program_int(program, "reseed", s->reseed);
    acrsm_dispatch(c, 1);
    return true;
}

bool acrsm_seed(struct acrsm_clusters *c, const struct irb_rsm *rsm,
                const struct irb_texture *importance, const struct irb_pyramid *pyramid,
                const struct acrsm_settings *s, struct irb_error *err)
{
    acrsm_bind_buffers(c);
    const struct irb_program *program = acrsm_program(c, ACRSM_SEED, err);
    if (!program || !list_seeds(c, s, err))
        return false;
    irb_program_use(program);
    irb_pyramid_bind(pyramid, program);
    int unit = irb_rsm_bind(rsm, program, 0);
    c->gl->api.BindTextureUnit((GLuint)unit, importance->id);
    irb_program_int(program, "importance", unit);
    irb_program_int(program, "active_count", c->active);
    irb_program_int(program, "reseed", s->reseed);
    irb_program_int(program, "levels", s->warp_levels);
    irb_program_uint(program, "first", irb_halton_stretch(c->seed % SEQUENCES, 0, POINTS_APART));
    acrsm_dispatch(c, c->active);
    return irb_gl_check(c->gl, "acrsm: seed", err);
}
