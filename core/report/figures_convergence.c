/* SPDX-License-Identifier: MIT */
#include "core/report/figures_convergence.h"
#include "core/report/table_cells.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const int errors[] = {IRB_METRIC_indirect_rmse, IRB_METRIC_indirect_flip};
enum { ERRORS = sizeof errors / sizeof *errors };

/* ---- parameters: the flat JSON object that the store has of a trial ---- */

/* "name": value of `json`, from *place on, which moves behind it; false at the end. Both texts
 * without their quotes, borrowed. */
struct member {
    const char *name, *value;
    size_t name_length, value_length;
    bool is_text;
};

static bool next_member(const char **place, struct member *m)
{
    const char *name = strchr(*place, '"');
    const char *end = name ? strchr(name + 1, '"') : NULL;
    if (!end)
        return false;
    const char *value = end + 1 + strspn(end + 1, ": \n");
    m->name = name + 1;
    m->name_length = (size_t)(end - m->name);
    m->is_text = *value == '"';
    value += m->is_text;
    m->value = value;
    m->value_length = strcspn(value, m->is_text ? "\"" : ",}\n ");
    *place = value + m->value_length + m->is_text;
    return true;
}

/* NaN for what is no number. */
static double number_of(const struct member *m)
{
    char *end;
    double value = m->is_text ? NAN : strtod(m->value, &end);
    return m->is_text || end != m->value + m->value_length ? NAN : value;
}

static bool equal(const struct member *a, const struct member *b)
{
    return a->name_length == b->name_length && a->value_length == b->value_length &&
           a->is_text == b->is_text && !strncmp(a->name, b->name, a->name_length) &&
           !strncmp(a->value, b->value, a->value_length);
}

/* Whether both have the same parameters and values but for the one named, which both have. */
static bool differ_in(const char *a, const char *b, const char *name)
{
    struct member of_a, of_b;
    bool has_a, has_b, found = false;
    size_t length = strlen(name);
    for (;;) {
        has_a = next_member(&a, &of_a);
        has_b = next_member(&b, &of_b);
        if (!has_a || !has_b)
            return found && has_a == has_b;
        bool named = of_a.name_length == length && of_b.name_length == length &&
                     !strncmp(of_a.name, name, length) && !strncmp(of_b.name, name, length);
        found = found || named;
        if (!named && !equal(&of_a, &of_b))
            return false;
    }
}

static double parameter(const char *json, const char *name)
{
    struct member m;
    while (next_member(&json, &m))
        if (m.name_length == strlen(name) && !strncmp(m.name, name, m.name_length))
            return number_of(&m);
    return NAN;
}

/* ---- families ---- */

/* "rsm:mode=all:samples=100" without ":samples=100", malloc'ed. */
static char *family_name(const char *trial, const char *parameter_name)
{
    struct irb_str name = {0};
    size_t length = strlen(parameter_name);
    irb_str_append(&name, "", 0);
    for (const char *part = trial; *part;) {
        size_t size = strcspn(part + 1, ":") + 1;
        bool is_it =
            *part == ':' && !strncmp(part + 1, parameter_name, length) && part[1 + length] == '=';
        if (!is_it)
            irb_str_append(&name, part, size);
        part += size;
    }
    return name.text;
}

/* Trials in order of their number. */
struct family {
    const struct irb_analysis_scene *scene;
    const char *parameter;
    int *trials; /* owned */
    int count;
};

static double x_of(const struct family *f, int i)
{
    return parameter(f->scene->trials[f->trials[i]].params_json, f->parameter);
}

/* All trials that differ from `first` in the parameter alone, and itself. */
static struct family find_family(const struct irb_analysis_scene *scene, int first,
                                 const char *name)
{
    struct family f = {scene, name, calloc((size_t)scene->trial_count, sizeof(int)), 0};
    const struct irb_analysis_trial *trials = scene->trials;
    if (!f.trials)
        abort();
    for (int t = 0; t < scene->trial_count; t++) {
        double x = parameter(trials[t].params_json, name);
        if (strcmp(trials[t].method, trials[first].method) || isnan(x) ||
            !differ_in(trials[first].params_json, trials[t].params_json, name))
            continue;
        int at = f.count++;
        f.trials[at] = t;
        for (; at > 0 && x_of(&f, at) < x_of(&f, at - 1); at--) {
            f.trials[at] = f.trials[at - 1];
            f.trials[at - 1] = t;
        }
    }
    return f;
}

/* Whether the family is not known from an earlier trial, and has two numbers. */
static bool is_new(const struct family *f, int first)
{
    for (int i = 0; i < f->count; i++)
        if (f->trials[i] < first)
            return false;
    return f->count > 1 && x_of(f, 0) < x_of(f, f->count - 1);
}

static void write_family(const struct family *f, struct irb_str *out)
{
    const struct irb_analysis_trial *first = &f->scene->trials[f->trials[0]];
    char *name = family_name(first->trial, f->parameter);
    for (int i = 0; i < f->count; i++) {
        const struct irb_analysis_trial *trial = &f->scene->trials[f->trials[i]];
        const char *const texts[] = {f->scene->name, trial->method, name, f->parameter};
        for (int c = 0; c < 4; c++) {
            irb_str_printf(out, "%s", c ? "," : "");
            irb_csv_text(out, texts[c]);
        }
        irb_csv_number(out, x_of(f, i));
        for (int e = 0; e < ERRORS; e++)
            irb_csv_measure(out, &trial->measures[errors[e]]);
        irb_str_printf(out, "\n");
    }
    free(name);
}

void irb_convergence_titles(struct irb_str *out)
{
    irb_str_printf(out, "scene,method,family,parameter,x");
    for (int e = 0; e < ERRORS; e++) {
        const char *name = irb_metrics[errors[e]].name;
        irb_str_printf(out, ",%s,%s_low,%s_high", name, name, name);
    }
}

void irb_convergence_lines(const struct irb_analysis *analysis,
                           const struct irb_analysis_scene *scene, struct irb_str *out)
{
    (void)analysis;
    for (int t = 0; t < scene->trial_count; t++) {
        const char *place = scene->trials[t].params_json;
        struct member m;
        while (next_member(&place, &m)) {
            if (isnan(number_of(&m)))
                continue;
            char *name = irb_asprintf("%.*s", (int)m.name_length, m.name);
            struct family f = find_family(scene, t, name);
            if (is_new(&f, t))
                write_family(&f, out);
            free(f.trials);
            free(name);
        }
    }
}
