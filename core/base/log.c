/* SPDX-License-Identifier: MIT */
#include "core/base/log.h"
#include "core/base/clock.h"
#include "core/base/str.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <unistd.h>

static const double bar_interval_s = 0.1;
static const double line_interval_s = 5.0;
static const double json_interval_s = 0.5;

bool irb_colour_wanted(int fd)
{
    const char *no_color = getenv("NO_COLOR");
    return isatty(fd) && !(no_color && *no_color);
}

struct irb_log irb_log_default(void)
{
    return (struct irb_log){
        .out = stderr,
        .level = IRB_LOG_INFO,
        .colour = irb_colour_wanted(STDERR_FILENO),
        .progress_bar = isatty(STDERR_FILENO),
    };
}

/* Writes a finished object as one line, and at once: somebody waits for it. */
static void write_json(struct irb_log *log, struct irb_str *object)
{
    irb_str_printf(object, "}\n");
    fwrite(irb_str_text(object), 1, object->length, log->out);
    fflush(log->out);
    irb_str_free(object);
}

static struct irb_str begin_json(const char *event)
{
    struct irb_str object = {0};
    irb_str_printf(&object, "{\"event\": \"%s\"", event);
    return object;
}

static void json_message(struct irb_log *log, const char *event, const char *code,
                         const char *message)
{
    struct irb_str object = begin_json(event);
    if (code)
        irb_str_printf(&object, ", \"code\": \"%s\"", code);
    irb_str_printf(&object, ", \"message\": ");
    irb_str_json_string(&object, message);
    write_json(log, &object);
}

static void json_progress(struct irb_log *log, const char *what, double fraction, double left_s)
{
    struct irb_str object = begin_json("progress");
    irb_str_printf(&object, ", \"what\": ");
    irb_str_json_string(&object, what);
    irb_str_printf(&object, ", \"fraction\": %.4f, \"left_s\": ", fraction);
    irb_str_json_number(&object, round(10 * left_s) / 10); /* tenths say enough */
    if (log->run.known) {
        irb_str_printf(&object, ", \"run_fraction\": %.4f, \"run_left_s\": ", log->run.fraction);
        irb_str_json_number(&object, round(10 * log->run.left_s) / 10);
    }
    write_json(log, &object);
}

void irb_log_error(struct irb_log *log, const struct irb_error *err)
{
    if (!log)
        return;
    if (log->json)
        json_message(log, "error", irb_error_name(err->code), err->message);
    else
        irb_log_write(log, IRB_LOG_ERROR, "%s", err->message);
}

void irb_log_done(struct irb_log *log, const char *run)
{
    if (log && log->json) {
        struct irb_str object = begin_json("done");
        irb_str_printf(&object, ", \"run\": ");
        irb_str_json_string(&object, run);
        write_json(log, &object);
    } else if (run) {
        irb_log_write(log, IRB_LOG_INFO, "results: %s", run);
    }
}

void irb_log_write(struct irb_log *log, enum irb_log_level level, const char *format, ...)
{
    static const char *const events[] = {"error", "warning", "info", "debug"};
    static const char *const prefix[] = {"error: ", "warning: ", "", ""};
    static const char *const tint[] = {"\033[31m", "\033[33m", "", "\033[2m"};
    if (!log || level > log->level)
        return;
    char message[2048];
    va_list args;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    if (log->json) {
        json_message(log, events[level], NULL, message);
        return;
    }
    irb_log_progress_done(log);
    if (log->colour)
        fputs(tint[level], log->out);
    fputs(prefix[level], log->out);
    fputs(message, log->out);
    fputs(log->colour ? "\033[0m\n" : "\n", log->out);
}

static int print_left(char *out, size_t size, const char *before, double seconds)
{
    long s = lround(seconds);
    return snprintf(out, size, "%s  %ld:%02ld left", before, s / 60, s % 60);
}

void irb_log_progress(struct irb_log *log, const char *what, double fraction, double elapsed_s)
{
    if (!log)
        return;
    if (log->watch)
        log->watch(log->watcher, fraction);
    if (log->level < IRB_LOG_INFO)
        return;
    double now = irb_clock_s();
    double interval = log->json           ? json_interval_s
                      : log->progress_bar ? bar_interval_s
                                          : line_interval_s;
    bool complete = log->json && fraction >= 1;
    if (!complete && now - log->last_progress_s < interval)
        return;
    log->last_progress_s = now;
    if (log->json) {
        json_progress(log, what, fraction,
                      fraction > 0 ? elapsed_s * (1 - fraction) / fraction : NAN);
        return;
    }
    char left[96] = "";
    int length = 0;
    if (fraction > 0.01)
        length = print_left(left, sizeof left, "", elapsed_s * (1 - fraction) / fraction);
    if (log->run.known && length >= 0) {
        char run[32];
        snprintf(run, sizeof run, "   run %3.0f %%", 100 * log->run.fraction);
        print_left(left + length, sizeof left - (size_t)length, run, log->run.left_s);
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
