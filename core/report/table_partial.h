/* SPDX-License-Identifier: MIT
 *
 * Tables of a run that is being written, or was stopped: how far it is, and rows of the frames that
 * are there.
 */
#ifndef IRB_REPORT_TABLE_PARTIAL_H
#define IRB_REPORT_TABLE_PARTIAL_H

#include "core/base/str.h"
#include "core/report/table_data.h"

/* Sets the row's frames and frames_of. Where the sequence has no figures yet, they are made of the
 * frames that have scores, as scoring would; but for those of regions, and the lag. */
bool irb_table_partial_read(struct irb_table_row *row, struct irb_store *store,
                            struct irb_error *err);

/* Whether frames of the row's sequence are known to be missing. */
bool irb_table_partial(const struct irb_table_row *row);
/* Puts "(3 of 8 frames)" behind the names of such rows. */
void irb_table_partial_name(struct irb_table_data *data);

/* Of rows of one trial that are to become one, keeps those with the most frames, in front, and
 * frees the others; returns how many. */
int irb_table_partial_keep(struct irb_table_row *rows, int count);

/* "running: 43 %, about 12 min left (render hall, seed 2 of 5)\n", or how far a run came that is
 * not finished; nothing of one that is. What is running but has said nothing for 2 minutes may be
 * dead: then it says when. */
void irb_table_progress(struct irb_store *store, struct irb_str *out);

#endif
