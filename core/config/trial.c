/* SPDX-License-Identifier: MIT
 *
 * A trial's parameters, the method's and the core's; its name, "method:option=value:option=value",
 * as it is parsed and printed.
 */
#include "core/base/str.h"
#include "core/config/parts.h"

#include <stdlib.h>
#include <string.h>

const struct irb_option irb_trial_options[] = {
    IRB_OPTION_INT(
        struct irb_trial_settings, rsm_resolution, 0, 0, IRB_MOST_RSM_RESOLUTION, "texels",
        "side of the reflective shadow map that the method is given; 0 = the config's", "ours"),
    IRB_OPTION_END,
};

/* ---- parameters ---- */

bool irb_trial_option_is_core(const struct irb_option *option)
{
    for (const struct irb_option *o = irb_trial_options; o->name; o++)
        if (o == option)
            return true;
    return false;
}

const struct irb_option *irb_trial_option(const struct irb_method *method, int index)
{
    const struct irb_option *o = method->params;
    for (; o->name; o++)
        if (!index--)
            return o;
    for (o = irb_trial_options; o->name; o++)
        if (!irb_option_find(method->params, o->name) && !index--)
            return o;
    return NULL;
}

int irb_trial_option_find(const struct irb_method *method, const char *name)
{
    const struct irb_option *o;
    for (int i = 0; (o = irb_trial_option(method, i)); i++)
        if (!strcmp(o->name, name))
            return i;
    return -1;
}

int irb_trial_rsm_resolution(const struct irb_trial *trial,
                             const struct irb_render_settings *render)
{
    return trial->core.rsm_resolution ? trial->core.rsm_resolution : render->rsm_resolution;
}

void irb_trial_hash_core(const struct irb_trial *trial, struct irb_hash *hash)
{
    for (const struct irb_option *o = irb_trial_options; o->name; o++) {
        struct irb_str text = {0};
        if (irb_option_is_default(o, &trial->core))
            continue;
        irb_str_printf(&text, "%s=", o->name);
        irb_option_print(o, &trial->core, &text);
        irb_hash_string(hash, irb_str_text(&text));
        irb_str_free(&text);
    }
}

bool irb_trial_refuse_track(const struct irb_option *option, struct irb_error *err)
{
    return irb_fail(err, IRB_E_INPUT,
                    "%s: expected one value, found keys; it stays the same over the sequence",
                    option->name);
}

/* ---- the trial ---- */

bool irb_trial_begin(struct irb_trial *trial, const struct irb_method *method,
                     struct irb_error *err)
{
    /* zeroed, so that padding has one value too */
    void *params = calloc(1, method->params_size ? method->params_size : 1);
    if (!params)
        return irb_fail(err, IRB_E_MEMORY, "out of memory for the parameters of '%s'",
                        method->name);
    *trial = (struct irb_trial){.method = method, .params = params};
    irb_options_default(method->params, params);
    irb_options_default(irb_trial_options, &trial->core);
    irb_trial_rename(trial);
    return true;
}

void irb_trial_rename(struct irb_trial *trial)
{
    struct irb_str name = {0};
    irb_str_printf(&name, "%s", trial->method->name);
    const struct irb_option *o;
    for (int i = 0; (o = irb_trial_option(trial->method, i)); i++) {
        if (irb_trial_is_default(trial, o))
            continue;
        irb_str_printf(&name, ":%s=", o->name);
        irb_trial_print(trial, o, &name);
    }
    free(trial->name);
    trial->name = name.text;
}

bool irb_trial_set(struct irb_trial *trial, const char *name, const char *text,
                   struct irb_error *err)
{
    const struct irb_method *method = trial->method;
    const struct irb_option *core = irb_option_find(irb_trial_options, name);
    if (core && !irb_option_find(method->params, name))
        return irb_track_is_text(text)
                   ? irb_trial_refuse_track(core, err)
                   : irb_option_set(irb_trial_options, &trial->core, name, text, err);
    if (!method->params->name)
        return irb_fail(err, IRB_E_INPUT, "unknown key '%.64s'; %s has no parameters", name,
                        method->name);
    const struct irb_option *option = irb_option_find(method->params, name);
    if (option && irb_track_is_text(text))
        return irb_trial_parse_track(trial, option, text, err);
    if (!irb_option_set(method->params, trial->params, name, text, err))
        return false;
    irb_trial_drop_track(trial, option);
    return true;
}

void irb_trial_destroy(struct irb_trial *trial)
{
    irb_trial_destroy_tracks(trial);
    free(trial->params);
    free(trial->name);
    free(trial->folder);
    free(trial->place);
    *trial = (struct irb_trial){0};
}

/* One "option=value", which is cut in two in place. `before`: the options that were set already,
 * each between colons. */
static bool set_option(struct irb_trial *trial, char *assignment, struct irb_str *before,
                       struct irb_error *err)
{
    char *equals = strchr(assignment, '=');
    if (!equals || equals == assignment)
        return irb_fail(err, IRB_E_INPUT, "expected option=value, found '%.64s'", assignment);
    *equals = 0;
    char *key = irb_asprintf(":%s:", assignment);
    bool twice = strstr(irb_str_text(before), key) != NULL;
    irb_str_printf(before, "%s", key);
    free(key);
    if (twice)
        return irb_fail(err, IRB_E_INPUT, "'%.64s' is given twice", assignment);
    return irb_trial_set(trial, assignment, equals + 1, err);
}

static bool set_options(struct irb_trial *trial, char *text, struct irb_error *err)
{
    struct irb_str before = {0};
    bool ok = true;
    while (ok && text) {
        char *next = strchr(text, ':');
        if (next)
            *next++ = 0;
        ok = set_option(trial, text, &before, err);
        text = next;
    }
    irb_str_free(&before);
    return ok;
}

bool irb_trial_parse(struct irb_trial *trial, const char *text, const struct irb_registry *registry,
                     struct irb_error *err)
{
    *trial = (struct irb_trial){0};
    char *copy = irb_strdup(text);
    char *options = strchr(copy, ':');
    if (options)
        *options++ = 0;
    const struct irb_method *method = irb_registry_find(registry, copy, err);
    bool ok = method && irb_trial_begin(trial, method, err) &&
              (!options || set_options(trial, options, err));
    free(copy);
    if (!ok) {
        irb_trial_destroy(trial);
        return irb_error_prefix(err, "trial '%.128s'", text);
    }
    irb_trial_rename(trial);
    return true;
}
