/* SPDX-License-Identifier: MIT */
#include "methods/rsm/energy.h"

#include <stdlib.h>

/* Work group of shaders/methods/rsm/lost_energy.comp. */
enum { ROW_GROUP = 64 };

struct rsm_energy *rsm_energy_create(struct irb_gl *gl, int height, struct irb_error *err)
{
    struct rsm_energy *energy = calloc(1, sizeof *energy);
    if (!energy) {
        irb_fail(err, IRB_E_MEMORY, "rsm: out of memory");
        return NULL;
    }
    energy->gl = gl;
    const struct irb_program_desc program = {.name = "rsm: lost energy",
                                             .compute = "methods/rsm/lost_energy.comp"};
    if ((energy->rows = irb_buffer_create(gl, "rsm: row sums", height * (int64_t)8, NULL, err)) &&
        (energy->program = irb_program_create(gl, &program, err)))
        return energy;
    rsm_energy_destroy(energy);
    return NULL;
}

void rsm_energy_destroy(struct rsm_energy *energy)
{
    if (!energy)
        return;
    irb_program_destroy(energy->program);
    irb_buffer_destroy(energy->rows);
    free(energy);
}

bool rsm_energy_lost(struct rsm_energy *energy, const struct irb_texture *irradiance, double *share,
                     struct irb_error *err)
{
    const struct irb_gl_api *api = &energy->gl->api;
    const int height = irradiance->height;
    const size_t bytes = (size_t)height * 2 * sizeof(float);

    irb_program_use(energy->program);
    api->BindTextureUnit(0, irradiance->id);
    irb_program_int(energy->program, "irradiance", 0);
    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, energy->rows->id);
    api->DispatchCompute((unsigned)(height + ROW_GROUP - 1) / ROW_GROUP, 1, 1);
    float *rows = malloc(bytes);
    if (!rows)
        return irb_fail(err, IRB_E_MEMORY, "rsm: out of memory for %d row sums", height);
    bool ok = irb_buffer_read(energy->rows, 0, (int64_t)bytes, rows, err);
    double kept = 0, lost = 0;
    for (int y = 0; ok && y < height; y++) {
        kept += rows[2 * y];
        lost += rows[2 * y + 1];
    }
    free(rows);
    *share = kept + lost > 0 ? lost / (kept + lost) : 0;
    return ok;
}
