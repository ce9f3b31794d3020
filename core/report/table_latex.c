/* SPDX-License-Identifier: MIT */
#include "core/report/table_latex.h"
#include "core/report/table_view.h"

#include <string.h>

void irb_latex_text(struct irb_str *out, const char *text)
{
    static const struct {
        char character;
        const char *command;
    } special[] = {
        {'\\', "\\textbackslash{}"},
        {'{', "\\{"},
        {'}', "\\}"},
        {'$', "\\$"},
        {'&', "\\&"},
        {'#', "\\#"},
        {'%', "\\%"},
        {'_', "\\_"},
        {'~', "\\textasciitilde{}"},
        {'^', "\\textasciicircum{}"},
        {'<', "\\textless{}"},
        {'>', "\\textgreater{}"},
        {'|', "\\textbar{}"},
        {'"', "\\textquotedbl{}"},
        {'\n', " "},
    };
    enum { SPECIAL = sizeof special / sizeof *special };
    for (; *text; text++) {
        int i = 0;
        while (i < SPECIAL && special[i].character != *text)
            i++;
        if (i < SPECIAL)
            irb_str_printf(out, "%s", special[i].command);
        else
            irb_str_append(out, text, 1);
    }
}

/* "W/(m2 sr)" with its exponent raised. */
static void latex_unit(struct irb_str *out, const char *unit)
{
    for (; *unit; unit++) {
        char one[2] = {*unit, 0};
        irb_latex_text(out, one);
        if (*unit == 'm' && unit[1] == '2') {
            irb_str_printf(out, "\\textsuperscript{2}");
            unit++;
        }
    }
}

void irb_latex_number(struct irb_str *out, const char *number)
{
    const char *e = strchr(number, 'e');
    if (!strcmp(number, "inf") || !strcmp(number, "-inf")) {
        irb_str_printf(out, "%s\\infty", *number == '-' ? "-" : "");
        return;
    }
    if (!e) {
        irb_str_printf(out, "%s", number);
        return;
    }
    const char *digits = e + 1 + (e[1] == '-' || e[1] == '+');
    while (*digits == '0' && digits[1])
        digits++;
    irb_str_printf(out, "%.*s \\times 10^{%s%s}", (int)(e - number), number, e[1] == '-' ? "-" : "",
                   digits);
}

static void latex_cell(const struct irb_table_group *group, int r, int c, struct irb_str *out)
{
    const struct irb_column *column = &irb_columns[c];
    const struct irb_table_row *row = &group->rows[r];
    enum irb_mark mark = irb_table_mark(group, column, row);
    char number[32], spread[32];
    irb_table_number(number, row->metrics[column->metric], column->digits);
    irb_table_spread(spread, column, row);
    if (!strcmp(number, "-")) {
        irb_str_printf(out, " & --");
        return;
    }
    irb_str_printf(out, " & $%s", mark == IRB_MARK_BEST ? "\\mathbf{" : "");
    irb_latex_number(out, number);
    irb_str_printf(out, "%s",
                   mark == IRB_MARK_BEST          ? "}"
                   : mark == IRB_MARK_BELOW_FLOOR ? "^{\\sim}"
                   : mark == IRB_MARK_SAME        ? "^{=}"
                                                  : "");
    if (*spread) {
        irb_str_printf(out, " \\pm ");
        irb_latex_number(out, spread);
    }
    irb_str_printf(out, "$");
}

static void latex_header(const struct irb_table_group *group, struct irb_str *out)
{
    irb_str_printf(out, "  \\begin{tabular}{l");
    for (int c = 0; c < IRB_COLUMNS; c++)
        irb_str_printf(out, "%s", group->shown[c] ? "r" : "");
    irb_str_printf(out, "}\n    \\toprule\n    trial");
    for (int c = 0; c < IRB_COLUMNS; c++) {
        if (!group->shown[c])
            continue;
        irb_str_printf(out, " & ");
        irb_latex_text(out, irb_columns[c].title);
        if (!*irb_column_unit(&irb_columns[c]))
            continue;
        irb_str_printf(out, " [");
        latex_unit(out, irb_column_unit(&irb_columns[c]));
        irb_str_printf(out, "]");
    }
    irb_str_printf(out, " \\\\\n    \\midrule\n");
}

static void latex_group(const struct irb_table_group *group, struct irb_str *out)
{
    struct irb_str reference = {0};
    irb_table_reference(group, &reference);
    irb_str_printf(out, "\\begin{table}\n  \\centering\n  \\caption{");
    irb_latex_text(out, group->rows->trial->scene);
    irb_str_printf(out, ". ");
    irb_latex_text(out, irb_str_text(&reference));
    irb_str_printf(out, ".}\n");
    irb_str_free(&reference);
    latex_header(group, out);
    for (int r = 0; r < group->count; r++) {
        irb_str_printf(out, "    ");
        irb_latex_text(out, group->rows[r].name);
        for (int c = 0; c < IRB_COLUMNS; c++)
            if (group->shown[c])
                latex_cell(group, r, c, out);
        irb_str_printf(out, " \\\\\n");
    }
    irb_str_printf(out, "    \\bottomrule\n  \\end{tabular}\n\\end{table}\n");
}

void irb_latex_comment(struct irb_str *out, const char *text)
{
    while (*text) {
        size_t length = strcspn(text, "\n");
        irb_str_printf(out, "%% %.*s\n", (int)length, text);
        text += length + (text[length] == '\n');
    }
}

void irb_latex_begin(struct irb_str *out, const struct irb_table_data *data)
{
    irb_str_printf(out, "%% needs \\usepackage{booktabs} and \\usepackage[T1]{fontenc}\n");
    if (!data->row_count)
        irb_str_printf(out, "%% no trials yet\n");
}

void irb_table_latex(const struct irb_table_data *data, struct irb_str *out)
{
    struct irb_str foot = {0};
    irb_latex_begin(out, data);
    for (int first = 0; first < data->row_count;) {
        struct irb_table_group group = irb_table_group_at(data, first);
        latex_group(&group, out);
        first += group.count;
    }
    if (data->row_count)
        irb_table_foot("Bold: ", data, &foot);
    irb_latex_comment(out, irb_str_text(&foot));
    irb_str_free(&foot);
}
