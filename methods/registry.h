/* SPDX-License-Identifier: MIT
 *
 * The methods that there are: those built in, which registry.c lists, and those of modules. Names
 * are unique.
 */
#ifndef IRB_METHODS_REGISTRY_H
#define IRB_METHODS_REGISTRY_H

#include "methods/method.h"

/* Stages that the core times itself, in the order of a frame; a method's stages have other names.
 */
enum irb_core_stage { IRB_CORE_GBUFFER, IRB_CORE_RSM, IRB_CORE_DIRECT, IRB_CORE_STAGE_COUNT };
extern const char *const irb_core_stages[]; /* NULL-terminated */

struct irb_registry {
    const struct irb_method *methods[64]; /* borrowed */
    int count;
    void *modules[16]; /* dlopen handles; owned */
    int module_count;
};

/* All built-in methods. */
void irb_registry_init(struct irb_registry *registry);
void irb_registry_close(struct irb_registry *registry);
/* Loads a shared object; checks its ABI and that its name is free. */
bool irb_registry_load(struct irb_registry *registry, const char *path, struct irb_error *err);
/* NULL with IRB_E_INPUT that names the nearest method. */
const struct irb_method *irb_registry_find(const struct irb_registry *registry, const char *name,
                                           struct irb_error *err);

#endif
