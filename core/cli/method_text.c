/* SPDX-License-Identifier: MIT */
#include "core/cli/method_text.h"

#include <stdlib.h>

/* A yes or no that follows from parameters. */
struct property {
    const struct irb_method *method;
    unsigned need; /* 0: indirect visibility */
};

static bool holds(const struct property *property, const void *params)
{
    const struct irb_method *method = property->method;
    if (property->need)
        return method->needs && (method->needs(params) & property->need);
    return method->claims_visibility && method->claims_visibility(params);
}

static int choices_of(const struct irb_option *option)
{
    int count = 0;
    if (option->type == IRB_TYPE_BOOL)
        return 2;
    while (option->type == IRB_TYPE_ENUM && option->choices[count])
        count++;
    return count; /* of numbers none */
}

static void *default_params(const struct irb_method *method)
{
    void *params = calloc(1, method->params_size ? method->params_size : 1);
    if (!params)
        abort(); /* a few bytes */
    irb_options_default(method->params, params);
    return params;
}

/* Appends every choice that alone makes it otherwise than the defaults do: what `before` says, then
 * NAME=VALUE, NAME=VALUE. Returns how many. */
static int list_exceptions(const struct property *property, const char *before, const char *quote,
                           struct irb_str *out)
{
    void *params = default_params(property->method);
    bool usual = holds(property, params);
    int count = 0;
    for (const struct irb_option *o = property->method->params; o->name; o++) {
        for (int i = 0; i < choices_of(o); i++) {
            irb_option_store(o, params, i);
            if (holds(property, params) == usual)
                continue;
            irb_str_printf(out, "%s%s%s=", count++ ? ", " : before, quote, o->name);
            irb_option_print(o, params, out);
            irb_str_printf(out, "%s", quote);
        }
        irb_option_store(o, params, o->default_value);
    }
    free(params);
    return count;
}

static bool usually(const struct property *property)
{
    void *params = default_params(property->method);
    bool usual = holds(property, params);
    free(params);
    return usual;
}

void irb_method_visibility_text(const struct irb_method *method, const char *quote,
                                struct irb_str *out)
{
    const struct property visibility = {.method = method};
    irb_str_printf(out, "%s indirect visibility", usually(&visibility) ? "with" : "no");
    list_exceptions(&visibility, ", but for ", quote, out);
}

void irb_method_needs_text(const struct irb_method *method, unsigned need, const char *what,
                           const char *quote, struct irb_str *out)
{
    const struct property needed = {.method = method, .need = need};
    struct irb_str exceptions = {0};
    bool usual = usually(&needed);
    int count = list_exceptions(&needed, usual ? ", but for " : " with ", quote, &exceptions);
    if (usual || count)
        irb_str_printf(out, " %s%s.", what, irb_str_text(&exceptions));
    irb_str_free(&exceptions);
}
