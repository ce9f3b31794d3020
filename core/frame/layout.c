/* SPDX-License-Identifier: MIT */
#include "core/frame/layout.h"

#include <stddef.h>

const char *const irb_layout_names[] = {"full", "slim", NULL};
