/* SPDX-License-Identifier: MIT
 *
 * A small run that nobody rendered, with values chosen so that each rule of the tables shows.
 */
#ifndef IRB_TESTS_REPORT_SYNTHETIC_H
#define IRB_TESTS_REPORT_SYNTHETIC_H

#include "core/store/store.h"

/* Fills a new store in `folder`; NULL with *err on failure. Two scenes, whose trials are stored
 * alternately:
 *
 *   trial          relMSE  RMSE  noise  stage times of frames -1 (settle), 0, 1, 2, 3, 4
 *   rsm            0.04    0.2   0.001  gather 100; 1, 2, 3, 4, 10
 *   rsm:mode=all   0.0005  0.02  0.001  gather 5, filter 1 in every frame
 *   plain          0.01    inf   0.001  none, and scored nothing else
 *
 * in `cornell`, and `rsm` in `a,"b"` without any score. */
struct irb_store *synthetic_store(const char *folder, struct irb_error *err);

#endif
