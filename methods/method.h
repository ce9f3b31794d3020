/* SPDX-License-Identifier: MIT
 *
 * The contract of a method module: the one header that a method includes and a new method has to
 * satisfy. A method is one folder methods/<name>/, one line in methods/registry.c, and its shaders
 * under shaders/methods/<name>/. Built as a shared object that exports
 *
 *     const struct irb_method *irb_method_module(void);
 *
 * the same source is loaded with `irbench --module path.so`.
 *
 * A method gets the scene, the light, the camera, the G-buffer and the RSM of one frame and returns
 * indirect irradiance at the G-buffer's resolution. Albedo is applied afterwards, once, by the
 * core. It does not: see the reference or the scores, write files, or know another method.
 *
 * Units: metres, watts, W/sr, W/m2; linear RGB with Rec.709 primaries.
 */
#ifndef IRB_METHODS_METHOD_H
#define IRB_METHODS_METHOD_H

#include "core/base/option.h"
#include "core/frame/gbuffer.h"
#include "core/frame/rsm.h"
#include "core/gl/timer.h"

#define IRB_METHOD_ABI 3

/* What a method needs beyond the frame it is given. */
enum irb_method_needs {
    IRB_NEEDS_NOTHING = 0,
    IRB_NEEDS_HISTORY = 1 << 0,         /* keeps state from frame to frame */
    IRB_NEEDS_STATIC_GEOMETRY = 1 << 1, /* objects must not move or deform */
};

/* All of one frame's inputs; borrowed, valid during render_frame only. */
struct irb_frame_inputs {
    const struct irb_scene_gl *scene;
    const struct irb_light *light;
    const struct irb_camera *camera;
    const struct irb_gbuffer *gbuffer;
    const struct irb_rsm *rsm;
    int frame;               /* 0.. in the sequence; settle frames are negative */
    uint64_t seed;           /* of the sequence; the same in all its frames */
    const void *params;      /* the method's own parameter struct, as this frame has it */
    struct irb_timer *timer; /* begin/end with an index into `stages`; may be NULL */
    bool debug;              /* debug layers are wanted; else nobody looks at them, make none. All
                                other output is the same with and without. */
};

/* Of all frames of a run: what parameters may have to go with. */
struct irb_frame_sizes {
    int width, height;  /* of the images, pixels */
    int rsm_resolution; /* of the reflective shadow map, texels a side */
};

/* What a debug layer holds, which decides how it is stored and shown. */
enum irb_debug_kind {
    IRB_DEBUG_COLOUR,   /* display-referred RGB in [0,1]: as it is */
    IRB_DEBUG_RADIANCE, /* linear RGB (W/(m2 sr), W/m2): tone-mapped like the previews */
    IRB_DEBUG_SCALAR,   /* one number a texel (R32F; R32UI: a whole number, exact up to 2^24):
                           grey, from 0 to its largest finite value */
    IRB_DEBUG_DISTANCE, /* m, +Inf where there is nothing (R32F; R32UI: the float's bits): grey
                           likewise, what is not finite black */
};

enum { IRB_MAX_DEBUG_LAYERS = 16, IRB_MAX_STATISTICS = 16 };

struct irb_frame_output {
    const struct irb_texture *irradiance; /* RGBA32F, W/m2, G-buffer resolution; the method's */
    const struct irb_texture *radiance;   /* NULL, or W/(m2 sr) that is added as it is */
    /* For people, where inputs->debug asks for it: made outside all stages. */
    struct {
        const char *name; /* "cluster-map": at most 31 of A-Z, a-z, 0-9, '-' and '_', each once */
        const struct irb_texture *texture; /* the method's; of any size, an array's layers below one
                                              another. Of more than 16384 texels a side the core
                                              keeps every second one, every third one, ... */
        enum irb_debug_kind kind;
    } debug[IRB_MAX_DEBUG_LAYERS];
    int debug_count;
    /* Shares in [0,1] of light that the method leaves out, means of the channels; 0 where it leaves
     * out none, NaN where that is not measured. */
    double uncovered_flux; /* of the RSM's reflected flux: what no virtual light stands for */
    double
        clamped_light; /* of the indirect irradiance that there is without a clamp: what it takes */
    struct {
        const char *name; /* "vpls" */
        double value;
    } statistics[IRB_MAX_STATISTICS];
    int statistic_count;
};

/* Appends a number for the report. Where there is no room it is only counted, and the core refuses
 * the frame. */
static inline void irb_output_statistic(struct irb_frame_output *output, const char *name,
                                        double value)
{
    const int i = output->statistic_count++;
    if (i >= IRB_MAX_STATISTICS)
        return;
    output->statistics[i].name = name;
    output->statistics[i].value = value;
}

/* Appends a debug layer, likewise. */
static inline void irb_output_layer(struct irb_frame_output *output, const char *name,
                                    const struct irb_texture *texture, enum irb_debug_kind kind)
{
    const int i = output->debug_count++;
    if (i >= IRB_MAX_DEBUG_LAYERS)
        return;
    output->debug[i].name = name;
    output->debug[i].texture = texture;
    output->debug[i].kind = kind;
}

/* IRB_TIMED with the frame's timer. */
#define IRB_STAGE(ok, inputs, stage, call) IRB_TIMED(ok, (inputs)->timer, stage, call)

struct irb_method {
    int abi;                         /* IRB_METHOD_ABI */
    const char *name;                /* "rsm": config key and folder name */
    const char *title;               /* "Reflective shadow maps" */
    const char *citation;            /* authors, title, venue, year */
    const char *path_classes;        /* Heckbert's notation of what it adds, "LDDE" */
    size_t params_size;              /* of its parameter struct */
    const struct irb_option *params; /* ended by IRB_OPTION_END */
    const char *const *stages;       /* names for timing, NULL-terminated, at most 24;
                                        not gbuffer, rsm or direct, which the core times */

    /* What follows from the parameters, as one frame has them, each in its option's range. These
     * three are called where there is neither a state nor OpenGL. */
    /* Whether it models indirect visibility. Where not, its own claim is scored too: that frame
     * against the reference without visibility. NULL: never. */
    bool (*claims_visibility)(const void *params);
    /* enum irb_method_needs; a trial needs what any of its frames does. NULL: nothing. */
    unsigned (*needs)(const void *params);
    /* Whether the parameters go together, and with the sizes. Called when a config is read, for
     * every frame and every key of each trial, so that nothing is rendered before all are sound:
     * IRB_E_INPUT with what was expected and what was found. What only a driver can know is left
     * to render_frame. NULL: they always do. */
    bool (*check)(const void *params, const struct irb_frame_sizes *sizes, struct irb_error *err);

    /* State for one trial, for images of width x height. NULL on failure. A config may give
     * parameters keys over the sequence: `params` here and in begin_sequence are those of frame 0,
     * and every value that the option's range allows may come later. So what depends on a
     * parameter has the size of its range's maximum, or grows in render_frame before its stages
     * begin. */
    void *(*create)(struct irb_gl *gl, const struct irb_scene_gl *scene, int width, int height,
                    const void *params, struct irb_error *err);
    bool (*resize)(void *state, int width, int height, struct irb_error *err);
    /* Forgets all history. */
    bool (*begin_sequence)(void *state, const void *params, uint64_t seed, struct irb_error *err);
    bool (*render_frame)(void *state, const struct irb_frame_inputs *inputs,
                         struct irb_frame_output *output, struct irb_error *err);
    void (*destroy)(void *state);
};

typedef const struct irb_method *(*irb_method_module_fn)(void);

#endif
