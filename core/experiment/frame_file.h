/* SPDX-License-Identifier: MIT
 *
 * The files between render and score: what a method returned for one frame, the direct light that
 * all trials share, and the mask of pixels that are left out.
 */
#ifndef IRB_EXPERIMENT_FRAME_FILE_H
#define IRB_EXPERIMENT_FRAME_FILE_H

#include "core/config/config.h"
#include "core/experiment/debug_layers.h"
#include "core/frame/gbuffer.h"
#include "methods/method.h"

/* irradiance (RGB, W/m2) and, where the method has its own radiance, that too. */
struct irb_frame_file {
    struct irb_image irradiance;
    struct irb_image radiance; /* data NULL when there is none */
};

/* debug: empty where there are no layers. */
bool irb_frame_file_save(const char *path, const struct irb_frame_output *output,
                         const struct irb_debug_layers *debug, struct irb_error *err);
bool irb_frame_file_load(const char *path, struct irb_frame_file *file, struct irb_error *err);
void irb_frame_file_destroy(struct irb_frame_file *file);

/* What images say of where they are from: scene, trial, seed, frame and config. */
enum { IRB_FRAME_ATTRIBUTES = 5 };
struct irb_frame_provenance {
    struct irb_exr_attribute list[IRB_FRAME_ATTRIBUTES]; /* borrows all but these: */
    char seed[16], frame[16];
};
void irb_frame_provenance(struct irb_frame_provenance *out, const char *scene,
                          const struct irb_trial *trial, int frame,
                          const struct irb_key *config_key);

/* Single-layer helpers: direct light (RGB). */
bool irb_direct_file_save(const char *path, const struct irb_texture *radiance,
                          struct irb_error *err);
bool irb_direct_file_load(const char *path, struct irb_image *radiance, struct irb_error *err);

/* Pixels that two G-buffers see differently: 1 where position or normal differ by more than the
 * last bits that another driver may round differently (position: 1e-4 of the distance to the
 * camera; normal: 1 - cos > 1e-4). Created with 1 channel; *share is the part of the covered
 * pixels. */
bool irb_gbuffer_difference(const struct irb_gbuffer_image *a, const struct irb_gbuffer_image *b,
                            struct irb_image *difference, double *share, struct irb_error *err);

#endif
