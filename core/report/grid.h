/* SPDX-License-Identifier: MIT
 *
 * A table of texts: filled cell by cell, row by row, the first row being titles; then written for
 * people in any of their formats. For core/report only.
 */
#ifndef IRB_REPORT_GRID_H
#define IRB_REPORT_GRID_H

#include "core/base/str.h"
#include "core/report/table.h"

/* Zero-initialise but for columns; free with irb_grid_free. */
struct irb_grid {
    int columns;
    int left;     /* how many of them, from the left, are words: left-aligned; at least 1 */
    char **cells; /* owned, and so is each */
    int count;
};

/* Appends a cell: a copy. */
void irb_grid_add(struct irb_grid *grid, const char *text);
/* Appends a cell and empties the text. */
void irb_grid_take(struct irb_grid *grid, struct irb_str *text);
/* IRB_TABLE_TEXT, _MD or _LATEX. caption: what stands over it, plain text. */
void irb_grid_write(const struct irb_grid *grid, enum irb_table_format format, bool colour,
                    const char *caption, struct irb_str *out);
void irb_grid_free(struct irb_grid *grid);

#endif
