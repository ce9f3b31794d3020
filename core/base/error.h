/* SPDX-License-Identifier: MIT
 *
 * The one error type. Functions that can fail return false (or NULL) and fill the caller's
 * `struct irb_error`; the caller passes it up unchanged or adds a prefix with irb_error_prefix().
 * Messages are one line: where (file, line, path), what was expected, what was found.
 *
 * Does not: allocate, print, or abort.
 */
#ifndef IRB_BASE_ERROR_H
#define IRB_BASE_ERROR_H

#include <stdbool.h>

/* name, process exit status, one line of documentation */
#define IRB_ERROR_CODES(X)                                                                         \
    X(OK, 0, "success")                                                                            \
    X(CHECK, 1, "a check or bound that was asked for did not hold")                                \
    X(USAGE, 2, "the command line is wrong")                                                       \
    X(INPUT, 3, "a config, scene, image or shader is malformed or missing")                        \
    X(BACKEND, 4, "no usable OpenGL backend, or the driver reported an error")                     \
    X(IO, 5, "a file or database could not be written")                                            \
    X(MEMORY, 6, "out of memory, or a stated memory bound would be exceeded")                      \
    X(INTERNAL, 7, "a defect in irbench itself")                                                   \
    X(INTERRUPTED, 130, "stopped by the user; what was computed is kept")

enum irb_error_code {
#define X(name, status, doc) IRB_E_##name,
    IRB_ERROR_CODES(X)
#undef X
};

struct irb_error {
    enum irb_error_code code;
    char message[1024];
};

/* Fills *err (which may be NULL) and returns false, so that `return irb_fail(err, ...)` reads well.
 */
bool irb_fail(struct irb_error *err, enum irb_error_code code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Puts "prefix: " before the message that is already in *err; returns false. */
bool irb_error_prefix(struct irb_error *err, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* "INPUT", ...; and the exit status that the command line gives for a code. */
const char *irb_error_name(enum irb_error_code code);
int irb_error_status(enum irb_error_code code);

#endif
