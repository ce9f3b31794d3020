/* SPDX-License-Identifier: MIT
 *
 * What reading and writing EXR share, private to core/image: a file in memory behind OpenEXRCore's
 * stream calls, the first error text that the library reports, and channel names.
 */
#ifndef IRB_IMAGE_EXR_STREAM_H
#define IRB_IMAGE_EXR_STREAM_H

#include "core/image/exr.h"

#include <openexr.h>
#include <stdint.h>

enum { IRB_EXR_NAME_SIZE = 256 }; /* of a channel's name, terminating zero included */

struct irb_exr_stream {
    unsigned char *data; /* owned; the whole file */
    uint64_t size, capacity;
    bool out_of_memory;
    char message[512]; /* the first error that the library reported; "" for none */
};

/* Context settings that use the stream (which must outlive the context). */
exr_context_initializer_t irb_exr_context_settings(struct irb_exr_stream *stream);

/* Fails with the library's own text for `result`, after `path`. */
bool irb_exr_fail(struct irb_error *err, enum irb_error_code code, const char *path,
                  const struct irb_exr_stream *stream, exr_result_t result);

/* "layer.S" or "S". False when it does not fit. */
bool irb_exr_channel_name(char out[IRB_EXR_NAME_SIZE], const char *layer, char suffix);

#endif
