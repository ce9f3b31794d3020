/* SPDX-License-Identifier: MIT
 *
 * The references that `irbench docs` prints; one function a subject.
 */
#ifndef IRB_CLI_DOCS_H
#define IRB_CLI_DOCS_H

#include "core/cli/cli.h"

#include <stdio.h>

/* A key of a config that is in no option table. */
struct irb_documented_key {
    const char *name, *value, *doc;
};
/* One section of a config. */
struct irb_documented_section {
    const char *title;
    const struct irb_documented_key *keys; /* ended by a NULL name */
};
extern const struct irb_documented_section irb_documented_sections[]; /* ended by a NULL title */

void irb_docs_config(FILE *out, const struct irb_cli *cli);

#endif
