/* SPDX-License-Identifier: MIT
 *
 * Content hashes (128-bit XXH3) that key every stage by its inputs. Not cryptographic.
 */
#ifndef IRB_BASE_HASH_H
#define IRB_BASE_HASH_H

#include <stddef.h>
#include <stdint.h>

struct irb_hash; /* a running hash; create, add, finish (which frees it) */

/* 32 hexadecimal digits and the terminating zero. */
struct irb_key {
    char hex[33];
};

struct irb_hash *irb_hash_create(void);
void irb_hash_bytes(struct irb_hash *hash, const void *data, size_t size);
/* Adds the string with its length, so that ("ab","c") and ("a","bc") differ. NULL counts as "". */
void irb_hash_string(struct irb_hash *hash, const char *string);
void irb_hash_u64(struct irb_hash *hash, uint64_t value);
/* Adds the bits, with -0 folded into +0. */
void irb_hash_floats(struct irb_hash *hash, const float *values, size_t count);
void irb_hash_double(struct irb_hash *hash, double value);
/* Frees the running hash. */
struct irb_key irb_hash_finish(struct irb_hash *hash);

/* 64-bit mix of two integers, for seeds that must not correlate. */
uint64_t irb_hash_mix(uint64_t a, uint64_t b);

#endif
