/* SPDX-License-Identifier: MIT */
#include "core/base/hash.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

struct irb_hash {
    XXH3_state_t *state;
};

struct irb_hash *irb_hash_create(void)
{
    struct irb_hash *hash = malloc(sizeof *hash);
    if (!hash || !(hash->state = XXH3_createState()))
        abort(); /* a few hundred bytes: nothing sensible is left to do */
    XXH3_128bits_reset(hash->state);
    return hash;
}

void irb_hash_bytes(struct irb_hash *hash, const void *data, size_t size)
{
    if (size)
        XXH3_128bits_update(hash->state, data, size);
}

void irb_hash_u64(struct irb_hash *hash, uint64_t value)
{
    irb_hash_bytes(hash, &value, sizeof value);
}

void irb_hash_string(struct irb_hash *hash, const char *string)
{
    size_t length = string ? strlen(string) : 0;
    irb_hash_u64(hash, length);
    irb_hash_bytes(hash, string, length);
}

void irb_hash_floats(struct irb_hash *hash, const float *values, size_t count)
{
    enum { BLOCK = 256 };
    float block[BLOCK];
    while (count) {
        size_t n = count < BLOCK ? count : BLOCK;
        for (size_t i = 0; i < n; i++)
            block[i] = values[i] + 0.0f;
        irb_hash_bytes(hash, block, n * sizeof *block);
        values += n;
        count -= n;
    }
}

void irb_hash_double(struct irb_hash *hash, double value)
{
    value += 0.0;
    irb_hash_bytes(hash, &value, sizeof value);
}

struct irb_key irb_hash_finish(struct irb_hash *hash)
{
    XXH128_hash_t digest = XXH3_128bits_digest(hash->state);
    XXH3_freeState(hash->state);
    free(hash);
    struct irb_key key;
    snprintf(key.hex, sizeof key.hex, "%016llx%016llx", (unsigned long long)digest.high64,
             (unsigned long long)digest.low64);
    return key;
}

uint64_t irb_hash_mix(uint64_t a, uint64_t b)
{
    uint64_t pair[2] = {a, b};
    return XXH3_64bits(pair, sizeof pair);
}
