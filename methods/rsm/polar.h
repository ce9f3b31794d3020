/* SPDX-License-Identifier: MIT
 *
 * The paper's gather (Dachsbacher and Stamminger 2005, section 4.1): each receiver looks up the
 * texels round its own place in the light's image, by one pattern of samples.
 */
#ifndef IRB_METHODS_RSM_POLAR_H
#define IRB_METHODS_RSM_POLAR_H

#include "methods/rsm/pixels.h"

#include <stdint.h>

/* Samples in one uniform block: 16 bytes each, 32 KiB. */
enum { RSM_PATTERN_BLOCK = 2048, RSM_PATTERN_BYTES = 16 };

enum rsm_weight {
    RSM_WEIGHT_XI2, /* the paper's xi_1^2, normalised so that a constant is exact; biased */
    RSM_WEIGHT_XI1, /* 2 pi r_max^2 xi_1/N, the inverse of the samples' density; unbiased */
};
extern const char *const rsm_weight_names[]; /* "xi2", "xi1", NULL */

enum rsm_fetch {
    RSM_FETCH_PACKED, /* a texel in 16 bytes, one fetch */
    RSM_FETCH_FULL,   /* position, normal and flux from the RSM as it is */
};
extern const char *const rsm_fetch_names[]; /* "packed", "full", NULL */

/* All that the pattern depends on. */
struct rsm_pattern {
    int samples;    /* N */
    float radius;   /* r_max as a share of the map's side */
    int weight;     /* enum rsm_weight */
    uint32_t first; /* point of the Halton sequence, its point 0 apart */
    int resolution; /* of the RSM */
};

/* Sample i = 0.. of a pattern: offset in texels, and how many texels it stands for. */
void rsm_pattern_sample(const struct rsm_pattern *pattern, double square_sum, int i, float out[3]);
/* Sum of xi_1^2 over the samples: what XI2 is normalised with. */
double rsm_pattern_square_sum(const struct rsm_pattern *pattern);

struct rsm_polar {
    struct rsm_programs programs;
    struct irb_program *pack[2]; /* by the RSM's layout */
    struct irb_texture *packed;  /* RGBA32UI, (resolution + 2)^2; NULL until it is needed */
    struct irb_buffer *samples;  /* of `pattern` */
    struct rsm_pattern pattern;
};

struct rsm_polar *rsm_polar_create(struct irb_gl *gl, struct irb_error *err);
void rsm_polar_destroy(struct rsm_polar *polar);

/* Makes what the frame's gather needs: the pattern, where it is another one, and the packed map
 * unless `fetch` is FULL. */
bool rsm_polar_prepare(struct rsm_polar *polar, const struct irb_rsm *rsm,
                       const struct rsm_pattern *pattern, int fetch, struct irb_error *err);

struct rsm_polar_settings {
    int fetch;           /* enum rsm_fetch */
    float bound;         /* largest cos cos/r^2, 1/m2; 0 for none */
    float normal_offset; /* m */
};

/* After rsm_polar_prepare() with the same RSM. Same input, same bits. */
bool rsm_polar_run(struct rsm_polar *polar, const struct rsm_pixels *pixels,
                   const struct irb_rsm *rsm, const struct rsm_polar_settings *settings,
                   struct irb_error *err);

#endif
