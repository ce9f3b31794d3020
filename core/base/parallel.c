/* SPDX-License-Identifier: MIT */
#include "core/base/parallel.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdlib.h>

struct job {
    irb_parallel_fn fn;
    void *user;
    int count;
    atomic_int next;
    atomic_bool stopped;
};

struct worker {
    struct job *job;
    int thread;
    pthread_t handle;
};

static void *work(void *arg)
{
    struct worker *worker = arg;
    struct job *job = worker->job;
    for (;;) {
        int index = atomic_fetch_add(&job->next, 1);
        if (index >= job->count || atomic_load(&job->stopped))
            return NULL;
        if (!job->fn(job->user, index, worker->thread))
            atomic_store(&job->stopped, true);
    }
}

int irb_core_count(void)
{
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) == 0 && CPU_COUNT(&set) > 0)
        return CPU_COUNT(&set);
    return 1;
}

bool irb_parallel_for(int count, int threads, irb_parallel_fn fn, void *user)
{
    if (threads <= 0)
        threads = irb_core_count();
    if (threads > count)
        threads = count > 0 ? count : 1;
    struct job job = {.fn = fn, .user = user, .count = count};
    struct worker *workers = calloc((size_t)threads, sizeof *workers);
    struct worker self = {.job = &job, .thread = 0};
    int started = 0;
    /* Without memory or threads the calling thread does it all: slower, never wrong. */
    for (int i = 1; workers && i < threads; i++) {
        workers[i] = (struct worker){.job = &job, .thread = i};
        if (pthread_create(&workers[i].handle, NULL, work, &workers[i]))
            break;
        started = i;
    }
    work(&self);
    for (int i = 1; i <= started; i++)
        pthread_join(workers[i].handle, NULL);
    free(workers);
    return !atomic_load(&job.stopped);
}
