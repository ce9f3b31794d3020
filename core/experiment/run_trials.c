/* SPDX-License-Identifier: MIT */
#include "core/experiment/run_trials.h"
#include "core/base/fs.h"
#include "core/base/str.h"
#include "core/experiment/render_trial.h"

#include <stdlib.h>
#include <string.h>

static bool unknown_trial(const struct irb_config *config, const char *name, struct irb_error *err)
{
    const char *names[IRB_MOST_TRIALS];
    for (int i = 0; i < config->trial_count; i++)
        names[i] = config->trials[i].name;
    const char *near = irb_nearest(name, names, (size_t)config->trial_count);
    return irb_fail(err, IRB_E_USAGE, "--only: the config has no trial '%s'%s%s%s", name,
                    near ? "; did you mean '" : "", near ? near : "", near ? "'?" : "");
}

/* Whether each of the config's trials is to be run. */
static bool select_trials(bool wanted[IRB_MOST_TRIALS], const struct irb_config *config,
                          const struct irb_run_options *options, struct irb_error *err)
{
    for (int i = 0; i < config->trial_count; i++)
        wanted[i] = !options->only_count;
    for (int o = 0; o < options->only_count; o++) {
        bool found = false;
        for (int i = 0; i < config->trial_count; i++) {
            if (strcmp(config->trials[i].name, options->only[o]))
                continue;
            wanted[i] = found = true;
        }
        if (!found)
            return unknown_trial(config, options->only[o], err);
    }
    return true;
}

bool irb_run_trials(struct irb_config *selected, const struct irb_config *config,
                    const struct irb_run_options *options, struct irb_error *err)
{
    bool wanted[IRB_MOST_TRIALS];
    *selected = *config;
    selected->trial_count = 0;
    selected->trials =
        calloc((size_t)config->trial_count * (size_t)config->seed_count, sizeof *selected->trials);
    if (!selected->trials)
        return irb_fail(err, IRB_E_MEMORY, "no memory for %d trials", config->trial_count);
    if (!select_trials(wanted, config, options, err))
        return false;
    for (int i = 0; i < config->trial_count; i++) {
        for (int s = 0; wanted[i] && s < config->seed_count; s++) {
            struct irb_trial *trial = &selected->trials[selected->trial_count++];
            *trial = config->trials[i];
            trial->seed = config->seeds[s];
            char *name = irb_fs_short_name(trial->name);
            trial->folder = config->seed_count > 1 ? irb_asprintf("%s/seed-%d", name, trial->seed)
                                                   : irb_strdup(name);
            free(name);
        }
    }
    return true;
}

bool irb_run_rendered_trials(struct irb_config *rendered, const struct irb_run *run,
                             const struct irb_sequence *sequence, struct irb_error *err)
{
    const struct irb_config *config = run->config;
    *rendered = *config;
    rendered->trial_count = 0;
    rendered->trials = calloc((size_t)config->trial_count, sizeof *rendered->trials);
    if (!rendered->trials)
        return irb_fail(err, IRB_E_MEMORY, "no memory for %d trials", config->trial_count);
    for (int i = 0; i < config->trial_count; i++)
        if (irb_trial_is_rendered(run, sequence, &config->trials[i]))
            rendered->trials[rendered->trial_count++] = config->trials[i];
    /* of rounds that were left out there has been a warning */
    if (rendered->trial_count && rendered->trial_count < config->trial_count &&
        !run->rounds_left_out)
        irb_warn(run->log,
                 "%s: %d of %d trials, each seed counted, are not rendered to their end "
                 "and not scored; the same command goes on with them",
                 sequence->entry->name, config->trial_count - rendered->trial_count,
                 config->trial_count);
    if (!rendered->trial_count) /* scoring says what is missing */
        for (int i = 0; i < config->trial_count; i++)
            rendered->trials[rendered->trial_count++] = config->trials[i];
    return true;
}

static bool trial_is_whole(const struct irb_run *run, const char *scene, const char *trial,
                           int seed)
{
    int64_t id = irb_store_trial_find(run->store, scene, trial, seed);
    bool whole = id > 0 && irb_store_has_scores(run->store, id, -1);
    for (int r = 0; whole && r < run->config->repeats; r++)
        whole = irb_store_has_repeat(run->store, id, r, run->config->render.frames - 1);
    return whole;
}

bool irb_run_is_whole(const struct irb_run *run)
{
    const struct irb_config *config = run->config;
    bool whole = true;
    for (int s = 0; whole && s < config->scene_count; s++)
        for (int t = 0; whole && t < config->trial_count; t++)
            for (int i = 0; whole && i < config->seed_count; i++)
                whole = trial_is_whole(run, config->scenes[s].name, config->trials[t].name,
                                       config->seeds[i]);
    return whole;
}

void irb_run_trials_free(struct irb_config *selected)
{
    for (int i = 0; i < selected->trial_count; i++)
        free(selected->trials[i].folder);
    free(selected->trials);
    selected->trials = NULL;
    selected->trial_count = 0;
}
