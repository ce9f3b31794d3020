/* SPDX-License-Identifier: MIT
 *
 * The complete tables, csv and json; and which writer a format has.
 */
#include "core/report/table.h"
#include "core/base/str.h"
#include "core/report/table_cells.h"
#include "core/report/table_data.h"
#include "core/report/table_frames.h"
#include "core/report/table_latex.h"
#include "core/report/table_measures.h"
#include "core/report/table_partial.h"
#include "core/report/table_ratio.h"
#include "core/report/table_text.h"
#include "core/report/table_view.h"

#include <errno.h>
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

static void json_interval(const struct irb_table_row *row, int metric, struct irb_str *out)
{
    const struct irb_measure *m = &row->measured->measures[metric];
    const char *name = irb_metrics[metric].name;
    irb_json_member(out, "", name, "_low", m->interval.low);
    irb_json_member(out, "", name, "_high", m->interval.high);
    irb_str_printf(out, ", \"%s_unit\": \"%s\"", name, irb_unit_names[m->unit]);
}

static void json_row(const struct irb_table_data *data, const struct irb_table_row *row,
                     struct irb_str *out)
{
    irb_json_row_begin(out, row);
    for (int i = 0; i < IRB_METRIC_COUNT; i++)
        irb_json_member(out, "", irb_metrics[i].name, "", row->metrics[i]);
    for (int i = 0; i < data->region_metrics.count; i++)
        irb_json_member(out, "", data->region_metrics.list[i], "", row->regions.list[i]);
    for (int i = 0; i < data->stages.count; i++)
        irb_json_member(out, "stage_", data->stages.list[i], "_ms", row->stage_ms.list[i]);
    for (int i = 0; data->has_spread && i < IRB_METRIC_COUNT; i++)
        irb_json_member(out, "", irb_metrics[i].name, "_sd", row->spread[i]);
    for (int i = 0; row->measured && i < IRB_RANKED_METRICS; i++)
        json_interval(row, irb_ranked_metrics[i], out);
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

/* ---- csv ---- */

static void csv_header(const struct irb_table_data *data, struct irb_str *out)
{
    irb_csv_row_titles(out);
    for (int i = 0; i < IRB_METRIC_COUNT; i++)
        irb_csv_title(out, "", irb_metrics[i].name, "");
    for (int i = 0; i < data->region_metrics.count; i++)
        irb_csv_title(out, "", data->region_metrics.list[i], "");
    for (int i = 0; i < data->stages.count; i++)
        irb_csv_title(out, "stage_", data->stages.list[i], "_ms");
    for (int i = 0; data->has_spread && i < IRB_METRIC_COUNT; i++)
        irb_csv_title(out, "", irb_metrics[i].name, "_sd");
    for (int i = 0; data->analysis.scene_count && i < IRB_RANKED_METRICS; i++) {
        irb_csv_title(out, "", irb_metrics[irb_ranked_metrics[i]].name, "_low");
        irb_csv_title(out, "", irb_metrics[irb_ranked_metrics[i]].name, "_high");
        irb_csv_title(out, "", irb_metrics[irb_ranked_metrics[i]].name, "_unit");
    }
    irb_str_printf(out, "\n");
}

static void csv_row(const struct irb_table_data *data, const struct irb_table_row *row,
                    struct irb_str *out)
{
    irb_csv_row_begin(out, row);
    for (int m = 0; m < IRB_METRIC_COUNT; m++)
        irb_csv_number(out, row->metrics[m]);
    for (int r = 0; r < data->region_metrics.count; r++)
        irb_csv_number(out, row->regions.list[r]);
    for (int s = 0; s < data->stages.count; s++)
        irb_csv_number(out, row->stage_ms.list[s]);
    for (int m = 0; data->has_spread && m < IRB_METRIC_COUNT; m++)
        irb_csv_number(out, row->spread[m]);
    for (int i = 0; row->measured && i < IRB_RANKED_METRICS; i++) {
        const struct irb_measure *m = &row->measured->measures[irb_ranked_metrics[i]];
        irb_csv_number(out, m->interval.low);
        irb_csv_number(out, m->interval.high);
        irb_str_printf(out, ",%s", irb_unit_names[m->unit]);
    }
    irb_str_printf(out, "\n");
}

static void write_csv(const struct irb_table_data *data, struct irb_str *out)
{
    csv_header(data, out);
    for (int i = 0; i < data->row_count; i++)
        csv_row(data, &data->rows[i], out);
}

/* ---- which table, and how ---- */

static void write_scores(struct irb_table_data *data, const struct irb_table_options *options,
                         struct irb_str *out)
{
    bool for_people = options->format != IRB_TABLE_CSV && options->format != IRB_TABLE_JSON;
    if (for_people)
        irb_table_find_same(data);
    switch (options->format) {
    case IRB_TABLE_TEXT:
        irb_table_text(data, options->colour, out);
        break;
    case IRB_TABLE_MD:
        irb_table_markdown(data, out);
        break;
    case IRB_TABLE_CSV:
        write_csv(data, out);
        break;
    case IRB_TABLE_JSON:
        write_json(data, out);
        break;
    case IRB_TABLE_LATEX:
        irb_table_latex(data, out);
        break;
    }
}

static bool write_subject(struct irb_store *store, const struct irb_table_options *options,
                          struct irb_str *out, struct irb_error *err)
{
    struct irb_table_data data;
    if (options->subject == IRB_TABLE_FRAMES)
        return irb_table_frames(store, options->format, out, err);
    if (options->subject == IRB_TABLE_RATIO)
        return irb_table_ratio(store, options, out, err);
    if (!irb_table_data_read(&data, store, options->per_seed, err))
        return false;
    if (options->subject == IRB_TABLE_SCORES)
        write_scores(&data, options, out);
    else
        irb_table_measures(&data, options, out);
    irb_table_data_destroy(&data);
    return true;
}

bool irb_table_check(const struct irb_table_options *options, struct irb_error *err)
{
    bool for_programs = options->format == IRB_TABLE_CSV || options->format == IRB_TABLE_JSON;
    if (options->subject == IRB_TABLE_RATIO && options->per_seed)
        return irb_fail(err, IRB_E_USAGE, "--ratio is over all seeds; leave out --per-seed");
    return options->subject != IRB_TABLE_FRAMES || for_programs ||
           irb_fail(err, IRB_E_USAGE, "format: frames are printed as csv or json, not as %s",
                    irb_table_format_names[options->format]);
}

bool irb_table_write(FILE *out, struct irb_store *store, const struct irb_table_options *options,
                     struct irb_error *err)
{
    struct irb_str text = {0}, progress = {0};
    if (!irb_table_check(options, err))
        return false;
    if (options->format == IRB_TABLE_LATEX)
        irb_str_printf(&progress, "%% ");
    if (options->format != IRB_TABLE_CSV && options->format != IRB_TABLE_JSON)
        irb_table_progress(store, &progress);
    if (strchr(irb_str_text(&progress), '\n'))
        irb_str_printf(&text, "%s%s", irb_str_text(&progress),
                       options->format == IRB_TABLE_LATEX ? "" : "\n");
    irb_str_free(&progress);
    bool made = write_subject(store, options, &text, err);
    bool ok =
        made && fwrite(irb_str_text(&text), 1, text.length, out) == text.length && !fflush(out);
    irb_str_free(&text);
    return ok || (made && irb_fail(err, IRB_E_IO, "cannot write the table: %s", strerror(errno)));
}
