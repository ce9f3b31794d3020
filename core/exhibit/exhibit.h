/* SPDX-License-Identifier: MIT
 *
 * An exhibit: a published table or figure that is measured again. It is the section `exhibit:` of
 * an experiment's config, which says what to make of the run's numbers and pictures, and what was
 * published. A run passes over it. Nothing of a method or of a paper stands in the program: names
 * of trials, stages, layers and all published values come from the file.
 *
 * What a cell of a table, or a panel of a grid of images, shows is a *place*: the table's own
 * settings, then what its row says, then what its column says; the later wins.
 */
#ifndef IRB_EXHIBIT_EXHIBIT_H
#define IRB_EXHIBIT_EXHIBIT_H

#include "core/base/error.h"

#include <stdbool.h>

/* ---- what is measured ---- */

enum irb_quantity_kind {
    IRB_QUANTITY_UNSET,
    IRB_QUANTITY_STAGES, /* {stages: [splat, pull-push]}: time of these together, ms a frame */
    IRB_QUANTITY_FRAME,  /* {frame: true} or {frame_without: [evaluate]}: of a frame, ms, less
                            these stages */
    IRB_QUANTITY_METRIC, /* {metric: indirect_flip}: core/score/metric_list.h, or METRIC@REGION */
    IRB_QUANTITY_STATISTIC, /* {statistic: points, frames: [36, 47]}: mean over these frames, both
                               ends included; without frames over all */
};

struct irb_quantity {
    enum irb_quantity_kind kind;
    char **names; /* owned, and so is each: stages; or the one metric or statistic */
    int count;
    int first_frame, last_frame; /* of a statistic; -1, -1 = all */
};

/* ---- tables ---- */

/* One row or column of a table, or what a cell has of both. NULL, negative and UNSET: not said. */
struct irb_place {
    char *title; /* owned; of a row or column */
    char *trial; /* label of a trial; owned. {row} and {column} in it are their titles */
    int scene; /* index among the config's scenes; -1 not said. `scene: 1` in the file is the first
                */
    double x;  /* the number that the row or column stands for; NaN: its title's, if it is one */
    struct irb_quantity quantity;
};

enum irb_exhibit_plot { IRB_PLOT_NONE, IRB_PLOT_BARS, IRB_PLOT_LINES, IRB_PLOT_STACKED };
extern const char *const irb_exhibit_plot_names[]; /* "none", "bars", "lines", "stacked", NULL */

struct irb_exhibit_table {
    char *title;                      /* "ISM rendering stage" */
    char *unit;                       /* "ms"; "" for none */
    struct irb_place all;             /* what all cells have */
    struct irb_place *rows, *columns; /* owned; at least one of each */
    int row_count, column_count;
    double *published; /* [row][column], NaN for none; NULL: nothing was published. Owned */
    int base;          /* column that ratios are to, -1: no ratios */
    bool ordered;      /* the published order of the columns is to be checked, in each row */
    enum irb_exhibit_plot plot;
    bool logarithmic; /* the plot's values */
    char *x_label;    /* of lines: what the columns' numbers are; "" */
};

/* ---- grids of images ---- */

/* A box of the image that is shown enlarged, with a frame in its colour. */
struct irb_inset {
    char *title;
    float box[4];    /* x0, y0 (upper left), x1, y1: fractions of the image */
    float colour[3]; /* display-referred, from a name of irb_inset_colours or #rrggbb */
};

/* A row or column of a grid, or a panel. */
struct irb_panel {
    char *title;
    char *trial;  /* label */
    char *minus;  /* label of a trial whose layer is subtracted; with `times` */
    double times; /* factor of the difference as the display shows it, or of the layer; 1 */
    char *layer;  /* "result", "indirect", "direct", "reference", "reference_indirect", "flip",
                     "signed_error", or the name of a debug layer */
    int scene;    /* as in struct irb_place */
    int frame;    /* -1 not said: the last one that is kept */
    int inset;    /* index of the inset that is shown, -1: the whole image */
};

struct irb_exhibit_grid {
    char *title;
    struct irb_panel all;
    struct irb_panel *rows, *columns;
    int row_count, column_count;
    struct irb_inset *insets; /* framed in panels that show a whole image of the camera */
    int inset_count;
    bool each_scene; /* one grid a scene of the config; else of the panels' scenes alone */
};

/* ---- layouts of buffers ---- */

struct irb_layout_row {
    char *object; /* name of an OpenGL object of the run */
    char *what;   /* as published: "Normal" */
    char *layout; /* as published: "X 16, Y 16" */
    int bits;     /* published, of a texel; -1 for none */
};

struct irb_exhibit_layout {
    char *title;
    char *holder; /* "gbuffer", "rsm", or the label of a trial */
    struct irb_layout_row *rows;
    int row_count;
    bool others; /* objects that were not published are listed as well */
};

/* ---- claims ---- */

enum irb_claim_kind {
    IRB_CLAIM_EXPONENT, /* of value = c x^e along a table's rows or columns, c of each line its own
                         */
    IRB_CLAIM_RATIO,    /* of one cell to another */
    IRB_CLAIM_SPREAD,   /* largest over smallest difference of two columns, over the rows */
    IRB_CLAIM_LARGEST,  /* x of the row in which a column is largest, in a table's rows */
    IRB_CLAIM_REACHES,  /* x at which a curve of trials comes down to another trial's error */
    IRB_CLAIM_SPEEDUP,  /* there: the other's time over the curve's */
};
extern const char *const irb_claim_kind_names[]; /* "exponent", ..., NULL */

struct irb_claim {
    char *id;   /* "evaluation-size" */
    char *says; /* the claim, in one sentence */
    char *source;
    char *because; /* the reason found where it does not hold here; "" */
    enum irb_claim_kind kind;
    double low, high; /* holds where the measured value lies in [low, high]; may be infinite */
    double algorithm; /* exponent of the algorithm itself, NaN for none */
    int table;        /* index of the table whose cells are meant */
    bool along_rows;  /* exponent: x are the rows' numbers; else the columns' */
    int row, column;  /* of the cell, or -1: all */
    int other_row, other_column; /* ratio, spread: of the second one */
    /* reaches, speed-up: rows of the table are the curve's trials, x theirs */
    int target_row;  /* row of the trial whose error, in `column`, is to be reached */
    int time_column; /* speed-up: column of the times */
};

/* ---- the whole ---- */

struct irb_exhibit {
    char *id; /* "table-6.1": letters, digits, '.', '-' */
    char *title;
    char *source;  /* where it was published, on what machine */
    char *notes;   /* what is different here, and why; "" */
    char **errors; /* metrics for the table of errors of all trials; owned, and so is each */
    int error_count;
    struct irb_exhibit_table *tables;
    struct irb_exhibit_grid *grids;
    struct irb_exhibit_layout *layouts;
    struct irb_claim *claims;
    int table_count, grid_count, layout_count, claim_count;
};

/* Reads the section of a config. variant: as irb_config_load, may be NULL. A config without such a
 * section is no error: *there is false, and nothing has to be destroyed. IRB_E_INPUT names file,
 * line and column. */
bool irb_exhibit_load(struct irb_exhibit *exhibit, const char *config_path, const char *variant,
                      bool *there, struct irb_error *err);
void irb_exhibit_destroy(struct irb_exhibit *exhibit);

#endif
