/* SPDX-License-Identifier: MIT
 *
 * Where everything lies. All results are malloc'ed paths.
 *
 *     CACHE/gbuffer-KEY.exr               full-precision G-buffer
 *     CACHE/reference-KEY.exr             finished reference of one frame
 *     CACHE/reference-KEY.partial         tiles of an unfinished one
 *     RUN/results.sqlite                  every number
 *     RUN/config.yaml                     the config as it was read
 *     RUN/SCENE/direct-0000.exr           direct light of a frame, shared by all trials
 *     RUN/SCENE/mask-0000.exr             pixels left out of scores (only where there are any)
 *     RUN/SCENE/TRIAL/frame-0000.exr      what a method returned
 *     RUN/SCENE/TRIAL/image-0000.exr|png  a kept frame: result, reference, maps
 *     RUN/SCENE/TRIAL/debug-NAME-0000.png a debug layer of a kept frame
 *     RUN/SCENE/TRIAL/debug-NAME-0000.exr the same where it has not the image's size
 *     RUN/SCENE/TRIAL/profile.exr|png     a row of the image over the sequence, see temporal_maps.h
 *     RUN/SCENE/TRIAL/flicker.exr|png     temporal residual over the sequence
 *     RUN/SCENE/film/STEM-0000.jpg        small pictures of every frame, see film.h
 *     RUN/SCENE/TRIAL/film/STEM-0000.jpg  the same of a trial
 *
 * With several seeds what lies in TRIAL/ is in RUN/SCENE/TRIAL/seed-N/.
 */
#ifndef IRB_EXPERIMENT_PATHS_H
#define IRB_EXPERIMENT_PATHS_H

#include "core/base/hash.h"

/* $IRBENCH_CACHE, else $XDG_CACHE_HOME/irbench, else $HOME/.cache/irbench, else ./.irbench-cache.
 */
char *irb_cache_dir(void);
char *irb_cache_gbuffer(const char *cache, const struct irb_key *key);
char *irb_cache_reference(const char *cache, const struct irb_key *key);
char *irb_cache_checkpoint(const char *cache, const struct irb_key *key);

/* RUN/SCENE/stem-0003.exr; trial (its folder) may be NULL. extension without a dot. */
char *irb_run_file(const char *run, const char *scene, const char *trial, const char *stem,
                   int frame, const char *extension);
char *irb_run_folder(const char *run, const char *scene, const char *trial);

/* A frame of a trial. Everything is borrowed. */
struct irb_frame_place {
    const char *run, *scene;
    const char *folder; /* of the trial, below the scene's */
    int frame;
};
/* RUN/SCENE/TRIAL/stem-0003.exr */
char *irb_frame_path(const struct irb_frame_place *place, const char *stem, const char *extension);

#endif
