/* SPDX-License-Identifier: MIT */
#include "methods/registry.h"
#include "core/base/str.h"

#include <ctype.h>
#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>

/* The built-in methods, one line each: X(NAME) stands for the `const struct irb_method
 * irb_method_NAME` that methods/NAME defines. The order is that of `irbench list methods`. */
#define IRB_BUILTIN_METHODS(X) X(acrsm) X(clustered_visibility) X(ism) X(rsm) X(rsm_clustering)

#define X(name) extern const struct irb_method irb_method_##name;
IRB_BUILTIN_METHODS(X)
#undef X

static const struct irb_method *const builtin_methods[] = {
#define X(name) &irb_method_##name,
    IRB_BUILTIN_METHODS(X)
#undef X
        NULL,
};

const char *const irb_core_stages[] = {"gbuffer", "rsm", "direct", NULL};

enum {
    MOST_METHODS = sizeof((struct irb_registry *)0)->methods / sizeof(void *),
    MOST_MODULES = sizeof((struct irb_registry *)0)->modules / sizeof(void *),
    MOST_STAGES = 24, /* methods/method.h; the core's own stages share a timer with them */
};

void irb_registry_init(struct irb_registry *registry)
{
    *registry = (struct irb_registry){0};
    for (int i = 0; builtin_methods[i] && i < MOST_METHODS; i++)
        registry->methods[registry->count++] = builtin_methods[i];
}

void irb_registry_close(struct irb_registry *registry)
{
    for (int i = registry->module_count - 1; i >= 0; i--)
        dlclose(registry->modules[i]);
    *registry = (struct irb_registry){0};
}

static const struct irb_method *lookup(const struct irb_registry *registry, const char *name)
{
    for (int i = 0; i < registry->count; i++)
        if (!strcmp(registry->methods[i]->name, name))
            return registry->methods[i];
    return NULL;
}

/* Names are config keys, folder names and the first word of a trial's name. */
static bool name_is_valid(const char *name)
{
    if (!name || !islower((unsigned char)*name))
        return false;
    size_t length = strspn(name, "abcdefghijklmnopqrstuvwxyz0123456789-");
    return !name[length] && length < 64;
}

static size_t field_size(const struct irb_option *option)
{
    switch (option->type) {
    case IRB_TYPE_BOOL:
        return sizeof(bool);
    case IRB_TYPE_FLOAT:
        return sizeof(float);
    default:
        return sizeof(int);
    }
}

static bool check_params(const struct irb_method *method, struct irb_error *err)
{
    if (!method->params || !method->params_size)
        return irb_fail(err, IRB_E_INPUT, "method '%s' declares no parameter table", method->name);
    for (const struct irb_option *o = method->params; o->name; o++) {
        if (!o->unit || !o->doc || !o->source)
            return irb_fail(err, IRB_E_INPUT,
                            "method '%s': parameter '%s' must state unit, doc and source",
                            method->name, o->name);
        if (o->offset + field_size(o) > method->params_size)
            return irb_fail(err, IRB_E_INPUT,
                            "method '%s': parameter '%s' ends at byte %zu of a struct of %zu",
                            method->name, o->name, o->offset + field_size(o), method->params_size);
        if (o->type == IRB_TYPE_ENUM && !o->choices)
            return irb_fail(err, IRB_E_INPUT, "method '%s': parameter '%s' has no choices",
                            method->name, o->name);
    }
    return true;
}

static bool check_method(const struct irb_registry *registry, const struct irb_method *method,
                         struct irb_error *err)
{
    if (!method)
        return irb_fail(err, IRB_E_INPUT, "irb_method_module() returned no method");
    /* nothing else in the struct can be trusted before its ABI is known */
    if (method->abi != IRB_METHOD_ABI)
        return irb_fail(
            err, IRB_E_INPUT,
            "expected method ABI %d, found %d; rebuild it against this methods/method.h",
            IRB_METHOD_ABI, method->abi);
    if (!name_is_valid(method->name))
        return irb_fail(err, IRB_E_INPUT,
                        "expected a method name of a-z, 0-9 and '-', found '%.64s'",
                        method->name ? method->name : "");
    if (!method->title || !method->citation || !method->path_classes)
        return irb_fail(err, IRB_E_INPUT, "method '%s' must state title, citation and path classes",
                        method->name);
    if (lookup(registry, method->name))
        return irb_fail(err, IRB_E_INPUT, "there is a method '%s' already", method->name);
    if (!method->create || !method->resize || !method->begin_sequence || !method->render_frame ||
        !method->destroy)
        return irb_fail(err, IRB_E_INPUT,
                        "method '%s' must define create, resize, begin_sequence, render_frame and "
                        "destroy",
                        method->name);
    int stages = 0;
    while (method->stages && method->stages[stages] && stages <= MOST_STAGES)
        stages++;
    if (!stages || stages > MOST_STAGES)
        return irb_fail(err, IRB_E_INPUT, "method '%s': expected 1 to %d stages, found %s",
                        method->name, MOST_STAGES, stages ? "more" : "none");
    for (int i = 0; i < stages; i++)
        for (int r = 0; irb_core_stages[r]; r++)
            if (!strcmp(method->stages[i], irb_core_stages[r]))
                return irb_fail(err, IRB_E_INPUT, "method '%s': stage '%s' is the core's own name",
                                method->name, method->stages[i]);
    return check_params(method, err);
}

/* dlopen searches the system's folders for a name without a slash; a path is meant. */
static void *open_module(const char *path, struct irb_error *err)
{
    char *local = strchr(path, '/') ? irb_strdup(path) : irb_asprintf("./%s", path);
    void *module = dlopen(local, RTLD_NOW | RTLD_LOCAL);
    if (!module)
        irb_fail(err, IRB_E_INPUT, "cannot load the module: %s", dlerror());
    free(local);
    return module;
}

bool irb_registry_load(struct irb_registry *registry, const char *path, struct irb_error *err)
{
    if (registry->module_count >= MOST_MODULES || registry->count >= MOST_METHODS)
        return irb_fail(err, IRB_E_INPUT, "%s: expected at most %d modules and %d methods", path,
                        MOST_MODULES, MOST_METHODS);
    void *module = open_module(path, err);
    if (!module)
        return irb_error_prefix(err, "%s", path);
    irb_method_module_fn entry = NULL;
    *(void **)&entry = dlsym(module, "irb_method_module"); /* POSIX's way round ISO C */
    bool ok =
        entry ? true : irb_fail(err, IRB_E_INPUT, "the module doesn't export irb_method_module()");
    const struct irb_method *method = ok ? entry() : NULL;
    ok = ok && check_method(registry, method, err);
    if (!ok) {
        dlclose(module);
        return irb_error_prefix(err, "%s", path);
    }
    registry->modules[registry->module_count++] = module;
    registry->methods[registry->count++] = method;
    return true;
}

const struct irb_method *irb_registry_find(const struct irb_registry *registry, const char *name,
                                           struct irb_error *err)
{
    const struct irb_method *method = lookup(registry, name);
    if (method)
        return method;
    const char *names[MOST_METHODS] = {0};
    for (int i = 0; i < registry->count; i++)
        names[i] = registry->methods[i]->name;
    const char *near = irb_nearest(name, names, (size_t)registry->count);
    if (near) {
        irb_fail(err, IRB_E_INPUT, "unknown method '%.64s'; did you mean '%s'?", name, near);
        return NULL;
    }
    struct irb_str list = {0};
    for (int i = 0; i < registry->count; i++)
        irb_str_printf(&list, "%s%s", i ? ", " : "", names[i]);
    irb_fail(err, IRB_E_INPUT, "unknown method '%.64s'; expected one of: %s", name,
             irb_str_text(&list));
    irb_str_free(&list);
    return NULL;
}
