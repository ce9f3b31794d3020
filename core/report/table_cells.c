/* SPDX-License-Identifier: MIT */
#include "core/report/table_cells.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- csv ---- */

void irb_csv_text(struct irb_str *out, const char *text)
{
    if (!strpbrk(text, ",\"\r\n")) {
        irb_str_printf(out, "%s", text);
        return;
    }
    irb_str_append(out, "\"", 1);
    for (; *text; text++) {
        if (*text == '"')
            irb_str_append(out, "\"", 1);
        irb_str_append(out, text, 1);
    }
    irb_str_append(out, "\"", 1);
}

void irb_csv_number(struct irb_str *out, double value)
{
    irb_str_printf(out, ",");
    if (!isnan(value))
        irb_str_printf(out, "%.9g", value);
}

void irb_csv_measure(struct irb_str *out, const struct irb_measure *measure)
{
    irb_csv_number(out, measure->interval.value);
    irb_csv_number(out, measure->interval.low);
    irb_csv_number(out, measure->interval.high);
}

void irb_csv_title(struct irb_str *out, const char *before, const char *name, const char *behind)
{
    char *title = irb_asprintf("%s%s%s", before, name, behind);
    irb_str_printf(out, ",");
    irb_csv_text(out, title);
    free(title);
}

/* {"mode": "uniform", "samples": 400} as mode=uniform;samples=400: no comma and no quote, so that
 * tools that split lines at commas (gnuplot, cut) read the table as well. Malloc'ed. */
static char *csv_params(const char *json)
{
    struct irb_str text = {0};
    irb_str_append(&text, "", 0);
    for (const char *c = json; *c; c++) {
        if (*c == ',')
            irb_str_append(&text, ";", 1);
        else if (*c == ':')
            irb_str_append(&text, "=", 1);
        else if (!strchr("{}\" \n", *c))
            irb_str_append(&text, c, 1);
    }
    return text.text;
}

void irb_csv_row_titles(struct irb_str *out)
{
    irb_str_printf(out, "scene,method,trial,params,seed,seeds");
}

void irb_csv_row_begin(struct irb_str *out, const struct irb_table_row *row)
{
    char *params = csv_params(row->trial->params_json);
    const char *const texts[] = {row->trial->scene, row->trial->method, row->trial->trial, params};
    for (int c = 0; c < 4; c++) {
        irb_str_printf(out, "%s", c ? "," : "");
        irb_csv_text(out, texts[c]);
    }
    free(params);
    irb_csv_number(out, row->seeds > 1 ? NAN : row->trial->seed);
    irb_csv_number(out, row->seeds);
}

/* ---- json ---- */

void irb_json_member(struct irb_str *out, const char *before, const char *name, const char *behind,
                     double value)
{
    char *key = irb_asprintf("%s%s%s", before, name, behind);
    irb_str_printf(out, ", ");
    irb_str_json_string(out, key);
    irb_str_printf(out, ": ");
    irb_str_json_number(out, value);
    free(key);
}

void irb_json_row_begin(struct irb_str *out, const struct irb_table_row *row)
{
    const struct irb_store_trial_row *trial = row->trial;
    irb_str_printf(out, "{\"scene\": ");
    irb_str_json_string(out, trial->scene);
    irb_str_printf(out, ", \"method\": ");
    irb_str_json_string(out, trial->method);
    irb_str_printf(out, ", \"trial\": ");
    irb_str_json_string(out, trial->trial);
    irb_str_printf(out, ", \"params\": %s", *trial->params_json ? trial->params_json : "{}");
    irb_json_member(out, "", "seed", "", row->seeds > 1 ? NAN : trial->seed);
    irb_str_printf(out, ", \"seeds\": %d", row->seeds);
}
