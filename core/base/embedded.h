/* SPDX-License-Identifier: MIT
 *
 * Text files that the binary carries: tables made by embed.py at build time.
 */
#ifndef IRB_BASE_EMBEDDED_H
#define IRB_BASE_EMBEDDED_H

#include <stddef.h>

struct irb_embedded_file {
    const char *path; /* below the folder that was embedded */
    const char *text;
};

#endif
