/* SPDX-License-Identifier: MIT */
#include "core/experiment/frame_file.h"
#include "core/image/exr.h"

#include <math.h>
#include <stdio.h>

bool irb_frame_file_save(const char *path, const struct irb_frame_output *output,
                         const struct irb_debug_layers *debug, struct irb_error *err)
{
    enum { OWN = 2 };
    struct irb_image irradiance = {0}, radiance = {0};
    bool ok = irb_texture_read(output->irradiance, 3, &irradiance, err) &&
              (!output->radiance || irb_texture_read(output->radiance, 3, &radiance, err));
    struct irb_exr_layer layers[OWN + IRB_MAX_DEBUG_LAYERS] = {{"irradiance", "RGB", &irradiance},
                                                               {"radiance", "RGB", &radiance}};
    irb_debug_layer_name names[IRB_MAX_DEBUG_LAYERS];
    struct irb_debug_attributes attributes;
    int count = output->radiance ? 2 : 1;
    count += irb_debug_layers_append(debug, layers + count, names);
    irb_debug_attributes(&attributes, debug);
    ok = ok &&
         irb_exr_write(path, layers, count, attributes.list, attributes.count, IRB_EXR_NONE, err);
    irb_image_destroy(&irradiance);
    irb_image_destroy(&radiance);
    return ok;
}

bool irb_frame_file_load(const char *path, struct irb_frame_file *file, struct irb_error *err)
{
    *file = (struct irb_frame_file){0};
    if (!irb_exr_read(path, "irradiance", "RGB", &file->irradiance, err))
        return false;
    struct irb_error absent;
    irb_exr_read(path, "radiance", "RGB", &file->radiance, &absent);
    return true;
}

void irb_frame_provenance(struct irb_frame_provenance *out, const char *scene,
                          const struct irb_trial *trial, int frame,
                          const struct irb_key *config_key)
{
    snprintf(out->seed, sizeof out->seed, "%d", trial->seed);
    snprintf(out->frame, sizeof out->frame, "%d", frame);
    const struct irb_exr_attribute list[IRB_FRAME_ATTRIBUTES] = {
        {"irbench:scene", scene},
        {"irbench:trial", trial->name},
        {"irbench:seed", out->seed},
        {"irbench:frame", out->frame},
        {"irbench:config_key", config_key->hex},
    };
    for (int i = 0; i < IRB_FRAME_ATTRIBUTES; i++)
        out->list[i] = list[i];
}

void irb_frame_file_destroy(struct irb_frame_file *file)
{
    irb_image_destroy(&file->irradiance);
    irb_image_destroy(&file->radiance);
}

bool irb_direct_file_save(const char *path, const struct irb_texture *radiance,
                          struct irb_error *err)
{
    struct irb_image image = {0};
    if (!irb_texture_read(radiance, 3, &image, err))
        return false;
    struct irb_exr_layer layer = {"direct", "RGB", &image};
    bool ok = irb_exr_write(path, &layer, 1, NULL, 0, IRB_EXR_NONE, err);
    irb_image_destroy(&image);
    return ok;
}

bool irb_direct_file_load(const char *path, struct irb_image *radiance, struct irb_error *err)
{
    return irb_exr_read(path, "direct", "RGB", radiance, err);
}

static bool pixel_differs(const float *position_a, const float *normal_a, const float *position_b,
                          const float *normal_b)
{
    const float tolerance = 1e-4f; /* see the header */
    if ((position_a[3] > 0) != (position_b[3] > 0))
        return true;
    if (position_a[3] <= 0)
        return false;
    float apart = hypotf(hypotf(position_a[0] - position_b[0], position_a[1] - position_b[1]),
                         position_a[2] - position_b[2]);
    float cosine =
        normal_a[0] * normal_b[0] + normal_a[1] * normal_b[1] + normal_a[2] * normal_b[2];
    return !(apart <= tolerance * normal_a[3]) || !(1 - cosine <= tolerance);
}

bool irb_gbuffer_difference(const struct irb_gbuffer_image *a, const struct irb_gbuffer_image *b,
                            struct irb_image *difference, double *share, struct irb_error *err)
{
    if (a->width != b->width || a->height != b->height)
        return irb_fail(err, IRB_E_INTERNAL, "G-buffers differ in size: %dx%d and %dx%d", a->width,
                        a->height, b->width, b->height);
    if (!irb_image_create(difference, a->width, a->height, 1, err))
        return false;
    size_t covered = 0, differing = 0;
    for (size_t i = 0; i < irb_image_pixels(difference); i++) {
        covered += a->position.data[4 * i + 3] > 0 || b->position.data[4 * i + 3] > 0;
        if (pixel_differs(a->position.data + 4 * i, a->normal.data + 4 * i,
                          b->position.data + 4 * i, b->normal.data + 4 * i)) {
            difference->data[i] = 1;
            differing++;
        }
    }
    *share = covered ? (double)differing / (double)covered : 0;
    return true;
}
