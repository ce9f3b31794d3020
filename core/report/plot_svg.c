/* SPDX-License-Identifier: MIT */
#include "core/report/plot_svg.h"

#include "core/base/str.h"

#include <string.h>

/* `%s` in `to` is the id. */
struct replacement {
    const char *from, *to;
};

/* as gnuplot 5 and 6 write them */
static const struct replacement ids[] = {
    {"id='gp", "id='%s_gp"},
    {"id=\"gnuplot_canvas\"", "id=\"%s_canvas\""},
    {"xlink:href='#gp", "xlink:href='#%s_gp"},
    {"url(#gp", "url(#%s_gp"},
    {"id='textbox'", "id='%s_textbox'"},
    {"id='greybox'", "id='%s_greybox'"},
    {"url(#textbox)", "url(#%s_textbox)"},
    {"url(#greybox)", "url(#%s_greybox)"},
};

/* Ink, background and the white lines between areas. Text on an area is rgb(0,0,1) or white: it
 * stays.
 */
static const struct replacement colours[] = {
    {"color=\"black\"", "color=\"inherit\""},
    {"color='rgb(  0,   0,   0)'", "color='inherit'"},
    {"color='rgb(255, 255, 255)'", "color='transparent'"},
    {"color='#FFFFFF'", "color='transparent'"},
    {"color=\"#FFFFFF\"", "color=\"transparent\""},
    {"fill=\"black\"", "fill=\"currentColor\""},
    {"fill=\"rgb(0,0,0)\"", "fill=\"currentColor\""},
    {"fill=\"#ffffff\"", "fill=\"none\""},
    {"stroke=\"black\"", "stroke=\"currentColor\""},
    {"stroke='black'", "stroke='currentColor'"},
    {"stroke='rgb(  0,   0,   0)'", "stroke='currentColor'"},
    {"stroke=\"rgb(  0,   0,   0)\"", "stroke=\"currentColor\""},
    {"stroke='rgb(255, 255, 255)'", "stroke='none'"},
};

static const struct replacement *match(const char *at, const struct replacement *list, int count)
{
    for (int i = 0; i < count; i++)
        if (!strncmp(at, list[i].from, strlen(list[i].from)))
            return &list[i];
    return NULL;
}

#define COUNT(array) (int)(sizeof(array) / sizeof *(array))

/* Behind the title of the whole, which is but an id, and which browsers show as a tooltip. */
static const char *behind_title(const char *svg)
{
    const char *title = strstr(svg, "<title>"), *group = strstr(svg, "<g ");
    const char *end = title && group && title < group ? strstr(title, "</title>") : NULL;
    return end ? end + strlen("</title>") : NULL;
}

/* Markup alone: the text between ">" and "<" is names and numbers. */
char *irb_plot_svg_tidy(const char *svg, const char *id, bool inlined)
{
    struct irb_str out = {0};
    bool in_tag = false;
    const char *start = inlined ? strstr(svg, "<svg") : NULL, *behind = behind_title(svg);
    for (const char *c = start ? start : svg; *c;) {
        if (behind && !strncmp(c, "<title>", 7) && c < behind)
            c = behind;
        const struct replacement *found = in_tag ? match(c, ids, COUNT(ids)) : NULL;
        if (!found && in_tag && inlined)
            found = match(c, colours, COUNT(colours));
        in_tag = *c == '<' || (in_tag && *c != '>');
        if (found) {
            const char *mark = strstr(found->to, "%s");
            size_t before = mark ? (size_t)(mark - found->to) : strlen(found->to);
            irb_str_append(&out, found->to, before);
            if (mark)
                irb_str_printf(&out, "%s%s", id, mark + 2);
            c += strlen(found->from);
        } else {
            irb_str_append(&out, c++, 1);
        }
    }
    return out.text ? out.text : irb_strdup("");
}
