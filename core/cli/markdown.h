/* SPDX-License-Identifier: MIT
 *
 * Markdown tables of options, for `irbench docs`.
 */
#ifndef IRB_CLI_MARKDOWN_H
#define IRB_CLI_MARKDOWN_H

#include "core/base/option.h"

#include <stdio.h>

/* One row: `cells` NULL-terminated; what Markdown takes for markup is escaped. A cell that begins
 * with '`' is code and printed as it is but for '|'. */
void irb_markdown_row(FILE *out, const char *const *cells);
/* A row and the rule below it. */
void irb_markdown_header(FILE *out, const char *const *titles);
/* key, default, allowed values with their unit, what it means, where it comes from */
void irb_markdown_options(FILE *out, const struct irb_option *options, const char *title);

/* Appends "[1, 65536] texels", "all, uniform" or "true, false". */
void irb_option_allowed(const struct irb_option *option, const char *between, struct irb_str *out);

#endif
