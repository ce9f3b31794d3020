/* SPDX-License-Identifier: MIT
 *
 * Which pixels a gather of plain RSM covers, and the programs that gather for them
 * (shaders/methods/rsm/pixels.glsl).
 */
#ifndef IRB_METHODS_RSM_PIXELS_H
#define IRB_METHODS_RSM_PIXELS_H

#include "core/frame/gbuffer.h"
#include "core/frame/rsm.h"

/* Every scale-th pixel into an image of that resolution, or a list of pixels into an image of the
 * G-buffer's. All borrowed. */
struct rsm_pixels {
    const struct irb_gbuffer *gbuffer;
    const struct irb_texture *target; /* RGBA32F */
    int scale;                        /* of a grid; 1 = every pixel */
    const struct irb_buffer *list;    /* NULL for a grid */
    const struct irb_buffer *work;    /* with a list: the arguments of its indirect dispatch */
};

/* What a program is compiled for; the bits of its index in rsm_programs. */
enum {
    RSM_CLAMPED = 1,
    RSM_LIST = 2,
    RSM_SLIM_GBUFFER = 4,
    RSM_SLIM_RSM = 8,
    RSM_OFFSET = 16,
    RSM_PACKED = 32,
    RSM_VARIANTS = 64
};

/* Variants of one compute shader, each made when it is first asked for. */
struct rsm_programs {
    struct irb_gl *gl;  /* borrowed */
    const char *shader; /* path; static */
    int tile;           /* an invocation gathers for tile x tile pixels */
    struct irb_program *program[RSM_VARIANTS];
};

/* `tile` on software rasterisers; 1 on hardware, which wants many invocations. */
void rsm_programs_init(struct rsm_programs *programs, struct irb_gl *gl, const char *shader,
                       int software_tile);
void rsm_programs_destroy(struct rsm_programs *programs);
/* NULL on failure. `variant` is completed by what `pixels` asks for. */
const struct irb_program *rsm_programs_get(struct rsm_programs *programs, unsigned variant,
                                           const struct rsm_pixels *pixels, struct irb_error *err);

/* Binds G-buffer (texture units from first_unit), target (image unit 0) and list (storage 1, 2).
 * Returns the first unit after them. */
int rsm_pixels_bind(const struct rsm_pixels *pixels, const struct irb_program *program,
                    int first_unit);
/* One invocation for each tile of pixels, and a barrier for the target. */
void rsm_pixels_dispatch(const struct rsm_programs *programs, const struct rsm_pixels *pixels);
/* After the last dispatch: the target may be read in any way. */
bool rsm_pixels_finish(const struct rsm_pixels *pixels, const char *site, struct irb_error *err);

/* Pixels of a list that one work group takes. */
int rsm_programs_group_pixels(const struct rsm_programs *programs);

#endif
