/* SPDX-License-Identifier: MIT
 *
 * In a build without tinygltf.
 */
#include "core/scene/gltf/gltf.h"

#include "core/base/error.h"

const struct irb_gltf *irb_gltf_parse(const void *data, size_t size, bool binary,
                                      const char *folder, struct irb_error *err)
{
    (void)data;
    (void)size;
    (void)binary;
    (void)folder;
    irb_fail(err, IRB_E_USAGE,
             "this build cannot read glTF files (configure with -Dimages=enabled and tinygltf)");
    return NULL;
}

void irb_gltf_destroy(const struct irb_gltf *gltf)
{
    (void)gltf;
}
