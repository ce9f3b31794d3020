/* SPDX-License-Identifier: MIT
 *
 * Averaging (thesis 4.7, 5.3.1), the marks of the centres in the cluster map, and the clusters as
 * area lights.
 */
#include "methods/acrsm/clusters.h"

#include "core/frame/light_gl.h"

/* shaders/methods/acrsm/average.comp, tiles.glsl: a bit of a word is a tile. */
enum { TILE_SIDE = 32, WORD = 32, ROWS = TILE_SIDE * TILE_SIDE / ACRSM_GROUP };
/* Rounds of loops over the tiles of a word, and words that so fit into a dispatch. */
enum { WORD_ROUNDS = WORD * (ROWS + 2) + 2, WORDS = IRB_LOOP_ROUNDS_MOST / WORD_ROUNDS };

static bool average(struct acrsm_clusters *c, const struct irb_rsm *rsm,
                    const struct irb_light *light, const struct irb_texture *importance,
                    const struct acrsm_settings *s, struct irb_error *err)
{
    const struct irb_gl_api *api = &c->gl->api;
    const struct irb_program *program = acrsm_program(c, ACRSM_AVERAGE, err);
    const int tiles = (c->resolution + TILE_SIDE - 1) / TILE_SIDE;
    if (!program)
        return false;
    irb_program_use(program);
    irb_light_uniforms(light, program);
    int unit = irb_rsm_bind(rsm, program, 0);
    api->BindTextureUnit((GLuint)unit, importance->id);
    irb_program_int(program, "importance", unit++);
    api->BindTextureUnit((GLuint)unit, c->map->id);
    irb_program_int(program, "cluster_map", unit);
    irb_program_int(program, "second_moment", s->area == ACRSM_AREA_MOMENT);
    return acrsm_dispatch_parts(c, program, (tiles * tiles + WORD - 1) / WORD, WORDS, err);
}

static bool mark_centres(struct acrsm_clusters *c, struct irb_error *err)
{
    const struct irb_program *program = acrsm_program(c, ACRSM_CENTRES, err);
    if (!program)
        return false;
    irb_program_use(program);
    irb_program_int(program, "active_count", c->active);
    c->gl->api.BindImageTexture(0, c->map->id, 0, GL_FALSE, 0, GL_READ_WRITE, GL_RG32UI);
    acrsm_dispatch(c, c->active);
    return true;
}

static bool write_lights(struct acrsm_clusters *c, const struct acrsm_settings *s,
                         struct irb_error *err)
{
    const struct irb_program *program =
        acrsm_program(c, (enum acrsm_program)(ACRSM_LIGHTS + s->flux), err);
    if (!program)
        return false;
    irb_program_use(program);
    irb_program_int(program, "active_count", c->active);
    acrsm_dispatch(c, ACRSM_CLUSTERS_MOST);
    return true;
}

bool acrsm_average(struct acrsm_clusters *c, const struct irb_rsm *rsm,
                   const struct irb_light *light, const struct irb_texture *importance,
                   const struct acrsm_settings *s, struct irb_error *err)
{
    acrsm_bind_buffers(c);
    return average(c, rsm, light, importance, s, err) && mark_centres(c, err) &&
           write_lights(c, s, err) && irb_gl_check(c->gl, "acrsm: average", err);
}
