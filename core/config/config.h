/* SPDX-License-Identifier: MIT
 *
 * An experiment: scenes with camera and light scripts, trials (a method with parameters), and how
 * to render, reference and score them. Read from YAML; every error names file, line and column,
 * and the nearest valid key.
 */
#ifndef IRB_CONFIG_CONFIG_H
#define IRB_CONFIG_CONFIG_H

#include "core/base/error.h"
#include "core/base/log.h"
#include "core/reference/reference.h"
#include "core/scene/animation.h"
#include "core/scene/pose.h"
#include "methods/registry.h"

/* Scalar settings at the top of a config and in its sections; declared as options. */
struct irb_render_settings {
    int width, height;  /* pixels: `resolution: [w, h]` */
    int frames;         /* scored frames */
    int settle;         /* unscored frames at the first pose (design: 16 for all methods) */
    int rsm_resolution; /* texels a side */
    int gbuffer_layout; /* enum irb_layout: what methods are given */
    int rsm_layout;     /* enum irb_layout: what methods are given */
    float exposure;     /* of previews, a factor on radiance; 0 = from the reference */
};
extern const struct irb_option irb_render_options[];

enum { IRB_MOST_RSM_RESOLUTION = 8192 };

/* Parameters that the core gives every trial beside its method's own; a method's own of the same
 * name takes their place. They don't change over the sequence. */
struct irb_trial_settings {
    int rsm_resolution; /* texels a side of the RSM that the method is given; 0: the config's */
};
extern const struct irb_option irb_trial_options[];

/* What is kept of a run beside its numbers. It changes none of them but gl_bytes, where a method
 * makes textures for it, and is not in the config's key. */
struct irb_output_settings {
    bool debug_layers; /* of kept frames, those of methods that have any */
    bool film;         /* small pictures of every frame */
};
extern const struct irb_option irb_output_options[];

/* A named box of the image that is scored on its own. */
struct irb_region {
    char *name;
    float box[4];   /* x0, y0 (upper left, inclusive), x1, y1 (exclusive) */
    bool fractions; /* of width and height; else pixels. All four at most 1 means fractions. */
};
enum { IRB_MOST_REGIONS = 16 }; /* of a scene */

struct irb_scene_entry {
    char *name;                       /* key in tables: the built-in's name or the file's stem */
    char *source;                     /* built-in name or path, ${VARIABLES} expanded */
    struct irb_animation animation;   /* from the config, else the built-in's view; no light or
                                         camera keys where the file's own are taken */
    char *light_name, *camera_name;   /* of the file's own; NULL = its first one */
    char *light_place, *camera_place; /* "FILE:LINE:COLUMN", for messages */
    struct irb_poses poses;           /* how objects move */
    struct irb_region *regions;       /* owned */
    int region_count;
    float profile; /* row of the profiles: pixels, or a fraction of the height between 0 and 1;
                      negative: none is named */
    char *profile_place; /* "FILE:LINE:COLUMN", for messages; NULL where none is named */
};

/* A parameter whose value changes over the sequence. Before its first key it has the first key's
 * value, behind its last key the last one's. */
enum irb_track_interpolation { IRB_TRACK_STEP, IRB_TRACK_LINEAR };
extern const char *const irb_track_interpolation_names[]; /* "step", "linear", NULL */
struct irb_track_key {
    int frame;    /* 0..; keys are in rising order */
    double value; /* bool 0/1, enum index */
};
struct irb_track {
    const struct irb_option *option;            /* one of the method's; borrowed */
    enum irb_track_interpolation interpolation; /* LINEAR of numbers only; INT is rounded */
    struct irb_track_key *keys;                 /* owned */
    int key_count;
};

struct irb_trial {
    const struct irb_method *method;
    void *params; /* the method's parameter struct, as frame 0 has it; owned */
    struct irb_trial_settings core;
    struct irb_track *tracks; /* of the parameters that change; owned */
    int track_count;
    char *name; /* "rsm:mode=importance:samples=400@0+100@8": only what differs from the defaults */
    char *place; /* "FILE:LINE:COLUMN", for messages; NULL of one that is in no file */
    /* Set by a run, which takes each trial of a config once for each seed: */
    int seed;
    char *folder; /* of its files, below the scene's: NAME, or NAME/seed-2 with several seeds */
};

enum {
    IRB_MOST_TRIALS = 1000, /* of a config; seeds and trials multiplied as well */
    IRB_MOST_SEEDS = 100,
    IRB_USUAL_SEEDS = 5, /* where a config says nothing */
    IRB_MOST_REPEATS = 100,
};

struct irb_config {
    char *path; /* where it was read */
    char *name; /* `name:`, else the file's stem */
    struct irb_render_settings render;
    struct irb_output_settings output;
    struct irb_reference_settings reference;
    int seeds[IRB_MOST_SEEDS]; /* every trial is run with each of them */
    int seed_count;
    int repeats; /* how often each seed is rendered: all but the first time for the times alone.
                    More of them can be added to a run, so they are not in the config's key */
    struct irb_scene_entry *scenes;
    int scene_count;
    struct irb_trial *trials;
    int trial_count;
};

/* `overrides`: NULL-terminated "key=value" strings of --set, dotted for sections
 * ("reference.noise=0.02"); they win over the file. */
bool irb_config_load(struct irb_config *config, const char *path, const char *const *overrides,
                     const struct irb_registry *registry, struct irb_error *err);
void irb_config_destroy(struct irb_config *config);

/* Parses "method:option=value:option=value" into a trial. A value may be "32@0+64@4": 32 from frame
 * 0 and 64 from frame 4 on; or "32@0..64@4": from 32 to 64 in a straight line. */
bool irb_trial_parse(struct irb_trial *trial, const char *text, const struct irb_registry *registry,
                     struct irb_error *err);
void irb_trial_destroy(struct irb_trial *trial);

/* The parameters of one frame, into the params_size bytes at `out`. Settle frames are negative and
 * have those of frame 0. */
void irb_trial_params(const struct irb_trial *trial, int frame, void *out);
/* Appends a parameter as irb_trial_parse reads it. */
void irb_trial_print(const struct irb_trial *trial, const struct irb_option *option,
                     struct irb_str *out);
/* Whether it has its default value in all frames. */
bool irb_trial_is_default(const struct irb_trial *trial, const struct irb_option *option);
/* The parameters of a trial in order: the method's, then the core's; NULL behind the last one. */
const struct irb_option *irb_trial_option(const struct irb_method *method, int index);
/* Its place in that order by name, -1 where there is none. */
int irb_trial_option_find(const struct irb_method *method, const char *name);
/* Whether it is one of the core's: these are said of a trial only where they are set. */
bool irb_trial_option_is_core(const struct irb_option *option);
/* Of the RSM that its method is given, texels a side. */
int irb_trial_rsm_resolution(const struct irb_trial *trial,
                             const struct irb_render_settings *render);
/* Whether it changes over the sequence. */
bool irb_trial_has_track(const struct irb_trial *trial, const struct irb_option *option);

/* What its method says of the parameters of one frame, and of all of `frames` frames together. */
bool irb_trial_claims_visibility(const struct irb_trial *trial, int frame);
unsigned irb_trial_needs(const struct irb_trial *trial, int frames); /* enum irb_method_needs */

/* The region in pixels of a width x height image: x0, y0, x1, y1, the last two exclusive. Fractions
 * are rounded to the nearest pixel edge. False where no pixel is in it or it leaves the image. */
bool irb_region_pixels(const struct irb_region *region, int width, int height, int box[4]);

/* The row of the scene's profiles in an image `height` pixels high; false where the config names
 * none, or none that is inside. */
bool irb_profile_row(const struct irb_scene_entry *entry, int height, int *row);

/* Hash of all that can change a result of the run. */
struct irb_key irb_config_key(const struct irb_config *config);

#endif
