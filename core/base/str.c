/* SPDX-License-Identifier: MIT */
#include "core/base/str.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void reserve(struct irb_str *str, size_t extra)
{
    size_t need = str->length + extra + 1;
    if (need <= str->capacity)
        return;
    size_t capacity = str->capacity ? str->capacity : 64;
    while (capacity < need)
        capacity *= 2;
    char *text = realloc(str->text, capacity);
    if (!text)
        abort();
    str->text = text;
    str->capacity = capacity;
}

void irb_str_append(struct irb_str *str, const char *text, size_t length)
{
    reserve(str, length);
    memcpy(str->text + str->length, text, length);
    str->length += length;
    str->text[str->length] = 0;
}

static void append_format(struct irb_str *str, const char *format, va_list args)
{
    va_list again;
    va_copy(again, args);
    int n = vsnprintf(NULL, 0, format, args);
    if (n < 0)
        abort();
    reserve(str, (size_t)n);
    vsnprintf(str->text + str->length, (size_t)n + 1, format, again);
    va_end(again);
    str->length += (size_t)n;
}

void irb_str_printf(struct irb_str *str, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    append_format(str, format, args);
    va_end(args);
}

void irb_str_json_string(struct irb_str *str, const char *text)
{
    if (!text) {
        irb_str_append(str, "null", 4);
        return;
    }
    irb_str_append(str, "\"", 1);
    for (const unsigned char *c = (const unsigned char *)text; *c; c++) {
        if (*c == '"' || *c == '\\')
            irb_str_printf(str, "\\%c", *c);
        else if (*c < 0x20)
            irb_str_printf(str, "\\u%04x", *c);
        else
            irb_str_append(str, (const char *)c, 1);
    }
    irb_str_append(str, "\"", 1);
}

void irb_str_json_number(struct irb_str *str, double value)
{
    if (isfinite(value))
        irb_str_printf(str, "%.9g", value);
    else
        irb_str_append(str, "null", 4);
}

const char *irb_str_text(const struct irb_str *str)
{
    return str->text ? str->text : "";
}

void irb_str_free(struct irb_str *str)
{
    free(str->text);
    *str = (struct irb_str){0};
}

char *irb_strdup(const char *text)
{
    char *copy = strdup(text);
    if (!copy)
        abort();
    return copy;
}

char *irb_asprintf(const char *format, ...)
{
    struct irb_str str = {0};
    va_list args;
    va_start(args, format);
    append_format(&str, format, args);
    va_end(args);
    return str.text;
}

static size_t edit_distance(const char *a, const char *b)
{
    enum { LONGEST = 64 };
    size_t n = strlen(a), m = strlen(b);
    if (n >= LONGEST || m >= LONGEST)
        return LONGEST;
    size_t row[LONGEST];
    for (size_t j = 0; j <= m; j++)
        row[j] = j;
    for (size_t i = 1; i <= n; i++) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= m; j++) {
            size_t best = diagonal + (a[i - 1] != b[j - 1]);
            if (row[j] + 1 < best)
                best = row[j] + 1;
            if (row[j - 1] + 1 < best)
                best = row[j - 1] + 1;
            diagonal = row[j];
            row[j] = best;
        }
    }
    return row[m];
}

const char *irb_nearest(const char *word, const char *const *candidates, size_t count)
{
    size_t limit = strlen(word) / 2 > 2 ? strlen(word) / 2 : 2;
    const char *best = NULL;
    for (size_t i = 0; i < count; i++) {
        size_t d = edit_distance(word, candidates[i]);
        if (d < limit || (d == limit && !best)) {
            limit = d;
            best = candidates[i];
        }
    }
    return best;
}
