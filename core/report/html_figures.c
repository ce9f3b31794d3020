/* SPDX-License-Identifier: MIT
 *
 * The figures of the page, each with its data. Without gnuplot the data stays.
 */
#include "core/report/html_parts.h"
#include "core/report/html_text.h"
#include "core/report/plot.h"

#include <stdlib.h>
#include <string.h>

static const struct {
    enum irb_figure figure;
    const char *title, *caption;
} figures[] = {
    {IRB_FIGURE_PARETO, "Error against time",
     "HDR-FLIP of the indirect image over the time of a frame, with intervals. A trial on the line "
     "of its front is beaten by no other one in both."},
    {IRB_FIGURE_CONVERGENCE, "Convergence",
     "Error over the one number in which the trials of a family differ."},
    {IRB_FIGURE_STAGES, "Where the time goes", "Mean time of every stage of a frame."},
    {IRB_FIGURE_TIMELINE, "Over the sequence",
     "The error from frame to frame, of each method's best trial."},
    {IRB_FIGURE_FLICKER, "Flicker",
     "Change of the error from frame to frame, relative to the mean reference, with the share of "
     "pixels that pop and the flicker that the reference has itself."},
};

/* The figure's CSV, the caller's; empty where it has no line but its titles. */
static struct irb_str read_csv(const struct irb_html_page *page, enum irb_figure figure)
{
    struct irb_str csv = {0};
    bool ok = irb_figure_text(&page->analysis, figure, NULL, &csv, NULL);
    const char *line = ok ? strchr(irb_str_text(&csv), '\n') : NULL;
    if (!line || !line[1])
        irb_str_free(&csv);
    return csv;
}

static void link_to_data(struct irb_str *out, const char *name, const struct irb_str *csv)
{
    irb_str_printf(out, " <a download=\"%s.csv\" href=\"data:text/csv;charset=utf-8;base64,", name);
    irb_html_base64(out, csv->text, csv->length);
    irb_str_printf(out, "\">Data: %s.csv</a>", name);
}

/* The width that the figure was drawn for, CSS pixels. */
static int width_of(const char *svg)
{
    const char *box = svg ? strstr(svg, "viewBox=\"0 0 ") : NULL;
    int width = box ? atoi(box + strlen("viewBox=\"0 0 ")) : 0;
    return width > 0 ? width : 620;
}

static void figure(struct irb_str *out, const struct irb_html_page *page, size_t i)
{
    const char *name = irb_figure_names[figures[i].figure];
    struct irb_error err = {0};
    struct irb_str csv = read_csv(page, figures[i].figure);
    char *svg = csv.length ? irb_plot_svg(&page->analysis, figures[i].figure, NULL, &err) : NULL;
    irb_str_printf(out, "<figure id=\"figure-%s\" style=\"--drawn:%dpx\"><h3>%s</h3>\n", name,
                   width_of(svg), figures[i].title);
    if (svg) {
        irb_str_printf(out, "<div class=\"svg\" role=\"img\" aria-label=\"%s\">", figures[i].title);
        irb_html_markup(out, svg);
        irb_str_printf(out, "</div>\n");
    } else {
        irb_str_printf(out, "<p class=\"muted\">");
        irb_html_text(out, csv.length ? "Not drawn: " : "This run has no data for it.");
        irb_html_text(out, csv.length ? err.message : "");
        irb_str_printf(out, "</p>\n");
    }
    irb_str_printf(out, "<figcaption>%s", figures[i].caption);
    if (csv.length)
        link_to_data(out, name, &csv);
    irb_str_printf(out, "</figcaption></figure>\n");
    free(svg);
    irb_str_free(&csv);
}

void irb_html_figures(struct irb_str *out, const struct irb_html_page *page)
{
    for (size_t i = 0; i < sizeof figures / sizeof *figures; i++)
        figure(out, page, i);
}
