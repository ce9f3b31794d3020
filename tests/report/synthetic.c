/* SPDX-License-Identifier: MIT */
#include "tests/report/synthetic.h"

#include <math.h>
#include <stddef.h>

#define COUNT(array) (int)(sizeof(array) / sizeof *(array))

static bool fill_rsm(struct irb_store *store, int64_t trial, struct irb_error *err)
{
    static const double gather[] = {100, 1, 2, 3, 4, 10};
    for (int frame = -1; frame < 5; frame++) {
        const struct irb_store_value stage[] = {{"gather", gather[frame + 1]}};
        if (!irb_store_frame(store, trial, frame, "finish+clock", stage, 1, NULL, 0, err))
            return false;
    }
    const struct irb_store_value whole[] = {
        {"indirect_relmse", 0.04},
        {"indirect_rmse", 0.2},
        {"indirect_bias", -0.01},
        {"indirect_energy_ratio", 0.97},
        {"indirect_flip", 0.125},
        {"indirect_flicker", 0.003},
        {"reference_noise", 0.001},
        {"reference_noise_rmse", 0.025},
        {"reference_flicker", 0.002},
        {"uncovered_flux", 0.25},
        {"clamped_light", 0},
        {"lost_energy", 0.125},
        {"non_finite", 0},
        {"claim_rmse", NAN},
        {"a_metric_of_tomorrow", 1},
        {"full_flip@door", 0.5},
        {"lag_error@3", 1},
        {"of_tomorrow@door", 1},
    };
    /* a frame's own scores must not be taken for the sequence's */
    const struct irb_store_value frame[] = {{"indirect_relmse", 77}};
    return irb_store_scores(store, trial, 3, frame, 1, err) &&
           irb_store_scores(store, trial, -1, whole, COUNT(whole), err);
}

static bool fill_all(struct irb_store *store, int64_t trial, struct irb_error *err)
{
    for (int frame = 0; frame < 5; frame++) {
        const struct irb_store_value stages[] = {{"gather", 5}, {"filter", 1}};
        if (!irb_store_frame(store, trial, frame, "finish+clock", stages, 2, NULL, 0, err))
            return false;
    }
    const struct irb_store_value whole[] = {
        {"indirect_relmse", 0.0005},     {"indirect_rmse", 0.02},
        {"indirect_energy_ratio", 1.02}, {"indirect_flicker", 0.001},
        {"reference_noise", 0.001},      {"reference_flicker", 0.002},
        {"reference_noise_rmse", 0.025}, {"indirect_flip", 0.0625},
        {"uncovered_flux", 0},           {"non_finite", 0},
        {"indirect_rmse@wall", 0.75},
    };
    return irb_store_scores(store, trial, -1, whole, COUNT(whole), err);
}

struct irb_store *synthetic_store(const char *folder, struct irb_error *err)
{
    struct irb_store *store = irb_store_open(folder, true, err);
    if (!store)
        return NULL;
    int64_t rsm = irb_store_trial(store, "cornell", "rsm", "rsm",
                                  "{\"mode\": \"uniform\", \"samples\": 400}", 1, err);
    int64_t odd = irb_store_trial(store, "a,\"b\"", "rsm", "rsm", "{}", 1, err);
    int64_t all = irb_store_trial(store, "cornell", "rsm", "rsm:mode=all",
                                  "{\"mode\": \"all\", \"samples\": 400}", 1, err);
    int64_t plain = irb_store_trial(store, "cornell", "plain", "plain", "{}", 1, err);
    const struct irb_store_value whole[] = {
        {"indirect_relmse", 0.01}, {"indirect_rmse", INFINITY}, {"reference_noise", 0.001}};
    irb_store_set_meta(store, "gl_renderer", "a device", err);
    irb_store_set_meta(store, "scene/cornell/relmse_eps_indirect", "0.00012345", err);
    if (rsm && odd && all && plain && fill_rsm(store, rsm, err) && fill_all(store, all, err) &&
        irb_store_scores(store, plain, -1, whole, COUNT(whole), err))
        return store;
    irb_store_close(store);
    return NULL;
}
