/* SPDX-License-Identifier: MIT */
#include "core/score/display.h"

#include "core/score/flip_math.h"

#include <math.h>

static const float red = 0.2126f, green = 0.7152f, blue = 0.0722f; /* Rec.709 */
static const float bound = 1e30f; /* shown as white at every exposure that is of use */

/* IEC 61966-2-1; v in [0,1]. */
static inline float srgb_encode(float v)
{
    float power = 1.055f * irb_unit_power(v, 1 / 2.4f) - 0.055f;
    return v <= 0.0031308f ? 12.92f * v : power;
}

/* Reinhard on luminance: c e/(1 + Y e). Written so that infinite colours and luminances need no
 * branch: NaN is 0, large values are bounded. */
IRB_FLIP_WIDE
static void tonemap_row(const float *restrict rgb, int width, float exposure, float *restrict out)
{
    for (int x = 0; x < width; x++) {
        const float *p = rgb + 3 * x;
        float y = (red * p[0] + green * p[1] + blue * p[2]) * exposure;
        float white = y > 0 ? 1 + y : 1;
        for (int c = 0; c < 3; c++) {
            float v = p[c] > 0 ? p[c] : 0;
            float mapped = v * exposure / white;
            mapped = mapped < 1 ? mapped : 1; /* also inf/inf */
            out[3 * x + c] = v > 0 ? mapped : 0;
        }
    }
}

IRB_FLIP_WIDE
static void clamp_row(const float *restrict in, int count, float *restrict out)
{
    for (int i = 0; i < count; i++) {
        float v = in[i] > 0 ? in[i] : 0;
        out[i] = v < 1 ? v : 1;
    }
}

IRB_FLIP_WIDE
static void luma_row(const float *restrict linear, int width, float *restrict luma)
{
    for (int x = 0; x < width; x++)
        luma[x] = red * srgb_encode(linear[3 * x]) + green * srgb_encode(linear[3 * x + 1]) +
                  blue * srgb_encode(linear[3 * x + 2]);
}

bool irb_display(const struct irb_image *radiance, double exposure, struct irb_displayed *out,
                 struct irb_error *err)
{
    *out = (struct irb_displayed){0};
    int width = radiance->width, height = radiance->height;
    if (radiance->channels != 3)
        return irb_fail(err, IRB_E_INTERNAL, "display: expected 3 channels, found %d",
                        radiance->channels);
    if (!irb_image_create(&out->linear, width, height, 3, err) ||
        !irb_image_create(&out->luma, width, height, 1, err)) {
        irb_displayed_destroy(out);
        return false;
    }
    float gain = exposure < (double)bound ? (float)exposure : bound;
    for (int y = 0; y < height; y++) {
        float *linear = irb_image_at(&out->linear, 0, y);
        if (exposure > 0)
            tonemap_row(irb_image_at(radiance, 0, y), width, gain, linear);
        else
            clamp_row(irb_image_at(radiance, 0, y), 3 * width, linear);
        luma_row(linear, width, irb_image_at(&out->luma, 0, y));
    }
    return true;
}

void irb_displayed_destroy(struct irb_displayed *displayed)
{
    irb_image_destroy(&displayed->linear);
    irb_image_destroy(&displayed->luma);
}

bool irb_displayed_difference(const struct irb_displayed *a, const struct irb_displayed *b,
                              struct irb_image *out, struct irb_error *err)
{
    if (!irb_image_create(out, a->linear.width, a->linear.height, 3, err))
        return false;
    for (size_t i = 0; i < 3 * irb_image_pixels(out); i++)
        out->data[i] = fabsf(srgb_encode(a->linear.data[i]) - srgb_encode(b->linear.data[i]));
    return true;
}
