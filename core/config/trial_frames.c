/* SPDX-License-Identifier: MIT
 *
 * What a trial's method says of its parameters (methods/method.h), frame by frame.
 */
#include "core/config/parts.h"

#include <stdlib.h>

/* The parameters of a frame: the trial's own, or in `scratch`, which is made when it is needed. */
static const void *params_at(const struct irb_trial *trial, int frame, void **scratch)
{
    if (!trial->track_count)
        return trial->params;
    if (!*scratch && !(*scratch = calloc(1, trial->method->params_size)))
        abort(); /* a few bytes */
    irb_trial_params(trial, frame, *scratch);
    return *scratch;
}

bool irb_trial_claims_visibility(const struct irb_trial *trial, int frame)
{
    void *scratch = NULL;
    bool claims = trial->method->claims_visibility &&
                  trial->method->claims_visibility(params_at(trial, frame, &scratch));
    free(scratch);
    return claims;
}

unsigned irb_trial_needs(const struct irb_trial *trial, int frames)
{
    void *scratch = NULL;
    unsigned needs = IRB_NEEDS_NOTHING;
    for (int i = 0; trial->method->needs && i < (trial->track_count ? frames : 1); i++)
        needs |= trial->method->needs(params_at(trial, i, &scratch));
    free(scratch);
    return needs;
}

/* ---- whether they go together ---- */

static bool check_frame(const struct irb_trial *trial, int frame,
                        const struct irb_frame_sizes *sizes, void **scratch, struct irb_error *err)
{
    if (trial->method->check(params_at(trial, frame, scratch), sizes, err))
        return true;
    if (trial->track_count)
        irb_error_prefix(err, "frame %d", frame);
    irb_error_prefix(err, "trial '%.128s'", trial->name);
    return irb_error_prefix(err, "%s", trial->place);
}

/* All frames of the sequence, between keys as well, and the keys behind it: --set frames=2 makes no
 * config sound. */
static bool check_trial(const struct irb_trial *trial, int frames,
                        const struct irb_frame_sizes *sizes, struct irb_error *err)
{
    void *scratch = NULL;
    bool ok = true;
    for (int i = 0; ok && i < (trial->track_count ? frames : 1); i++)
        ok = check_frame(trial, i, sizes, &scratch, err);
    for (int t = 0; ok && t < trial->track_count; t++)
        for (int k = 0; ok && k < trial->tracks[t].key_count; k++)
            ok = trial->tracks[t].keys[k].frame < frames ||
                 check_frame(trial, trial->tracks[t].keys[k].frame, sizes, &scratch, err);
    free(scratch);
    return ok;
}

bool irb_config_check_trials(const struct irb_config *config, struct irb_error *err)
{
    const struct irb_render_settings *render = &config->render;
    for (int i = 0; i < config->trial_count; i++) {
        const struct irb_trial *trial = &config->trials[i];
        const struct irb_frame_sizes sizes = {render->width, render->height,
                                              irb_trial_rsm_resolution(trial, render)};
        if (trial->method->check && !check_trial(trial, render->frames, &sizes, err))
            return false;
    }
    return true;
}
