/* SPDX-License-Identifier: MIT */
#include "core/base/error.h"

#include <stdarg.h>
#include <stdio.h>

bool irb_fail(struct irb_error *err, enum irb_error_code code, const char *format, ...)
{
    if (!err)
        return false;
    err->code = code;
    va_list args;
    va_start(args, format);
    vsnprintf(err->message, sizeof err->message, format, args);
    va_end(args);
    return false;
}

bool irb_error_prefix(struct irb_error *err, const char *format, ...)
{
    if (!err)
        return false;
    char old[sizeof err->message];
    snprintf(old, sizeof old, "%s", err->message);
    char prefix[256];
    va_list args;
    va_start(args, format);
    vsnprintf(prefix, sizeof prefix, format, args);
    va_end(args);
    snprintf(err->message, sizeof err->message, "%s: %.760s", prefix, old);
    return false;
}

const char *irb_error_name(enum irb_error_code code)
{
    switch (code) {
#define X(name, status, doc)                                                                       \
    case IRB_E_##name:                                                                             \
        return #name;
        IRB_ERROR_CODES(X)
#undef X
    }
    return "UNKNOWN";
}

int irb_error_status(enum irb_error_code code)
{
    switch (code) {
#define X(name, status, doc)                                                                       \
    case IRB_E_##name:                                                                             \
        return status;
        IRB_ERROR_CODES(X)
#undef X
    }
    return 7;
}
