/* SPDX-License-Identifier: MIT
 *
 * The table of results of the page: core/report/table_view.h's columns, with intervals.
 */
#include "core/report/html_parts.h"
#include "core/report/html_text.h"
#include "core/report/table_view.h"

#include <math.h>
#include <stdio.h>

/* Left out where no trial has a value, or where it matters only if it is not 0. */
static bool column_shown(const struct irb_analysis_scene *scene, const struct irb_column *column)
{
    for (int t = 0; t < scene->trial_count; t++) {
        double value = scene->trials[t].measures[column->metric].interval.value;
        if (!isnan(value) && (!column->only_if_any || value != 0))
            return true;
    }
    return false;
}

static void heading(struct irb_str *out, const struct irb_column *column)
{
    const char *unit = irb_column_unit(column);
    irb_str_printf(out, "<th scope=\"col\"><button type=\"button\" title=\"");
    irb_html_text(out, irb_metrics[column->metric].doc);
    irb_str_printf(out, "\">");
    irb_html_text(out, column->title);
    irb_str_printf(out, "</button><span class=\"unit\">%s</span></th>", *unit ? unit : "&nbsp;");
}

/* Narrower than irb_html_interval: without brackets, where no end is negative. */
static void range(char out[80], const struct irb_measure *measure, int digits)
{
    irb_html_interval(out, measure, digits);
    char low[32], high[32];
    if (!*out || measure->interval.low < 0)
        return;
    if (measure->interval.low == measure->interval.high) {
        *out = 0; /* all units alike: the value says it */
        return;
    }
    irb_table_number(low, measure->interval.low, digits);
    irb_table_number(high, measure->interval.high, digits);
    snprintf(out, 80, "%s&ndash;%s", low, high);
}

/* What the sign behind a value means; NULL for none. */
struct sign {
    const char *sign, *meaning;
};

static struct sign sign_of(const struct irb_html_page *page, int s, int t, int metric, int best)
{
    const struct irb_analysis_scene *scene = &page->analysis.scenes[s];
    if (scene->trials[t].at_noise[metric])
        return (struct sign){"~", "not above the reference's own noise, not ranked"};
    if (best < 0)
        return (struct sign){0};
    double badness = irb_metric_badness(metric, scene->trials[t].measures[metric].interval.value);
    if (badness == irb_metric_badness(metric, scene->trials[best].measures[metric].interval.value))
        return (struct sign){"*", "best"};
    if (irb_html_same(page, s, t, best, metric))
        return (struct sign){"=", "not distinguishable from the best"};
    return (struct sign){0};
}

static void cell(struct irb_str *out, const struct irb_html_page *page, int s, int t,
                 const struct irb_column *column, int best)
{
    const struct irb_measure *measure =
        &page->analysis.scenes[s].trials[t].measures[column->metric];
    const struct sign sign = sign_of(page, s, t, column->metric, best);
    char value[32], interval[80];
    irb_html_value(value, measure, column->digits);
    range(interval, measure, column->digits);
    double badness = irb_metric_badness(column->metric, measure->interval.value);
    irb_str_printf(out, "<td%s", sign.sign && *sign.sign == '*' ? " class=\"best\"" : "");
    if (!isnan(badness))
        irb_str_printf(out, " data-key=\"%.9g\"", badness);
    if (*interval)
        irb_str_printf(out, " title=\"%s\"", interval);
    irb_str_printf(out, "><span class=\"value\">%s</span>", value);
    if (sign.sign)
        irb_str_printf(out, "<abbr class=\"mark\" title=\"%s\">%s</abbr>", sign.meaning, sign.sign);
    else
        irb_str_printf(out, "<span class=\"mark\"></span>");
    if (*interval && column->spread)
        irb_str_printf(out, "<span class=\"interval\">%s</span>", interval);
    irb_str_printf(out, "</td>");
}

/* The best is marked where there are several to choose from. */
static int best_of(const struct irb_analysis_scene *scene, int metric)
{
    int count = 0;
    for (int t = 0; t < scene->trial_count; t++)
        count += !isnan(scene->trials[t].measures[metric].interval.value);
    return count > 1 ? irb_html_best(scene, metric) : -1;
}

static void reference_line(struct irb_str *out, const struct irb_analysis_scene *scene)
{
    char noise[32] = "-", flicker[32] = "-";
    for (int t = 0; t < scene->trial_count; t++) {
        const struct irb_measure *measures = scene->trials[t].measures;
        if (!isnan(measures[IRB_METRIC_reference_noise].interval.value))
            irb_html_value(noise, &measures[IRB_METRIC_reference_noise], 3);
        if (!isnan(measures[IRB_METRIC_reference_flicker].interval.value))
            irb_html_value(flicker, &measures[IRB_METRIC_reference_flicker], 3);
    }
    irb_str_printf(out,
                   "<p class=\"small muted\">The reference's own noise: %s (relMSE); its "
                   "flicker: at most %s.</p>\n",
                   noise, flicker);
}

static void table(struct irb_str *out, const struct irb_html_page *page, int s)
{
    const struct irb_analysis_scene *scene = &page->analysis.scenes[s];
    bool shown[IRB_COLUMNS];
    int best[IRB_COLUMNS];
    irb_str_printf(out, "<h3>");
    irb_html_text(out, scene->name);
    irb_str_printf(out, "</h3>\n<div class=\"scroll\"><table class=\"results\"><thead><tr>"
                        "<th scope=\"col\"><button type=\"button\">trial</button></th>");
    for (int c = 0; c < IRB_COLUMNS; c++) {
        shown[c] = column_shown(scene, &irb_columns[c]);
        best[c] = best_of(scene, irb_columns[c].metric);
        if (shown[c])
            heading(out, &irb_columns[c]);
    }
    irb_str_printf(out, "</tr></thead><tbody>\n");
    for (int t = 0; t < scene->trial_count; t++) {
        irb_str_printf(out, "<tr><th scope=\"row\">");
        irb_html_trial(out, page, &scene->trials[t]);
        irb_str_printf(out, "</th>");
        for (int c = 0; c < IRB_COLUMNS; c++)
            if (shown[c])
                cell(out, page, s, t, &irb_columns[c], best[c]);
        irb_str_printf(out, "</tr>\n");
    }
    irb_str_printf(out, "</tbody></table></div>\n");
    reference_line(out, scene);
}

static bool any_interval(const struct irb_analysis *analysis)
{
    for (int s = 0; s < analysis->scene_count; s++)
        for (int t = 0; t < analysis->scenes[s].trial_count; t++)
            for (int m = 0; m < IRB_METRIC_COUNT; m++)
                if (analysis->scenes[s].trials[t].measures[m].unit != IRB_UNIT_NONE)
                    return true;
    return false;
}

void irb_html_tables(struct irb_str *out, const struct irb_html_page *page)
{
    for (int s = 0; s < page->analysis.scene_count; s++)
        table(out, page, s);
    irb_str_printf(out, "<p class=\"small muted\">* best of its column and scene; = not "
                        "distinguishable from it; ~ not above the reference's own noise, not "
                        "ranked. ");
    if (any_interval(&page->analysis))
        irb_str_printf(out,
                       "In small type: %g&nbsp;%% intervals; those of the other columns show under "
                       "the cursor.",
                       100 * page->analysis.confidence);
    else
        irb_str_printf(out, "There are no intervals: too few seeds and frames.");
    irb_str_printf(out, " How they are made is said under Provenance.</p>\n");
}
