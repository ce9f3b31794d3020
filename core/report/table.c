/* SPDX-License-Identifier: MIT
 *
 * The complete tables, csv and json; and which writer a format has.
 */
#include "core/report/table.h"
#include "core/base/str.h"
#include "core/report/table_data.h"
#include "core/report/table_latex.h"
#include "core/report/table_text.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *const irb_table_format_names[] = {"text", "csv", "md", "json", "latex", NULL};

bool irb_table_format_parse(const char *text, enum irb_table_format *format, struct irb_error *err)
{
    for (int i = 0; irb_table_format_names[i]; i++) {
        if (!strcmp(text, irb_table_format_names[i])) {
            *format = (enum irb_table_format)i;
            return true;
        }
    }
    return irb_fail(err, IRB_E_USAGE,
                    "format: expected text, csv, md, json or latex, found '%.64s'", text);
}

/* ---- json ---- */

static void json_row(const struct irb_table_data *data, const struct irb_table_row *row,
                     struct irb_str *out)
{
    const struct irb_store_trial_row *trial = row->trial;
    irb_str_printf(out, "{\"scene\": ");
    irb_str_json_string(out, trial->scene);
    irb_str_printf(out, ", \"method\": ");
    irb_str_json_string(out, trial->method);
    irb_str_printf(out, ", \"trial\": ");
    irb_str_json_string(out, trial->trial);
    irb_str_printf(out, ", \"params\": %s", *trial->params_json ? trial->params_json : "{}");
    irb_str_printf(out, ", \"seed\": ");
    irb_str_json_number(out, row->seeds > 1 ? NAN : trial->seed);
    irb_str_printf(out, ", \"seeds\": %d", row->seeds);
    for (int i = 0; i < IRB_METRIC_COUNT; i++) {
        irb_str_printf(out, ", \"%s\": ", irb_metrics[i].name);
        irb_str_json_number(out, row->metrics[i]);
    }
    for (int i = 0; i < data->region_metric_count; i++) {
        irb_str_printf(out, ", ");
        irb_str_json_string(out, data->region_metrics[i]);
        irb_str_printf(out, ": ");
        irb_str_json_number(out, row->regions[i]);
    }
    for (int i = 0; i < data->stage_count; i++) {
        char *key = irb_asprintf("stage_%s_ms", data->stages[i]);
        irb_str_printf(out, ", ");
        irb_str_json_string(out, key);
        irb_str_printf(out, ": ");
        irb_str_json_number(out, row->stage_ms[i]);
        free(key);
    }
    for (int i = 0; data->has_spread && i < IRB_METRIC_COUNT; i++) {
        irb_str_printf(out, ", \"%s_sd\": ", irb_metrics[i].name);
        irb_str_json_number(out, row->spread[i]);
    }
    irb_str_printf(out, "}");
}

static void write_json(const struct irb_table_data *data, struct irb_str *out)
{
    irb_str_printf(out, "[");
    for (int i = 0; i < data->row_count; i++) {
        irb_str_printf(out, "%s\n ", i ? "," : "");
        json_row(data, &data->rows[i], out);
    }
    irb_str_printf(out, "%s]\n", data->row_count ? "\n" : "");
}

/* ---- csv (RFC 4180, but for its line ends, which are plain) ---- */

static void csv_text(struct irb_str *out, const char *text)
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

static void csv_number(struct irb_str *out, double value)
{
    irb_str_printf(out, ",");
    if (!isnan(value))
        irb_str_printf(out, "%.9g", value);
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

static void csv_header(const struct irb_table_data *data, struct irb_str *out)
{
    irb_str_printf(out, "scene,method,trial,params,seed,seeds");
    for (int i = 0; i < IRB_METRIC_COUNT; i++)
        irb_str_printf(out, ",%s", irb_metrics[i].name);
    for (int i = 0; i < data->region_metric_count; i++)
        irb_str_printf(out, ",%s", data->region_metrics[i]);
    for (int i = 0; i < data->stage_count; i++) {
        char *name = irb_asprintf("stage_%s_ms", data->stages[i]);
        irb_str_printf(out, ",");
        csv_text(out, name);
        free(name);
    }
    for (int i = 0; data->has_spread && i < IRB_METRIC_COUNT; i++)
        irb_str_printf(out, ",%s_sd", irb_metrics[i].name);
    irb_str_printf(out, "\n");
}

static void csv_row(const struct irb_table_data *data, const struct irb_table_row *row,
                    struct irb_str *out)
{
    char *params = csv_params(row->trial->params_json);
    const char *const texts[] = {row->trial->scene, row->trial->method, row->trial->trial, params};
    for (int c = 0; c < 4; c++) {
        irb_str_printf(out, "%s", c ? "," : "");
        csv_text(out, texts[c]);
    }
    free(params);
    csv_number(out, row->seeds > 1 ? NAN : row->trial->seed);
    csv_number(out, row->seeds);
    for (int m = 0; m < IRB_METRIC_COUNT; m++)
        csv_number(out, row->metrics[m]);
    for (int r = 0; r < data->region_metric_count; r++)
        csv_number(out, row->regions[r]);
    for (int s = 0; s < data->stage_count; s++)
        csv_number(out, row->stage_ms[s]);
    for (int m = 0; data->has_spread && m < IRB_METRIC_COUNT; m++)
        csv_number(out, row->spread[m]);
    irb_str_printf(out, "\n");
}

static void write_csv(const struct irb_table_data *data, struct irb_str *out)
{
    csv_header(data, out);
    for (int i = 0; i < data->row_count; i++)
        csv_row(data, &data->rows[i], out);
}

bool irb_table_write(FILE *out, struct irb_store *store, const struct irb_table_options *options,
                     struct irb_error *err)
{
    struct irb_table_data data;
    if (!irb_table_data_read(&data, store, options->per_seed, err))
        return false;
    struct irb_str text = {0};
    switch (options->format) {
    case IRB_TABLE_TEXT:
        irb_table_text(&data, options->colour, &text);
        break;
    case IRB_TABLE_MD:
        irb_table_markdown(&data, &text);
        break;
    case IRB_TABLE_CSV:
        write_csv(&data, &text);
        break;
    case IRB_TABLE_JSON:
        write_json(&data, &text);
        break;
    case IRB_TABLE_LATEX:
        irb_table_latex(&data, &text);
        break;
    }
    irb_table_data_destroy(&data);
    bool ok = fwrite(irb_str_text(&text), 1, text.length, out) == text.length && !fflush(out);
    irb_str_free(&text);
    return ok || irb_fail(err, IRB_E_IO, "cannot write the table: %s", strerror(errno));
}
