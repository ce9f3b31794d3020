/* SPDX-License-Identifier: MIT */
#include "core/score/compare.h"

#include "core/base/str.h"
#include "core/frame/composite.h"
#include "core/score/display.h"
#include "core/score/metrics.h"
#include "core/score/ssim.h"

#include <math.h>
#include <string.h>

const struct irb_compare_info irb_compare_metrics[IRB_COMPARE_COUNT] = {
#define X(name, unit, doc) {#name, unit, doc},
    IRB_COMPARE_METRICS(X)
#undef X
};

int irb_compare_find(const char *name, struct irb_error *err)
{
    const char *names[IRB_COMPARE_COUNT];
    for (int i = 0; i < IRB_COMPARE_COUNT; i++) {
        names[i] = irb_compare_metrics[i].name;
        if (!strcmp(names[i], name))
            return i;
    }
    const char *near = irb_nearest(name, names, IRB_COMPARE_COUNT);
    struct irb_str list = {0};
    for (int i = 0; i < IRB_COMPARE_COUNT && !near; i++)
        irb_str_printf(&list, "%s%s", i ? ", " : "", names[i]);
    irb_fail(err, IRB_E_USAGE, "unknown metric '%.64s'; %s %s%s", name,
             near ? "did you mean" : "expected one of", near ? near : irb_str_text(&list),
             near ? "?" : "");
    irb_str_free(&list);
    return -1;
}

/* v - r, and its largest channel. */
static bool difference_map(struct irb_comparison *out, const struct irb_image *test,
                           const struct irb_image *reference, struct irb_error *err)
{
    if (!irb_image_create(&out->difference, test->width, test->height, 3, err))
        return false;
    double largest = 0;
    for (size_t i = 0; i < 3 * irb_image_pixels(test); i++) {
        double d = (double)test->data[i] - reference->data[i];
        out->difference.data[i] = (float)d;
        if (isfinite(d) && fabs(d) > largest)
            largest = fabs(d);
    }
    out->values[IRB_COMPARE_max_error] = largest;
    return true;
}

static bool score_values(struct irb_comparison *out, const struct irb_image *test,
                         const struct irb_image *reference, struct irb_error *err)
{
    struct irb_pair pair = {test, reference, NULL};
    double *v = out->values;
    out->eps = irb_relmse_eps(irb_masked_mean(reference, NULL));
    out->peak = irb_value_percentile(&reference, NULL, 1, IRB_PSNR_PEAK_FRACTION);
    struct irb_error_scores scores = irb_score_errors(&pair, out->eps);
    v[IRB_COMPARE_rmse] = scores.rmse;
    v[IRB_COMPARE_relmse] = scores.relmse;
    v[IRB_COMPARE_smape] = scores.smape;
    v[IRB_COMPARE_psnr] = irb_psnr(scores.rmse, out->peak);
    v[IRB_COMPARE_bias] = scores.bias;
    v[IRB_COMPARE_energy_ratio] = scores.energy_ratio;
    v[IRB_COMPARE_non_finite] = (double)scores.non_finite;
    v[IRB_COMPARE_negative] = (double)scores.negative;
    return irb_relmse_map(&pair, out->eps, &out->relmse, err) &&
           difference_map(out, test, reference, err);
}

static bool score_hdr_flip(struct irb_comparison *out, const struct irb_image *test,
                           const struct irb_image *reference, int threads, struct irb_error *err)
{
    struct irb_flip_scores scores;
    out->lit = irb_flip_exposures_of(&reference, NULL, 1, &out->exposures);
    if (!out->lit)
        return irb_image_create(&out->flip, test->width, test->height, 1, err);
    if (!irb_flip_hdr(test, reference, NULL, &out->exposures, IRB_FLIP_PPD, threads, &out->flip,
                      &scores, err))
        return false;
    out->values[IRB_COMPARE_flip] = scores.mean;
    return true;
}

static bool score_ldr_flip(struct irb_comparison *out, const struct irb_image *test,
                           const struct irb_image *reference, int threads, struct irb_error *err)
{
    struct irb_flip_scores scores;
    struct irb_flip_reference *a = irb_flip_view_create(test, IRB_FLIP_PPD, threads, err);
    struct irb_flip_reference *b =
        a ? irb_flip_view_create(reference, IRB_FLIP_PPD, threads, err) : NULL;
    bool ok = a && b && irb_flip_views(a, b, NULL, threads, &out->ldr_flip, &scores, err);
    if (ok)
        out->values[IRB_COMPARE_ldr_flip] = scores.mean;
    irb_flip_reference_destroy(a);
    irb_flip_reference_destroy(b);
    return ok;
}

static bool score_displayed(struct irb_comparison *out, const struct irb_image *test,
                            const struct irb_image *reference, int threads, struct irb_error *err)
{
    struct irb_displayed a = {0}, b = {0};
    bool ok = irb_display(test, out->exposure, &a, err) &&
              irb_display(reference, out->exposure, &b, err) &&
              irb_displayed_difference(&a, &b, &out->displayed_difference, err) &&
              irb_ssim(&a.luma, &b.luma, NULL, &out->ssim, &out->values[IRB_COMPARE_ssim], err) &&
              score_ldr_flip(out, &a.linear, &b.linear, threads, err);
    irb_displayed_destroy(&a);
    irb_displayed_destroy(&b);
    return ok;
}

bool irb_compare(struct irb_comparison *out, const struct irb_image *test,
                 const struct irb_image *reference, bool display_referred, int threads,
                 struct irb_error *err)
{
    *out = (struct irb_comparison){0};
    for (int i = 0; i < IRB_COMPARE_COUNT; i++)
        out->values[i] = NAN;
    if (test->channels != 3 || reference->channels != 3)
        return irb_fail(err, IRB_E_INTERNAL, "compare: expected 3 channels, found %d and %d",
                        test->channels, reference->channels);
    if (test->width != reference->width || test->height != reference->height)
        return irb_fail(err, IRB_E_INPUT,
                        "the images differ in size: %d x %d and, for the reference, %d x %d",
                        test->width, test->height, reference->width, reference->height);
    out->exposure = display_referred ? 0 : irb_exposure_of(reference, NULL);
    bool ok = score_values(out, test, reference, err) &&
              score_hdr_flip(out, test, reference, threads, err) &&
              score_displayed(out, test, reference, threads, err);
    if (!ok)
        irb_comparison_destroy(out);
    return ok;
}

void irb_comparison_destroy(struct irb_comparison *comparison)
{
    irb_image_destroy(&comparison->difference);
    irb_image_destroy(&comparison->relmse);
    irb_image_destroy(&comparison->flip);
    irb_image_destroy(&comparison->ldr_flip);
    irb_image_destroy(&comparison->ssim);
    irb_image_destroy(&comparison->displayed_difference);
}
