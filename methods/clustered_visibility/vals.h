/* SPDX-License-Identifier: MIT
 *
 * Virtual area lights (VALs): clusters of virtual point lights by k-means (Dong et al. 2009; thesis
 * 3.2.5), in one work group, until no VPL changes its VAL.
 *
 *     mu(c, x) = w_x |x - c| + w_a angle(n_x, n_c)     (eq. 3.7)
 *
 * A tie goes to the VAL of lower number. The VALs of a start are the first k VPLs of the sequence
 * that those are drawn by: the same assignment to begin with in every frame. Or they are those of
 * the frame before, and then one that lost all its VPLs takes no further part (figure 3.9).
 */
#ifndef IRB_METHODS_CLUSTERED_VISIBILITY_VALS_H
#define IRB_METHODS_CLUSTERED_VISIBILITY_VALS_H

#include "core/gl/program.h"
#include "core/lights/virtual_light.h"

enum { CV_MOST_VPLS = 2048, CV_MOST_VALS = 128 };

enum cv_start { CV_RESTART, CV_REUSE };
enum cv_extent { CV_EXTENT_MOMENT, CV_EXTENT_MAX };
enum cv_centre { CV_CENTRE_MEAN, CV_CENTRE_LIFTED, CV_CENTRE_MEMBER };
extern const char *const cv_start_names[];  /* "restart", "reuse", NULL */
extern const char *const cv_extent_names[]; /* "moment", "max", NULL */
extern const char *const cv_centre_names[]; /* "mean", "lifted", "member", NULL */

struct cv_cluster_settings {
    int vals;              /* k, 1..CV_MOST_VALS */
    float weight_distance; /* w_x, 1/m */
    float weight_angle;    /* w_a, 1/rad */
    int iterations;        /* at most, >= 1 */
    enum cv_start start;
    enum cv_extent extent; /* radius of a VAL: of the disc with its VPLs' second moment, which is
                              sqrt(2 mean |x - c|^2), or to its farthest VPL */
    enum cv_centre centre; /* where its shadow map stands: at the mean of its VPLs; that, lifted
                              along the mean normal to the height of the highest of them; or at the
                              VPL that is nearest to it */
    int tiles;             /* of interleaved sampling, as the VPLs were drawn with: n m */
};

/* A VAL as a virtual light (core/lights/virtual_light.h), with a count in the place of a zero. */
struct cv_val {
    float position[3], area; /* m; pi radius^2, m2 */
    float normal[3], vpls;   /* unit, or 0 where it is empty; how many it has */
    float flux[3], unused;   /* W: their sum */
};

struct cv_statistics {
    int in_use;     /* VALs that have VPLs */
    int iterations; /* assignments; the last one changed nothing if converged */
    bool converged;
};

struct cv_vals {
    struct irb_gl *gl;             /* borrowed */
    struct irb_buffer *vals;       /* struct cv_val each, one block of IRB_VPL_BLOCK */
    struct irb_buffer *assignment; /* uint a VPL: its VAL */
    struct irb_buffer *ordered; /* VPLs by tile, then VAL, then number, in whole blocks; the VAL in
                                   the normal's w */
    int count;                  /* k of the last run */
    int vpls;                   /* in the order */
    bool has_history;           /* of as many VALs */
    struct irb_buffer *means, *statistics; /* private, as the programs */
    struct irb_program *kmeans, *finish, *order;
};

struct cv_vals *cv_vals_create(struct irb_gl *gl, struct irb_error *err);
void cv_vals_destroy(struct cv_vals *vals);
/* The next run starts anew. */
void cv_vals_forget(struct cv_vals *vals);

/* Clusters up to CV_MOST_VPLS lights. None at all make no VAL, and leave history as it is. Same
 * input, same bits. */
bool cv_vals_cluster(struct cv_vals *vals, const struct irb_virtual_lights *vpls,
                     const struct cv_cluster_settings *settings, struct irb_error *err);
/* Fills `ordered`. */
bool cv_vals_order(struct cv_vals *vals, const struct irb_virtual_lights *vpls, int tiles,
                   struct irb_error *err);

/* Waits for the GPU. */
bool cv_vals_statistics(const struct cv_vals *vals, struct cv_statistics *out,
                        struct irb_error *err);

/* As lights that shadow maps are rendered for. */
static inline struct irb_virtual_lights cv_vals_view(const struct cv_vals *vals)
{
    return (struct irb_virtual_lights){.buffer = vals->vals, .count = vals->count};
}

#endif
