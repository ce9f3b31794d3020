/* SPDX-License-Identifier: MIT */
#include "core/report/table_text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A column that people are shown. */
struct column {
    int metric;
    const char *title;
    int digits;       /* significant */
    int floor;        /* metric whose value this one must exceed to be ranked, or -1 */
    int compared;     /* metric that is held against the floor: of one kind with it */
    bool only_if_any; /* left out where all trials have 0 */
};

#define M(name) IRB_METRIC_##name

/* The indirect image is what is ranked; the full image and the whole solution come after it. The
 * reference's noise is known as a relMSE of the indirect image, so that this decides for the other
 * errors of the same image too. */
static const struct column columns[] = {
    {M(indirect_relmse), "relMSE", 3, M(reference_noise), M(indirect_relmse), false},
    {M(indirect_rmse), "RMSE", 3, M(reference_noise), M(indirect_relmse), false},
    {M(indirect_flip), "FLIP", 3, M(reference_noise), M(indirect_relmse), false},
    {M(indirect_energy_ratio), "energy", 4, -1, -1, false},
    {M(indirect_flicker), "flicker", 3, M(reference_flicker), M(indirect_flicker), false},
    {M(indirect_pop_share), "pops", 3, -1, -1, false},
    {M(full_flip), "full FLIP", 3, -1, -1, false},
    {M(solution_relmse), "solution relMSE", 3, -1, -1, false},
    {M(lost_energy), "lost", 3, -1, -1, true},
    {M(non_finite), "non-finite", 3, -1, -1, true},
    {M(frame_ms), "frame", 3, -1, -1, false},
    {M(frame_ms_p95), "p95", 3, -1, -1, false},
    {M(frame_ms_worst), "worst", 3, -1, -1, false},
};
enum { COLUMNS = sizeof columns / sizeof *columns };

/* The trials of one scene. */
struct group {
    const struct irb_table_row *rows;
    int count;
    bool shown[COLUMNS];
    bool any_below; /* a value that is not ranked is shown */
};

enum mark { PLAIN, BEST, BELOW_FLOOR };

/* 3 or 4 significant digits, without an exponent where that is short. */
static void print_number(char out[32], double value, int digits)
{
    double size = fabs(value);
    if (isnan(value))
        snprintf(out, 32, "-");
    else if (value == 0)
        snprintf(out, 32, "0");
    else if (isinf(value) || size < 1e-4 || size >= 1e6)
        snprintf(out, 32, "%.*e", digits - 1, value);
    else {
        int decimals = digits - 1 - (int)floor(log10(size));
        snprintf(out, 32, "%.*f", decimals > 0 ? decimals : 0, value);
    }
}

static bool below_floor(const struct column *column, const struct irb_table_row *row)
{
    return column->floor >= 0 && row->metrics[column->compared] <= row->metrics[column->floor];
}

/* The smallest badness of the ranked values; NaN where there is nothing to choose between. */
static double best_of(const struct group *group, const struct column *column)
{
    double best = NAN;
    int ranked = 0;
    for (int i = 0; i < group->count; i++) {
        const struct irb_table_row *row = &group->rows[i];
        double badness = irb_metric_badness(column->metric, row->metrics[column->metric]);
        if (isnan(badness))
            continue;
        ranked++;
        if (!below_floor(column, row) && !(badness >= best))
            best = badness;
    }
    return ranked > 1 ? best : NAN;
}

static enum mark mark_of(const struct group *group, const struct column *column,
                         const struct irb_table_row *row)
{
    double value = row->metrics[column->metric];
    if (isnan(value))
        return PLAIN;
    if (below_floor(column, row))
        return BELOW_FLOOR;
    return irb_metric_badness(column->metric, value) == best_of(group, column) ? BEST : PLAIN;
}

static bool column_shown(const struct group *group, const struct column *column)
{
    for (int i = 0; i < group->count; i++) {
        double value = group->rows[i].metrics[column->metric];
        if (!isnan(value) && (!column->only_if_any || value != 0))
            return true;
    }
    return false;
}

/* The group that begins at row `first`. */
static struct group group_at(const struct irb_table_data *data, int first)
{
    struct group group = {.rows = &data->rows[first]};
    const char *scene = group.rows->trial->scene;
    while (first + group.count < data->row_count &&
           !strcmp(data->rows[first + group.count].trial->scene, scene))
        group.count++;
    for (int c = 0; c < COLUMNS; c++) {
        group.shown[c] = column_shown(&group, &columns[c]);
        for (int i = 0; group.shown[c] && i < group.count; i++)
            if (mark_of(&group, &columns[c], &group.rows[i]) == BELOW_FLOOR)
                group.any_below = true;
    }
    return group;
}

/* The largest value of a property of the measurement; NaN where no trial has it. */
static double largest(const struct group *group, int metric)
{
    double most = NAN;
    for (int i = 0; i < group->count; i++)
        if (!(group->rows[i].metrics[metric] <= most) && !isnan(group->rows[i].metrics[metric]))
            most = group->rows[i].metrics[metric];
    return most;
}

static void print_reference(const struct group *group, struct irb_str *out)
{
    char noise[32], flicker[32];
    print_number(noise, largest(group, M(reference_noise)), 3);
    print_number(flicker, largest(group, M(reference_flicker)), 3);
    const char *choices = group->rows->choices;
    irb_str_printf(out, "reference: noise %s (relMSE), flicker floor %s%s%s", noise, flicker,
                   *choices ? "; " : "", choices);
}

/* ---- layout: every cell as text first, then as wide as the widest of its column ---- */

struct cells {
    char *text; /* [row][column][CELL] */
    int width[COLUMNS], name_width;
};

enum { CELL = 40 };

static char *cell(const struct cells *cells, int row, int column)
{
    return cells->text + ((size_t)row * COLUMNS + (size_t)column) * CELL;
}

static const char *unit_of(int column)
{
    return irb_metrics[columns[column].metric].unit;
}

/* `best` and `below` are put round and behind a value. */
static struct cells lay_out(const struct group *group, const char *best, const char *below)
{
    struct cells cells = {.name_width = (int)strlen("trial")};
    cells.text = calloc((size_t)group->count * COLUMNS, CELL);
    if (!cells.text)
        abort();
    for (int c = 0; c < COLUMNS; c++) {
        size_t title = strlen(columns[c].title), unit = strlen(unit_of(c));
        cells.width[c] = (int)(title > unit ? title : unit);
        for (int r = 0; r < group->count; r++) {
            const struct irb_table_row *row = &group->rows[r];
            enum mark mark = mark_of(group, &columns[c], row);
            char number[32];
            print_number(number, row->metrics[columns[c].metric], columns[c].digits);
            int length =
                snprintf(cell(&cells, r, c), CELL, "%s%s%s", mark == BEST ? best : "", number,
                         mark == BEST          ? best
                         : mark == BELOW_FLOOR ? below
                                               : "");
            if (length > cells.width[c])
                cells.width[c] = length;
        }
    }
    for (int r = 0; r < group->count; r++)
        if ((int)strlen(group->rows[r].trial->trial) > cells.name_width)
            cells.name_width = (int)strlen(group->rows[r].trial->trial);
    return cells;
}

/* ---- text ---- */

/* One character behind each number is kept for its mark, so that digits stay in line. */
static void text_cell(const struct group *group, int r, int c, int width, bool colour,
                      struct irb_str *out)
{
    const struct irb_table_row *row = &group->rows[r];
    enum mark mark = mark_of(group, &columns[c], row);
    char number[32];
    print_number(number, row->metrics[columns[c].metric], columns[c].digits);
    bool bold = colour && mark == BEST;
    irb_str_printf(out, "  %*s%s%s%s%s", width - (int)strlen(number), "", bold ? "\033[1m" : "",
                   number,
                   mark == BEST          ? "*"
                   : mark == BELOW_FLOOR ? "~"
                                         : " ",
                   bold ? "\033[0m" : "");
}

static void text_header(const struct group *group, const struct cells *cells, struct irb_str *out)
{
    irb_str_printf(out, "  %-*s", cells->name_width, "trial");
    for (int c = 0; c < COLUMNS; c++)
        if (group->shown[c])
            irb_str_printf(out, "  %*s ", cells->width[c], columns[c].title);
    irb_str_printf(out, "\n  %-*s", cells->name_width, "");
    for (int c = 0; c < COLUMNS; c++)
        if (group->shown[c])
            irb_str_printf(out, "  %*s ", cells->width[c], unit_of(c));
    irb_str_printf(out, "\n");
}

static void text_group(const struct group *group, bool colour, struct irb_str *out)
{
    struct cells cells = lay_out(group, "", "");
    irb_str_printf(out, "%s%s%s   ", colour ? "\033[1m" : "", group->rows->trial->scene,
                   colour ? "\033[0m" : "");
    print_reference(group, out);
    irb_str_printf(out, "\n");
    text_header(group, &cells, out);
    for (int r = 0; r < group->count; r++) {
        irb_str_printf(out, "  %-*s", cells.name_width, group->rows[r].trial->trial);
        for (int c = 0; c < COLUMNS; c++)
            if (group->shown[c])
                text_cell(group, r, c, cells.width[c], colour, out);
        irb_str_printf(out, "\n");
    }
    free(cells.text);
}

static const char *const legend =
    "best of its column and scene; ~ not above the reference's own noise, not ranked.\n"
    "Errors are of the indirect image unless said otherwise, against bounce 1 with exact "
    "visibility.\n";

void irb_table_text(const struct irb_table_data *data, bool colour, struct irb_str *out)
{
    if (!data->row_count)
        irb_str_printf(out, "no trials yet\n");
    for (int first = 0; first < data->row_count;) {
        struct group group = group_at(data, first);
        text_group(&group, colour, out);
        irb_str_printf(out, "\n");
        first += group.count;
    }
    if (data->row_count)
        irb_str_printf(out, "* %s%s%s", legend, data->provenance, *data->provenance ? "\n" : "");
}

/* ---- Markdown ---- */

static void markdown_group(const struct group *group, struct irb_str *out)
{
    struct cells cells = lay_out(group, "**", "~");
    irb_str_printf(out, "### %s\n\n| %-*s |", group->rows->trial->scene, cells.name_width, "trial");
    for (int c = 0; c < COLUMNS; c++) {
        if (!group->shown[c])
            continue;
        char *title = *unit_of(c) ? irb_asprintf("%s [%s]", columns[c].title, unit_of(c))
                                  : irb_strdup(columns[c].title);
        if ((int)strlen(title) > cells.width[c])
            cells.width[c] = (int)strlen(title);
        irb_str_printf(out, " %*s |", cells.width[c], title);
        free(title);
    }
    irb_str_printf(out, "\n|:");
    for (int i = 0; i < cells.name_width + 1; i++)
        irb_str_printf(out, "-");
    irb_str_printf(out, "|");
    for (int c = 0; c < COLUMNS; c++) {
        for (int i = 0; group->shown[c] && i < cells.width[c] + 1; i++)
            irb_str_printf(out, "-");
        irb_str_printf(out, "%s", group->shown[c] ? ":|" : "");
    }
    for (int r = 0; r < group->count; r++) {
        irb_str_printf(out, "\n| %-*s |", cells.name_width, group->rows[r].trial->trial);
        for (int c = 0; c < COLUMNS; c++)
            if (group->shown[c])
                irb_str_printf(out, " %*s |", cells.width[c], cell(&cells, r, c));
    }
    irb_str_printf(out, "\n\n");
    free(cells.text);
    print_reference(group, out);
    irb_str_printf(out, "\n\n");
}

void irb_table_markdown(const struct irb_table_data *data, struct irb_str *out)
{
    if (!data->row_count)
        irb_str_printf(out, "no trials yet\n");
    for (int first = 0; first < data->row_count;) {
        struct group group = group_at(data, first);
        markdown_group(&group, out);
        first += group.count;
    }
    if (data->row_count)
        irb_str_printf(out, "Bold: %s%s%s", legend, data->provenance,
                       *data->provenance ? "\n" : "");
}
