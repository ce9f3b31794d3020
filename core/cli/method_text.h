/* SPDX-License-Identifier: MIT
 *
 * A method's functions of its parameters in words: what holds with the defaults, and which single
 * values make it otherwise.
 */
#ifndef IRB_CLI_METHOD_TEXT_H
#define IRB_CLI_METHOD_TEXT_H

#include "methods/method.h"

/* Appends "with indirect visibility, but for `visibility=none`"; `quote` stands before and behind a
 * value. */
void irb_method_visibility_text(const struct irb_method *method, const char *quote,
                                struct irb_str *out);

/* Appends " Keeps a history with `start=reuse`." or the like, where `need` (enum irb_method_needs)
 * is ever needed; `what` is the sentence's beginning. */
void irb_method_needs_text(const struct irb_method *method, unsigned need, const char *what,
                           const char *quote, struct irb_str *out);

#endif
