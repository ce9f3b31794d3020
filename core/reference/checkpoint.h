/* SPDX-License-Identifier: MIT
 *
 * Private to the room: the file in which finished tiles outlive an interrupted job.
 *
 * A header, then two slots a tile. A tile's state after pass p goes to slot p mod 2, so that the
 * state before it stays whole while it is written, and the file never grows beyond two states. Each
 * slot ends in a hash of its content: a torn one is seen and ignored.
 */
#ifndef IRB_REFERENCE_CHECKPOINT_H
#define IRB_REFERENCE_CHECKPOINT_H

#include "core/base/error.h"
#include "core/base/hash.h"

#include <stddef.h>
#include <stdint.h>

/* A tile after `passes` passes. */
struct checkpoint_tile {
    uint32_t tile;
    uint32_t passes;
    uint64_t rays;
    double seconds; /* of one thread */
};

struct checkpoint {
    int file;           /* -1: no checkpoint is kept */
    size_t state_bytes; /* of one tile */
};

/* Opens or creates the file; another job's or a damaged header starts it anew. A NULL path gives a
 * checkpoint that keeps nothing. */
bool checkpoint_open(struct checkpoint *checkpoint, const char *path, const struct irb_key *key,
                     size_t state_bytes, struct irb_error *err);
void checkpoint_close(struct checkpoint *checkpoint);

/* Fills `tile` and `state` with the latest whole state of tile number tile->tile; false where there
 * is none, and then both are unchanged. */
bool checkpoint_read(const struct checkpoint *checkpoint, struct checkpoint_tile *tile,
                     void *state);
/* May be called by several threads for different tiles. False when the file can't take it. */
bool checkpoint_write(const struct checkpoint *checkpoint, const struct checkpoint_tile *tile,
                      const void *state);

#endif
