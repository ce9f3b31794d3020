/* SPDX-License-Identifier: MIT
 *
 * Messages to a person, on stderr. Results go to stdout and never through here.
 * A NULL `struct irb_log *` is silent, so that library code and tests need no special case.
 *
 * With `json` every message is one line, a JSON object, for programs that watch a run:
 *
 *     {"event": "progress", "what": "render", "fraction": 0.3700, "left_s": 12}
 *                                                     of a whole run also "run_fraction",
 * "run_left_s"
 *     {"event": "info", "message": "..."}             also "warning" and "debug"
 *     {"event": "error", "code": "INPUT", "message": "..."}
 *     {"event": "done", "run": "results/runs/..."}    the last line of what went well
 */
#ifndef IRB_BASE_LOG_H
#define IRB_BASE_LOG_H

#include "core/base/error.h"

#include <stdbool.h>
#include <stdio.h>

enum irb_log_level { IRB_LOG_ERROR, IRB_LOG_WARNING, IRB_LOG_INFO, IRB_LOG_DEBUG };

/* Of all the work that the part whose progress is shown belongs to. */
struct irb_log_run {
    bool known;
    double fraction, left_s;
};

/* Is told of every call of irb_log_progress(), also of those that show nothing. */
typedef void (*irb_log_watch_fn)(void *watcher, double fraction);

struct irb_log {
    FILE *out;                /* borrowed, usually stderr */
    enum irb_log_level level; /* messages above this are dropped */
    bool colour;              /* off under NO_COLOR or when `out` is no terminal */
    bool json;                /* lines for programs, see above */
    bool progress_bar;        /* `out` is a terminal: progress is redrawn in place */
    bool bar_shown;           /* a progress line is on the screen and has to be cleared first */
    double last_progress_s;   /* monotonic time of the last progress line */
    struct irb_log_run run;   /* shown behind the progress of a part */
    irb_log_watch_fn watch;   /* may be NULL */
    void *watcher;
};

/* Whether to write in colour to a file descriptor: a terminal, unless NO_COLOR is set. */
bool irb_colour_wanted(int fd);

/* stderr, IRB_LOG_INFO, colour and bar as the terminal and NO_COLOR allow. */
struct irb_log irb_log_default(void);

void irb_log_write(struct irb_log *log, enum irb_log_level level, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#define irb_warn(log, ...) irb_log_write(log, IRB_LOG_WARNING, __VA_ARGS__)
#define irb_info(log, ...) irb_log_write(log, IRB_LOG_INFO, __VA_ARGS__)
#define irb_debug(log, ...) irb_log_write(log, IRB_LOG_DEBUG, __VA_ARGS__)

/* The error that ends a program, whatever the level. */
void irb_log_error(struct irb_log *log, const struct irb_error *err);

/* Says where the results are, `run`; which is NULL for what leaves none. */
void irb_log_done(struct irb_log *log, const char *run);

/* Shows "what 37 % 0:12 left"; in place on a terminal (at most 10 a second), else a plain line at
 * most every 5 seconds, as JSON every half second and when it is complete. fraction in [0,1];
 * elapsed_s since the work began, for the time left. */
void irb_log_progress(struct irb_log *log, const char *what, double fraction, double elapsed_s);

/* Clears the bar, if one is shown. */
void irb_log_progress_done(struct irb_log *log);

#endif
