/* SPDX-License-Identifier: MIT */
#include "core/report/table_measures.h"
#include "core/report/table_cells.h"
#include "core/report/table_latex.h"
#include "core/report/table_view.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What the columns are: one for each name, and of times that of the whole frame. */
struct measures {
    const struct irb_table_data *data;
    const struct irb_names *names;
    bool times;
    int count;
    const char *before, *behind; /* the name, as a column for programs */
};

static struct measures measures_of(const struct irb_table_data *data,
                                   enum irb_table_subject subject)
{
    bool times = subject == IRB_TABLE_STAGES;
    const struct irb_names *names = times ? &data->stages : &data->statistics;
    return (struct measures){.data = data,
                             .names = names,
                             .times = times,
                             .count = names->count + times,
                             .before = times ? "stage_" : "statistic_",
                             .behind = times ? "_ms" : ""};
}

static double value_of(const struct measures *m, const struct irb_table_row *row, int column)
{
    if (column == m->names->count)
        return row->metrics[IRB_METRIC_frame_ms];
    return m->times ? row->stage_ms.list[column] : row->statistics.list[column];
}

static const char *title_of(const struct measures *m, int column)
{
    return column == m->names->count ? "frame" : m->names->list[column];
}

/* ---- csv, json ---- */

static void write_csv(const struct measures *m, struct irb_str *out)
{
    irb_csv_row_titles(out);
    for (int c = 0; c < m->names->count; c++)
        irb_csv_title(out, m->before, m->names->list[c], m->behind);
    irb_str_printf(out, "%s\n", m->times ? ",frame_ms" : "");
    for (int r = 0; r < m->data->row_count; r++) {
        irb_csv_row_begin(out, &m->data->rows[r]);
        for (int c = 0; c < m->count; c++)
            irb_csv_number(out, value_of(m, &m->data->rows[r], c));
        irb_str_printf(out, "\n");
    }
}

static void write_json(const struct measures *m, struct irb_str *out)
{
    irb_str_printf(out, "[");
    for (int r = 0; r < m->data->row_count; r++) {
        const struct irb_table_row *row = &m->data->rows[r];
        irb_str_printf(out, "%s\n ", r ? "," : "");
        irb_json_row_begin(out, row);
        for (int c = 0; c < m->names->count; c++)
            irb_json_member(out, m->before, m->names->list[c], m->behind, value_of(m, row, c));
        if (m->times)
            irb_json_member(out, "", "frame_ms", "", row->metrics[IRB_METRIC_frame_ms]);
        irb_str_printf(out, "}");
    }
    irb_str_printf(out, "%s]\n", m->data->row_count ? "\n" : "");
}

/* ---- for people: the trials of one method in one scene ---- */

struct group {
    const struct irb_table_row **rows; /* borrowed from the data; the list is owned */
    int count;
    int *columns; /* those that some row has a value for; owned */
    int column_count;
};

enum { CELL = 32, DIGITS = 3 };

static bool same_method(const struct irb_table_row *a, const struct irb_table_row *b)
{
    return !strcmp(a->trial->scene, b->trial->scene) && !strcmp(a->trial->method, b->trial->method);
}

/* The group that row `first` is the first of; empty where an earlier row is. */
static struct group group_at(const struct measures *m, int first)
{
    const struct irb_table_data *data = m->data;
    struct group g = {.rows = calloc((size_t)data->row_count, sizeof *g.rows),
                      .columns = calloc((size_t)m->count + 1, sizeof *g.columns)};
    if (!g.rows || !g.columns)
        abort();
    for (int r = 0; r < first; r++)
        if (same_method(&data->rows[r], &data->rows[first]))
            return g;
    for (int r = first; r < data->row_count; r++)
        if (same_method(&data->rows[r], &data->rows[first]))
            g.rows[g.count++] = &data->rows[r];
    for (int c = 0; c < m->count; c++) {
        bool any = false;
        for (int r = 0; r < g.count; r++)
            any = any || !isnan(value_of(m, g.rows[r], c));
        if (any)
            g.columns[g.column_count++] = c;
    }
    return g;
}

static void free_group(struct group *g)
{
    free(g->rows);
    free(g->columns);
}

/* Characters of the widest cell of a column, its title included; of the trials' for column -1. */
static int width_of(const struct measures *m, const struct group *g, int column)
{
    size_t widest = strlen(column < 0 ? "trial" : title_of(m, column));
    for (int r = 0; r < g->count; r++) {
        char cell[CELL];
        if (column >= 0)
            irb_table_number(cell, value_of(m, g->rows[r], column), DIGITS);
        size_t length = strlen(column < 0 ? g->rows[r]->name : cell);
        widest = length > widest ? length : widest;
    }
    return (int)widest;
}

static const char *caption_of(const struct measures *m)
{
    return m->times ? "median times, ms" : "means over the frames";
}

static void foot(const struct measures *m, struct irb_str *out)
{
    if (m->times)
        irb_str_printf(out, "Medians over the frames; that of the whole frame is not their sum.\n");
    irb_table_foot_seeds(m->data, false, out);
}

static void write_text(const struct measures *m, const struct group *g, bool colour,
                       struct irb_str *out)
{
    const struct irb_store_trial_row *trial = g->rows[0]->trial;
    int names = width_of(m, g, -1);
    irb_str_printf(out, "%s%s, %s%s   %s\n  %-*s", colour ? "\033[1m" : "", trial->scene,
                   trial->method, colour ? "\033[0m" : "", caption_of(m), names, "trial");
    for (int i = 0; i < g->column_count; i++)
        irb_str_printf(out, "  %*s", width_of(m, g, g->columns[i]), title_of(m, g->columns[i]));
    for (int r = 0; r < g->count; r++) {
        irb_str_printf(out, "\n  %-*s", names, g->rows[r]->name);
        for (int i = 0; i < g->column_count; i++) {
            char cell[CELL];
            irb_table_number(cell, value_of(m, g->rows[r], g->columns[i]), DIGITS);
            irb_str_printf(out, "  %*s", width_of(m, g, g->columns[i]), cell);
        }
    }
    irb_str_printf(out, "\n\n");
}

static void markdown_rule(int width, bool right, struct irb_str *out)
{
    irb_str_printf(out, "%s", right ? "" : ":");
    for (int i = 0; i < width + 1; i++)
        irb_str_printf(out, "-");
    irb_str_printf(out, "%s|", right ? ":" : "");
}

static void write_markdown(const struct measures *m, const struct group *g, struct irb_str *out)
{
    const struct irb_store_trial_row *trial = g->rows[0]->trial;
    int names = width_of(m, g, -1);
    irb_str_printf(out, "### %s, %s\n\n| %-*s |", trial->scene, trial->method, names, "trial");
    for (int i = 0; i < g->column_count; i++)
        irb_str_printf(out, " %*s |", width_of(m, g, g->columns[i]), title_of(m, g->columns[i]));
    irb_str_printf(out, "\n|");
    markdown_rule(names, false, out);
    for (int i = 0; i < g->column_count; i++)
        markdown_rule(width_of(m, g, g->columns[i]), true, out);
    for (int r = 0; r < g->count; r++) {
        irb_str_printf(out, "\n| %-*s |", names, g->rows[r]->name);
        for (int i = 0; i < g->column_count; i++) {
            char cell[CELL];
            irb_table_number(cell, value_of(m, g->rows[r], g->columns[i]), DIGITS);
            irb_str_printf(out, " %*s |", width_of(m, g, g->columns[i]), cell);
        }
    }
    irb_str_printf(out, "\n\n%s\n\n", caption_of(m));
}

static void write_latex(const struct measures *m, const struct group *g, struct irb_str *out)
{
    const struct irb_store_trial_row *trial = g->rows[0]->trial;
    irb_str_printf(out, "\\begin{table}\n  \\centering\n  \\caption{");
    irb_latex_text(out, trial->scene);
    irb_str_printf(out, ", ");
    irb_latex_text(out, trial->method);
    irb_str_printf(out, ": %s.}\n  \\begin{tabular}{l", caption_of(m));
    for (int i = 0; i < g->column_count; i++)
        irb_str_printf(out, "r");
    irb_str_printf(out, "}\n    \\toprule\n    trial");
    for (int i = 0; i < g->column_count; i++) {
        irb_str_printf(out, " & ");
        irb_latex_text(out, title_of(m, g->columns[i]));
    }
    irb_str_printf(out, " \\\\\n    \\midrule\n");
    for (int r = 0; r < g->count; r++) {
        irb_str_printf(out, "    ");
        irb_latex_text(out, g->rows[r]->name);
        for (int i = 0; i < g->column_count; i++) {
            char cell[CELL];
            irb_table_number(cell, value_of(m, g->rows[r], g->columns[i]), DIGITS);
            irb_str_printf(out, !strcmp(cell, "-") ? " & --" : " & $");
            if (strcmp(cell, "-")) {
                irb_latex_number(out, cell);
                irb_str_printf(out, "$");
            }
        }
        irb_str_printf(out, " \\\\\n");
    }
    irb_str_printf(out, "    \\bottomrule\n  \\end{tabular}\n\\end{table}\n");
}

static void write_groups(const struct measures *m, const struct irb_table_options *options,
                         struct irb_str *out)
{
    for (int first = 0; first < m->data->row_count; first++) {
        struct group g = group_at(m, first);
        bool any = g.count && g.column_count;
        if (any && options->format == IRB_TABLE_LATEX)
            write_latex(m, &g, out);
        else if (any && options->format == IRB_TABLE_MD)
            write_markdown(m, &g, out);
        else if (any)
            write_text(m, &g, options->colour, out);
        free_group(&g);
    }
}

void irb_table_measures(const struct irb_table_data *data, const struct irb_table_options *options,
                        struct irb_str *out)
{
    struct measures m = measures_of(data, options->subject);
    struct irb_str below = {0};
    if (data->row_count)
        foot(&m, &below);
    switch (options->format) {
    case IRB_TABLE_CSV:
        write_csv(&m, out);
        break;
    case IRB_TABLE_JSON:
        write_json(&m, out);
        break;
    case IRB_TABLE_LATEX:
        irb_latex_begin(out, data);
        write_groups(&m, options, out);
        irb_latex_comment(out, irb_str_text(&below));
        break;
    default:
        if (!data->row_count)
            irb_str_printf(out, "no trials yet\n");
        write_groups(&m, options, out);
        irb_str_printf(out, "%s", irb_str_text(&below));
    }
    irb_str_free(&below);
}
