/* SPDX-License-Identifier: MIT
 *
 * The ray-traced reference (Embree). It shades the points of a G-buffer that the core rendered, so
 * that a difference to a method is light transport and never rasterisation.
 *
 * Bounce 1 combines, by multiple importance sampling (balance heuristic), cosine-weighted
 * hemisphere samples with next-event estimation and light-subpath samples (points that the light
 * sees), both with exact visibility. Samples are Owen-scrambled Sobol points with a seed per pixel
 * that stays over a sequence. Results do not depend on the number of threads.
 *
 * Surfaces are two-sided: the geometric side that faces a ray is the side that is seen, the shading
 * normal is turned to that side, and light that arrives at the other side contributes nothing.
 * Bounces are diffuse (k_d). Alpha masks cut surfaces as they do in the G-buffer. A build without
 * Embree (-Dreference=disabled) has the options, the key and the files; tracing fails with
 * IRB_E_USAGE.
 *
 * Does not: filter textures by footprint (the finest level, bilinear, as nothing is minified by a
 * ray), or clamp anything.
 */
#ifndef IRB_REFERENCE_REFERENCE_H
#define IRB_REFERENCE_REFERENCE_H

#include "core/base/log.h"
#include "core/base/option.h"
#include "core/frame/gbuffer_image.h"
#include "core/scene/light.h"
#include "core/scene/scene.h"

#include <signal.h>

struct irb_reference_settings {
    int min_samples; /* samples a pixel before the noise target is looked at; rounded up to a power
                        of two, at least IRB_REFERENCE_BATCHES */
    int max_samples; /* the budget, rounded down to a power of two (but not below min_samples);
                        the number of samples doubles until the target or the budget is met */
    float noise;     /* target: standard error of bounce 1, root mean square over the image's
                        pixels, relative to the image's mean; 0 = always max_samples */
    int bounces;     /* last bounce of "rest", 1..16; 1 leaves bounce 2 and rest black */
    bool unoccluded; /* also render bounce 1 without visibility between bounce point and receiver */
    int seed;
};

/* Samples come in so many independently scrambled sequences, whose spread gives the variance: a
 * single low-discrepancy sequence says nothing about its own error. The variance of one pixel thus
 * has 3 degrees of freedom; means over pixels are what to rely on. */
enum { IRB_REFERENCE_BATCHES = 4 };

extern const struct irb_option irb_reference_options[];

/* What comes out, at the G-buffer's resolution. Irradiance is on the receiver, before its albedo;
 * W/m2. Each has 3 channels but for the two at the end, which have 1. */
struct irb_reference_image {
    struct irb_image direct;     /* direct radiance towards the eye, W/(m2 sr): Lambert + Blinn */
    struct irb_image bounce1;    /* irradiance after one diffuse bounce, exact visibility */
    struct irb_image bounce2;    /* after two */
    struct irb_image rest;       /* after 3..bounces */
    struct irb_image unoccluded; /* bounce 1 without visibility; all zero unless asked for. Each
                                    surface point that the light sees counts with the geometric
                                    cosine at that point; a method that takes the shading normal
                                    there differs where normals bend */
    struct irb_image variance;   /* of the mean of bounce1's luminance, (W/m2)^2 */
    struct irb_image unoccluded_variance; /* likewise */
    int samples;                          /* a pixel */
    double noise;                         /* reached: as settings.noise defines it */
    double rest_remainder; /* estimated irradiance beyond the last bounce (geometric series
                              through the later half), as a share of the mean of all bounces;
                              infinite where the series does not converge (albedo 1, closed),
                              NaN where bounces = 1 gives nothing to go by */
    uint64_t rays;         /* traced for it */
    double seconds;        /* of work, divided by the threads; of all runs of a resumed job */
};

void irb_reference_image_destroy(struct irb_reference_image *image);

/* Geometry for Embree, built once a scene (and again when objects move or deform). The scene may be
 * destroyed afterwards. */
struct irb_tracer;
struct irb_tracer *irb_tracer_create(const struct irb_scene *scene, struct irb_error *err);
void irb_tracer_destroy(struct irb_tracer *tracer);

struct irb_reference_job {
    const struct irb_tracer *tracer;
    const struct irb_light *light;
    const struct irb_camera *camera; /* for the specular part of direct light */
    const struct irb_gbuffer_image *gbuffer;
    const struct irb_reference_settings *settings;
    int threads;                       /* 0 = all cores */
    const char *checkpoint;            /* file that keeps finished tiles, or NULL. An interrupted
                                          job goes on from it and gives the same bits; a file of
                                          another job is overwritten. It stays after the end: the
                                          caller removes it once the result is saved */
    struct irb_log *log;               /* progress with time left; may be NULL */
    const volatile sig_atomic_t *stop; /* set by a signal handler: finish the tiles in flight, keep
                                          them and return IRB_E_INTERRUPTED; may be NULL */
};

/* IRB_E_INPUT: settings out of range or layers of different size; IRB_E_INTERRUPTED: job->stop;
 * IRB_E_IO: the checkpoint can't be opened; IRB_E_MEMORY. On failure *out is zeroed. */
bool irb_reference_render(const struct irb_reference_job *job, struct irb_reference_image *out,
                          struct irb_error *err);

/* One multi-layer EXR with the layers named as in the struct (RGB, variances Y); samples, noise,
 * rest_remainder, rays, seconds and key as string attributes "irbench.NAME". Load checks that all
 * are there; on failure *image is zeroed. */
bool irb_reference_image_save(const struct irb_reference_image *image, const char *path,
                              const char *key, struct irb_error *err);
bool irb_reference_image_load(struct irb_reference_image *image, const char *path,
                              struct irb_error *err);

/* Key of one frame's reference: scene content, light, camera, G-buffer content, settings, and the
 * version of the tracer. */
struct irb_key irb_reference_key(const struct irb_key *scene, const struct irb_light *light,
                                 const struct irb_camera *camera, const struct irb_key *gbuffer,
                                 const struct irb_reference_settings *settings);

#endif
