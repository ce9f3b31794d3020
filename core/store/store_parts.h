/* SPDX-License-Identifier: MIT
 *
 * What the files of the store share, and nobody else.
 */
#ifndef IRB_STORE_PARTS_H
#define IRB_STORE_PARTS_H

#include "core/store/store.h"

#include <sqlite3.h>

/* Every statement, prepared when it is first used and kept. */
enum irb_store_statement {
    SET_META,
    GET_META,
    READ_META,
    FIND_TRIAL,
    ADD_TRIAL,
    ADD_FRAME,
    DROP_STAGES,
    ADD_STAGE,
    DROP_STATISTICS,
    ADD_STATISTIC,
    DROP_SCORES,
    ADD_SCORE,
    SET_COST,
    HAS_FRAME,
    HAS_REPEAT,
    HAS_SCORES,
    GET_CLOCK,
    LIST_TRIALS,
    READ_SCORES,
    READ_TIMES,
    READ_STATISTICS,
    READ_COSTS,
    IRB_STORE_STATEMENTS
};

struct irb_store {
    sqlite3 *db;
    char *path;
    sqlite3_stmt *statements[IRB_STORE_STATEMENTS];
};

/* What SQLite says of the last call, as an error of ours: IRB_E_INPUT for a damaged file, else
 * IRB_E_IO. Returns false. */
bool irb_store_fail(struct irb_store *store, const char *doing, struct irb_error *err);
/* Runs statements that return no rows. */
bool irb_store_exec(struct irb_store *store, const char *sql, const char *doing,
                    struct irb_error *err);
/* Ends the transaction: all of it or, without `ok`, nothing. */
bool irb_store_finish(struct irb_store *store, bool ok, struct irb_error *err);

#endif
