/* SPDX-License-Identifier: MIT
 *
 * Exact weighted quantiles of non-negative floats in two passes over the data and a fixed amount of
 * memory, whatever the count: the upper 16 bits of the values are found first, then the lower.
 * (The bits of non-negative floats sort as the floats do.)
 *
 *     struct irb_quantile *q = irb_quantile_create(0.5);
 *     for (int pass = 0; pass < 2; pass++) {
 *         ... irb_quantile_add(q, value, weight) for each ...
 *         irb_quantile_pass_done(q);
 *     }
 *     float median = irb_quantile_finish(q);
 */
#ifndef IRB_SCORE_QUANTILE_H
#define IRB_SCORE_QUANTILE_H

struct irb_quantile;

/* fraction in (0,1]; NULL when memory is out. */
struct irb_quantile *irb_quantile_create(double fraction);
/* value >= 0, finite; weight >= 0. */
void irb_quantile_add(struct irb_quantile *quantile, float value, double weight);
void irb_quantile_pass_done(struct irb_quantile *quantile);
/* The smallest value v for which the weights of the values <= v reach fraction * all weights; 0 for
 * no weight at all. Frees the struct. */
float irb_quantile_finish(struct irb_quantile *quantile);

#endif
