/* SPDX-License-Identifier: MIT
 *
 * What all tables of numbers for programs have in common: how CSV (RFC 4180, but for its line ends,
 * which are plain) and JSON print a cell, and how a trial's row begins. For core/report only.
 */
#ifndef IRB_REPORT_TABLE_CELLS_H
#define IRB_REPORT_TABLE_CELLS_H

#include "core/base/str.h"
#include "core/report/analysis.h"
#include "core/report/table_data.h"

/* Quoted where it has to be. */
void irb_csv_text(struct irb_str *out, const char *text);
/* A comma and the number; nothing behind it for NaN. */
void irb_csv_number(struct irb_str *out, double value);
/* Value, low and high. */
void irb_csv_measure(struct irb_str *out, const struct irb_measure *measure);
/* A comma and "BEFORE NAME BEHIND" as one text. */
void irb_csv_title(struct irb_str *out, const char *before, const char *name, const char *behind);
/* ", "BEFORE NAME BEHIND": number" */
void irb_json_member(struct irb_str *out, const char *before, const char *name, const char *behind,
                     double value);

/* scene, method, trial, params, seed, seeds: the titles, and a row's values. JSON's object is left
 * open. */
void irb_csv_row_titles(struct irb_str *out);
void irb_csv_row_begin(struct irb_str *out, const struct irb_table_row *row);
void irb_json_row_begin(struct irb_str *out, const struct irb_table_row *row);

#endif
