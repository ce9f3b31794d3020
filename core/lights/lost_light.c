/* SPDX-License-Identifier: MIT */
#include "core/lights/lost_light.h"

#include <stdlib.h>

enum { ROW_GROUP = 64 }; /* work group of shaders/lights/shade_lost.comp */

void irb_lost_light_destroy(struct irb_lost_light *lost)
{
    irb_texture_destroy(lost->image);
    irb_program_destroy(lost->sum);
    *lost = (struct irb_lost_light){.gl = lost->gl};
}

bool irb_lost_light_fits(const struct irb_lost_light *lost, const struct irb_interleave *il)
{
    return lost->image && lost->image->width == il->split->width &&
           lost->image->height == il->split->height;
}

bool irb_lost_light_prepare(struct irb_lost_light *lost, const struct irb_interleave *il,
                            float bound, struct irb_error *err)
{
    lost->valid = bound > 0;
    if (!lost->valid || irb_lost_light_fits(lost, il))
        return true;
    irb_texture_destroy(lost->image);
    lost->image = irb_texture_create(lost->gl,
                                     &(struct irb_texture_desc){.name = "lost light",
                                                                .format = GL_R32F,
                                                                .width = il->split->width,
                                                                .height = il->split->height},
                                     err);
    return lost->image != NULL;
}

/* What is there and what the bound took, a row each. */
static bool read_rows(struct irb_lost_light *lost, const struct irb_interleave *il, float *rows,
                      int64_t bytes, struct irb_error *err)
{
    const struct irb_gl_api *api = &lost->gl->api;
    const struct irb_program_desc desc = {.name = "lost light",
                                          .compute = "lights/shade_lost.comp"};
    if (!lost->sum && !(lost->sum = irb_program_create(lost->gl, &desc, err)))
        return false;
    struct irb_buffer *sums = irb_buffer_create(lost->gl, "lost light: row sums", bytes, NULL, err);
    if (!sums)
        return false;
    irb_program_use(lost->sum);
    api->BindTextureUnit(0, il->split->id);
    irb_program_int(lost->sum, "split_image", 0);
    api->BindTextureUnit(1, lost->image->id);
    irb_program_int(lost->sum, "lost", 1);
    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, sums->id);
    api->DispatchCompute((unsigned)(il->split->height + ROW_GROUP - 1) / ROW_GROUP, 1, 1);
    bool ok = irb_buffer_read(sums, 0, bytes, rows, err);
    irb_buffer_destroy(sums);
    return ok && irb_gl_check(lost->gl, "lost light", err);
}

bool irb_lost_light_share(struct irb_lost_light *lost, const struct irb_interleave *il,
                          double *share, struct irb_error *err)
{
    const int height = il->split->height;
    const size_t bytes = (size_t)height * 2 * sizeof(float);

    *share = 0;
    if (!lost->valid)
        return true;
    float *rows = malloc(bytes);
    if (!rows)
        return irb_fail(err, IRB_E_MEMORY, "out of memory for %d row sums", height);
    bool ok = read_rows(lost, il, rows, (int64_t)bytes, err);
    double kept = 0, taken = 0;
    for (int y = 0; ok && y < height; y++) {
        kept += rows[2 * y];
        taken += rows[2 * y + 1];
    }
    free(rows);
    *share = kept + taken > 0 ? taken / (kept + taken) : 0;
    return ok;
}
