/* SPDX-License-Identifier: MIT
 *
 * Options: the one table from which a settings struct gets its defaults, is parsed, validated,
 * printed, hashed and documented. Methods declare their parameters with it, the core its config
 * sections.
 *
 *     struct rsm_params { int samples; float clamp; int mode; };
 *     static const struct irb_option options[] = {
 *         IRB_OPTION_INT(struct rsm_params, samples, 400, 1, 1 << 20, "", "VPLs a frame", "..."),
 *         IRB_OPTION_END };
 *
 * Does not: own the settings struct, nor know what a value means.
 */
#ifndef IRB_BASE_OPTION_H
#define IRB_BASE_OPTION_H

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/base/str.h"

#include <stdbool.h>
#include <stddef.h>

enum irb_option_type {
    IRB_TYPE_END = 0,
    IRB_TYPE_BOOL,  /* bool field */
    IRB_TYPE_INT,   /* int field, [min, max] */
    IRB_TYPE_FLOAT, /* float field, [min, max] */
    IRB_TYPE_ENUM,  /* int field: index into choices */
};

struct irb_option {
    const char *name;
    enum irb_option_type type;
    size_t offset;              /* of the field in the settings struct */
    double default_value;       /* bool 0/1, enum index */
    double min, max;            /* inclusive, for INT and FLOAT */
    const char *const *choices; /* NULL-terminated, for ENUM; static */
    const char *unit;           /* "m", "W/sr", "deg", "" */
    const char *doc;            /* one line */
    const char *source;         /* paper, section, equation; or "ours" */
};

/* it takes the braces below for blocks */
/* clang-format off */
#define IRB_OPTION_BOOL(T, field, def, doc, source)                                                \
    {#field, IRB_TYPE_BOOL, offsetof(T, field), def, 0, 1, NULL, "", doc, source}
#define IRB_OPTION_INT(T, field, def, min, max, unit, doc, source)                                 \
    {#field, IRB_TYPE_INT, offsetof(T, field), def, min, max, NULL, unit, doc, source}
#define IRB_OPTION_FLOAT(T, field, def, min, max, unit, doc, source)                               \
    {#field, IRB_TYPE_FLOAT, offsetof(T, field), def, min, max, NULL, unit, doc, source}
#define IRB_OPTION_ENUM(T, field, def, choices, doc, source)                                       \
    {#field, IRB_TYPE_ENUM, offsetof(T, field), def, 0, 0, choices, "", doc, source}
#define IRB_OPTION_END                                                                             \
    {NULL, IRB_TYPE_END, 0, 0, 0, 0, NULL, NULL, NULL, NULL}
/* clang-format on */

/* Sets every field to its default. */
void irb_options_default(const struct irb_option *options, void *settings);

/* NULL when there is none of that name. */
const struct irb_option *irb_option_find(const struct irb_option *options, const char *name);

/* Parses `text` into the field. IRB_E_INPUT names the option, the range or the choices, and what
 * was found; an unknown name gets the nearest valid one. */
bool irb_option_set(const struct irb_option *options, void *settings, const char *name,
                    const char *text, struct irb_error *err);

/* The field's value as irb_option_set would read it (appended to out). */
void irb_option_print(const struct irb_option *option, const void *settings, struct irb_str *out);
/* Likewise a value that irb_option_value() gave. */
void irb_option_print_value(const struct irb_option *option, double value, struct irb_str *out);

/* The field as a number (bool 0/1, enum index), and back; it must be in range. */
double irb_option_value(const struct irb_option *option, const void *settings);
void irb_option_store(const struct irb_option *option, void *settings, double value);

bool irb_option_is_default(const struct irb_option *option, const void *settings);

/* Adds every name and value to a hash. */
void irb_options_hash(const struct irb_option *options, const void *settings,
                      struct irb_hash *hash);

#endif
