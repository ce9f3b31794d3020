/* SPDX-License-Identifier: MIT */
#include "core/report/names.h"
#include "core/base/str.h"

#include <stdlib.h>
#include <string.h>

int irb_names_find(const struct irb_names *names, const char *name)
{
    for (int i = 0; i < names->count; i++)
        if (!strcmp(names->list[i], name))
            return i;
    return -1;
}

int irb_names_index(struct irb_names *names, const char *name)
{
    int found = irb_names_find(names, name);
    if (found >= 0)
        return found;
    char **list = realloc(names->list, ((size_t)names->count + 1) * sizeof *list);
    if (!list)
        abort();
    names->list = list;
    list[names->count] = irb_strdup(name);
    return names->count++;
}

void irb_names_destroy(struct irb_names *names)
{
    for (int i = 0; i < names->count; i++)
        free(names->list[i]);
    free(names->list);
    *names = (struct irb_names){0};
}
