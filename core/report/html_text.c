/* SPDX-License-Identifier: MIT */
#include "core/report/html_text.h"

static const unsigned not_a_character = 0xfffd;

/* The character that begins at *text, and *text behind it (RFC 3629; no overlong forms, no
 * surrogates). */
static unsigned next_character(const char **text)
{
    const unsigned char *c = (const unsigned char *)*text;
    int more = c[0] < 0x80   ? 0
               : c[0] < 0xc2 ? -1
               : c[0] < 0xe0 ? 1
               : c[0] < 0xf0 ? 2
               : c[0] < 0xf5 ? 3
                             : -1;
    (*text)++;
    if (more <= 0)
        return more ? not_a_character : c[0];
    unsigned value = c[0] & (0x3fU >> more);
    for (int i = 1; i <= more; i++) {
        if ((c[i] & 0xc0) != 0x80)
            return not_a_character;
        value = value << 6 | (c[i] & 0x3fU);
    }
    static const unsigned least[] = {0, 0x80, 0x800, 0x10000};
    if (value < least[more] || value > 0x10ffff || (value >= 0xd800 && value < 0xe000))
        return not_a_character;
    *text += more;
    return value;
}

static void put_reference(struct irb_str *out, unsigned character)
{
    irb_str_printf(out, "&#x%x;", character);
}

static void put_plain(struct irb_str *out, unsigned character)
{
    char c = (char)character;
    irb_str_append(out, &c, 1);
}

void irb_html_text(struct irb_str *out, const char *text)
{
    while (*text) {
        unsigned c = next_character(&text);
        bool control = c == 0x7f || (c < 0x20 && c != '\t' && c != '\n');
        if (control)
            put_reference(out, not_a_character);
        else if (c == '&' || c == '<' || c == '>' || c == '"' || c == '\'' || c >= 0x80)
            put_reference(out, c);
        else
            put_plain(out, c);
    }
}

void irb_html_markup(struct irb_str *out, const char *markup)
{
    while (*markup) {
        unsigned c = next_character(&markup);
        if (c >= 0x80)
            put_reference(out, c);
        else
            put_plain(out, c);
    }
}

void irb_html_json(struct irb_str *out, const char *json)
{
    while (*json) {
        unsigned c = next_character(&json);
        if (c >= 0x10000)
            irb_str_printf(out, "\\u%04x\\u%04x", 0xd800 + (c - 0x10000) / 0x400,
                           0xdc00 + (c - 0x10000) % 0x400);
        else if (c == '<' || c >= 0x80)
            irb_str_printf(out, "\\u%04x", c);
        else
            put_plain(out, c);
    }
}

size_t irb_html_base64_length(size_t size)
{
    return (size + 2) / 3 * 4;
}

void irb_html_base64(struct irb_str *out, const void *data, size_t size)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const unsigned char *bytes = data;
    for (size_t i = 0; i < size; i += 3) {
        size_t left = size - i;
        unsigned group = (unsigned)bytes[i] << 16;
        if (left > 1)
            group |= (unsigned)bytes[i + 1] << 8;
        if (left > 2)
            group |= bytes[i + 2];
        char four[4] = {digits[group >> 18], digits[group >> 12 & 63],
                        left > 1 ? digits[group >> 6 & 63] : '=',
                        left > 2 ? digits[group & 63] : '='};
        irb_str_append(out, four, 4);
    }
}
