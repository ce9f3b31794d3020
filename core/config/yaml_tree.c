/* SPDX-License-Identifier: MIT */
#include "core/config/yaml_tree.h"
#include "core/base/fs.h"
#include "core/base/str.h"

#include <float.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A config of a thousand trials is below 100 KiB. */
static const size_t largest_file = 1 << 20;
/* A config needs 6 levels. libyaml takes time quadratic in the depth of [[[[, so that a small file
 * could keep it busy for an hour. */
enum { DEEPEST = 32 };

/* ---- messages ---- */

/* One line, whatever the file holds. */
static void flatten(struct irb_error *err)
{
    for (char *c = err ? err->message : NULL; c && *c; c++)
        if ((unsigned char)*c < 0x20 || *c == 0x7f)
            *c = ' ';
}

bool irb_yaml_prefix(const struct irb_yaml *yaml, irb_yaml_node node, struct irb_error *err)
{
    if (!err)
        return false;
    char message[sizeof err->message];
    snprintf(message, sizeof message, "%s", err->message);
    enum irb_error_code code = err->code;
    irb_fail(err, code, "%s:%zu:%zu: %s", yaml->path, node ? node->start_mark.line + 1 : 1,
             node ? node->start_mark.column + 1 : 1, message);
    flatten(err);
    return false;
}

char *irb_yaml_place(const struct irb_yaml *yaml, irb_yaml_node node)
{
    return irb_asprintf("%s:%zu:%zu", yaml->path, node->start_mark.line + 1,
                        node->start_mark.column + 1);
}

bool irb_yaml_fail(const struct irb_yaml *yaml, irb_yaml_node node, struct irb_error *err,
                   const char *format, ...)
{
    if (!err)
        return false;
    va_list args;
    va_start(args, format);
    vsnprintf(err->message, sizeof err->message, format, args);
    va_end(args);
    err->code = IRB_E_INPUT;
    return irb_yaml_prefix(yaml, node, err);
}

/* ---- loading ---- */

/* Line and column of a byte, for the reader's errors (bad UTF-8), which have only an offset. */
static void place_of(const char *text, size_t offset, size_t *line, size_t *column)
{
    *line = *column = 1;
    for (size_t i = 0; i < offset; i++) {
        if (text[i] == '\n') {
            ++*line;
            *column = 1;
        } else if ((text[i] & 0xc0) != 0x80) { /* continuation bytes are no columns */
            ++*column;
        }
    }
}

static bool syntax_error(const char *path, const yaml_parser_t *parser, const char *text,
                         size_t size, struct irb_error *err)
{
    if (parser->error == YAML_MEMORY_ERROR)
        return irb_fail(err, IRB_E_MEMORY, "%s: out of memory", path);
    size_t line = parser->problem_mark.line + 1, column = parser->problem_mark.column + 1;
    if (parser->error == YAML_READER_ERROR)
        place_of(text, parser->problem_offset < size ? parser->problem_offset : size, &line,
                 &column);
    irb_fail(err, IRB_E_INPUT, "%s:%zu:%zu: not valid YAML: %s", path, line, column,
             parser->problem ? parser->problem : "unknown cause");
    if (err && parser->context) {
        char *first = irb_strdup(err->message);
        irb_fail(err, IRB_E_INPUT, "%s (%s that begins at line %zu)", first, parser->context,
                 parser->context_mark.line + 1);
        free(first);
    }
    flatten(err);
    return false;
}

/* Goes through the file's events before a tree is built. Syntax errors are left to the loader. */
static bool check_depth(const char *path, const char *text, size_t size, struct irb_error *err)
{
    yaml_parser_t parser;
    if (!yaml_parser_initialize(&parser))
        return irb_fail(err, IRB_E_MEMORY, "%s: out of memory", path);
    yaml_parser_set_input_string(&parser, (const unsigned char *)text, size);
    int depth = 0;
    bool ok = true, more = true;
    yaml_event_t event;
    while (ok && more && yaml_parser_parse(&parser, &event)) {
        yaml_event_type_t type = event.type;
        depth += type == YAML_SEQUENCE_START_EVENT || type == YAML_MAPPING_START_EVENT;
        depth -= type == YAML_SEQUENCE_END_EVENT || type == YAML_MAPPING_END_EVENT;
        more = type != YAML_STREAM_END_EVENT;
        if (depth > DEEPEST)
            ok = irb_fail(err, IRB_E_INPUT,
                          "%s:%zu:%zu: expected at most %d lists and maps inside one another", path,
                          event.start_mark.line + 1, event.start_mark.column + 1, DEEPEST);
        yaml_event_delete(&event);
    }
    yaml_parser_delete(&parser);
    return ok;
}

/* A second document would be ignored in silence. */
static bool refuse_more(struct irb_yaml *yaml, yaml_parser_t *parser, const char *text, size_t size,
                        struct irb_error *err)
{
    yaml_document_t more;
    if (!yaml_parser_load(parser, &more))
        return syntax_error(yaml->path, parser, text, size, err);
    irb_yaml_node root = yaml_document_get_root_node(&more);
    bool ok = !root || irb_yaml_fail(yaml, root, err, "expected one YAML document, found another");
    yaml_document_delete(&more);
    return ok;
}

bool irb_yaml_load(struct irb_yaml *yaml, const char *path, struct irb_error *err)
{
    char *text = NULL;
    size_t size = 0;
    if (!irb_fs_read(path, largest_file, &text, &size, err))
        return false;
    yaml_parser_t parser;
    bool checked = check_depth(path, text, size, err);
    if (!checked || !yaml_parser_initialize(&parser)) {
        free(text);
        return checked ? irb_fail(err, IRB_E_MEMORY, "%s: out of memory", path) : false;
    }
    yaml_parser_set_input_string(&parser, (const unsigned char *)text, size);
    *yaml = (struct irb_yaml){.path = irb_strdup(path)};
    bool loaded = yaml_parser_load(&parser, &yaml->document);
    bool ok = loaded || syntax_error(path, &parser, text, size, err);
    /* an empty document ends the stream; there is nothing behind it to load */
    if (loaded && irb_yaml_root(yaml))
        ok = refuse_more(yaml, &parser, text, size, err);
    yaml_parser_delete(&parser);
    free(text);
    if (ok)
        return true;
    if (loaded)
        yaml_document_delete(&yaml->document);
    free(yaml->path);
    *yaml = (struct irb_yaml){0};
    return false;
}

void irb_yaml_destroy(struct irb_yaml *yaml)
{
    if (!yaml->path)
        return;
    yaml_document_delete(&yaml->document);
    free(yaml->path);
    *yaml = (struct irb_yaml){0};
}

irb_yaml_node irb_yaml_root(struct irb_yaml *yaml)
{
    return yaml_document_get_root_node(&yaml->document);
}

/* ---- the tree ---- */

const char *irb_yaml_kind(irb_yaml_node node)
{
    switch (node ? node->type : YAML_NO_NODE) {
    case YAML_MAPPING_NODE:
        return "a map";
    case YAML_SEQUENCE_NODE:
        return "a list";
    case YAML_SCALAR_NODE:
        return irb_yaml_is_null(node) ? "nothing" : "a single value";
    default:
        return "nothing";
    }
}

bool irb_yaml_is_null(irb_yaml_node node)
{
    if (!node)
        return true;
    if (node->type != YAML_SCALAR_NODE || node->data.scalar.style != YAML_PLAIN_SCALAR_STYLE)
        return false;
    const char *text = (const char *)node->data.scalar.value;
    return !*text || !strcmp(text, "~") || !strcmp(text, "null");
}

const char *irb_yaml_text(const struct irb_yaml *yaml, irb_yaml_node node, const char *what,
                          struct irb_error *err)
{
    if (!node || node->type != YAML_SCALAR_NODE) {
        irb_yaml_fail(yaml, node, err, "%s: expected a single value, found %s", what,
                      irb_yaml_kind(node));
        return NULL;
    }
    const char *text = (const char *)node->data.scalar.value;
    if (strlen(text) != node->data.scalar.length) {
        irb_yaml_fail(yaml, node, err, "%s: expected text, found a zero byte in it", what);
        return NULL;
    }
    return text;
}

int irb_yaml_count(irb_yaml_node list)
{
    if (!list || list->type != YAML_SEQUENCE_NODE)
        return 0;
    return (int)(list->data.sequence.items.top - list->data.sequence.items.start);
}

irb_yaml_node irb_yaml_item(struct irb_yaml *yaml, irb_yaml_node list, int index)
{
    return yaml_document_get_node(&yaml->document, list->data.sequence.items.start[index]);
}

int irb_yaml_pairs(irb_yaml_node map)
{
    if (!map || map->type != YAML_MAPPING_NODE)
        return 0;
    return (int)(map->data.mapping.pairs.top - map->data.mapping.pairs.start);
}

irb_yaml_node irb_yaml_key(struct irb_yaml *yaml, irb_yaml_node map, int index)
{
    return yaml_document_get_node(&yaml->document, map->data.mapping.pairs.start[index].key);
}

irb_yaml_node irb_yaml_value(struct irb_yaml *yaml, irb_yaml_node map, int index)
{
    return yaml_document_get_node(&yaml->document, map->data.mapping.pairs.start[index].value);
}

irb_yaml_node irb_yaml_find(struct irb_yaml *yaml, irb_yaml_node map, const char *key)
{
    for (int i = 0; i < irb_yaml_pairs(map); i++) {
        irb_yaml_node name = irb_yaml_key(yaml, map, i);
        if (name->type == YAML_SCALAR_NODE && !strcmp((const char *)name->data.scalar.value, key))
            return irb_yaml_value(yaml, map, i);
    }
    return NULL;
}

/* ---- checks ---- */

static bool check_known(const struct irb_yaml *yaml, irb_yaml_node node, const char *key,
                        const char *what, const char *const *allowed, struct irb_error *err)
{
    size_t count = 0;
    while (allowed[count])
        if (!strcmp(allowed[count++], key))
            return true;
    const char *near = irb_nearest(key, allowed, count);
    if (near)
        return irb_yaml_fail(yaml, node, err, "%s: unknown key '%.64s'; did you mean '%s'?", what,
                             key, near);
    struct irb_str list = {0};
    for (size_t i = 0; i < count; i++)
        irb_str_printf(&list, "%s%s", i ? ", " : "", allowed[i]);
    irb_yaml_fail(yaml, node, err, "%s: unknown key '%.64s'; expected one of: %s", what, key,
                  irb_str_text(&list));
    irb_str_free(&list);
    return false;
}

bool irb_yaml_check_map(struct irb_yaml *yaml, irb_yaml_node map, const char *what,
                        const char *const *allowed, struct irb_error *err)
{
    /* more keys than any section has: bounds the search for duplicates */
    enum { MOST_KEYS = 256 };
    if (!map || map->type != YAML_MAPPING_NODE)
        return irb_yaml_fail(yaml, map, err, "%s: expected a map of keys, found %s", what,
                             irb_yaml_kind(map));
    if (irb_yaml_pairs(map) > MOST_KEYS)
        return irb_yaml_fail(yaml, map, err, "%s: expected at most %d keys, found %d", what,
                             MOST_KEYS, irb_yaml_pairs(map));
    for (int i = 0; i < irb_yaml_pairs(map); i++) {
        irb_yaml_node node = irb_yaml_key(yaml, map, i);
        const char *key = irb_yaml_text(yaml, node, "a key", err);
        if (!key)
            return false;
        if (!strcmp(key, "<<"))
            return irb_yaml_fail(yaml, node, err,
                                 "%s: merge keys (<<) are not supported; use an alias for a whole "
                                 "value",
                                 what);
        if (allowed && !check_known(yaml, node, key, what, allowed, err))
            return false;
        for (int j = 0; j < i; j++) {
            irb_yaml_node other = irb_yaml_key(yaml, map, j);
            if (!strcmp((const char *)other->data.scalar.value, key))
                return irb_yaml_fail(yaml, node, err,
                                     "%s: '%.64s' stands here twice, first in line %zu", what, key,
                                     other->start_mark.line + 1);
        }
    }
    return true;
}

bool irb_yaml_float(struct irb_yaml *yaml, irb_yaml_node node, const char *what, double min,
                    double max, float *out, struct irb_error *err)
{
    const char *text = irb_yaml_text(yaml, node, what, err);
    if (!text)
        return false;
    char *end;
    double value = strtod(text, &end);
    /* negated, so that NaN fails it */
    if (end == text || *end || !(fabs(value) <= FLT_MAX))
        return irb_yaml_fail(yaml, node, err, "%s: expected a number, found '%.64s'", what, text);
    if (value < min || value > max)
        return irb_yaml_fail(yaml, node, err, "%s: expected a number in [%g, %g], found '%.64s'",
                             what, min, max, text);
    *out = (float)value;
    return true;
}

bool irb_yaml_floats(struct irb_yaml *yaml, irb_yaml_node list, const char *what, float *out,
                     int count, struct irb_error *err)
{
    if (!list || list->type != YAML_SEQUENCE_NODE)
        return irb_yaml_fail(yaml, list, err, "%s: expected a list of %d numbers, found %s", what,
                             count, irb_yaml_kind(list));
    if (irb_yaml_count(list) != count)
        return irb_yaml_fail(yaml, list, err, "%s: expected a list of %d numbers, found %d", what,
                             count, irb_yaml_count(list));
    for (int i = 0; i < count; i++)
        if (!irb_yaml_float(yaml, irb_yaml_item(yaml, list, i), what, -FLT_MAX, FLT_MAX, &out[i],
                            err))
            return false;
    return true;
}
