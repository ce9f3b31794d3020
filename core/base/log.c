/* SPDX-License-Identifier: MIT */
#include "core/base/log.h"
#include "core/base/clock.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <unistd.h>

static const double bar_interval_s = 0.1;
static const double line_interval_s = 5.0;

struct irb_log irb_log_default(void)
{
    const char *no_color = getenv("NO_COLOR");
    bool terminal = isatty(STDERR_FILENO);
    return (struct irb_log){
        .out = stderr,
        .level = IRB_LOG_INFO,
        .colour = terminal && !(no_color && *no_color),
        .progress_bar = terminal,
    };
}

void irb_log_write(struct irb_log *log, enum irb_log_level level, const char *format, ...)
{
    static const char *const prefix[] = {"error: ", "warning: ", "", ""};
    static const char *const tint[] = {"\033[31m", "\033[33m", "", "\033[2m"};
    if (!log || level > log->level)
        return;
    irb_log_progress_done(log);
    if (log->colour)
        fputs(tint[level], log->out);
    fputs(prefix[level], log->out);
    va_list args;
    va_start(args, format);
    vfprintf(log->out, format, args);
    va_end(args);
    fputs(log->colour ? "\033[0m\n" : "\n", log->out);
}

void irb_log_progress(struct irb_log *log, const char *what, double fraction, double elapsed_s)
{
    if (!log || log->level < IRB_LOG_INFO)
        return;
    double now = irb_clock_s();
    if (now - log->last_progress_s < (log->progress_bar ? bar_interval_s : line_interval_s))
        return;
    log->last_progress_s = now;
    char left[32] = "";
    if (fraction > 0.01) {
        long s = lround(elapsed_s * (1 - fraction) / fraction);
        snprintf(left, sizeof left, "  %ld:%02ld left", s / 60, s % 60);
    }
    if (!log->progress_bar) {
        fprintf(log->out, "%s %3.0f %%%s\n", what, 100 * fraction, left);
        return;
    }
    int filled = (int)(fraction * 24);
    fprintf(log->out, "\r\033[K%-28.28s [%.*s%*s] %3.0f %%%s", what, filled,
            "########################", 24 - filled, "", 100 * fraction, left);
    fflush(log->out);
    log->bar_shown = true;
}

void irb_log_progress_done(struct irb_log *log)
{
    if (!log || !log->bar_shown)
        return;
    fputs("\r\033[K", log->out);
    fflush(log->out);
    log->bar_shown = false;
}
