/* SPDX-License-Identifier: MIT
 *
 * At a glance: for every scene which method is best, at what cost, and where it fails.
 */
#include "core/report/html_parts.h"
#include "core/report/html_text.h"
#include "core/report/pareto.h"
#include "core/report/table_view.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define M(name) IRB_METRIC_##name

/* "0.247 [0.241, 0.253] ms" */
static void value(struct irb_str *out, const struct irb_analysis_trial *trial, int metric)
{
    char number[32], interval[80];
    const char *unit = irb_metrics[metric].unit;
    irb_html_value(number, &trial->measures[metric], 3);
    irb_html_interval(interval, &trial->measures[metric], 3);
    irb_str_printf(out, "%s%s%s", number, *unit ? " " : "", unit);
    if (*interval)
        irb_str_printf(out, " <span class=\"muted\">%s</span>", interval);
}

/* "a, b and c" of the trials that cannot be told from the best; returns how many. */
static int not_distinguishable(struct irb_str *out, const struct irb_html_page *page, int s,
                               int best, int metric)
{
    const struct irb_analysis_scene *scene = &page->analysis.scenes[s];
    int count = 0;
    for (int t = 0; t < scene->trial_count; t++) {
        if (!irb_html_same(page, s, t, best, metric))
            continue;
        irb_str_printf(out, "%s", count++ ? ", " : "");
        irb_html_text(out, scene->trials[t].trial);
    }
    return count;
}

static const struct irb_table_row *row_of(const struct irb_html_page *page, const char *scene,
                                          const char *trial)
{
    for (int i = 0; i < page->table.row_count; i++) {
        const struct irb_table_row *row = &page->table.rows[i];
        if (!strcmp(row->trial->scene, scene) && !strcmp(row->trial->trial, trial))
            return row;
    }
    return NULL;
}

/* "Of the named regions it is worst in door: 0.61." Nothing where the scene names none. */
static void worst_region(struct irb_str *out, const struct irb_html_page *page, const char *scene,
                         const char *trial)
{
    static const char prefix[] = "indirect_flip@";
    const struct irb_table_row *row = row_of(page, scene, trial);
    const char *worst = NULL;
    double most = NAN;
    for (int i = 0; row && i < row->regions.count; i++) {
        const char *name = page->table.region_metrics.list[i];
        double flip = row->regions.list[i];
        if (strncmp(name, prefix, strlen(prefix)) || isnan(flip) || flip <= most)
            continue;
        worst = name + strlen(prefix);
        most = flip;
    }
    if (!worst)
        return;
    char number[32];
    irb_table_number(number, most, 3);
    irb_str_printf(out, " Of the named regions it is worst in ");
    irb_html_text(out, worst);
    irb_str_printf(out, ": %s.", number);
}

static void verdict(struct irb_str *out, const struct irb_html_page *page, int s)
{
    const struct irb_analysis_scene *scene = &page->analysis.scenes[s];
    int best = irb_html_best(scene, M(indirect_flip));
    if (best < 0) {
        irb_str_printf(out, "<p class=\"verdict\">No trial is scored and above the reference's own "
                            "noise yet.</p>\n");
        return;
    }
    const struct irb_analysis_trial *trial = &scene->trials[best];
    struct irb_str same = {0};
    int count = not_distinguishable(&same, page, s, best, M(indirect_flip));
    irb_str_printf(out, "<p class=\"verdict\"><strong>");
    irb_html_text(out, trial->trial);
    irb_str_printf(out, "</strong> has the least HDR-FLIP, ");
    value(out, trial, M(indirect_flip));
    irb_str_printf(out, ", at ");
    value(out, trial, M(frame_ms));
    irb_str_printf(out, " a frame. ");
    if (count)
        irb_str_printf(out, "Not distinguishable from it: %s.", irb_str_text(&same));
    else if (trial->measures[M(indirect_flip)].unit != IRB_UNIT_NONE && scene->trial_count > 1)
        irb_str_printf(out, "Every other trial is distinguishably worse.");
    else if (scene->trial_count > 1)
        irb_str_printf(out, "Too few seeds and frames to say which others differ from it.");
    worst_region(out, page, scene->name, trial->trial);
    irb_str_printf(out, "</p>\n");
    irb_str_free(&same);
}

/* One line of "least RMSE: trial, value, time, not distinguishable". */
static void answer(struct irb_str *out, const struct irb_html_page *page, int s, int metric,
                   const char *question)
{
    const struct irb_analysis_scene *scene = &page->analysis.scenes[s];
    int best = irb_html_best(scene, metric);
    if (best < 0)
        return;
    struct irb_str same = {0};
    int count = not_distinguishable(&same, page, s, best, metric);
    irb_str_printf(out, "<tr><th scope=\"row\">%s</th><td>", question);
    irb_html_trial(out, page, &scene->trials[best]);
    irb_str_printf(out, "</td><td class=\"n\">");
    value(out, &scene->trials[best], metric);
    irb_str_printf(out, "</td><td class=\"n\">");
    if (metric != M(frame_ms)) {
        char ms[32];
        irb_html_value(ms, &scene->trials[best].measures[M(frame_ms)], 3);
        irb_str_printf(out, "at %s ms", ms);
    }
    irb_str_printf(out, "</td><td class=\"muted\">%s%s</td></tr>\n",
                   count ? "not distinguishable: " : "", irb_str_text(&same));
    irb_str_free(&same);
}

/* The trials that no other one beats in both HDR-FLIP and frame time, fastest first. */
static void front(struct irb_str *out, const struct irb_analysis_scene *scene)
{
    int *list = calloc((size_t)scene->trial_count + 1, sizeof *list);
    if (!list)
        abort();
    int count = irb_scene_front_sorted(scene, M(indirect_flip), M(frame_ms), list);
    irb_str_printf(out, "<tr><th scope=\"row\">worth their time</th><td colspan=\"4\">");
    for (int i = 0; i < count; i++) {
        char flip[32], ms[32];
        const struct irb_analysis_trial *trial = &scene->trials[list[i]];
        irb_html_value(flip, &trial->measures[M(indirect_flip)], 3);
        irb_html_value(ms, &trial->measures[M(frame_ms)], 3);
        irb_str_printf(out, "%s", i ? ", " : "");
        irb_html_text(out, trial->trial);
        irb_str_printf(out, " <span class=\"muted\">(%s at %s ms)</span>", flip, ms);
    }
    irb_str_printf(out, "%s</td></tr>\n", count ? "" : "none");
    free(list);
}

static void card(struct irb_str *out, const struct irb_html_page *page, int s)
{
    const struct irb_analysis_scene *scene = &page->analysis.scenes[s];
    irb_str_printf(out, "<article class=\"scene-card\"><h3>");
    irb_html_text(out, scene->name);
    irb_str_printf(out, "</h3>\n");
    verdict(out, page, s);
    irb_str_printf(out, "<div class=\"scroll\"><table class=\"answers\"><tbody>\n");
    answer(out, page, s, M(indirect_relmse), "least relMSE");
    answer(out, page, s, M(indirect_rmse), "least RMSE");
    answer(out, page, s, M(indirect_flicker), "least flicker");
    answer(out, page, s, M(frame_ms), "fastest");
    if (irb_html_best(scene, M(frame_ms)) >= 0)
        front(out, scene);
    irb_str_printf(out,
                   "</tbody></table></div>\n"
                   "<h4 hidden>Where they fail: the best trial of each method, HDR-FLIP of its "
                   "worst frame (bright is wrong)</h4>\n"
                   "<ul class=\"fails\" data-scene=\"%d\"></ul>\n</article>\n",
                   s);
}

void irb_html_glance(struct irb_str *out, const struct irb_html_page *page)
{
    if (!page->analysis.scene_count)
        irb_str_printf(out, "<p>The run has no trials yet.</p>\n");
    for (int s = 0; s < page->analysis.scene_count; s++)
        card(out, page, s);
    if (page->analysis.scene_count)
        irb_str_printf(
            out,
            "<p class=\"small muted\">Errors are of the indirect image, against bounce 1 "
            "with exact visibility. Not distinguishable: the %g&nbsp;%% interval of the ratio of "
            "the two contains 1. Worth their time: no other trial has both less HDR-FLIP "
            "and a shorter frame.</p>\n",
            100 * page->analysis.confidence);
}

void irb_html_notes(struct irb_str *out, const struct irb_html_page *page)
{
    char *progress = irb_html_meta(page, "progress");
    if (*progress == '{')
        irb_str_printf(out, "<p class=\"note\">This run was not finished when the report was made: "
                            "numbers are of what was there.</p>\n");
    free(progress);
}
