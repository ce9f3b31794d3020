/* SPDX-License-Identifier: MIT */
#include "core/config/sweep.h"
#include "core/base/str.h"

#include <stdlib.h>
#include <string.h>

static const char matrix_key[] = "matrix";

enum { MOST_PARAMS = 128 }; /* of a trial */

/* What is said of each parameter, in the order of irb_trial_option(); NULL where nothing is. */
struct sweep {
    struct irb_yaml *yaml;
    const struct irb_method *method;
    irb_yaml_node values[MOST_PARAMS]; /* a value, a map of its keys, or a list of these */
    irb_sweep_fn fn;
    void *user;
};

static const char *key_text(irb_yaml_node key)
{
    return (const char *)key->data.scalar.value;
}

/* A method may have a parameter of that name; then it is that parameter. */
static bool is_matrix(const struct irb_method *method, irb_yaml_node key)
{
    return !strcmp(key_text(key), matrix_key) && !irb_option_find(method->params, matrix_key);
}

static bool unknown_key(struct sweep *s, irb_yaml_node key, struct irb_error *err)
{
    struct irb_trial trial = {.method = s->method};
    if (!irb_trial_begin(&trial, s->method, err))
        return false;
    irb_trial_set(&trial, key_text(key), "", err); /* names the nearest */
    irb_trial_destroy(&trial);
    irb_error_prefix(err, "%s", s->method->name);
    return irb_yaml_prefix(s->yaml, key, err);
}

/* Lays the values of a map over what is there. */
static bool merge(struct sweep *s, irb_yaml_node map, struct irb_error *err)
{
    if (!irb_yaml_check_map(s->yaml, map, s->method->name, NULL, err))
        return false;
    for (int i = 0; i < irb_yaml_pairs(map); i++) {
        irb_yaml_node key = irb_yaml_key(s->yaml, map, i);
        int option = irb_trial_option_find(s->method, key_text(key));
        if (option >= 0)
            s->values[option] = irb_yaml_value(s->yaml, map, i);
        else if (!is_matrix(s->method, key))
            return unknown_key(s, key, err);
    }
    return true;
}

static bool set_value(struct sweep *s, struct irb_trial *trial, const struct irb_option *option,
                      irb_yaml_node value, struct irb_error *err)
{
    if (value->type == YAML_MAPPING_NODE)
        return irb_trial_read_track(trial, option, s->yaml, value, err);
    const char *text = irb_yaml_text(s->yaml, value, option->name, err);
    if (!text)
        return false;
    if (irb_trial_set(trial, option->name, text, err))
        return true;
    irb_error_prefix(err, "%s", s->method->name);
    return irb_yaml_prefix(s->yaml, value, err);
}

/* Every value of the list must be one, and none may stand there twice ("1" and "1.0" are one). */
static bool check_list(struct sweep *s, const struct irb_option *option, irb_yaml_node list,
                       struct irb_error *err)
{
    int count = irb_yaml_count(list);
    char **before = calloc((size_t)count, sizeof *before);
    struct irb_trial scratch = {0};
    bool ok = before ? irb_trial_begin(&scratch, s->method, err)
                     : irb_fail(err, IRB_E_MEMORY, "%s: out of memory", s->yaml->path);
    for (int i = 0; ok && i < count; i++) {
        irb_yaml_node item = irb_yaml_item(s->yaml, list, i);
        struct irb_str text = {0};
        ok = set_value(s, &scratch, option, item, err);
        if (!ok)
            break;
        irb_trial_print(&scratch, option, &text);
        before[i] = text.text;
        for (int j = 0; ok && j < i; j++)
            if (!strcmp(before[i], before[j]))
                ok = irb_yaml_fail(s->yaml, item, err, "%s.%s: %.64s stands here twice",
                                   s->method->name, option->name, irb_str_text(&text));
    }
    for (int i = 0; before && i < count; i++)
        free(before[i]);
    free(before);
    irb_trial_destroy(&scratch);
    return ok;
}

static int values_of(irb_yaml_node value)
{
    return value && value->type == YAML_SEQUENCE_NODE ? irb_yaml_count(value) : 1;
}

/* How many trials there are; *total is bounded. */
static bool check_lists(struct sweep *s, int *total, struct irb_error *err)
{
    const struct irb_option *option;
    *total = 1;
    for (int i = 0; (option = irb_trial_option(s->method, i)); i++) {
        irb_yaml_node value = s->values[i];
        int count = values_of(value);
        if (!count)
            return irb_yaml_fail(s->yaml, value, err,
                                 "%s.%s: expected at least one value, found an empty list",
                                 s->method->name, option->name);
        if (count > IRB_MOST_TRIALS / *total)
            return irb_yaml_fail(s->yaml, value, err,
                                 "%s.%s: expected at most %d trials, found %lld with these values",
                                 s->method->name, option->name, IRB_MOST_TRIALS,
                                 (long long)*total * count);
        *total *= count;
        if (value && value->type == YAML_SEQUENCE_NODE && !check_list(s, option, value, err))
            return false;
    }
    return true;
}

/* The trial at `index`, whose digits are the places in the lists, the last list's first. */
static bool make_trial(struct sweep *s, struct irb_trial *trial, int index, struct irb_error *err)
{
    int place[MOST_PARAMS] = {0}, count = 0;
    while (irb_trial_option(s->method, count))
        count++;
    for (int i = count - 1; i >= 0; i--) {
        place[i] = index % values_of(s->values[i]);
        index /= values_of(s->values[i]);
    }
    if (!irb_trial_begin(trial, s->method, err))
        return false;
    for (int i = 0; i < count; i++) {
        irb_yaml_node value = s->values[i];
        if (!value)
            continue;
        if (value->type == YAML_SEQUENCE_NODE)
            value = irb_yaml_item(s->yaml, value, place[i]);
        if (!set_value(s, trial, irb_trial_option(s->method, i), value, err)) {
            irb_trial_destroy(trial);
            return false;
        }
    }
    irb_trial_rename(trial);
    return true;
}

/* Whether every value is one, also those that an entry of the matrix replaces. */
static bool check_values(struct sweep *s, struct irb_error *err)
{
    struct irb_trial scratch = {0};
    int total;
    if (!check_lists(s, &total, err) || !make_trial(s, &scratch, 0, err))
        return false;
    irb_trial_destroy(&scratch);
    return true;
}

static bool emit(struct sweep *s, struct irb_error *err)
{
    int total;
    if (!check_lists(s, &total, err))
        return false;
    for (int i = 0; i < total; i++) {
        struct irb_trial trial = {0};
        if (!make_trial(s, &trial, i, err) || !s->fn(s->user, &trial, err))
            return false;
    }
    return true;
}

static bool emit_matrix(struct sweep *s, irb_yaml_node list, struct irb_error *err)
{
    if (!irb_yaml_count(list))
        return irb_yaml_fail(
            s->yaml, list, err, "%s.matrix: expected a list of maps, found %s", s->method->name,
            list->type == YAML_SEQUENCE_NODE ? "an empty one" : irb_yaml_kind(list));
    if (!check_values(s, err))
        return false;
    for (int i = 0; i < irb_yaml_count(list); i++) {
        struct sweep entry = *s;
        irb_yaml_node map = irb_yaml_item(s->yaml, list, i);
        irb_yaml_node inner = irb_yaml_find(s->yaml, map, matrix_key);
        if (inner && !irb_option_find(s->method->params, matrix_key))
            return irb_yaml_fail(s->yaml, inner, err, "%s.matrix: expected no matrix inside it",
                                 s->method->name);
        if (!merge(&entry, map, err) || !emit(&entry, err))
            return false;
    }
    return true;
}

bool irb_sweep(struct irb_yaml *yaml, const struct irb_method *method, irb_yaml_node params,
               irb_sweep_fn fn, void *user, struct irb_error *err)
{
    struct sweep s = {.yaml = yaml, .method = method, .fn = fn, .user = user};
    int count = 0;
    while (irb_trial_option(method, count))
        count++;
    if (count > MOST_PARAMS)
        return irb_fail(err, IRB_E_INTERNAL, "%s: has %d parameters, at most %d are supported",
                        method->name, count, MOST_PARAMS);
    if (irb_yaml_is_null(params))
        return emit(&s, err);
    if (!merge(&s, params, err))
        return false;
    irb_yaml_node matrix = irb_option_find(method->params, matrix_key)
                               ? NULL
                               : irb_yaml_find(yaml, params, matrix_key);
    return matrix ? emit_matrix(&s, matrix, err) : emit(&s, err);
}
