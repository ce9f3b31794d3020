/* SPDX-License-Identifier: MIT
 *
 * What the stages of a run share: its options, its state and the clock of its work. The stages are
 * in prepare.c, render.c, score_stage.c and keep.c; run.c calls them in order.
 */
#ifndef IRB_EXPERIMENT_STAGE_H
#define IRB_EXPERIMENT_STAGE_H

#include "core/config/config.h"
#include "core/experiment/sequence.h"
#include "core/gl/context.h"
#include "core/store/store.h"

enum irb_stage {
    IRB_STAGE_PREPARE = 1 << 0, /* scenes, G-buffers, references into the cache */
    IRB_STAGE_RENDER = 1 << 1,  /* frames of every trial */
    IRB_STAGE_SCORE = 1 << 2,   /* metrics, kept images */
    IRB_STAGE_ALL = IRB_STAGE_PREPARE | IRB_STAGE_RENDER | IRB_STAGE_SCORE,
};

struct irb_run_options {
    const char *out; /* run folder; NULL = results/runs/NAME-KEY */
    enum irb_backend backend;
    const char *shader_dir;  /* NULL = the embedded shaders */
    int threads;             /* of reference and scoring; 0 = all cores */
    unsigned stages;         /* enum irb_stage */
    const char *const *only; /* names of the trials to run; NULL or only_count 0 = all */
    int only_count;
    bool keep_all; /* keep every frame's image, not only first, middle, worst and last */
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
    double seconds[IRB_WORK_COUNT];
    enum irb_work working; /* what the clock is running for */
    double since_s;
};

/* From now on the time goes to `work`. */
void irb_run_work(struct irb_run *run, enum irb_work work);
bool irb_run_stopped(const struct irb_run *run, struct irb_error *err);
/* Creates the GL context if there is none yet. */
bool irb_run_need_gl(struct irb_run *run, struct irb_error *err);

#endif
