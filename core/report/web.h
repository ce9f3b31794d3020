/* SPDX-License-Identifier: MIT
 *
 * The files of core/report/web/, embedded in the binary.
 */
#ifndef IRB_REPORT_WEB_H
#define IRB_REPORT_WEB_H

#include "core/base/embedded.h"

extern const struct irb_embedded_file irb_web_files[];
extern const size_t irb_web_files_count;

#endif
