/* SPDX-License-Identifier: MIT
 *
 * A strict JSON reader (RFC 8259) for tests: it knows whether a text is JSON, and finds the text of
 * one value. Independent of what the program writes with.
 */
#ifndef IRB_TESTS_REPORT_JSON_H
#define IRB_TESTS_REPORT_JSON_H

#include <stdbool.h>
#include <stddef.h>

bool json_valid(const char *text);

/* The value of `key` in the object `text`, or the item `index` of the array `text`, up to its end;
 * copied into out. false where there is none. */
bool json_member(const char *text, const char *key, char *out, size_t size);
bool json_item(const char *text, int index, char *out, size_t size);

#endif
