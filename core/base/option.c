/* SPDX-License-Identifier: MIT */
#include "core/base/option.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static void *field_of(const struct irb_option *option, void *settings)
{
    return (char *)settings + option->offset;
}

double irb_option_value(const struct irb_option *option, const void *settings)
{
    const void *field = (const char *)settings + option->offset;
    switch (option->type) {
    case IRB_TYPE_BOOL:
        return *(const bool *)field;
    case IRB_TYPE_FLOAT:
        return *(const float *)field;
    default:
        return *(const int *)field;
    }
}

void irb_option_store(const struct irb_option *option, void *settings, double value)
{
    void *field = field_of(option, settings);
    switch (option->type) {
    case IRB_TYPE_BOOL:
        *(bool *)field = value != 0;
        break;
    case IRB_TYPE_FLOAT:
        *(float *)field = (float)value;
        break;
    default:
        *(int *)field = (int)value;
    }
}

void irb_options_default(const struct irb_option *options, void *settings)
{
    for (const struct irb_option *o = options; o->name; o++)
        irb_option_store(o, settings, o->default_value);
}

const struct irb_option *irb_option_find(const struct irb_option *options, const char *name)
{
    for (const struct irb_option *o = options; o->name; o++)
        if (!strcmp(o->name, name))
            return o;
    return NULL;
}

static bool unknown_option(const struct irb_option *options, const char *name,
                           struct irb_error *err)
{
    enum { MOST = 128 };
    const char *names[MOST] = {0};
    size_t count = 0;
    for (const struct irb_option *o = options; o->name && count < MOST; o++)
        names[count++] = o->name;
    const char *near = irb_nearest(name, names, count);
    if (near)
        return irb_fail(err, IRB_E_INPUT, "unknown key '%s'; did you mean '%s'?", name, near);
    struct irb_str list = {0};
    for (size_t i = 0; i < count; i++)
        irb_str_printf(&list, "%s%s", i ? ", " : "", names[i]);
    irb_fail(err, IRB_E_INPUT, "unknown key '%s'; expected one of: %s", name, irb_str_text(&list));
    irb_str_free(&list);
    return false;
}

static bool parse_bool(const char *text, bool *value)
{
    static const char *const yes[] = {"true", "yes", "on", "1"};
    static const char *const no[] = {"false", "no", "off", "0"};
    for (size_t i = 0; i < 4; i++) {
        if (!strcasecmp(text, yes[i]) || !strcasecmp(text, no[i])) {
            *value = !strcasecmp(text, yes[i]);
            return true;
        }
    }
    return false;
}

static bool set_enum(const struct irb_option *option, void *settings, const char *text,
                     struct irb_error *err)
{
    struct irb_str list = {0};
    for (int i = 0; option->choices[i]; i++) {
        if (!strcmp(option->choices[i], text)) {
            irb_option_store(option, settings, i);
            irb_str_free(&list);
            return true;
        }
        irb_str_printf(&list, "%s%s", i ? ", " : "", option->choices[i]);
    }
    irb_fail(err, IRB_E_INPUT, "%s: expected one of %s; found '%s'", option->name,
             irb_str_text(&list), text);
    irb_str_free(&list);
    return false;
}

static bool set_number(const struct irb_option *option, void *settings, const char *text,
                       struct irb_error *err)
{
    char *end = NULL;
    errno = 0;
    double value = strtod(text, &end);
    bool whole = option->type == IRB_TYPE_INT;
    /* negated comparisons, so that NaN fails them */
    bool valid = end != text && !*end && !(whole && value != floor(value)) &&
                 value >= option->min && value <= option->max;
    if (!valid)
        return irb_fail(err, IRB_E_INPUT, "%s: expected %s in [%g, %g]%s%s; found '%s'",
                        option->name, whole ? "a whole number" : "a number", option->min,
                        option->max, *option->unit ? " " : "", option->unit, text);
    irb_option_store(option, settings, value);
    return true;
}

bool irb_option_set(const struct irb_option *options, void *settings, const char *name,
                    const char *text, struct irb_error *err)
{
    const struct irb_option *option = irb_option_find(options, name);
    if (!option)
        return unknown_option(options, name, err);
    if (option->type == IRB_TYPE_ENUM)
        return set_enum(option, settings, text, err);
    if (option->type != IRB_TYPE_BOOL)
        return set_number(option, settings, text, err);
    bool value;
    if (!parse_bool(text, &value))
        return irb_fail(err, IRB_E_INPUT, "%s: expected true or false; found '%s'", name, text);
    irb_option_store(option, settings, value);
    return true;
}

/* The shortest decimal that reads back as the same float: 0.1, not 0.100000001. */
static void print_float(double value, struct irb_str *out)
{
    char text[32];
    for (int digits = 6; digits <= 9; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, value);
        if (strtof(text, NULL) == (float)value)
            break;
    }
    irb_str_printf(out, "%s", text);
}

void irb_option_print_value(const struct irb_option *option, double value, struct irb_str *out)
{
    switch (option->type) {
    case IRB_TYPE_BOOL:
        irb_str_printf(out, "%s", value != 0 ? "true" : "false");
        break;
    case IRB_TYPE_ENUM:
        irb_str_printf(out, "%s", option->choices[(int)value]);
        break;
    case IRB_TYPE_FLOAT:
        print_float(value, out);
        break;
    default:
        irb_str_printf(out, "%.0f", value);
    }
}

void irb_option_print(const struct irb_option *option, const void *settings, struct irb_str *out)
{
    irb_option_print_value(option, irb_option_value(option, settings), out);
}

bool irb_option_is_default(const struct irb_option *option, const void *settings)
{
    double value = irb_option_value(option, settings);
    if (option->type == IRB_TYPE_FLOAT)
        return (float)value == (float)option->default_value;
    return value == option->default_value;
}

void irb_options_hash(const struct irb_option *options, const void *settings, struct irb_hash *hash)
{
    struct irb_str text = {0};
    for (const struct irb_option *o = options; o->name; o++) {
        irb_str_printf(&text, "%s=", o->name);
        irb_option_print(o, settings, &text);
        irb_str_append(&text, ";", 1);
    }
    irb_hash_string(hash, irb_str_text(&text));
    irb_str_free(&text);
}
