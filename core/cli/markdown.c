/* SPDX-License-Identifier: MIT */
#include "core/cli/markdown.h"

#include <stdlib.h>
#include <string.h>

static void print_cell(FILE *out, const char *text)
{
    bool code = *text == '`';
    for (; *text; text++) {
        if (*text == '|' || (!code && strchr("*_<\\", *text)))
            fputc('\\', out);
        fputc(*text, out);
    }
}

void irb_markdown_row(FILE *out, const char *const *cells)
{
    fputs("|", out);
    for (; *cells; cells++) {
        fputs(" ", out);
        print_cell(out, *cells);
        fputs(" |", out);
    }
    fputs("\n", out);
}

void irb_markdown_header(FILE *out, const char *const *titles)
{
    irb_markdown_row(out, titles);
    fputs("|", out);
    for (; *titles; titles++)
        fputs("---|", out);
    fputs("\n", out);
}

void irb_option_allowed(const struct irb_option *option, const char *between, struct irb_str *out)
{
    switch (option->type) {
    case IRB_TYPE_BOOL:
        irb_str_printf(out, "true%sfalse", between);
        break;
    case IRB_TYPE_ENUM:
        for (int i = 0; option->choices[i]; i++)
            irb_str_printf(out, "%s%s", i ? between : "", option->choices[i]);
        break;
    default:
        irb_str_printf(out, "[%.9g, %.9g]%s%s", option->min, option->max, *option->unit ? " " : "",
                       option->unit);
    }
}

/* The default as the option would be printed. Fields lie within what a settings struct holds. */
static char *default_text(const struct irb_option *options, const struct irb_option *option)
{
    size_t size = 0;
    for (const struct irb_option *o = options; o->name; o++)
        size = o->offset + sizeof(double) > size ? o->offset + sizeof(double) : size;
    void *settings = calloc(1, size);
    struct irb_str text = {0};
    if (!settings)
        abort();
    irb_options_default(options, settings);
    irb_option_print(option, settings, &text);
    free(settings);
    return text.text;
}

void irb_markdown_options(FILE *out, const struct irb_option *options, const char *title)
{
    irb_markdown_header(
        out, (const char *const[]){title, "default", "allowed", "meaning", "source", NULL});
    for (const struct irb_option *o = options; o->name; o++) {
        struct irb_str allowed = {0}, name = {0};
        char *standard = default_text(options, o);
        irb_str_printf(&name, "`%s`", o->name);
        irb_option_allowed(o, ", ", &allowed);
        irb_markdown_row(out,
                         (const char *const[]){irb_str_text(&name), standard,
                                               irb_str_text(&allowed), o->doc, o->source, NULL});
        free(standard);
        irb_str_free(&name);
        irb_str_free(&allowed);
    }
}
