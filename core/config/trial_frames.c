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
