/* SPDX-License-Identifier: MIT */
#include "core/report/palette.h"

#include <string.h>

const char *irb_other_colour(int n)
{
    int others = 0;
    for (const struct irb_palette_line *line = irb_palette; line->method; line++)
        others += !strcmp(line->method, "*");
    int left = others ? n % others : 0;
    for (const struct irb_palette_line *line = irb_palette; line->method; line++)
        if (!strcmp(line->method, "*") && left-- == 0)
            return line->colour;
    return "#000000";
}

const char *irb_method_colour(const char *method)
{
    for (const struct irb_palette_line *line = irb_palette; line->method; line++)
        if (!strcmp(line->method, method))
            return line->colour;
    return irb_other_colour(0);
}
