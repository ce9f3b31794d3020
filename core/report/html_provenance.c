/* SPDX-License-Identifier: MIT
 *
 * Where the page's numbers come from: all that the run says of itself, the metrics' definitions,
 * and how intervals are made.
 */
#include "core/report/html_parts.h"
#include "core/report/html_text.h"

#include <stdlib.h>
#include <string.h>

struct rows {
    struct irb_str *out;
    const char *prefix; /* of the names that are wanted; NULL: those without a slash */
    int count;
};

static void row(void *user, const char *name, const char *value)
{
    struct rows *rows = user;
    bool wanted = rows->prefix ? !strncmp(name, rows->prefix, strlen(rows->prefix))
                               : !strchr(name, '/') && strcmp(name, "config_text");
    if (!wanted)
        return;
    bool lines = strchr(value, '\n');
    irb_str_printf(rows->out, "<tr><th scope=\"row\">");
    irb_html_text(rows->out, name);
    irb_str_printf(rows->out, "</th><td>%s", lines ? "<pre>" : "");
    irb_html_text(rows->out, value);
    irb_str_printf(rows->out, "%s</td></tr>\n", lines ? "</pre>" : "");
    rows->count++;
}

static void table(struct irb_str *out, const struct irb_html_page *page, const char *title,
                  const char *prefix, bool open)
{
    struct irb_str body = {0};
    struct rows rows = {.out = &body, .prefix = prefix};
    irb_store_read_meta(page->store, row, &rows, NULL);
    if (rows.count)
        irb_str_printf(out,
                       "<details%s><summary>%s</summary><table class=\"meta\"><tbody>\n%s"
                       "</tbody></table></details>\n",
                       open ? " open" : "", title, body.text);
    irb_str_free(&body);
}

static void config(struct irb_str *out, const struct irb_html_page *page)
{
    char *text = irb_html_meta(page, "config_text");
    irb_str_printf(out, "<details><summary>The config, as it was read</summary><pre>");
    irb_html_text(out, text);
    irb_str_printf(out, "</pre></details>\n");
    free(text);
}

static void metrics(struct irb_str *out)
{
    irb_str_printf(out,
                   "<details id=\"metrics\"><summary>Definitions of the metrics</summary>"
                   "<p class=\"small\">v is the method's image, r the reference: linear "
                   "radiance in W/(m&sup2; sr), over pixels with geometry and over channels. eps "
                   "= (0.01 &times; mean r of the sequence)&sup2;.</p>"
                   "<table class=\"meta\"><tbody>\n");
    for (int m = 0; m < IRB_METRIC_COUNT; m++) {
        irb_str_printf(out, "<tr><th scope=\"row\"><code>%s</code></th><td>", irb_metrics[m].name);
        irb_html_text(out, irb_metrics[m].doc);
        irb_str_printf(out, "</td><td class=\"muted\">%s</td></tr>\n", irb_metrics[m].unit);
    }
    irb_str_printf(out, "</tbody></table></details>\n");
}

/* By what the trials' intervals were made, of the errors and of the times. */
static void count_units(const struct irb_html_page *page, bool used[4])
{
    for (int s = 0; s < page->analysis.scene_count; s++)
        for (int t = 0; t < page->analysis.scenes[s].trial_count; t++)
            for (int m = 0; m < IRB_METRIC_COUNT; m++)
                used[page->analysis.scenes[s].trials[t].measures[m].unit] = true;
}

static void intervals(struct irb_str *out, const struct irb_html_page *page)
{
    bool used[4] = {false};
    count_units(page, used);
    irb_str_printf(
        out,
        "<details id=\"how-intervals\"><summary>How intervals are made</summary>"
        "<p>Intervals are of %g %% confidence, by the smoothed bootstrap-t over what was repeated "
        "independently: seeds, where a trial has %d of them or more; else, of times, whole rounds "
        "of the sequence; else blocks of frames that follow one another, since frames themselves "
        "are not independent. Seeds stand for all that a method draws at random; blocks tell "
        "from frame to frame only, and so speak of this sequence alone. An error's interval is "
        "extended downwards by what the reference's own noise may have added.</p>"
        "<p>Two trials are compared by the ratio of their values over the same seeds, rounds or "
        "blocks: they are not distinguishable where its interval contains 1.</p><p>In this run: ",
        100 * page->analysis.confidence, IRB_INTERVAL_LEAST_UNITS);
    int listed = 0;
    for (int u = 1; u < 4; u++)
        if (used[u])
            irb_str_printf(out, "%sintervals from %ss", listed++ ? ", " : "", irb_unit_names[u]);
    irb_str_printf(out, "%s.</p></details>\n",
                   listed ? "" : "no intervals, for too few of all three");
}

void irb_html_provenance(struct irb_str *out, const struct irb_html_page *page)
{
    table(out, page, "The run: program, config, machine, driver, time", NULL, true);
    config(out, page);
    intervals(out, page);
    metrics(out);
    table(out, page, "How the scenes were scored: keys of the references, constants", "scene/",
          false);
    table(out, page, "Stages of the methods", "method/", false);
}
