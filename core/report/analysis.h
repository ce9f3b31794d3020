/* SPDX-License-Identifier: MIT
 *
 * What a run's numbers can bear: every metric of every trial with a confidence interval, and ratios
 * of two trials from paired units.
 *
 * The unit is what was repeated independently: a seed, where the trial has
 * IRB_INTERVAL_LEAST_UNITS of them; else, of times, a whole round of the sequence (seed and
 * repeat); else a block of frames that follow one another (frames themselves are not independent);
 * else there is none and no interval. Seeds stand for all that a method draws at random; blocks
 * tell from frame to frame only, and therefore speak of this sequence alone. Units that are all
 * equal, in one trial or in both of a pair, are none: seeds of a method that draws nothing would
 * make an interval of no width. Blocks of frames stand in for them. Of memory they are exact.
 *
 * While a run goes on, or after it was stopped, trials may have different frames of a scene. Those
 * with fewer than another are compared with none: see partial.
 *
 * Values are those of the tables. Of metrics that are roots of means of squares (RMSE, flicker)
 * blocks are means of squares, and the interval's ends are the roots. A time's value is a median
 * and its blocks are means: that interval is moved to the value by their ratio.
 *
 * The reference has noise of its own, which adds to an error and never takes from it on average. An
 * error's interval is therefore extended downwards by it: relMSE by reference_noise, RMSE by
 * reference_noise_rmse (squares again), FLIP by indirect_flip_noise; where these were not stored,
 * by nothing. Flicker's is not: reference_flicker is what the noise stays below, by an unknown
 * amount. Ratios are of the errors as measured: the same noise in both draws a ratio towards 1.
 */
#ifndef IRB_REPORT_ANALYSIS_H
#define IRB_REPORT_ANALYSIS_H

#include "core/report/names.h"
#include "core/score/metric_list.h"
#include "core/score/metrics.h"
#include "core/stats/interval.h"
#include "core/store/store.h"

#define IRB_CONFIDENCE 0.95

/* The metrics by which trials are ranked, and whose intervals are worth their time; all others have
 * their value alone. */
enum { IRB_RANKED_METRICS = 12 };
extern const int irb_ranked_metrics[IRB_RANKED_METRICS];

struct irb_measure {
    struct irb_interval interval; /* value: the table's; NaN low and high where unit is NONE */
    enum irb_unit unit;
};

/* A trial with one seed. */
struct irb_analysis_seed {
    int seed;
    double values[IRB_METRIC_COUNT]; /* of the sequence, as the tables have them; NaN for none */
    double *frames;                  /* [frame][metric] as stored; frame_ms is the mean over
                                        repeats; NaN for none; owned */
    int frame_count;
    struct irb_summary *rounds; /* frame times of each repeat, ms; NaN where the repeat is not
                                   whole; owned */
    int round_count;
    double *stage_ms; /* for each of the analysis' stages the mean over all frames and repeats: what
                         runs in some frames only is spread over all; NaN for none; owned */
    int stage_count;
};

struct irb_analysis_trial {
    char *method, *trial, *params_json; /* owned */
    struct irb_analysis_seed *seeds;    /* owned, seed_count >= 1 */
    int seed_count;
    struct irb_measure measures[IRB_METRIC_COUNT]; /* intervals: of irb_ranked_metrics */
    bool at_noise[IRB_METRIC_COUNT]; /* not above the reference's own noise: not ranked */
    int frames;                      /* that its numbers are of; 0 where the run does not say */
    bool partial; /* fewer than another trial of its scene has: not comparable with any */
};

struct irb_analysis_scene {
    char *name;                        /* owned */
    struct irb_analysis_trial *trials; /* owned; in the order of the tables */
    int trial_count;
};

struct irb_analysis {
    struct irb_analysis_scene *scenes; /* owned */
    int scene_count;
    struct irb_names stages; /* in the order in which they run */
    double confidence;
};

/* confidence in (0,1), IRB_CONFIDENCE as a rule. A run without trials has no scenes. */
bool irb_analysis_read(struct irb_analysis *analysis, struct irb_store *store, double confidence,
                       struct irb_error *err);
/* The same of rows that are read already, one a seed (irb_table_data_read_seeds). */
struct irb_table_data;
bool irb_analysis_of_rows(struct irb_analysis *analysis, const struct irb_table_data *data,
                          struct irb_store *store, double confidence, struct irb_error *err);
void irb_analysis_destroy(struct irb_analysis *analysis);

/* Indices, or -1 where there is none of that name. */
int irb_analysis_scene_find(const struct irb_analysis *analysis, const char *scene);
int irb_analysis_trial_find(const struct irb_analysis_scene *scene, const char *trial);

/* The metric of trial a over that of trial b of one scene, over the units that both have; its
 * value is the ratio of their means over the seeds that both have. NaN where there is none: a value
 * is missing, zero or negative, they have no seed in common, or one is partial. */
struct irb_measure irb_analysis_ratio(const struct irb_analysis *analysis, int scene, int a, int b,
                                      int metric);

/* How trial a stands to trial b by what is better in the metric: by the paired ratio, or, where the
 * best value is not 0 (energy ratios, dB) or a value is 0, by how far their means are from the
 * best, as they are ranked. */
enum irb_verdict {
    IRB_VERDICT_UNKNOWN, /* no interval, or one is partial */
    IRB_VERDICT_BETTER,
    IRB_VERDICT_WORSE,
    IRB_VERDICT_SAME, /* not distinguishable: the interval contains 1 (of a difference 0) */
};
enum irb_verdict irb_analysis_compare(const struct irb_analysis *analysis, int scene, int a, int b,
                                      int metric);

#endif
