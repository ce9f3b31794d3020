/* SPDX-License-Identifier: MIT */
#include "core/report/measure_text.h"
#include "core/report/table_view.h"

#include <math.h>
#include <string.h>

enum { DIGITS = 3 };

static bool is_exact(const struct irb_interval *i)
{
    return i->low == i->value && i->high == i->value;
}

static bool has_ends(const struct irb_interval *i)
{
    return !isnan(i->low) && !isnan(i->high) && !is_exact(i);
}

static void number(struct irb_str *out, int metric, double value)
{
    char text[32];
    irb_table_number(text, metric == IRB_METRIC_gl_bytes ? value / (1 << 20) : value, DIGITS);
    irb_str_printf(out, "%s", text);
}

static const char *unit_of(int metric)
{
    return metric == IRB_METRIC_gl_bytes ? "MiB" : irb_metrics[metric].unit;
}

void irb_measure_text(struct irb_str *out, const struct irb_measure *measure, int metric)
{
    const struct irb_interval *i = &measure->interval;
    number(out, metric, i->value);
    if (has_ends(i)) {
        irb_str_printf(out, " [");
        number(out, metric, i->low);
        irb_str_printf(out, ", ");
        number(out, metric, i->high);
        irb_str_printf(out, "]");
    }
}

void irb_metric_text(struct irb_str *out, int metric, double value)
{
    number(out, metric, value);
    if (!isnan(value) && *unit_of(metric))
        irb_str_printf(out, " %s", unit_of(metric));
}

/* Two decimals; three next to 1, so that what lies on one side of it does not print as 1.00. */
static void ratio_number(struct irb_str *out, double value)
{
    char text[32];
    irb_table_number(text, value, DIGITS);
    if (value >= 0.1 && value < 10)
        irb_str_printf(out, "%.*f", value != 1 && fabs(value - 1) < 0.01 ? 3 : 2, value);
    else
        irb_str_printf(out, "%s", text);
}

void irb_ratio_text(struct irb_str *out, const struct irb_measure *ratio)
{
    const struct irb_interval *i = &ratio->interval;
    if (isnan(i->value)) {
        irb_str_printf(out, "-");
        return;
    }
    irb_str_printf(out, "%s", irb_interval_contains(i, 1) ? "~ " : "");
    ratio_number(out, i->value);
    irb_str_printf(out, "%s", is_exact(i) ? " exact" : "");
    if (has_ends(i)) {
        irb_str_printf(out, " [");
        ratio_number(out, i->low);
        irb_str_printf(out, ", ");
        ratio_number(out, i->high);
        irb_str_printf(out, "]");
    }
}
