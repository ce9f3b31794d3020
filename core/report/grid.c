/* SPDX-License-Identifier: MIT */
#include "core/report/grid.h"
#include "core/report/table_latex.h"

#include <stdlib.h>
#include <string.h>

void irb_grid_add(struct irb_grid *grid, const char *text)
{
    char **cells = realloc(grid->cells, ((size_t)grid->count + 1) * sizeof *cells);
    if (!cells)
        abort(); /* a table's worth of text: nothing that holds results is lost */
    grid->cells = cells;
    cells[grid->count++] = irb_strdup(text);
}

void irb_grid_take(struct irb_grid *grid, struct irb_str *text)
{
    irb_grid_add(grid, irb_str_text(text));
    irb_str_free(text);
    *text = (struct irb_str){0};
}

void irb_grid_free(struct irb_grid *grid)
{
    for (int i = 0; i < grid->count; i++)
        free(grid->cells[i]);
    free(grid->cells);
    grid->cells = NULL;
    grid->count = 0;
}

static int width_of(const struct irb_grid *grid, int column)
{
    size_t widest = 1;
    for (int i = column; i < grid->count; i += grid->columns)
        if (strlen(grid->cells[i]) > widest)
            widest = strlen(grid->cells[i]);
    return (int)widest;
}

/* A row between `before`, `between` its cells, and `behind`; padded. */
static void write_row(const struct irb_grid *grid, int row, const char *before, const char *between,
                      const char *behind, struct irb_str *out)
{
    for (int c = 0; c < grid->columns; c++) {
        int width = width_of(grid, c);
        irb_str_printf(out, "%s%*s", c ? between : before, c < grid->left ? -width : width,
                       grid->cells[row * grid->columns + c]);
    }
    irb_str_printf(out, "%s\n", behind);
}

static void markdown_rule(const struct irb_grid *grid, struct irb_str *out)
{
    for (int c = 0; c < grid->columns; c++) {
        irb_str_printf(out, "|%s", c < grid->left ? ":" : "");
        for (int i = 0; i < width_of(grid, c) + 1; i++)
            irb_str_printf(out, "-");
        irb_str_printf(out, "%s", c < grid->left ? "" : ":");
    }
    irb_str_printf(out, "|\n");
}

static void latex_row(const struct irb_grid *grid, int row, struct irb_str *out)
{
    for (int c = 0; c < grid->columns; c++) {
        irb_str_printf(out, "%s", c ? " & " : "    ");
        irb_latex_text(out, grid->cells[row * grid->columns + c]);
    }
    irb_str_printf(out, " \\\\\n");
}

static void write_latex(const struct irb_grid *grid, const char *caption, struct irb_str *out)
{
    irb_str_printf(out, "\\begin{table}\n  \\centering\n  \\caption{");
    irb_latex_text(out, caption);
    irb_str_printf(out, ".}\n  \\begin{tabular}{");
    for (int c = 0; c < grid->columns; c++)
        irb_str_printf(out, "%s", c < grid->left ? "l" : "r");
    irb_str_printf(out, "}\n    \\toprule\n");
    for (int r = 0; r < grid->count / grid->columns; r++) {
        latex_row(grid, r, out);
        if (!r)
            irb_str_printf(out, "    \\midrule\n");
    }
    irb_str_printf(out, "    \\bottomrule\n  \\end{tabular}\n\\end{table}\n");
}

void irb_grid_write(const struct irb_grid *grid, enum irb_table_format format, bool colour,
                    const char *caption, struct irb_str *out)
{
    if (format == IRB_TABLE_LATEX) {
        write_latex(grid, caption, out);
        return;
    }
    bool markdown = format == IRB_TABLE_MD;
    irb_str_printf(out, "%s%s%s\n%s",
                   markdown ? "### "
                   : colour ? "\033[1m"
                            : "",
                   caption, !markdown && colour ? "\033[0m" : "", markdown ? "\n" : "");
    for (int r = 0; r < grid->count / grid->columns; r++) {
        if (markdown)
            write_row(grid, r, "| ", " | ", " |", out);
        else
            write_row(grid, r, "  ", "  ", "", out);
        if (!r && markdown)
            markdown_rule(grid, out);
    }
    irb_str_printf(out, "\n");
}
