/* SPDX-License-Identifier: MIT
 *
 * What the stages of a run share: its options, its state and the clock of its work. The stages are
 * in prepare.c, render.c, score_stage.c and keep.c; run.c calls them in order.
 */
#ifndef IRB_EXPERIMENT_STAGE_H
#define IRB_EXPERIMENT_STAGE_H

#include "core/config/config.h"
#include "core/experiment/progress.h"
#include "core/experiment/sequence.h"
#include "core/gl/context.h"
#include "core/store/store.h"

enum irb_stage {
    IRB_STAGE_PREPARE = 1 << 0, /* scenes, G-buffers, references into the cache */
    IRB_STAGE_RENDER = 1 << 1,  /* frames of every trial */
    IRB_STAGE_SCORE = 1 << 2,   /* metrics, kept images */
    IRB_STAGE_ALL = IRB_STAGE_PREPARE | IRB_STAGE_RENDER | IRB_STAGE_SCORE,
};

/* Of a method that keeps no history: they only load caches and compile shaders. */
enum { IRB_WARM_UP_FRAMES = 1 };
/* Frames before frame 0 of one that does: where it has none to settle in, it is warmed up too, and
 * forgets that. */
static inline int irb_settle_frames(const struct irb_render_settings *render)
{
    return render->settle > 0 ? render->settle : IRB_WARM_UP_FRAMES;
}

struct irb_run_options {
    const char *out; /* run folder; NULL = results/runs/NAME-KEY */
    enum irb_backend backend;
    const char *shader_dir;  /* NULL = the embedded shaders */
    int threads;             /* of reference and scoring; 0 = all cores */
    unsigned stages;         /* enum irb_stage */
    const char *const *only; /* names of the trials to run; NULL or only_count 0 = all */
    int only_count;
    double minutes;     /* after these no new round begins but each scene's first, and one that is
                           missing in any case; 0 = no limit */
    size_t batch_bytes; /* see irb_run_batch(); 0 = 1 GiB */
    bool keep_all;      /* keep every frame's image, not only first, middle, worst and last */
    const char *command_line;
    struct irb_log *log;               /* may be NULL */
    const volatile sig_atomic_t *stop; /* set on Ctrl-C; may be NULL */
};

/* Seconds of the whole run by kind of work. */
enum irb_work {
    IRB_WORK_STARTUP,   /* context, config, scene loading */
    IRB_WORK_REFERENCE, /* G-buffers for it and ray tracing */
    IRB_WORK_RENDER,    /* GL work of all trials, warm-up included */
    IRB_WORK_SCORE,     /* metrics and maps */
    IRB_WORK_STORE,     /* database, EXR and PNG files */
    IRB_WORK_COUNT
};
extern const char *const irb_work_names[IRB_WORK_COUNT];

struct irb_run {
    const struct irb_config *config; /* whose trials are the selected ones, each for each seed */
    struct irb_key config_key;       /* of the whole config */
    const struct irb_run_options *options;
    struct irb_log *log;
    struct irb_gl *gl;       /* NULL until a stage needs it */
    struct irb_store *store; /* NULL in `irbench reference` */
    char *dir, *cache;       /* owned */
    struct irb_progress progress;
    double deadline_s;   /* by irb_clock_s(); infinite without a limit */
    int rounds_rendered; /* by this process */
    int scenes_after;    /* this one */
    int rounds_left_out; /* for want of time */
    double seconds[IRB_WORK_COUNT];
    enum irb_work working; /* what the clock is running for */
    double since_s;
};

/* From now on the time goes to `work`. */
void irb_run_work(struct irb_run *run, enum irb_work work);
/* What is being done now, for people ("render hall, seed 2 of 5"), and that its clock begins. */
void irb_run_begin(struct irb_run *run, enum irb_progress_kind kind, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* `units` of it have been made. Progress goes to the log and, at most once a second, to meta
 * "progress": {"fraction": 0.43, "left_s": 730, "what": "...", "at": "2026-01-31T12:00:00Z",
 * "state": "running" or "stopped"}; "done" when all stages of all trials are. */
void irb_run_step(struct irb_run *run, double units);
/* So many units of the next step have been made: readers take a run for dead that says nothing for
 * 2 minutes. On the thread that began the work alone. */
void irb_run_part(struct irb_run *run, double units);
/* While a unit is made that reports its own progress to the log: that counts as its share. */
void irb_run_watch(struct irb_run *run, bool on);
/* The end of the command; `whole` where with it the run is. */
bool irb_run_end(struct irb_run *run, bool whole, struct irb_error *err);
/* Trials that go over a sequence together where each holds so many bytes meanwhile; at least one a
 * thread. */
int irb_run_batch(const struct irb_run *run, size_t trial_bytes);
bool irb_run_stopped(const struct irb_run *run, struct irb_error *err);
/* Creates the GL context if there is none yet. */
bool irb_run_need_gl(struct irb_run *run, struct irb_error *err);

#endif
