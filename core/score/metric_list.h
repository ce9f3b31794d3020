/* SPDX-License-Identifier: MIT
 *
 * Every metric that is stored: the one list from which tables, `list metrics` and the documentation
 * take names, units and definitions.
 *
 * v is the method's image, r the reference: linear radiance in W/(m2 sr), over pixels with
 * geometry and over channels. eps = (0.01 * mean r of the sequence)^2. `indirect` is the indirect
 * radiance and `full` the whole image, both against bounce 1 with exact visibility: what is ranked.
 * `solution` is the whole image against bounces 1 to 16; `claim` the indirect image of a method
 * that models no indirect visibility (with the frame's parameters) against bounce 1 without it:
 * diagnostic, never ranked.
 *
 * Stage times have metrics of their own, stage_<name>_ms, named by the method's table of stages. In
 * a scene's named regions the metrics of IRB_REGION_METRICS are scored too, as METRIC@REGION.
 */
#ifndef IRB_SCORE_METRIC_LIST_H
#define IRB_SCORE_METRIC_LIST_H

#define IRB_RADIANCE_UNIT "W/(m2 sr)"

/* Of one ranked image: identifier prefix, what it is called in text. */
#define IRB_METRICS_OF_IMAGE(X, image, text)                                                       \
    X(image##_rmse, IRB_RADIANCE_UNIT, LOWER, text " image: RMSE, sqrt(mean (v-r)^2)")             \
    X(image##_relmse, "", LOWER, text " image: relative MSE, mean (v-r)^2/(r^2+eps)")              \
    X(image##_smape, "", LOWER, text " image: SMAPE, mean |v-r|/(|v|+|r|+sqrt(eps))")              \
    X(image##_psnr, "dB", HIGHER,                                                                  \
      text                                                                                         \
      " image: PSNR, 20 log10(peak/RMSE), peak = 99.9th percentile of the reference's values")     \
    X(image##_bias, IRB_RADIANCE_UNIT, ZERO, text " image: mean signed error, mean (v-r)")         \
    X(image##_energy_ratio, "", ONE, text " image: sum v / sum r")                                 \
    X(image##_flip, "", LOWER,                                                                     \
      text " image: mean HDR-FLIP (Andersson et al. 2021), exposures from the reference sequence") \
    X(image##_ssim, "", HIGHER,                                                                    \
      text " image: mean SSIM (Wang et al. 2004, 11x11 Gaussian, sigma 1.5) on the luma of the "   \
           "fixed-exposure tone-mapped sRGB image")                                                \
    X(image##_ldr_flip, "", LOWER,                                                                 \
      text                                                                                         \
      " image: mean LDR-FLIP (Andersson et al. 2020) of the fixed-exposure tone-mapped image")     \
    X(image##_temporal_flip, "", LOWER,                                                            \
      text " image: mean LDR-FLIP, at the fixed exposure, between v_t and "                        \
           "max(0, v_(t-1) + r_t - r_(t-1))")                                                      \
    X(image##_flicker, "", LOWER,                                                                  \
      text " image: sqrt(mean |e_t - e_(t-1)|^2) / mean r, where e = v - r")                       \
    X(image##_pop_share, "", LOWER,                                                                \
      text " image: share of pixels where |e_t - e_(t-1)| > 0.1 max(r_t, 0.1 mean r)")

/* X(name, unit, what is better, one line) */
#define IRB_METRICS(X)                                                                             \
    IRB_METRICS_OF_IMAGE(X, indirect, "indirect")                                                  \
    IRB_METRICS_OF_IMAGE(X, full, "full")                                                          \
    X(lag, "frames", ZERO,                                                                         \
      "shift tau, -3 to 8, with the least mean |v_t - r_(t-tau)| of the indirect image over the "  \
      "sequence; camera and objects at rest")                                                      \
    X(solution_rmse, IRB_RADIANCE_UNIT, LOWER,                                                     \
      "full image against bounces 1 to 16: RMSE, sqrt(mean (v-r)^2)")                              \
    X(solution_relmse, "", LOWER,                                                                  \
      "full image against bounces 1 to 16: relative MSE, mean (v-r)^2/(r^2+eps)")                  \
    X(solution_energy_ratio, "", ONE, "full image against bounces 1 to 16: sum v / sum r")         \
    X(claim_rmse, IRB_RADIANCE_UNIT, LOWER,                                                        \
      "indirect image against bounce 1 without visibility (diagnostic): RMSE")                     \
    X(claim_relmse, "", LOWER,                                                                     \
      "indirect image against bounce 1 without visibility (diagnostic): relative MSE")             \
    X(claim_energy_ratio, "", ONE,                                                                 \
      "indirect image against bounce 1 without visibility (diagnostic): sum v / sum r")            \
    X(non_finite, "pixels", LOWER, "pixels with a NaN or an infinity, left out of the errors")     \
    X(negative, "pixels", LOWER, "pixels with a negative channel")                                 \
    X(masked_share, "", NONE,                                                                      \
      "share of the pixels with geometry that are left out because the run's G-buffer is not the " \
      "reference's there")                                                                         \
    X(uncovered_flux, "", LOWER,                                                                   \
      "share of the RSM's reflected flux that no virtual light stands for")                        \
    X(clamped_light, "", LOWER,                                                                    \
      "share of the indirect irradiance without a clamp that the method's clamp took")             \
    X(reference_noise, "", NONE,                                                                   \
      "relative MSE that the reference's own noise makes in the indirect image; an error below "   \
      "it is not ranked")                                                                          \
    X(reference_noise_rmse, IRB_RADIANCE_UNIT, NONE,                                               \
      "RMSE that the reference's own noise makes in the indirect image")                           \
    X(reference_flicker, "", NONE,                                                                 \
      "most flicker that the reference's own noise can make, were it another in each frame; its "  \
      "samples stay from frame to frame, so it is less")                                           \
    X(indirect_flip_noise, "", NONE,                                                               \
      "by how much indirect_flip grows in the middle frame with as much noise again in the "       \
      "reference: indirect_flip less this estimates FLIP against a reference without noise "       \
      "(Cook and Stefanski 1994)")                                                                 \
    X(frame_ms, "ms", LOWER, "time of a frame, median over the sequence and its repeats")          \
    X(frame_ms_mean, "ms", LOWER,                                                                  \
      "time of a frame, mean over the sequence: what happens in some frames only is spread over "  \
      "all")                                                                                       \
    X(frame_ms_p95, "ms", LOWER, "time of a frame, 95th percentile (nearest rank)")                \
    X(frame_ms_worst, "ms", LOWER, "time of a frame, the slowest one")                             \
    X(precompute_ms, "ms", LOWER,                                                                  \
      "what is paid once, before the first frame: making the method's state")                      \
    X(gl_bytes, "bytes", LOWER, "bytes of OpenGL objects that the method holds")

/* Scored in regions: X(name). */
#define IRB_REGION_METRICS_OF_IMAGE(X, image)                                                      \
    X(image##_rmse)                                                                                \
    X(image##_relmse)                                                                              \
    X(image##_bias)                                                                                \
    X(image##_flip)                                                                                \
    X(image##_flicker)                                                                             \
    X(image##_pop_share)                                                                           \
    X(image##_temporal_flip)
#define IRB_REGION_METRICS(X)                                                                      \
    IRB_REGION_METRICS_OF_IMAGE(X, indirect) IRB_REGION_METRICS_OF_IMAGE(X, full)

enum irb_metric {
#define X(name, unit, better, doc) IRB_METRIC_##name,
    IRB_METRICS(X)
#undef X
        IRB_METRIC_COUNT
};

/* The metrics that are scored in regions, as indices into irb_metrics. */
enum {
#define X(name) +1
    IRB_REGION_METRIC_COUNT = 0 IRB_REGION_METRICS(X)
#undef X
};
extern const int irb_region_metrics[IRB_REGION_METRIC_COUNT];

/* Where the best value of a metric lies. */
enum irb_better {
    IRB_BETTER_LOWER,
    IRB_BETTER_HIGHER,
    IRB_BETTER_ONE,  /* the nearer to one */
    IRB_BETTER_ZERO, /* the nearer to zero, from both sides */
    IRB_BETTER_NONE, /* says something about the measurement, not about the method */
};

struct irb_metric_info {
    const char *name;
    const char *unit; /* "" for a ratio */
    enum irb_better better;
    const char *doc; /* one line: the definition */
};

extern const struct irb_metric_info irb_metrics[IRB_METRIC_COUNT];

/* Index into irb_metrics, -1 where there is none of that name. */
int irb_metric_find(const char *name);

/* The metric of "METRIC@REGION", -1 where it is none of the metrics scored in regions. */
int irb_region_metric_find(const char *name);

/* "lower", "higher", "one", "zero", "none". */
const char *irb_better_name(enum irb_better better);

/* How the values of frames become a sequence's: those of the whole image and those of a region
 * alike. PSNR, energy ratios and the lag are made of others instead. */
enum irb_aggregate { IRB_AGGREGATE_MEAN, IRB_AGGREGATE_ROOT_MEAN_SQUARE, IRB_AGGREGATE_SUM };
enum irb_aggregate irb_metric_aggregate(int metric);
/* Of n frames' values, their sum and that of their squares; NaN for none. */
double irb_metric_of_frames(int metric, double sum, double squares, int n);

/* Of a sequence's reference images: the mean (<= 0 or NaN where it is black or unknown) and PSNR's
 * peak. */
struct irb_sequence_scale {
    double mean_indirect, mean_full, peak_indirect, peak_full;
};
/* What a sequence has from others of its values: PSNR from the RMSE, energy ratios from the bias,
 * NaN without a mean. */
void irb_metrics_derive(double values[IRB_METRIC_COUNT], const struct irb_sequence_scale *scale);

/* How far a value is from the best: smaller is better, whatever the metric; NaN stays NaN, and a
 * metric that ranks nothing gives 0. */
double irb_metric_badness(int metric, double value);

#endif
