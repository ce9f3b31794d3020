/* SPDX-License-Identifier: MIT */
#include "core/experiment/run.h"
#include "core/base/clock.h"
#include "core/base/fs.h"
#include "core/experiment/paths.h"
#include "core/experiment/prepare.h"
#include "core/experiment/provenance.h"
#include "core/experiment/render.h"
#include "core/experiment/run_trials.h"
#include "core/experiment/score_stage.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void close_run(struct irb_run *run)
{
    irb_gl_destroy(run->gl);
    irb_store_close(run->store);
    free(run->dir);
    free(run->cache);
}

static struct irb_run begin_run(const struct irb_config *config,
                                const struct irb_run_options *options)
{
    return (struct irb_run){
        .config = config,
        .config_key = irb_config_key(config),
        .options = options,
        .log = options->log,
        .cache = irb_cache_dir(),
        .working = IRB_WORK_STARTUP,
        .since_s = irb_clock_s(),
        .deadline_s = options->minutes > 0 ? irb_clock_s() + 60 * options->minutes : INFINITY,
    };
}

static bool holds_this(const struct irb_run *run, struct irb_store *store, struct irb_error *err)
{
    char *stored = irb_store_get_meta(store, "config_key");
    bool same = !stored || !strcmp(stored, run->config_key.hex);
    if (!same)
        irb_fail(err, IRB_E_USAGE,
                 "%s: holds another experiment (config key %.8s, this one is %.8s); choose another "
                 "--out or remove it",
                 run->dir, stored, run->config_key.hex);
    free(stored);
    return same;
}

/* Opening for writing converts an old file: before that, one of another experiment is refused and
 * left as it is. What can't be read is for that opening to judge. */
static bool holds_no_other(const struct irb_run *run, struct irb_error *err)
{
    struct irb_error unreadable;
    struct irb_store *store = irb_store_open(run->dir, false, &unreadable);
    bool ok = !store || holds_this(run, store, err);
    irb_store_close(store);
    return ok;
}

/* Opens the run folder; refuses one that holds another experiment. */
static bool open_results(struct irb_run *run, struct irb_error *err)
{
    run->dir = run->options->out
                   ? irb_strdup(run->options->out)
                   : irb_asprintf("results/runs/%s-%.8s", run->config->name, run->config_key.hex);
    return irb_fs_make_dirs(run->dir, err) && holds_no_other(run, err) &&
           (run->store = irb_store_open(run->dir, true, err)) && holds_this(run, run->store, err) &&
           irb_provenance_store_host(run, err);
}

/* Keys of all frames, so that scoring can run where there is no OpenGL. */
static bool store_keys(struct irb_run *run, const struct irb_sequence *sequence,
                       struct irb_error *err)
{
    struct irb_str lines = {0};
    for (int i = 0; i < sequence->frame_count; i++)
        irb_str_printf(&lines, "%s %s\n", sequence->frames[i].gbuffer.hex,
                       sequence->frames[i].reference.hex);
    char *name = irb_asprintf("scene/%s/keys", sequence->entry->name);
    char *before = irb_store_get_meta(run->store, name);
    bool ok = (!before || !strcmp(before, irb_str_text(&lines)) ||
               irb_fail(err, IRB_E_USAGE,
                        "%s: scene %s has changed since this run began; choose another --out",
                        run->dir, sequence->entry->name)) &&
              irb_store_set_meta(run->store, name, irb_str_text(&lines), err);
    free(before);
    free(name);
    irb_str_free(&lines);
    return ok;
}

static bool read_keys(struct irb_run *run, struct irb_sequence *sequence, struct irb_error *err)
{
    char *text = irb_store_get_scene_meta(run->store, sequence->entry->name, "keys");
    bool ok = text != NULL;
    const char *line = text;
    for (int i = 0; ok && i < sequence->frame_count; i++) {
        struct irb_sequence_frame *frame = &sequence->frames[i];
        int used = 0;
        ok = sscanf(line, "%32s %32s\n%n", frame->gbuffer.hex, frame->reference.hex, &used) == 2;
        line += used;
    }
    free(text);
    return ok ||
           irb_fail(err, IRB_E_USAGE, "%s: scene %s is not prepared; run --stage prepare first",
                    run->dir, sequence->entry->name);
}

static bool score_rendered(struct irb_run *run, struct irb_sequence *sequence,
                           struct irb_error *err)
{
    const struct irb_config *all = run->config;
    struct irb_config rendered;
    bool ok = irb_run_rendered_trials(&rendered, run, sequence, err);
    irb_progress_leave_out_trials(&run->progress, all->trial_count - rendered.trial_count);
    run->config = &rendered;
    ok = ok && irb_score_sequence(run, sequence, err);
    run->config = all;
    free(rendered.trials);
    return ok;
}

static bool run_scene(struct irb_run *run, const struct irb_scene_entry *entry,
                      struct irb_error *err)
{
    struct irb_sequence sequence;
    unsigned stages = run->options->stages;
    irb_run_work(run, IRB_WORK_STARTUP);
    if (!irb_sequence_open(&sequence, run->config, entry, run->log, err))
        return false;
    bool ok = true;
    if (stages & IRB_STAGE_PREPARE)
        ok = irb_prepare_gbuffers(run, &sequence, err) && store_keys(run, &sequence, err) &&
             irb_prepare_references(run, &sequence, err);
    else
        ok = read_keys(run, &sequence, err);
    if (ok && (stages & IRB_STAGE_RENDER))
        ok = irb_render_sequence(run, &sequence, err);
    if (ok && (stages & IRB_STAGE_SCORE))
        ok = score_rendered(run, &sequence, err);
    irb_sequence_close(&sequence);
    return ok || irb_error_prefix(err, "scene %s", entry->name);
}

static void report_seconds(const struct irb_run *run)
{
    struct irb_str line = {0};
    for (int i = 0; i < IRB_WORK_COUNT; i++)
        irb_str_printf(&line, "%s%s %.1f s", i ? ", " : "", irb_work_names[i], run->seconds[i]);
    irb_info(run->log, "time: %s", irb_str_text(&line));
    irb_str_free(&line);
}

static bool run_scenes(struct irb_run *run, struct irb_error *err)
{
    struct irb_config selected;
    bool ok = irb_run_trials(&selected, run->config, run->options, err);
    run->config = &selected;
    if (ok)
        run->progress = irb_progress_plan(&selected, run->options->stages, run->options->keep_all);
    run->progress.deadline_s = run->deadline_s;
    for (int i = 0; ok && i < selected.scene_count; i++) {
        run->scenes_after = selected.scene_count - 1 - i;
        ok = run_scene(run, &selected.scenes[i], err);
    }
    irb_run_trials_free(&selected);
    return ok;
}

bool irb_run_experiment(const struct irb_config *config, const struct irb_run_options *options,
                        char **run_dir, struct irb_error *err)
{
    struct irb_run run = begin_run(config, options);
    bool opened = open_results(&run, err);
    if (run.dir)
        *run_dir = irb_strdup(run.dir);
    bool ok = opened && run_scenes(&run, err);
    run.config = config;
    irb_run_work(&run, IRB_WORK_STARTUP);
    struct irb_error late;
    if (opened && !irb_run_end(&run, ok && irb_run_is_whole(&run), ok ? err : &late))
        ok = false;
    if (opened && (ok || (err && err->code == IRB_E_INTERRUPTED))) {
        if (!irb_provenance_store_seconds(&run, ok ? err : &late))
            ok = false;
        report_seconds(&run);
    }
    close_run(&run);
    return ok;
}

static void print_keys(const struct irb_run *run, const struct irb_sequence *sequence, FILE *out)
{
    for (int i = 0; i < sequence->frame_count; i++) {
        char *path = irb_cache_reference(run->cache, &sequence->frames[i].reference);
        fprintf(out, "%s %s %d %s\n", sequence->frames[i].reference.hex, sequence->entry->name, i,
                irb_fs_exists(path) ? "cached" : "missing");
        free(path);
    }
}

bool irb_run_references(const struct irb_config *config, const struct irb_run_options *options,
                        FILE *keys, struct irb_error *err)
{
    struct irb_run run = begin_run(config, options);
    bool ok = true;
    run.progress = irb_progress_plan(config, IRB_STAGE_PREPARE, false);
    for (int i = 0; ok && i < config->scene_count; i++) {
        struct irb_sequence sequence;
        irb_run_work(&run, IRB_WORK_STARTUP);
        ok = irb_sequence_open(&sequence, config, &config->scenes[i], run.log, err);
        if (!ok)
            break;
        ok = irb_prepare_gbuffers(&run, &sequence, err);
        if (ok && keys)
            print_keys(&run, &sequence, keys);
        else if (ok)
            ok = irb_prepare_references(&run, &sequence, err);
        irb_sequence_close(&sequence);
    }
    close_run(&run);
    return ok;
}
