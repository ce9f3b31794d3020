/* SPDX-License-Identifier: MIT
 *
 * A loop over threads.
 */
#ifndef IRB_BASE_PARALLEL_H
#define IRB_BASE_PARALLEL_H

#include <stdbool.h>

/* Work on item `index`; `thread` in [0, threads) picks scratch memory. Return false to stop all. */
typedef bool (*irb_parallel_fn)(void *user, int index, int thread);

/* Runs fn for index 0..count-1, in order of index but on up to `threads` threads (0 = as many as
 * there are cores). Returns false if a call returned false. Results must not depend on which
 * thread runs an item. */
bool irb_parallel_for(int count, int threads, irb_parallel_fn fn, void *user);

/* Cores that this process may run on, at least 1. */
int irb_core_count(void);

#endif
