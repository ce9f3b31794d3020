/* SPDX-License-Identifier: MIT
 *
 * Sorts unsigned 32-bit keys on the GPU (bitonic network, Batcher 1968), as the RSM clustering of
 * Prutkin et al. 2012 does with cluster numbers. Payload goes into a key's low bits; keys that
 * differ make the order unique. Same input, same bits.
 */
#ifndef IRB_GL_SORT_H
#define IRB_GL_SORT_H

#include "core/gl/objects.h"
#include "core/gl/program.h"

struct irb_sort {
    struct irb_gl *gl; /* borrowed */
    struct irb_program *blocks, *merge, *step;
};

struct irb_sort *irb_sort_create(struct irb_gl *gl, struct irb_error *err);
void irb_sort_destroy(struct irb_sort *sort);

/* Size of the buffer in which `count` keys are sorted: padded to a power of two, at least 2. */
int64_t irb_sort_bytes(int count);

/* Sorts the first `count` keys of the buffer, ascending; those up to irb_sort_bytes(count) become
 * 0xffffffff. IRB_E_INTERNAL where the buffer is smaller than that. Shaders may read it after. */
bool irb_sort_run(struct irb_sort *sort, const struct irb_buffer *keys, int count,
                  struct irb_error *err);

#endif
