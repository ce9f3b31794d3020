/* SPDX-License-Identifier: MIT */
#include "core/report/analysis_units.h"
#include "core/report/table_view.h"
#include "core/stats/blocks.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define M(name) IRB_METRIC_##name

/* ---- values ---- */

double irb_trial_value(const struct irb_analysis_trial *trial, int metric)
{
    double largest = NAN, *values = malloc(((size_t)trial->seed_count + 1) * sizeof *values);
    if (!values)
        abort();
    for (int i = 0; i < trial->seed_count; i++) {
        values[i] = trial->seeds[i].values[metric];
        largest = fmax(largest, values[i]);
    }
    double mean = irb_mean_over_seeds(values, trial->seed_count);
    free(values);
    return metric == M(frame_ms_worst) ? largest : mean;
}

/* ---- which frames and rounds make up a metric ---- */

static bool is_square(int metric)
{
    return irb_metric_aggregate(metric) == IRB_AGGREGATE_ROOT_MEAN_SQUARE;
}

/* Whether the sequence's value is the mean (of squares: its root) of the frames'. */
static bool is_of_frames(int metric)
{
    switch (metric) {
    case M(indirect_psnr):
    case M(full_psnr):
    case M(solution_energy_ratio):
    case M(claim_energy_ratio):
    case M(lag):
    case M(indirect_flip_noise):
    case M(masked_share):
    case M(uncovered_flux):
    case M(clamped_light):
    case M(reference_noise):
    case M(reference_noise_rmse):
    case M(reference_flicker):
    case M(frame_ms_p95):
    case M(frame_ms_worst):
    case M(precompute_ms):
    case M(gl_bytes):
        return false;
    default:
        return irb_metric_aggregate(metric) != IRB_AGGREGATE_SUM;
    }
}

/* An energy ratio of the sequence is 1 + bias / mean reference, and so is that of a block with its
 * own bias: means of the frames' ratios would be another number. */
static double energy_of_frame(const struct irb_analysis_seed *seed, int frame, int energy, int bias)
{
    double whole = seed->values[bias];
    double of_frame = seed->frames[(size_t)frame * IRB_METRIC_COUNT + (size_t)bias];
    return whole != 0 ? 1 + (seed->values[energy] - 1) / whole * of_frame : NAN;
}

/* What a block is the mean of; NaN where there is none. */
static double frame_value(const struct irb_analysis_seed *seed, int frame, int metric)
{
    if (frame >= seed->frame_count)
        return NAN;
    if (metric == M(indirect_energy_ratio))
        return energy_of_frame(seed, frame, metric, M(indirect_bias));
    if (metric == M(full_energy_ratio))
        return energy_of_frame(seed, frame, metric, M(full_bias));
    int column = metric == M(frame_ms_mean) ? M(frame_ms) : metric;
    double v = seed->frames[(size_t)frame * IRB_METRIC_COUNT + (size_t)column];
    return is_square(metric) ? v * v : v;
}

/* Of one repeat; NaN for what is no time. */
static double round_value(const struct irb_analysis_seed *seed, int repeat, int metric)
{
    if (repeat >= seed->round_count)
        return NAN;
    switch (metric) {
    case M(frame_ms):
        return seed->rounds[repeat].median;
    case M(frame_ms_mean):
        return seed->rounds[repeat].mean;
    case M(frame_ms_p95):
        return seed->rounds[repeat].p95;
    default:
        return NAN;
    }
}

/* ---- units ---- */

/* The seeds that all have the metric, as indices into a's and b's. */
struct common_seeds {
    const struct irb_analysis_trial *trial[2];
    int trials;
    int (*index)[2]; /* owned */
    int count;
};

static int find_seed(const struct irb_analysis_trial *trial, int seed, int metric)
{
    for (int i = 0; i < trial->seed_count; i++)
        if (trial->seeds[i].seed == seed && !isnan(trial->seeds[i].values[metric]))
            return i;
    return -1;
}

static struct common_seeds find_common(const struct irb_analysis_trial *a,
                                       const struct irb_analysis_trial *b, int metric)
{
    struct common_seeds c = {.trial = {a, b}, .trials = b ? 2 : 1};
    c.index = malloc(((size_t)a->seed_count + 1) * sizeof *c.index);
    if (!c.index)
        abort();
    for (int i = 0; i < a->seed_count; i++) {
        int other = b ? find_seed(b, a->seeds[i].seed, metric) : 0;
        if (isnan(a->seeds[i].values[metric]) || other < 0)
            continue;
        c.index[c.count][0] = i;
        c.index[c.count++][1] = other;
    }
    return c;
}

static const struct irb_analysis_seed *seed_of(const struct common_seeds *c, int which, int i)
{
    return &c->trial[which]->seeds[c->index[i][which]];
}

/* Appends a unit where all have it. */
static void append(struct irb_paired *p, int trials, double a, double b)
{
    if (isnan(a) || (trials > 1 && isnan(b)))
        return;
    p->of[0][p->count] = a;
    p->of[1][p->count++] = b;
}

static void allocate(struct irb_paired *p, int most)
{
    p->count = 0;
    for (int w = 0; w < 2; w++) {
        p->of[w] = realloc(p->of[w], ((size_t)most + 1) * sizeof(double));
        if (!p->of[w])
            abort();
    }
}

static void seeds_as_units(struct irb_paired *p, const struct common_seeds *c, int metric)
{
    allocate(p, c->count);
    for (int i = 0; i < c->count; i++)
        append(p, c->trials, seed_of(c, 0, i)->values[metric],
               c->trials > 1 ? seed_of(c, 1, i)->values[metric] : NAN);
}

static void rounds_as_units(struct irb_paired *p, const struct common_seeds *c, int metric)
{
    int most = 0;
    for (int i = 0; i < c->count; i++)
        most += seed_of(c, 0, i)->round_count;
    allocate(p, most);
    for (int i = 0; i < c->count; i++)
        for (int r = 0; r < seed_of(c, 0, i)->round_count; r++)
            append(p, c->trials, round_value(seed_of(c, 0, i), r, metric),
                   c->trials > 1 ? round_value(seed_of(c, 1, i), r, metric) : NAN);
}

/* Mean over the seeds of a frame. */
static double frame_mean(const struct common_seeds *c, int which, int frame, int metric)
{
    double sum = 0;
    for (int i = 0; i < c->count; i++)
        sum += frame_value(seed_of(c, which, i), frame, metric);
    return sum / c->count;
}

/* Whether units tell how much the metric varies. Equal ones (seeds of a method that draws nothing)
 * do not, however many there are; but for memory, which neither a draw nor a frame changes. */
static bool any_varies(const struct irb_paired *p, int trials, int metric)
{
    for (int w = 0; w < trials; w++)
        for (int i = 1; i < p->count; i++)
            if (p->of[w][i] != p->of[w][0])
                return true;
    return metric == M(gl_bytes);
}

static bool all_finite(const struct irb_paired *p, int trials)
{
    for (int w = 0; w < trials; w++)
        for (int i = 0; i < p->count; i++)
            if (!isfinite(p->of[w][i]))
                return false;
    return true;
}

static void blocks_as_units(struct irb_paired *p, const struct common_seeds *c, int metric)
{
    int frames = c->count && is_of_frames(metric) ? seed_of(c, 0, 0)->frame_count : 0;
    allocate(p, frames);
    for (int f = 0; f < frames; f++)
        append(p, c->trials, frame_mean(c, 0, f, metric),
               c->trials > 1 ? frame_mean(c, 1, f, metric) : NAN);
    double means[2][IRB_BLOCKS_MOST];
    p->squares = is_square(metric);
    if (!all_finite(p, c->trials))
        p->count = 0;
    p->count = c->trials > 1 ? irb_blocks_pair(p->of[0], p->of[1], p->count, means[0], means[1])
                             : irb_blocks(p->of[0], p->count, means[0]);
    for (int w = 0; w < c->trials; w++)
        memcpy(p->of[w], means[w], (size_t)p->count * sizeof *means[w]);
}

static double common_mean(const struct common_seeds *c, int which, int metric)
{
    double sum = 0;
    for (int i = 0; i < c->count; i++)
        sum += seed_of(c, which, i)->values[metric];
    return c->count ? sum / c->count : NAN;
}

struct irb_paired irb_paired_units(const struct irb_analysis_trial *a,
                                   const struct irb_analysis_trial *b, int metric)
{
    static void (*const made_of[])(struct irb_paired *, const struct common_seeds *, int) = {
        [IRB_UNIT_SEED] = seeds_as_units,
        [IRB_UNIT_REPEAT] = rounds_as_units,
        [IRB_UNIT_BLOCK] = blocks_as_units,
    };
    struct irb_paired p = {.unit = IRB_UNIT_NONE};
    struct common_seeds c = find_common(a, b, metric);
    for (int w = 0; w < c.trials; w++)
        p.mean[w] = common_mean(&c, w, metric);
    bool enough = metric == M(frame_ms_worst); /* no mean of anything */
    for (int unit = IRB_UNIT_SEED; !enough && unit <= IRB_UNIT_BLOCK; unit++) {
        made_of[unit](&p, &c, metric);
        enough = p.count >= IRB_INTERVAL_LEAST_UNITS && any_varies(&p, c.trials, metric);
        if (enough && all_finite(&p, c.trials))
            p.unit = (enum irb_unit)unit;
    }
    free(c.index);
    return p;
}

void irb_paired_free(struct irb_paired *p)
{
    free(p->of[0]);
    free(p->of[1]);
    *p = (struct irb_paired){0};
}

/* ---- intervals ---- */

/* The interval of squares as one of their roots, moved to the value that the tables show; by a
 * factor, so that nothing that is positive gets a negative end. */
static struct irb_interval at_value(struct irb_interval i, bool squares, double value)
{
    if (i.low == i.value && i.high == i.value)
        return (struct irb_interval){value, value, value, i.units};
    if (squares) {
        i.value = sqrt(i.value);
        i.low = sqrt(i.low > 0 ? i.low : isnan(i.low) ? i.low : 0);
        i.high = sqrt(i.high);
    }
    double factor = i.value > 0 && value > 0 ? value / i.value : 1;
    i.low *= factor;
    i.high *= factor;
    i.value = value;
    /* rounding alone must not put the value outside */
    i.low = i.low > value ? value : i.low;
    i.high = i.high < value ? value : i.high;
    return i;
}

/* The interval goes down to where the error would be without the reference's own noise, see
 * analysis.h. */
static struct irb_interval without_noise(const struct irb_analysis_trial *trial, int metric,
                                         struct irb_interval i)
{
    double noise = irb_trial_value(trial, M(reference_noise));
    double noise_rmse = irb_trial_value(trial, M(reference_noise_rmse));
    double flip_noise = irb_trial_value(trial, M(indirect_flip_noise));
    if (metric == M(indirect_relmse) && noise > 0)
        return irb_interval_less_noise(i, noise, false);
    if (metric == M(indirect_rmse) && noise_rmse > 0)
        return irb_interval_less_noise(i, noise_rmse * noise_rmse, true);
    if (metric == M(indirect_flip) && flip_noise > 0)
        return irb_interval_less_noise(i, flip_noise, false);
    return i;
}

struct irb_measure irb_trial_measure(const struct irb_analysis_trial *trial, int metric,
                                     double confidence)
{
    struct irb_measure m = {{irb_trial_value(trial, metric), NAN, NAN, 0}, IRB_UNIT_NONE};
    struct irb_paired p = irb_paired_units(trial, NULL, metric);
    if (p.unit != IRB_UNIT_NONE) {
        m.interval =
            at_value(irb_mean_interval(p.of[0], p.count, confidence), p.squares, m.interval.value);
        m.interval = without_noise(trial, metric, m.interval);
        if (irb_metrics[metric].better == IRB_BETTER_LOWER && m.interval.low < 0)
            m.interval.low = 0; /* none of these can be negative */
        m.unit = isnan(m.interval.low) ? IRB_UNIT_NONE : p.unit;
    }
    irb_paired_free(&p);
    return m;
}

bool irb_trial_at_noise(const struct irb_analysis_trial *trial, int metric)
{
    for (int c = 0; c < IRB_COLUMNS; c++)
        if (irb_columns[c].metric == metric && irb_columns[c].floor >= 0)
            return irb_trial_value(trial, irb_columns[c].compared) <=
                   irb_trial_value(trial, irb_columns[c].floor);
    return false;
}

double irb_trial_noise(const struct irb_analysis_trial *trial, int metric)
{
    for (int c = 0; c < IRB_COLUMNS; c++)
        if (irb_columns[c].metric == metric && irb_columns[c].compared == metric)
            return irb_trial_value(trial, irb_columns[c].floor);
    return NAN;
}

/* ---- two trials ---- */

static bool all_positive(const struct irb_paired *p)
{
    for (int w = 0; w < 2; w++)
        for (int i = 0; i < p->count; i++)
            if (!(p->of[w][i] > 0))
                return false;
    return p->mean[0] > 0 && p->mean[1] > 0;
}

static struct irb_measure ratio_of(const struct irb_paired *p, double confidence)
{
    struct irb_measure m = {{NAN, NAN, NAN, 0}, IRB_UNIT_NONE};
    if (p->mean[0] > 0 && p->mean[1] > 0)
        m.interval.value = p->mean[0] / p->mean[1];
    if (p->unit == IRB_UNIT_NONE || !all_positive(p))
        return m;
    struct irb_interval units = irb_ratio_interval(p->of[0], p->of[1], p->count, confidence);
    m.interval = at_value(units, p->squares, m.interval.value);
    m.unit = isnan(m.interval.low) ? IRB_UNIT_NONE : p->unit;
    return m;
}

struct irb_measure irb_analysis_ratio(const struct irb_analysis *analysis, int scene, int a, int b,
                                      int metric)
{
    const struct irb_analysis_trial *trials = analysis->scenes[scene].trials;
    if (trials[a].partial || trials[b].partial)
        return (struct irb_measure){{NAN, NAN, NAN, 0}, IRB_UNIT_NONE};
    struct irb_paired p = irb_paired_units(&trials[a], &trials[b], metric);
    struct irb_measure m = ratio_of(&p, analysis->confidence);
    irb_paired_free(&p);
    return m;
}

/* On which side of 0 the mean of a - best + weight (b - best) lies, 0 where its interval contains
 * that. false: there is no interval. */
static bool side_of(const struct irb_paired *p, double best, double weight, double confidence,
                    int *side)
{
    double *sums = malloc(((size_t)p->count + 1) * sizeof *sums);
    if (!sums)
        abort();
    for (int i = 0; i < p->count; i++)
        sums[i] = p->of[0][i] - best + weight * (p->of[1][i] - best);
    struct irb_interval interval = irb_mean_interval(sums, p->count, confidence);
    free(sums);
    *side = (interval.low > 0) - (interval.high < 0);
    return !isnan(interval.low) && !isnan(interval.high);
}

/* By the means, as the tables rank: with A and B what they are off the best, |A| < |B| where A - B
 * and A + B lie on opposite sides of 0. Both must be told from 0, so that what is as far off on the
 * other side is not taken for worse in more than 5 % of all cases (an intersection-union test:
 * Berger 1982). Where the best is at an end, A and B have one sign, and A - B says it alone. */
static enum irb_verdict compare_differences(const struct irb_paired *p, int metric,
                                            double confidence)
{
    enum irb_better better = irb_metrics[metric].better;
    int less, both = better == IRB_BETTER_HIGHER ? -1 : 1;
    if (better == IRB_BETTER_NONE)
        return IRB_VERDICT_SAME;
    if (!side_of(p, better == IRB_BETTER_ONE, -1, confidence, &less) ||
        ((better == IRB_BETTER_ONE || better == IRB_BETTER_ZERO) &&
         !side_of(p, better == IRB_BETTER_ONE, 1, confidence, &both)))
        return IRB_VERDICT_UNKNOWN;
    return less * both < 0   ? IRB_VERDICT_BETTER
           : less * both > 0 ? IRB_VERDICT_WORSE
                             : IRB_VERDICT_SAME;
}

static enum irb_verdict compare_units(const struct irb_paired *p, int metric, double confidence)
{
    if (p->unit == IRB_UNIT_NONE)
        return IRB_VERDICT_UNKNOWN;
    if (irb_metrics[metric].better != IRB_BETTER_LOWER || !all_positive(p))
        return compare_differences(p, metric, confidence);
    struct irb_interval i = ratio_of(p, confidence).interval;
    if (isnan(i.low) || isnan(i.high))
        return IRB_VERDICT_UNKNOWN;
    return i.high < 1 ? IRB_VERDICT_BETTER : i.low > 1 ? IRB_VERDICT_WORSE : IRB_VERDICT_SAME;
}

enum irb_verdict irb_analysis_compare(const struct irb_analysis *analysis, int scene, int a, int b,
                                      int metric)
{
    const struct irb_analysis_trial *trials = analysis->scenes[scene].trials;
    if (trials[a].partial || trials[b].partial)
        return IRB_VERDICT_UNKNOWN;
    struct irb_paired p = irb_paired_units(&trials[a], &trials[b], metric);
    enum irb_verdict verdict = compare_units(&p, metric, analysis->confidence);
    irb_paired_free(&p);
    return verdict;
}
