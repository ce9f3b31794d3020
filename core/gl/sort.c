/* SPDX-License-Identifier: MIT */
#include "core/gl/sort.h"

#include <stdlib.h>

/* Keys that one work group sorts in shared memory (16 KiB), and its size, in
 * shaders/gl/sort.comp. */
enum { BLOCK = 4096, GROUP = 256, KEYS_BINDING = 0 };

static struct irb_program *create_pass(struct irb_gl *gl, const char *name, const char *define,
                                       struct irb_error *err)
{
    const char *const defines[] = {define, "BITONIC_BLOCK 4096", NULL};
    _Static_assert(BLOCK == 4096, "the define above");
    return irb_program_create(
        gl, &(struct irb_program_desc){.name = name, .compute = "gl/sort.comp", .defines = defines},
        err);
}

struct irb_sort *irb_sort_create(struct irb_gl *gl, struct irb_error *err)
{
    struct irb_sort *sort = calloc(1, sizeof *sort);
    if (!sort) {
        irb_fail(err, IRB_E_MEMORY, "sort: out of memory");
        return NULL;
    }
    sort->gl = gl;
    if ((sort->blocks = create_pass(gl, "sort: blocks", "PASS 0", err)) &&
        (sort->merge = create_pass(gl, "sort: merge", "PASS 1", err)) &&
        (sort->step = create_pass(gl, "sort: step", "PASS 2", err)))
        return sort;
    irb_sort_destroy(sort);
    return NULL;
}

void irb_sort_destroy(struct irb_sort *sort)
{
    if (!sort)
        return;
    irb_program_destroy(sort->blocks);
    irb_program_destroy(sort->merge);
    irb_program_destroy(sort->step);
    free(sort);
}

static int64_t padded(int count)
{
    int64_t keys = 2;
    while (keys < count)
        keys *= 2;
    return keys;
}

int64_t irb_sort_bytes(int count)
{
    return padded(count) * (int64_t)sizeof(uint32_t);
}

static void dispatch(const struct irb_sort *sort, int64_t groups)
{
    sort->gl->api.DispatchCompute((unsigned)groups, 1, 1);
    sort->gl->api.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

/* The merge of length k: its steps wider than a block one by one, the rest at once. */
static void run_merge(const struct irb_sort *sort, int64_t keys, int64_t k)
{
    irb_program_use(sort->step);
    irb_program_uint(sort->step, "merge", (unsigned)k);
    for (int64_t j = k / 2; j >= BLOCK; j /= 2) {
        irb_program_uint(sort->step, "width", (unsigned)j);
        dispatch(sort, keys / 2 / GROUP);
    }
    irb_program_use(sort->merge);
    irb_program_uint(sort->merge, "block", BLOCK);
    irb_program_uint(sort->merge, "merge", (unsigned)k);
    dispatch(sort, keys / BLOCK);
}

bool irb_sort_run(struct irb_sort *sort, const struct irb_buffer *keys, int count,
                  struct irb_error *err)
{
    const int64_t all = padded(count), block = all < BLOCK ? all : BLOCK;
    if (count < 0 || irb_sort_bytes(count) > keys->bytes)
        return irb_fail(err, IRB_E_INTERNAL, "sort: %d keys in a buffer of %lld bytes", count,
                        (long long)keys->bytes);
    sort->gl->api.BindBufferBase(GL_SHADER_STORAGE_BUFFER, KEYS_BINDING, keys->id);
    irb_program_use(sort->blocks);
    irb_program_uint(sort->blocks, "count", (unsigned)count);
    irb_program_uint(sort->blocks, "block", (unsigned)block);
    dispatch(sort, all / block);
    for (int64_t k = 2 * BLOCK; k <= all; k *= 2)
        run_merge(sort, all, k);
    return irb_gl_check(sort->gl, "sort", err);
}
