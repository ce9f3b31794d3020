/* SPDX-License-Identifier: MIT */
#include "core/report/table_text.h"
#include "core/report/table_view.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- layout: every cell as text first, then as wide as the widest of its column ---- */

struct cells {
    char *text; /* [row][column][CELL] */
    int width[IRB_COLUMNS], name_width;
    int spread_width[IRB_COLUMNS]; /* of text: 0 where no row has one */
};

enum { CELL = 64 };

static char *cell(const struct cells *cells, int row, int column)
{
    return cells->text + ((size_t)row * IRB_COLUMNS + (size_t)column) * CELL;
}

static const char *unit_of(int column)
{
    return irb_column_unit(&irb_columns[column]);
}

/* How the notation marks a value, and what stands before its spread. */
struct notation {
    const char *best;         /* round the value */
    const char *below, *same; /* behind it */
    const char *spread;
};

/* Fills the column's cells and makes it as wide as they are. */
static void lay_out_column(struct cells *cells, const struct irb_table_group *group, int c,
                           const struct notation *notation)
{
    const struct irb_column *column = &irb_columns[c];
    size_t title = strlen(column->title), unit = strlen(unit_of(c));
    cells->width[c] = (int)(title > unit ? title : unit);
    for (int r = 0; r < group->count; r++) {
        const struct irb_table_row *row = &group->rows[r];
        enum irb_mark mark = irb_table_mark(group, column, row);
        char number[32], spread[32];
        irb_table_number(number, row->metrics[column->metric], column->digits);
        irb_table_spread(spread, column, row);
        if ((int)strlen(spread) > cells->spread_width[c])
            cells->spread_width[c] = (int)strlen(spread);
        const char *best = mark == IRB_MARK_BEST ? notation->best : "";
        int length = snprintf(cell(cells, r, c), CELL, "%s%s%s%s", best, number, best,
                              mark == IRB_MARK_BELOW_FLOOR ? notation->below
                              : mark == IRB_MARK_SAME      ? notation->same
                                                           : "");
        if (notation->spread && *spread)
            length += snprintf(cell(cells, r, c) + length, (size_t)(CELL - length), "%s%s",
                               notation->spread, spread);
        if (length > cells->width[c])
            cells->width[c] = length;
    }
}

static struct cells lay_out(const struct irb_table_group *group, const struct notation *notation)
{
    struct cells cells = {.name_width = (int)strlen("trial")};
    cells.text = calloc((size_t)group->count * IRB_COLUMNS, CELL);
    if (!cells.text)
        abort();
    for (int c = 0; c < IRB_COLUMNS; c++)
        lay_out_column(&cells, group, c, notation);
    for (int r = 0; r < group->count; r++)
        if ((int)strlen(group->rows[r].name) > cells.name_width)
            cells.name_width = (int)strlen(group->rows[r].name);
    return cells;
}

/* ---- text ---- */

/* One character behind each number is kept for its mark, so that digits stay in line. */
static void text_cell(const struct irb_table_group *group, const struct cells *cells, int r, int c,
                      bool colour, struct irb_str *out)
{
    static const char *const marks[] = {" ", "*", "~", "="};
    const struct irb_column *column = &irb_columns[c];
    const struct irb_table_row *row = &group->rows[r];
    enum irb_mark mark = irb_table_mark(group, column, row);
    char number[32], spread[32];
    irb_table_number(number, row->metrics[column->metric], column->digits);
    irb_table_spread(spread, column, row);
    bool bold = colour && mark == IRB_MARK_BEST;
    irb_str_printf(out, "  %*s%s%s%s%s", cells->width[c] - (int)strlen(number), "",
                   bold ? "\033[1m" : "", number, marks[mark], bold ? "\033[0m" : "");
    if (cells->spread_width[c])
        irb_str_printf(out, " %s%-*s", *spread ? "+-" : "  ", cells->spread_width[c], spread);
}

/* A title or unit: over the values, with room for marks and spreads behind it. */
static void text_heading(const struct cells *cells, int c, const char *text, struct irb_str *out)
{
    int behind = cells->spread_width[c] ? cells->spread_width[c] + (int)strlen(" +-") : 0;
    irb_str_printf(out, "  %*s %*s", cells->width[c], text, behind, "");
}

static void text_header(const struct irb_table_group *group, const struct cells *cells,
                        struct irb_str *out)
{
    irb_str_printf(out, "  %-*s", cells->name_width, "trial");
    for (int c = 0; c < IRB_COLUMNS; c++)
        if (group->shown[c])
            text_heading(cells, c, irb_columns[c].title, out);
    irb_str_printf(out, "\n  %-*s", cells->name_width, "");
    for (int c = 0; c < IRB_COLUMNS; c++)
        if (group->shown[c])
            text_heading(cells, c, unit_of(c), out);
    irb_str_printf(out, "\n");
}

static void text_group(const struct irb_table_group *group, bool colour, struct irb_str *out)
{
    struct cells cells = lay_out(group, &(struct notation){"", "", "", NULL});
    irb_str_printf(out, "%s%s%s   ", colour ? "\033[1m" : "", group->rows->trial->scene,
                   colour ? "\033[0m" : "");
    irb_table_reference(group, out);
    irb_str_printf(out, "\n");
    text_header(group, &cells, out);
    for (int r = 0; r < group->count; r++) {
        irb_str_printf(out, "  %-*s", cells.name_width, group->rows[r].name);
        for (int c = 0; c < IRB_COLUMNS; c++)
            if (group->shown[c])
                text_cell(group, &cells, r, c, colour, out);
        irb_str_printf(out, "\n");
    }
    free(cells.text);
}

void irb_table_text(const struct irb_table_data *data, bool colour, struct irb_str *out)
{
    if (!data->row_count)
        irb_str_printf(out, "no trials yet\n");
    for (int first = 0; first < data->row_count;) {
        struct irb_table_group group = irb_table_group_at(data, first);
        text_group(&group, colour, out);
        irb_str_printf(out, "\n");
        first += group.count;
    }
    if (data->row_count)
        irb_table_foot("* ", data, out);
}

/* ---- Markdown ---- */

static void markdown_group(const struct irb_table_group *group, struct irb_str *out)
{
    struct cells cells = lay_out(group, &(struct notation){"**", "~", "=", " ± "});
    irb_str_printf(out, "### %s\n\n| %-*s |", group->rows->trial->scene, cells.name_width, "trial");
    for (int c = 0; c < IRB_COLUMNS; c++) {
        if (!group->shown[c])
            continue;
        char *title = *unit_of(c) ? irb_asprintf("%s [%s]", irb_columns[c].title, unit_of(c))
                                  : irb_strdup(irb_columns[c].title);
        if ((int)strlen(title) > cells.width[c])
            cells.width[c] = (int)strlen(title);
        irb_str_printf(out, " %*s |", cells.width[c], title);
        free(title);
    }
    irb_str_printf(out, "\n|:");
    for (int i = 0; i < cells.name_width + 1; i++)
        irb_str_printf(out, "-");
    irb_str_printf(out, "|");
    for (int c = 0; c < IRB_COLUMNS; c++) {
        for (int i = 0; group->shown[c] && i < cells.width[c] + 1; i++)
            irb_str_printf(out, "-");
        irb_str_printf(out, "%s", group->shown[c] ? ":|" : "");
    }
    for (int r = 0; r < group->count; r++) {
        irb_str_printf(out, "\n| %-*s |", cells.name_width, group->rows[r].name);
        for (int c = 0; c < IRB_COLUMNS; c++)
            if (group->shown[c])
                irb_str_printf(out, " %*s |", cells.width[c], cell(&cells, r, c));
    }
    irb_str_printf(out, "\n\n");
    free(cells.text);
    irb_table_reference(group, out);
    irb_str_printf(out, "\n\n");
}

void irb_table_markdown(const struct irb_table_data *data, struct irb_str *out)
{
    if (!data->row_count)
        irb_str_printf(out, "no trials yet\n");
    for (int first = 0; first < data->row_count;) {
        struct irb_table_group group = irb_table_group_at(data, first);
        markdown_group(&group, out);
        first += group.count;
    }
    if (data->row_count)
        irb_table_foot("Bold: ", data, out);
}
