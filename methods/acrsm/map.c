/* SPDX-License-Identifier: MIT
 *
 * Mapping (thesis 4.6, 5.3.1).
 */
#include "methods/acrsm/clusters.h"

enum { TILE_SIDE = 32 }; /* shaders/methods/acrsm/tiles.glsl */

static int tiles_a_row(const struct acrsm_clusters *c)
{
    return (c->resolution + TILE_SIDE - 1) / TILE_SIDE;
}

static bool bin(struct acrsm_clusters *c, const struct acrsm_settings *s, struct irb_error *err)
{
    const struct irb_program *program = acrsm_program(c, ACRSM_BIN, err);
    const int64_t words = c->candidates->bytes / 4, presence = c->presence->bytes / 4;
    if (!program)
        return false;
    irb_program_use(program);
    irb_program_int(program, "active_count", c->active);
    irb_program_int(program, "resolution", c->resolution);
    irb_program_int(program, "side", s->square);
    irb_program_int(program, "presence_length", (int)presence);
    acrsm_dispatch(c, words > presence ? words : presence);
    return true;
}

bool acrsm_map(struct acrsm_clusters *c, const struct irb_rsm *rsm,
               const struct irb_texture *importance, const struct acrsm_settings *s,
               struct irb_error *err)
{
    const struct irb_gl_api *api = &c->gl->api;
    const int variant =
        2 * (s->cover == ACRSM_COVER_NEAREST) + (s->normals == ACRSM_NORMALS_SIGNED);
    const float weights[3] = {s->w_position / s->extent, s->w_normal, s->w_importance};
    const unsigned tiles = (unsigned)tiles_a_row(c);

    acrsm_bind_buffers(c);
    const struct irb_program *program =
        acrsm_program(c, (enum acrsm_program)(ACRSM_MAP + variant), err);
    if (!program || !bin(c, s, err))
        return false;
    irb_program_use(program);
    int unit = irb_rsm_bind(rsm, program, 0);
    api->BindTextureUnit((GLuint)unit, importance->id);
    irb_program_int(program, "importance", unit);
    irb_program_int(program, "active_count", c->active);
    irb_program_int(program, "side", s->square);
    irb_program_vec3(program, "weights", weights);
    api->BindImageTexture(0, c->map->id, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RG32UI);
    api->DispatchCompute(tiles, tiles, 1);
    acrsm_barrier(c);
    return irb_gl_check(c->gl, "acrsm: map", err);
}
