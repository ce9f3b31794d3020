/* SPDX-License-Identifier: MIT
 *
 * A growing string. Zero-initialise it, free it with irb_str_free(). Running out of memory for
 * text aborts: nothing that holds results depends on it.
 */
#ifndef IRB_BASE_STR_H
#define IRB_BASE_STR_H

#include <stddef.h>

struct irb_str {
    char *text; /* owned; NULL while empty, else zero-terminated */
    size_t length, capacity;
};

void irb_str_printf(struct irb_str *str, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
void irb_str_append(struct irb_str *str, const char *text, size_t length);
/* Appends "text" with JSON's escapes, quotes included. NULL gives null. */
void irb_str_json_string(struct irb_str *str, const char *text);
/* Appends a number that JSON can hold; NaN and infinities become null. */
void irb_str_json_number(struct irb_str *str, double value);
/* The text, "" while empty. Borrowed. */
const char *irb_str_text(const struct irb_str *str);
void irb_str_free(struct irb_str *str);

/* malloc'ed copies that abort when memory is out. */
char *irb_strdup(const char *text);
char *irb_asprintf(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* The candidate with the smallest edit distance to `word`, or NULL where none is near
 * (distance above max(2, length/2)). For "did you mean". */
const char *irb_nearest(const char *word, const char *const *candidates, size_t count);

#endif
