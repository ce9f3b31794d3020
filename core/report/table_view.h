/* SPDX-License-Identifier: MIT
 *
 * What tables for people have in common: which columns they show, which values are marked and how
 * numbers are printed. For core/report only.
 */
#ifndef IRB_REPORT_TABLE_VIEW_H
#define IRB_REPORT_TABLE_VIEW_H

#include "core/base/str.h"
#include "core/report/table_data.h"

/* A column that people are shown. */
struct irb_column {
    int metric;
    const char *title;
    int digits;       /* significant */
    int floor;        /* metric whose value this one must exceed to be ranked, or -1 */
    int compared;     /* metric that is held against the floor: of one kind with it */
    bool only_if_any; /* left out where all trials have 0 */
    bool spread;      /* shown with its spread over several seeds */
};
enum { IRB_COLUMNS = 14 };
extern const struct irb_column irb_columns[IRB_COLUMNS];

/* The trials of one scene. */
struct irb_table_group {
    const struct irb_table_row *rows;
    int count;
    bool shown[IRB_COLUMNS];
    bool spread[IRB_COLUMNS]; /* some row has one */
    bool any_below;           /* a value that is not ranked is shown */
    int frames;               /* most that a row is of: rows of fewer are not ranked */
};

enum irb_mark { IRB_MARK_NONE, IRB_MARK_BEST, IRB_MARK_BELOW_FLOOR, IRB_MARK_SAME };

/* Finds all rows that are not distinguishable from the best of their column and scene. */
void irb_table_find_same(struct irb_table_data *data);
/* The group that begins at row `first`. */
struct irb_table_group irb_table_group_at(const struct irb_table_data *data, int first);
enum irb_mark irb_table_mark(const struct irb_table_group *group, const struct irb_column *column,
                             const struct irb_table_row *row);
/* "" for a ratio. */
const char *irb_column_unit(const struct irb_column *column);

/* 3 or 4 significant digits, without an exponent where that is short; "-" for NaN. */
void irb_table_number(char out[32], double value, int digits);
/* The column's spread over the seeds, or "" where it shows none. */
void irb_table_spread(char out[32], const struct irb_column *column,
                      const struct irb_table_row *row);

/* "reference: noise ..., flicker floor <= ...; how the scene was scored" */
void irb_table_reference(const struct irb_table_group *group, struct irb_str *out);

/* What the marks mean (`best` says how the best value is marked), what is compared with what, over
 * how many seeds, and where the numbers come from. */
void irb_table_foot(const char *best, const struct irb_table_data *data, struct irb_str *out);
/* The end of that: over how many seeds, with their spread or without, and where from. */
void irb_table_foot_seeds(const struct irb_table_data *data, bool spread, struct irb_str *out);

#endif
