/* SPDX-License-Identifier: MIT
 *
 * Virtual area lights (VALs): clusters of virtual lights, here called VPLs though they may have
 * areas, by k-means (Dong et al. 2009; thesis 3.2.5), in one work group, until no VPL changes its
 * VAL. Dark ones belong to none.
 *
 *     mu(c, x) = w_x |x - c| + w_a angle(n_x, n_c)     (eq. 3.7)
 *
 * A tie goes to the VAL of lower number. The VALs of a start are the first k lit VPLs of the
 * sequence that those are drawn by: the same assignment to begin with in every frame. Or they are
 * those of the frame before, and then one that lost all its VPLs takes no further part
 * (figure 3.9).
 */
#ifndef IRB_LIGHTS_VALS_H
#define IRB_LIGHTS_VALS_H

#include "core/gl/program.h"
#include "core/lights/virtual_light.h"

enum { IRB_VALS_MOST_LIGHTS = 2048, IRB_VALS_MOST = 128 };

enum irb_vals_start { IRB_VALS_RESTART, IRB_VALS_REUSE };
enum irb_vals_area { IRB_VALS_AREA_MOMENT, IRB_VALS_AREA_MAX };
enum irb_vals_centre { IRB_VALS_CENTRE_MEAN, IRB_VALS_CENTRE_LIFTED, IRB_VALS_CENTRE_MEMBER };
extern const char *const irb_vals_start_names[];  /* "restart", "reuse", NULL */
extern const char *const irb_vals_area_names[];   /* "moment", "max", NULL */
extern const char *const irb_vals_centre_names[]; /* "mean", "lifted", "member", NULL */

struct irb_vals_settings {
    int vals;              /* k, 1..IRB_VALS_MOST */
    float weight_distance; /* w_x, 1/m */
    float weight_angle;    /* w_a, 1/rad */
    int iterations;        /* at most, >= 1 */
    enum irb_vals_start start;
    enum irb_vals_area area;     /* of a VAL: of the disc with its VPLs' second moment, of radius
                                  sqrt(2 mean |x - c|^2 + mean A/pi), or to the rim of its farthest
                                  VPL */
    enum irb_vals_centre centre; /* where its shadow map stands: at the mean of its VPLs; that,
                              lifted along the mean normal to the height of the highest of them; or
                              at the VPL that is nearest to it */
    int tiles;                   /* of interleaved sampling, as the VPLs were drawn with: n m */
};

/* A VAL as a virtual light (core/lights/virtual_light.h), with a count in the place of a zero. */
struct irb_val {
    float position[3], area; /* m; pi radius^2, m2 */
    float normal[3], vpls;   /* unit, or 0 where it is empty; how many it has */
    float flux[3], unused;   /* W: their sum */
};

struct irb_vals_statistics {
    int in_use;     /* VALs that have VPLs */
    int iterations; /* assignments; the last one changed nothing if converged */
    bool converged;
};

struct irb_vals {
    struct irb_gl *gl;             /* borrowed */
    struct irb_buffer *vals;       /* struct irb_val each, one block of IRB_VPL_BLOCK */
    struct irb_buffer *assignment; /* uint a VPL: its VAL */
    struct irb_buffer *ordered; /* VPLs by tile, then VAL, then number, in whole blocks; the VAL in
                                   the normal's w; -1 in that of dark ones, which come last */
    int count;                  /* k of the last run */
    int vpls;                   /* in the order */
    bool has_history;           /* of as many VALs */
    struct irb_buffer *means, *statistics; /* private, as the programs */
    struct irb_program *kmeans, *finish, *order;
};

struct irb_vals *irb_vals_create(struct irb_gl *gl, struct irb_error *err);
void irb_vals_destroy(struct irb_vals *vals);
/* The next run starts anew. */
void irb_vals_forget(struct irb_vals *vals);

/* Clusters up to IRB_VALS_MOST_LIGHTS lights. None at all make no VAL, and leave history as it is.
 * Same input, same bits. */
bool irb_vals_cluster(struct irb_vals *vals, const struct irb_virtual_lights *vpls,
                      const struct irb_vals_settings *settings, struct irb_error *err);
/* Fills `ordered`. */
bool irb_vals_order(struct irb_vals *vals, const struct irb_virtual_lights *vpls, int tiles,
                    struct irb_error *err);

/* Waits for the GPU. */
bool irb_vals_statistics(const struct irb_vals *vals, struct irb_vals_statistics *out,
                         struct irb_error *err);

/* As lights that shadow maps are rendered for. */
static inline struct irb_virtual_lights irb_vals_view(const struct irb_vals *vals)
{
    return (struct irb_virtual_lights){.buffer = vals->vals, .count = vals->count};
}

#endif
