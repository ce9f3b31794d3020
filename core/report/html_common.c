/* SPDX-License-Identifier: MIT
 *
 * What several parts of the page need.
 */
#include "core/report/html_parts.h"
#include "core/report/html_text.h"
#include "core/report/palette.h"
#include "core/report/table_view.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

char *irb_html_meta(const struct irb_html_page *page, const char *name)
{
    char *value = irb_store_get_meta(page->store, name);
    return value ? value : irb_strdup("");
}

const char *irb_html_colour(const struct irb_html_page *page, const char *method)
{
    int other = irb_names_find(&page->others, method);
    return other >= 0 ? irb_other_colour(other) : irb_method_colour(method);
}

void irb_html_trial(struct irb_str *out, const struct irb_html_page *page,
                    const struct irb_analysis_trial *trial)
{
    size_t length = strlen(trial->method);
    bool begins = !strncmp(trial->trial, trial->method, length) && trial->trial[length] == ':';
    irb_str_printf(
        out, "<span class=\"trial\"><span class=\"swatch\" style=\"background:%s\"></span><span>",
        irb_html_colour(page, trial->method));
    irb_html_text(out, begins ? trial->method : trial->trial);
    if (begins) {
        irb_str_printf(out, " <span class=\"params\">");
        /* where a line may end */
        for (const char *c = trial->trial + length + 1; *c; c++) {
            char one[2] = {*c, 0};
            irb_html_text(out, one);
            irb_str_printf(out, "%s", *c == ':' ? "<wbr>" : "");
        }
        irb_str_printf(out, "</span>");
    }
    irb_str_printf(out, "</span></span>");
}

int irb_html_best(const struct irb_analysis_scene *scene, int metric)
{
    int best = -1;
    double least = NAN;
    for (int t = 0; t < scene->trial_count; t++) {
        const struct irb_analysis_trial *trial = &scene->trials[t];
        double badness = irb_metric_badness(metric, trial->measures[metric].interval.value);
        if (isnan(badness) || trial->at_noise[metric] || trial->partial || badness >= least)
            continue;
        best = t;
        least = badness;
    }
    return best;
}

bool irb_html_same(const struct irb_html_page *page, int scene, int t, int best, int metric)
{
    return best >= 0 && t != best && !page->analysis.scenes[scene].trials[t].at_noise[metric] &&
           irb_analysis_compare(&page->analysis, scene, t, best, metric) == IRB_VERDICT_SAME;
}

void irb_html_value(char out[32], const struct irb_measure *measure, int digits)
{
    irb_table_number(out, measure->interval.value, digits);
}

void irb_html_interval(char out[80], const struct irb_measure *measure, int digits)
{
    char low[32], high[32];
    *out = 0;
    if (isnan(measure->interval.low) || isnan(measure->interval.high))
        return;
    irb_table_number(low, measure->interval.low, digits);
    irb_table_number(high, measure->interval.high, digits);
    snprintf(out, 80, "[%s, %s]", low, high);
}
