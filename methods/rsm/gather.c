/* SPDX-License-Identifier: MIT */
#include "methods/rsm/gather.h"

const char rsm_gather_shader[] = "methods/rsm/gather.comp";

/* One dispatch a block; no lights at all still take one, which writes zeros. */
bool rsm_gather_run(struct rsm_programs *programs, const struct rsm_pixels *pixels,
                    const struct irb_vpl_set *lights, float bound, struct irb_error *err)
{
    const struct irb_gl_api *api = &programs->gl->api;
    const struct irb_program *program =
        rsm_programs_get(programs, bound > 0 ? RSM_CLAMPED : 0u, pixels, err);
    const int blocks = irb_vpl_set_blocks(lights) > 0 ? irb_vpl_set_blocks(lights) : 1;
    const int64_t block_bytes = (int64_t)IRB_VPL_BLOCK * IRB_VPL_BYTES;

    if (!program)
        return false;
    rsm_pixels_bind(pixels, program, 0);
    irb_program_float(program, "bound", bound);
    for (int block = 0; block < blocks; block++) {
        int rest = lights->count - block * IRB_VPL_BLOCK;
        irb_program_int(program, "light_count", rest < IRB_VPL_BLOCK ? rest : IRB_VPL_BLOCK);
        irb_program_int(program, "first_block", block == 0);
        api->BindBufferRange(GL_UNIFORM_BUFFER, 0, lights->lights->id, block * block_bytes,
                             block_bytes);
        rsm_pixels_dispatch(programs, pixels);
    }
    return rsm_pixels_finish(pixels, "rsm: gather", err);
}
