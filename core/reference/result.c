/* SPDX-License-Identifier: MIT */
#include "core/reference/result.h"
#include "core/image/exr.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

enum { LAYERS = 7, COLOUR_LAYERS = 5, ATTRIBUTES = 6 };

/* The layers in the order of the struct. */
static void list_layers(const struct irb_reference_image *image, struct irb_exr_layer out[LAYERS])
{
    const struct irb_exr_layer layers[LAYERS] = {
        {"direct", "RGB", &image->direct},
        {"bounce1", "RGB", &image->bounce1},
        {"bounce2", "RGB", &image->bounce2},
        {"rest", "RGB", &image->rest},
        {"unoccluded", "RGB", &image->unoccluded},
        {"variance", "Y", &image->variance},
        {"unoccluded_variance", "Y", &image->unoccluded_variance},
    };
    for (int i = 0; i < LAYERS; i++)
        out[i] = layers[i];
}

static void list_images(struct irb_reference_image *image, struct irb_image *out[LAYERS])
{
    struct irb_image *images[LAYERS] = {&image->direct,
                                        &image->bounce1,
                                        &image->bounce2,
                                        &image->rest,
                                        &image->unoccluded,
                                        &image->variance,
                                        &image->unoccluded_variance};
    for (int i = 0; i < LAYERS; i++)
        out[i] = images[i];
}

bool irb_reference_image_create(struct irb_reference_image *image, int width, int height,
                                struct irb_error *err)
{
    struct irb_image *images[LAYERS];
    *image = (struct irb_reference_image){0};
    list_images(image, images);
    for (int i = 0; i < LAYERS; i++) {
        if (!irb_image_create(images[i], width, height, i < COLOUR_LAYERS ? 3 : 1, err)) {
            irb_reference_image_destroy(image);
            return false;
        }
    }
    return true;
}

void irb_reference_image_destroy(struct irb_reference_image *image)
{
    struct irb_image *images[LAYERS];
    list_images(image, images);
    for (int i = 0; i < LAYERS; i++)
        irb_image_destroy(images[i]);
    *image = (struct irb_reference_image){0};
}

bool irb_reference_image_save(const struct irb_reference_image *image, const char *path,
                              const char *key, struct irb_error *err)
{
    struct irb_exr_layer layers[LAYERS];
    list_layers(image, layers);
    char samples[32], noise[32], remainder[32], rays[32], seconds[32];
    snprintf(samples, sizeof samples, "%d", image->samples);
    snprintf(noise, sizeof noise, "%.17g", image->noise);
    snprintf(remainder, sizeof remainder, "%.17g", image->rest_remainder);
    snprintf(rays, sizeof rays, "%" PRIu64, image->rays);
    snprintf(seconds, sizeof seconds, "%.17g", image->seconds);
    const struct irb_exr_attribute attributes[ATTRIBUTES] = {
        {"irbench.samples", samples},          {"irbench.noise", noise},
        {"irbench.rest_remainder", remainder}, {"irbench.rays", rays},
        {"irbench.seconds", seconds},          {"irbench.key", key ? key : ""},
    };
    return irb_exr_write(path, layers, LAYERS, attributes, ATTRIBUTES, IRB_EXR_ZIP, err);
}

/* The whole text as a number; "inf" and "nan" count. */
static bool parse(const char *path, const struct irb_exr_value *value, double *out,
                  struct irb_error *err)
{
    char *end;
    *out = strtod(value->text, &end);
    if (end != value->text && !*end)
        return true;
    return irb_fail(err, IRB_E_INPUT, "%s: attribute '%s': expected a number, found '%s'", path,
                    value->name, value->text);
}

static bool load_attributes(struct irb_reference_image *image, const char *path,
                            struct irb_error *err)
{
    struct irb_exr_value values[] = {{"irbench.samples", ""},
                                     {"irbench.noise", ""},
                                     {"irbench.rest_remainder", ""},
                                     {"irbench.rays", ""},
                                     {"irbench.seconds", ""}};
    double samples, rays;
    if (!irb_exr_read_attributes(path, values, 5, err) || !parse(path, &values[0], &samples, err) ||
        !parse(path, &values[1], &image->noise, err) ||
        !parse(path, &values[2], &image->rest_remainder, err) ||
        !parse(path, &values[3], &rays, err) || !parse(path, &values[4], &image->seconds, err))
        return false;
    if (!(samples >= 1 && samples <= INT32_MAX && rays >= 0 && rays < 0x1p63))
        return irb_fail(err, IRB_E_INPUT, "%s: %g samples a pixel and %g rays make no reference",
                        path, samples, rays);
    image->samples = (int)samples;
    image->rays = (uint64_t)rays;
    return true;
}

bool irb_reference_image_load(struct irb_reference_image *image, const char *path,
                              struct irb_error *err)
{
    struct irb_exr_layer layers[LAYERS];
    struct irb_image loaded[LAYERS], *images[LAYERS];
    *image = (struct irb_reference_image){0};
    list_layers(image, layers);
    if (!irb_exr_read_layers(path, layers, loaded, LAYERS, err))
        return false;
    list_images(image, images);
    for (int i = 0; i < LAYERS; i++)
        *images[i] = loaded[i];
    if (load_attributes(image, path, err))
        return true;
    irb_reference_image_destroy(image);
    return false;
}
