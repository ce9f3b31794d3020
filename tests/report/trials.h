/* SPDX-License-Identifier: MIT
 *
 * Runs that nobody rendered, for tests: values that a test knows, in a database of its own.
 */
#ifndef IRB_TESTS_REPORT_TRIALS_H
#define IRB_TESTS_REPORT_TRIALS_H

#include "core/store/store.h"
#include "tests/support/compare.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Makes a folder from "/tmp/irb_NAME_XXXXXX" and a store in it. */
static inline struct irb_store *trials_open(char *folder)
{
    struct irb_error err = {0};
    struct irb_store *store = mkdtemp(folder) ? irb_store_open(folder, true, &err) : NULL;
    if (!store)
        fail_msg("%s: %s", folder, err.message);
    return store;
}

static inline int trials_close(struct irb_store *store, const char *folder)
{
    irb_store_close(store);
    char *command = NULL;
    if (asprintf(&command, "rm -rf '%s'", folder) < 0)
        return -1;
    int status = system(command);
    free(command);
    return status;
}

static inline int64_t trials_add(struct irb_store *store, const char *scene, const char *method,
                                 const char *trial, const char *params, int seed)
{
    struct irb_error err = {0};
    int64_t id = irb_store_trial(store, scene, method, trial, params, seed, &err);
    if (!id)
        fail_msg("%s", err.message);
    return id;
}

/* Scores of a frame, which replace all that it had; frame -1 for the sequence's. */
static inline void trials_scores(struct irb_store *store, int64_t id, int frame,
                                 const struct irb_store_value *values, int count)
{
    struct irb_error err = {0};
    REQUIRE_OK(irb_store_scores(store, id, frame, values, count, &err));
}

static inline void trials_score(struct irb_store *store, int64_t id, int frame, const char *name,
                                double value)
{
    trials_scores(store, id, frame, &(struct irb_store_value){name, value}, 1);
}

/* One stage, "gather", in repeat 0. */
static inline void trials_time(struct irb_store *store, int64_t id, int frame, double ms)
{
    struct irb_error err = {0};
    REQUIRE_OK(irb_store_frame(store, id, frame, "clock", &(struct irb_store_value){"gather", ms},
                               1, NULL, 0, &err));
}

static inline void trials_repeat(struct irb_store *store, int64_t id, int repeat, int frame,
                                 double ms)
{
    struct irb_error err = {0};
    REQUIRE_OK(irb_store_repeat(store, id, repeat, frame, &(struct irb_store_value){"gather", ms},
                                1, &err));
}

#endif
