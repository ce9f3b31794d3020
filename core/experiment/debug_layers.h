/* SPDX-License-Identifier: MIT
 *
 * The debug layers of a frame (methods/method.h), on their way from a method to the run folder.
 * Render stores them beside the frame file, since it is not known yet which frames are kept: those
 * of the image's size as its layers debug.NAME, all others in files of their own. Keep copies the
 * former to the kept image and makes a PNG of each; the frames that are not kept take theirs along.
 *
 * Does not: ask whether they are wanted. What is in a frame file is kept.
 */
#ifndef IRB_EXPERIMENT_DEBUG_LAYERS_H
#define IRB_EXPERIMENT_DEBUG_LAYERS_H

#include "core/experiment/paths.h"
#include "core/image/exr.h"
#include "methods/method.h"

enum { IRB_DEBUG_NAME_SIZE = 32 }; /* terminating zero included */

struct irb_debug_layer {
    char name[IRB_DEBUG_NAME_SIZE];
    enum irb_debug_kind kind;
    bool apart;             /* of another size than the frame: in a file of its own */
    struct irb_image image; /* 3 channels of COLOUR and RADIANCE, else 1; row 0 at the top */
};

struct irb_debug_layers {
    struct irb_debug_layer layers[IRB_MAX_DEBUG_LAYERS];
    int count;
};

/* Reads back what a method returned, of one that is longer than 16384 texels every k-th texel,
 * across and down, with the least k by which it is not. IRB_E_INPUT where its names or their number
 * are not what method.h asks for. On failure nothing is left. */
bool irb_debug_layers_read(struct irb_debug_layers *debug, const struct irb_frame_output *output,
                           struct irb_error *err);
void irb_debug_layers_destroy(struct irb_debug_layers *debug);

/* What an EXR file says of a frame's debug layers: how many there are and, of each, its kind, its
 * name and whether it is in the file. They are the attributes irbench:debug and irbench:debug_N. */
struct irb_debug_attributes {
    struct irb_exr_attribute list[IRB_MAX_DEBUG_LAYERS + 1];
    int count; /* 0 where there are no layers */
    char names[IRB_MAX_DEBUG_LAYERS + 1][24], values[IRB_MAX_DEBUG_LAYERS + 1][64];
};
void irb_debug_attributes(struct irb_debug_attributes *attributes,
                          const struct irb_debug_layers *debug);

/* Appends those of the frame's size as the layers debug.NAME to `layers`, which has room for
 * IRB_MAX_DEBUG_LAYERS more. Their names are in `names`. Returns how many. */
typedef char irb_debug_layer_name[IRB_DEBUG_NAME_SIZE + 8];
int irb_debug_layers_append(const struct irb_debug_layers *debug, struct irb_exr_layer *layers,
                            irb_debug_layer_name names[IRB_MAX_DEBUG_LAYERS]);

/* Writes the files of their own, debug-NAME-0003.exr, with the given provenance. */
bool irb_debug_layers_save_apart(const struct irb_debug_layers *debug,
                                 const struct irb_frame_place *place,
                                 const struct irb_exr_attribute *attributes, int attribute_count,
                                 struct irb_error *err);
/* All layers of a frame, from its frame file and their own files; none is no error. */
bool irb_debug_layers_load(struct irb_debug_layers *debug, const struct irb_frame_place *place,
                           struct irb_error *err);
/* Removes the files of their own. */
void irb_debug_layers_remove_apart(const struct irb_frame_place *place);

/* The layer as its PNG shows it, sRGB in [0,1] with 1 or 3 channels. `exposure` is that of the
 * sequence's previews. *out is created. */
bool irb_debug_preview(const struct irb_debug_layer *layer, double exposure, struct irb_image *out,
                       struct irb_error *err);
/* debug-NAME-0003.png of each layer. */
bool irb_debug_layers_show(const struct irb_debug_layers *debug,
                           const struct irb_frame_place *place, double exposure,
                           struct irb_error *err);

#endif
