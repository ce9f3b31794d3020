/* SPDX-License-Identifier: MIT
 *
 * The film: small JPEGs of every scored frame, for reports that show a sequence. Written while
 * scoring, before the scores are stored: where a score is, the film frame is too (unless `film` was
 * off, or the build has no OpenImageIO).
 *
 *     RUN/SCENE/film/reference-0000.jpg         indirect radiance of the reference
 *     RUN/SCENE/film/direct-0000.jpg            the core's direct light, shared by the trials
 *     RUN/SCENE/film/direct_reference-0000.jpg  exact direct light
 *     RUN/SCENE/TRIAL/film/indirect-0000.jpg    indirect radiance
 *     RUN/SCENE/TRIAL/film/flip-0000.jpg        its HDR-FLIP, grey: 1 is white
 *     RUN/SCENE/TRIAL/film/residual-0000.jpg    |e_t - e_(t-1)| / mean reference, grey: 1 and above
 *                                               is white; none of frame 0
 *
 * Of several seeds the first alone has a film, in TRIAL/seed-N/film/. Radiance is in the code of
 * core/score/film_code.h, whose scales are stored as scene/NAME/film_v0_indirect and so on.
 */
#ifndef IRB_EXPERIMENT_FILM_H
#define IRB_EXPERIMENT_FILM_H

#include "core/experiment/paths.h"
#include "core/experiment/score_frame.h"

/* Whether the run makes films, and whether this trial has one. */
bool irb_film_wanted(const struct irb_config *config);
bool irb_film_has_trial(const struct irb_config *config, const struct irb_trial *trial);

/* Makes the folder RUN/SCENE[/FOLDER]/film and clears it of what a killed run left half written.
 * folder may be NULL: the scene's. */
bool irb_film_open(const char *run, const char *scene, const char *folder, struct irb_error *err);

/* The three pictures of the scene, those that are not there yet; `target` as irb_target_load makes
 * it. */
bool irb_film_target(const char *run, const char *scene, int frame, const struct irb_target *target,
                     const struct irb_target_constants *constants, struct irb_error *err);

/* The pictures of a trial. Any thread; equal images give equal files. */
bool irb_film_trial(const struct irb_frame_place *place, const struct irb_image *indirect,
                    const struct irb_score_maps *maps, const struct irb_target_constants *constants,
                    struct irb_error *err);

#endif
