/* SPDX-License-Identifier: MIT
 *
 * The parts of a report's page. Each appends HTML; none fails: what is not there is said or left
 * out. For core/report only.
 */
#ifndef IRB_REPORT_HTML_PARTS_H
#define IRB_REPORT_HTML_PARTS_H

#include "core/report/analysis.h"
#include "core/report/html_images.h"
#include "core/report/names.h"
#include "core/report/table_data.h"
#include "core/store/store.h"

struct irb_html_page {
    const char *run_dir;
    const struct irb_html_options *options;
    struct irb_store *store;
    struct irb_analysis analysis;
    struct irb_table_data table; /* for the scores of named regions */
    struct irb_html_images images;
    struct irb_str figures;  /* drawn once */
    struct irb_names others; /* methods without a colour of their own, in the run's order */
    char nonce[33];          /* of the page's one script: no other runs */
};

/* ---- in several parts */

/* A run's text, malloc'ed, "" where it has none. */
char *irb_html_meta(const struct irb_html_page *page, const char *name);
/* "#0072B2", as in the figures. */
const char *irb_html_colour(const struct irb_html_page *page, const char *method);
/* The trial's name with its colour, the parameters in a weaker ink. */
void irb_html_trial(struct irb_str *out, const struct irb_html_page *page,
                    const struct irb_analysis_trial *trial);
/* The trial that has the best value of those that are ranked; -1 where none is. */
int irb_html_best(const struct irb_analysis_scene *scene, int metric);
/* Whether trial t cannot be told from the best one (which it is not). */
bool irb_html_same(const struct irb_html_page *page, int scene, int t, int best, int metric);
/* "0.247" or "[0.241, 0.253]"; the second is "" where there is no interval. */
void irb_html_value(char out[32], const struct irb_measure *measure, int digits);
void irb_html_interval(char out[80], const struct irb_measure *measure, int digits);

/* ---- the parts, by the names that the page has for them */
void irb_html_notes(struct irb_str *out, const struct irb_html_page *page);
void irb_html_glance(struct irb_str *out, const struct irb_html_page *page);
void irb_html_tables(struct irb_str *out, const struct irb_html_page *page);
void irb_html_figures(struct irb_str *out, const struct irb_html_page *page);
void irb_html_provenance(struct irb_str *out, const struct irb_html_page *page);
void irb_html_data(struct irb_str *out, const struct irb_html_page *page);

#endif
