/* SPDX-License-Identifier: MIT
 *
 * A growing list of names without repeats: the columns that a run's trials bring. Running out of
 * memory for it aborts: nothing that holds results is lost.
 */
#ifndef IRB_REPORT_NAMES_H
#define IRB_REPORT_NAMES_H

struct irb_names {
    char **list; /* owned, and so is each */
    int count;
};

/* Index of the name, -1 where it is not there. */
int irb_names_find(const struct irb_names *names, const char *name);
/* Likewise, appended where it is not there. */
int irb_names_index(struct irb_names *names, const char *name);
void irb_names_destroy(struct irb_names *names);

#endif
