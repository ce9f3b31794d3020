/* SPDX-License-Identifier: MIT
 *
 * Two methods without code: what a config needs to know of a method is its name and parameters, and
 * what follows from these.
 */
#ifndef IRB_TESTS_CONFIG_MOCK_METHODS_H
#define IRB_TESTS_CONFIG_MOCK_METHODS_H

#include "methods/registry.h"

struct mock_params {
    int mode, samples;
    float clamp;
    bool shared;
};

static const char *const mock_modes[] = {"all", "uniform", "importance", NULL};

static const struct irb_option mock_options[] = {
    IRB_OPTION_ENUM(struct mock_params, mode, 1, mock_modes, "which texels", "test"),
    IRB_OPTION_INT(struct mock_params, samples, 400, 1, 4096, "", "samples", "test"),
    IRB_OPTION_FLOAT(struct mock_params, clamp, 0.1, 0, 10, "m", "distance", "test"),
    IRB_OPTION_BOOL(struct mock_params, shared, 1, "one set for all pixels", "test"),
    IRB_OPTION_END,
};

static bool mock_claims_visibility(const void *params)
{
    return ((const struct mock_params *)params)->mode == 2;
}

static unsigned mock_needs(const void *params)
{
    const struct mock_params *p = params;
    return (p->samples > 1000 ? IRB_NEEDS_HISTORY : 0) |
           (p->shared ? 0 : IRB_NEEDS_STATIC_GEOMETRY);
}

/* Importance draws each texel once at most. */
static bool mock_check(const void *params, const struct irb_frame_sizes *sizes,
                       struct irb_error *err)
{
    const struct mock_params *p = params;
    const int texels = sizes->rsm_resolution * sizes->rsm_resolution;
    return p->mode != 2 || p->samples <= texels ||
           irb_fail(err, IRB_E_INPUT, "samples: expected at most %d, found %d", texels, p->samples);
}

static const struct irb_method mock_rsm = {.name = "rsm",
                                           .params_size = sizeof(struct mock_params),
                                           .params = mock_options,
                                           .claims_visibility = mock_claims_visibility,
                                           .needs = mock_needs,
                                           .check = mock_check};

static const struct irb_option mock_no_options[] = {IRB_OPTION_END};
static const struct irb_method mock_plain = {.name = "plain", .params = mock_no_options};

static const struct irb_registry mock_registry = {.methods = {&mock_rsm, &mock_plain}, .count = 2};

#endif
