/* SPDX-License-Identifier: MIT */
#include "tests/report/json.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

/* Each skips what it is named after and returns what is behind it; NULL where that is not there. */
static const char *skip_value(const char *c, int depth);

static const char *space(const char *c)
{
    return c ? c + strspn(c, " \t\r\n") : NULL;
}

static const char *literal(const char *c, const char *word)
{
    return c && !strncmp(c, word, strlen(word)) ? c + strlen(word) : NULL;
}

static const char *skip_string(const char *c)
{
    if (!c || *c++ != '"')
        return NULL;
    for (; *c != '"'; c++) {
        if ((unsigned char)*c < 0x20) /* the end of the text too */
            return NULL;
        if (*c != '\\')
            continue;
        c++;
        if (*c == 'u') {
            for (int i = 0; i < 4; i++)
                if (!isxdigit((unsigned char)*++c))
                    return NULL;
        } else if (!*c || !strchr("\"\\/bfnrt", *c)) {
            return NULL;
        }
    }
    return c + 1;
}

static const char *digits(const char *c)
{
    size_t n = strspn(c, "0123456789");
    return n ? c + n : NULL;
}

static const char *skip_number(const char *c)
{
    if (*c == '-')
        c++;
    c = *c == '0' ? c + 1 : digits(c);
    if (c && *c == '.')
        c = digits(c + 1);
    if (c && (*c == 'e' || *c == 'E')) {
        c++;
        if (*c == '+' || *c == '-')
            c++;
        c = digits(c);
    }
    return c;
}

/* An object or an array. */
static const char *skip_list(const char *c, char end, int depth)
{
    c = space(c + 1);
    if (*c == end)
        return c + 1;
    while (c) {
        if (end == '}')
            c = literal(space(skip_string(space(c))), ":");
        c = space(c ? skip_value(space(c), depth + 1) : NULL);
        if (c && *c == end)
            return c + 1;
        c = literal(c, ",");
    }
    return NULL;
}

static const char *skip_value(const char *c, int depth)
{
    if (depth > 32)
        return NULL;
    switch (*c) {
    case '{':
        return skip_list(c, '}', depth);
    case '[':
        return skip_list(c, ']', depth);
    case '"':
        return skip_string(c);
    case 't':
        return literal(c, "true");
    case 'f':
        return literal(c, "false");
    case 'n':
        return literal(c, "null");
    default:
        return skip_number(c);
    }
}

bool json_valid(const char *text)
{
    const char *end = space(skip_value(space(text), 0));
    return end && !*end;
}

static bool copy(const char *from, char *out, size_t size)
{
    const char *end = skip_value(from, 0);
    return end && (size_t)snprintf(out, size, "%.*s", (int)(end - from), from) < size;
}

bool json_member(const char *text, const char *key, char *out, size_t size)
{
    const char *c = space(text);
    if (*c++ != '{')
        return false;
    while (c) {
        const char *name = space(c), *end = skip_string(name);
        if (!end)
            return false;
        const char *value = space(literal(space(end), ":"));
        if ((size_t)(end - name) == strlen(key) + 2 && !strncmp(name + 1, key, strlen(key)))
            return value && copy(value, out, size);
        c = literal(space(value ? skip_value(value, 0) : NULL), ",");
    }
    return false;
}

bool json_item(const char *text, int index, char *out, size_t size)
{
    const char *c = space(text);
    if (*c++ != '[')
        return false;
    for (c = space(c); c && *c != ']'; index--) {
        if (!index)
            return copy(c, out, size);
        c = space(literal(space(skip_value(c, 0)), ","));
    }
    return false;
}
