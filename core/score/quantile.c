/* SPDX-License-Identifier: MIT */
#include "core/score/quantile.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { BUCKETS = 1 << 16 };

struct irb_quantile {
    double fraction;
    double target; /* weight to reach */
    double below;  /* weight of the buckets that lie below */
    uint32_t bits; /* of the result, as far as they are known */
    int pass;
    double weight[BUCKETS];
};

struct irb_quantile *irb_quantile_create(double fraction)
{
    struct irb_quantile *q = calloc(1, sizeof *q);
    if (q)
        q->fraction = fraction;
    return q;
}

void irb_quantile_add(struct irb_quantile *q, float value, double weight)
{
    uint32_t bits;
    value += 0.0f; /* -0 becomes +0 */
    memcpy(&bits, &value, sizeof bits);
    if (q->pass == 0)
        q->weight[bits >> 16] += weight;
    else if (bits >> 16 == q->bits >> 16)
        q->weight[bits & 0xffff] += weight;
}

/* The first bucket in which the weight reaches the target; the last one with any, should rounding
 * keep the sum below it. */
static uint32_t find_bucket(struct irb_quantile *q)
{
    uint32_t found = 0;
    double below = q->below, found_below = q->below;
    for (uint32_t i = 0; i < BUCKETS; i++) {
        if (q->weight[i] <= 0)
            continue;
        found = i;
        found_below = below;
        below += q->weight[i];
        if (below >= q->target)
            break;
    }
    q->below = found_below;
    return found;
}

void irb_quantile_pass_done(struct irb_quantile *q)
{
    if (q->pass == 0) {
        double total = 0;
        for (int i = 0; i < BUCKETS; i++)
            total += q->weight[i];
        q->target = q->fraction * total;
        q->bits = find_bucket(q) << 16;
        memset(q->weight, 0, sizeof q->weight);
    } else if (q->pass == 1) {
        q->bits |= find_bucket(q);
    }
    q->pass++;
}

float irb_quantile_finish(struct irb_quantile *q)
{
    float value;
    memcpy(&value, &q->bits, sizeof value);
    free(q);
    return value;
}
