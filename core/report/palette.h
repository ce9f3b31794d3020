/* SPDX-License-Identifier: MIT
 *
 * The colour of a method, the same in every figure and in the report. The table is
 * plots/methods.csv, which the plots read themselves.
 */
#ifndef IRB_REPORT_PALETTE_H
#define IRB_REPORT_PALETTE_H

struct irb_palette_line {
    const char *method; /* "*" for methods without a line of their own */
    const char *colour; /* "#0072B2" */
};
extern const struct irb_palette_line irb_palette[]; /* ended by a NULL method */

/* A method without a line of its own has the first colour for others; where a run has several such
 * methods, the n-th of them (in the order of the run, from 0) has irb_other_colour(n). */
const char *irb_method_colour(const char *method);
const char *irb_other_colour(int n);

#endif
