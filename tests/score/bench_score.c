/* SPDX-License-Identifier: MIT
 *
 * What the two slowest metrics cost on one thread at 800 x 600: HDR-FLIP an exposure, of a test
 * image against a prepared reference (what every trial costs) and of the reference's preparation
 * (once a frame), and SSIM. Processor time, median of REPEATS, and the budget beside it. The exit
 * status does not depend on the times.
 *
 *     bench_score
 */
#include "core/base/hash.h"
#include "core/score/flip.h"
#include "core/score/metrics.h"
#include "core/score/ssim.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { WIDTH = 800, HEIGHT = 600, REPEATS = 5 };

static const double flip_budget = 0.5; /* s an exposure */
static const double ssim_budget = 0.3; /* s */

static void must(bool ok, const struct irb_error *err)
{
    if (ok)
        return;
    fprintf(stderr, "bench_score: %s\n", err->message);
    exit(irb_error_status(err->code));
}

/* Of one thread: others on the machine do not count. */
static double cpu_s(void)
{
    return (double)clock() / CLOCKS_PER_SEC;
}

/* Radiance over five decades, with edges and noise of relative size `noise`. */
static struct irb_image make_image(int channels, double noise, uint64_t seed)
{
    struct irb_error err;
    struct irb_image image;
    must(irb_image_create(&image, WIDTH, HEIGHT, channels, &err), &err);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            for (int c = 0; c < channels; c++) {
                double light = exp(4 * sin(0.01 * x) * cos(0.013 * y)) * (x / 50 % 2 ? 1 : 0.3);
                double z = (double)(irb_hash_mix(seed, (uint64_t)(y * WIDTH + x)) >> 11) * 0x1p-53;
                double value = light * (1 + noise * (z - 0.5)) * (c == 1 ? 0.8 : 1);
                irb_image_at(&image, x, y)[c] =
                    (float)(channels == 1 ? value / (1 + value) : value);
            }
    return image;
}

static double median(double *times)
{
    return irb_summarise(times, REPEATS).median;
}

static void bench_flip(void)
{
    struct irb_error err;
    struct irb_image reference = make_image(3, 0, 1), test = make_image(3, 0.2, 2);
    const struct irb_image *references[] = {&reference};
    struct irb_flip_exposures exposures;
    struct irb_flip_scores scores = {0};
    double preparing[REPEATS], comparing[REPEATS];
    if (!irb_flip_exposures_of(references, NULL, 1, &exposures))
        must(irb_fail(&err, IRB_E_INTERNAL, "a black image"), &err);
    for (int i = 0; i < REPEATS; i++) {
        double start = cpu_s();
        struct irb_flip_reference *prepared =
            irb_flip_reference_create(&reference, &exposures, IRB_FLIP_PPD, 1, &err);
        must(prepared != NULL, &err);
        preparing[i] = cpu_s() - start;
        start = cpu_s();
        must(irb_flip_hdr_prepared(&test, prepared, NULL, 1, NULL, &scores, &err), &err);
        comparing[i] = cpu_s() - start;
        irb_flip_reference_destroy(prepared);
    }
    printf("HDR-FLIP, %d x %d, one thread, %d exposures (mean %.4f):\n", WIDTH, HEIGHT,
           exposures.count, scores.mean);
    printf("  a test image        %6.3f s, %6.4f s an exposure (budget %g s)\n", median(comparing),
           median(comparing) / exposures.count, flip_budget);
    printf("  a reference         %6.3f s, %6.4f s an exposure\n", median(preparing),
           median(preparing) / exposures.count);
    irb_image_destroy(&test);
    irb_image_destroy(&reference);
}

static void bench_ssim(void)
{
    struct irb_error err;
    struct irb_image reference = make_image(1, 0, 1), test = make_image(1, 0.2, 2);
    double times[REPEATS], mean = 0;
    for (int i = 0; i < REPEATS; i++) {
        double start = cpu_s();
        must(irb_ssim(&test, &reference, NULL, NULL, &mean, &err), &err);
        times[i] = cpu_s() - start;
    }
    printf("SSIM, %d x %d, one thread (mean %.4f):\n", WIDTH, HEIGHT, mean);
    printf("  a test image        %6.3f s (budget %g s)\n", median(times), ssim_budget);
    irb_image_destroy(&test);
    irb_image_destroy(&reference);
}

int main(void)
{
    bench_flip();
    bench_ssim();
    return 0;
}
