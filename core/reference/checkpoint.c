/* SPDX-License-Identifier: MIT */
#include "core/reference/checkpoint.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct file_header {
    char magic[16];       /* names the format and its version */
    uint32_t byte_order;  /* 0x01020304 as the writer stores it */
    uint32_t state_bytes; /* of one tile */
    struct irb_key key;   /* of the job */
};

struct slot_header {
    struct checkpoint_tile tile;
    struct irb_key hash; /* of `tile` and the state */
};

static const char magic[16] = "irbench tiles 1";

static struct irb_key slot_hash(const struct checkpoint_tile *tile, const void *state, size_t size)
{
    struct irb_hash *hash = irb_hash_create();
    irb_hash_bytes(hash, tile, sizeof *tile);
    irb_hash_bytes(hash, state, size);
    return irb_hash_finish(hash);
}

static off_t slot_offset(const struct checkpoint *checkpoint, uint32_t tile, uint32_t parity)
{
    size_t slot = sizeof(struct slot_header) + checkpoint->state_bytes;
    return (off_t)(sizeof(struct file_header) + (2 * (size_t)tile + parity) * slot);
}

static bool write_all(int file, const void *data, size_t size, off_t offset)
{
    const char *bytes = data;
    while (size) {
        ssize_t n = pwrite(file, bytes, size, offset);
        if (n < 0 && errno == EINTR)
            continue;
        if (n <= 0)
            return false;
        bytes += n;
        offset += n;
        size -= (size_t)n;
    }
    return true;
}

static bool read_all(int file, void *data, size_t size, off_t offset)
{
    char *bytes = data;
    while (size) {
        ssize_t n = pread(file, bytes, size, offset);
        if (n < 0 && errno == EINTR)
            continue;
        if (n <= 0)
            return false;
        bytes += n;
        offset += n;
        size -= (size_t)n;
    }
    return true;
}

bool checkpoint_open(struct checkpoint *checkpoint, const char *path, const struct irb_key *key,
                     size_t state_bytes, struct irb_error *err)
{
    *checkpoint = (struct checkpoint){.file = -1, .state_bytes = state_bytes};
    if (!path)
        return true;
    checkpoint->file = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (checkpoint->file < 0)
        return irb_fail(err, IRB_E_IO, "%s: can't open the reference's checkpoint: %s", path,
                        strerror(errno));
    struct file_header expected, found;
    memset(&expected, 0, sizeof expected); /* padding included, as it is compared */
    memcpy(expected.magic, magic, sizeof magic);
    expected.byte_order = 0x01020304;
    expected.state_bytes = (uint32_t)state_bytes;
    expected.key = *key;
    if (read_all(checkpoint->file, &found, sizeof found, 0) &&
        !memcmp(&found, &expected, sizeof found))
        return true;
    if (ftruncate(checkpoint->file, 0) ||
        !write_all(checkpoint->file, &expected, sizeof expected, 0)) {
        irb_fail(err, IRB_E_IO, "%s: can't write the reference's checkpoint: %s", path,
                 strerror(errno));
        checkpoint_close(checkpoint);
        return false;
    }
    return true;
}

void checkpoint_close(struct checkpoint *checkpoint)
{
    if (checkpoint->file >= 0)
        close(checkpoint->file);
    checkpoint->file = -1;
}

/* One slot into header and state; false unless it is whole and of this tile. */
static bool read_slot(const struct checkpoint *checkpoint, uint32_t tile, uint32_t parity,
                      struct slot_header *header, void *state)
{
    off_t offset = slot_offset(checkpoint, tile, parity);
    if (!read_all(checkpoint->file, header, sizeof *header, offset) || header->tile.tile != tile ||
        header->tile.passes % 2 != parity ||
        !read_all(checkpoint->file, state, checkpoint->state_bytes, offset + (off_t)sizeof *header))
        return false;
    struct irb_key hash = slot_hash(&header->tile, state, checkpoint->state_bytes);
    return !memcmp(&hash, &header->hash, sizeof hash);
}

bool checkpoint_read(const struct checkpoint *checkpoint, struct checkpoint_tile *tile, void *state)
{
    if (checkpoint->file < 0)
        return false;
    void *buffer = malloc(checkpoint->state_bytes);
    bool found = false;
    for (uint32_t parity = 0; buffer && parity < 2; parity++) {
        struct slot_header header;
        if (!read_slot(checkpoint, tile->tile, parity, &header, buffer) ||
            (found && header.tile.passes <= tile->passes))
            continue;
        *tile = header.tile;
        memcpy(state, buffer, checkpoint->state_bytes);
        found = true;
    }
    free(buffer);
    return found;
}

bool checkpoint_write(const struct checkpoint *checkpoint, const struct checkpoint_tile *tile,
                      const void *state)
{
    if (checkpoint->file < 0)
        return true;
    struct slot_header header;
    memset(&header, 0, sizeof header);
    header.tile = *tile;
    header.hash = slot_hash(tile, state, checkpoint->state_bytes);
    off_t offset = slot_offset(checkpoint, tile->tile, tile->passes % 2);
    return write_all(checkpoint->file, &header, sizeof header, offset) &&
           write_all(checkpoint->file, state, checkpoint->state_bytes,
                     offset + (off_t)sizeof header);
}
