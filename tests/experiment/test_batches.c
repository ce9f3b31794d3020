/* SPDX-License-Identifier: MIT
 *
 * Scores and pictures are the same, bit for bit, whether all trials go over the sequence together
 * or one after the other.
 */
#include "core/experiment/run.h"
#include "tests/support/compare.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char folder[] = "/tmp/irb_batches_XXXXXX";

static const char yaml[] =
    "name: batches\n"
    "scene: cornell\n"
    "resolution: [32, 24]\n"
    "frames: 4\n"
    "settle: 1\n"
    "rsm_resolution: 16\n"
    "seeds: [3, 8]\n"
    "reference: {min_samples: 4, max_samples: 4, bounces: 1}\n"
    "regions: [{name: left, box: [0, 0, 0.5, 1]}]\n"
    "light:\n"
    "  keys:\n"
    "    - {frame: 0, position: [0.2, 0.4, 0.15], target: [0.3, 0.1, 0.55], intensity: 1, "
    "cone: 30}\n"
    "    - {frame: 3, position: [0.2, 0.4, 0.15], target: [0.55, 0.2, 0.3], intensity: 1, "
    "cone: 30}\n"
    "trials:\n"
    "  - rsm: {mode: importance, samples: 9}\n"
    "  - acrsm: {clusters: 16}\n"
    "  - rsm: {mode: all}\n";

static int set_up(void **state)
{
    (void)state;
    char path[64];
    if (!mkdtemp(folder))
        return -1;
    snprintf(path, sizeof path, "%s/config.yaml", folder);
    FILE *file = fopen(path, "w");
    return file && fputs(yaml, file) >= 0 && !fclose(file) ? setenv("IRBENCH_CACHE", folder, 1)
                                                           : -1;
}

static int tear_down(void **state)
{
    (void)state;
    char command[64];
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    return system(command);
}

/* The run `name` with so many bytes for the trials of a batch, on one thread. */
static void run(const struct irb_config *config, const char *name, size_t batch_bytes)
{
    struct irb_error err = {0};
    char out[64], *dir = NULL;
    snprintf(out, sizeof out, "%s/%s", folder, name);
    const struct irb_run_options options = {
        .out = out,
        .backend = IRB_BACKEND_OSMESA,
        .threads = 1,
        .stages = IRB_STAGE_ALL,
        .batch_bytes = batch_bytes,
        .command_line = "",
    };
    REQUIRE_OK(irb_run_experiment(config, &options, &dir, &err));
    free(dir);
}

static void write_line(void *user, int frame, const char *name, double value)
{
    fprintf(user, "%d %s %a\n", frame, name, value);
}

/* All scores of the run, a line each. Malloc'ed. */
static char *read_scores(const char *name, int *lines)
{
    struct irb_error err = {0};
    char path[64], *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    snprintf(path, sizeof path, "%s/%s", folder, name);
    struct irb_store *store = irb_store_open(path, false, &err);
    struct irb_store_trial_list trials;
    assert_non_null(store);
    REQUIRE_OK(irb_store_trials(store, &trials, &err));
    for (int i = 0; i < trials.count; i++) {
        fprintf(out, "%s, seed %d\n", trials.rows[i].trial, trials.rows[i].seed);
        REQUIRE_OK(irb_store_read_scores(store, trials.rows[i].id, write_line, out, &err));
    }
    irb_store_trial_list_destroy(&trials);
    irb_store_close(store);
    fclose(out);
    *lines = 0;
    for (const char *c = text; *c; c++)
        *lines += *c == '\n';
    return text;
}

static void test_same_bits(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct irb_registry registry;
    struct irb_config config = {0};
    const char *const none[] = {NULL};
    char path[64], command[256];
    irb_registry_init(&registry);
    snprintf(path, sizeof path, "%s/config.yaml", folder);
    REQUIRE_OK(irb_config_load(&config, path, none, &registry, &err));
    run(&config, "together", 0);
    run(&config, "alone", 1);
    irb_config_destroy(&config);
    irb_registry_close(&registry);

    int count_a, count_b;
    char *a = read_scores("together", &count_a), *b = read_scores("alone", &count_b);
    assert_true(count_a > 6 * 5 * 30); /* 3 trials with 2 seeds, 4 frames and the sequence */
    assert_int_equal(count_a, count_b);
    assert_string_equal(a, b);
    free(a);
    free(b);
    snprintf(command, sizeof command, "diff -r -x results.sqlite\\* '%s/together' '%s/alone'",
             folder, folder);
    assert_int_equal(system(command), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_same_bits)};
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
