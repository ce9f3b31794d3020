/* SPDX-License-Identifier: MIT */
#include "core/score/profile.h"
#include "core/frame/composite.h"

#include <math.h>
#include <string.h>

void irb_row_change_add(double *rows, const struct irb_image *a, const struct irb_image *b)
{
    size_t values = (size_t)a->width * (size_t)a->channels;
    for (int y = 0; y < a->height; y++) {
        const float *p = irb_image_at(a, 0, y), *q = irb_image_at(b, 0, y);
        for (size_t i = 0; i < values; i++) {
            double change = fabs((double)q[i] - p[i]);
            rows[y] += isfinite(change) ? change : 0;
        }
    }
}

int irb_busiest_row(const double *rows, int height)
{
    int busiest = 0;
    for (int y = 1; y < height; y++)
        if (rows[y] > rows[busiest])
            busiest = y;
    return rows[busiest] > 0 ? busiest : height / 2;
}

void irb_profile_set(struct irb_image *profile, int to, const struct irb_image *image, int row)
{
    memcpy(irb_image_at(profile, 0, to), irb_image_at(image, 0, row),
           (size_t)image->width * (size_t)image->channels * sizeof(float));
}

/* Pixels that a frame's row is high in the picture. */
static int row_height(int frames)
{
    enum { WHOLE = 256, LEAST = 3, MOST = 16 };
    int height = WHOLE / frames;
    return height < LEAST ? LEAST : height > MOST ? MOST : height;
}

static bool place(struct irb_image *sheet, const struct irb_image *profile, double exposure,
                  int left, struct irb_error *err)
{
    struct irb_image shown = {0};
    if (!irb_tonemap(profile, exposure, &shown, err))
        return false;
    int repeat = row_height(profile->height);
    for (int y = 0; y < sheet->height; y++)
        memcpy(irb_image_at(sheet, left, y), irb_image_at(&shown, 0, y / repeat),
               3 * sizeof(float) * (size_t)shown.width);
    irb_image_destroy(&shown);
    return true;
}

bool irb_profile_sheet(const struct irb_image *result, const struct irb_image *reference,
                       double exposure, struct irb_image *sheet, struct irb_error *err)
{
    enum { GAP = 4 }; /* pixels between the two, as in the contact sheets */
    int width = result->width;
    if (!irb_image_create(sheet, 2 * width + GAP, result->height * row_height(result->height), 3,
                          err))
        return false;
    if (place(sheet, result, exposure, 0, err) &&
        place(sheet, reference, exposure, width + GAP, err))
        return true;
    irb_image_destroy(sheet);
    return false;
}
