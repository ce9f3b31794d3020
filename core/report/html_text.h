/* SPDX-License-Identifier: MIT
 *
 * Text in HTML: escapes. Whatever the text, what comes out is ASCII: a page of some 20 MB that is
 * ASCII alone opens in two thirds of the time (Chromium 156). What is not UTF-8 becomes U+FFFD.
 * For core/report only.
 */
#ifndef IRB_REPORT_HTML_TEXT_H
#define IRB_REPORT_HTML_TEXT_H

#include "core/base/str.h"

#include <stdbool.h>
#include <stdio.h>

/* For elements and for attributes in quotes of either kind. Control characters other than tab and
 * line ends become U+FFFD. */
void irb_html_text(struct irb_str *out, const char *text);
/* HTML or SVG that is markup already. */
void irb_html_markup(struct irb_str *out, const char *markup);
/* JSON that may stand in a script element: "<" becomes an escape, wherever it is (in JSON it can
 * only be in a string), so that no text ends the element. */
void irb_html_json(struct irb_str *out, const char *json);
/* RFC 4648, with padding; no line ends. */
void irb_html_base64(struct irb_str *out, const void *data, size_t size);
size_t irb_html_base64_length(size_t size);

#endif
