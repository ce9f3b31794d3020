/* SPDX-License-Identifier: MIT */
#include "core/score/sheet.h"
#include "core/frame/composite.h"
#include "core/score/falsecolour.h"

#include <math.h>
#include <string.h>

enum { COLUMNS = 3, ROWS = 2, GAP = 4 /* pixels between the panels */ };

/* Copies an RGB panel to its place. */
static void place(struct irb_image *sheet, const struct irb_image *panel, int column, int row)
{
    int left = column * (panel->width + GAP), top = row * (panel->height + GAP);
    for (int y = 0; y < panel->height; y++)
        memcpy(irb_image_at(sheet, left, top + y), irb_image_at(panel, 0, y),
               3 * sizeof(float) * (size_t)panel->width);
}

static bool place_radiance(struct irb_image *sheet, const struct irb_image *radiance,
                           double exposure, int column, int row, struct irb_error *err)
{
    struct irb_image panel = {0};
    if (!irb_tonemap(radiance, exposure, &panel, err))
        return false;
    place(sheet, &panel, column, row);
    irb_image_destroy(&panel);
    return true;
}

/* Mean over the channels of (test - reference), in units of `scale`, to [-1, 1]. */
static bool signed_error(const struct irb_image *test, const struct irb_image *reference,
                         double scale, struct irb_image *out, struct irb_error *err)
{
    if (!irb_image_create(out, test->width, test->height, 1, err))
        return false;
    for (size_t i = 0; i < irb_image_pixels(out); i++) {
        double difference = 0;
        for (size_t c = 0; c < 3; c++)
            difference += ((double)test->data[3 * i + c] - reference->data[3 * i + c]) / 3;
        out->data[i] = (float)(scale > 0 ? difference / scale : 0);
    }
    return true;
}

static bool place_errors(struct irb_image *sheet, const struct irb_sheet_inputs *in,
                         struct irb_error *err)
{
    struct irb_image difference = {0}, panel = {0};
    bool ok =
        signed_error(in->indirect, in->reference_indirect, in->mean_indirect, &difference, err) &&
        irb_falsecolour_signed(&difference, 1, &panel, err);
    if (ok)
        place(sheet, &panel, 2, 0);
    irb_image_destroy(&panel);
    irb_image_destroy(&difference);
    ok = ok && irb_falsecolour(in->flip_indirect, 1, &panel, err);
    if (ok)
        place(sheet, &panel, 2, 1);
    irb_image_destroy(&panel);
    return ok;
}

bool irb_sheet_make(const struct irb_sheet_inputs *inputs, struct irb_image *sheet,
                    struct irb_error *err)
{
    int width = inputs->full->width, height = inputs->full->height;
    if (!irb_image_create(sheet, COLUMNS * (width + GAP) - GAP, ROWS * (height + GAP) - GAP, 3,
                          err))
        return false;
    return place_radiance(sheet, inputs->full, inputs->exposure, 0, 0, err) &&
           place_radiance(sheet, inputs->reference_full, inputs->exposure, 1, 0, err) &&
           place_radiance(sheet, inputs->indirect, inputs->exposure, 0, 1, err) &&
           place_radiance(sheet, inputs->reference_indirect, inputs->exposure, 1, 1, err) &&
           place_errors(sheet, inputs, err);
}
