/* SPDX-License-Identifier: MIT
 *
 * Basis images of every map (Annen et al. 2007; thesis eq. 3.5), and the z-weighted ones (Annen et
 * al. 2008; thesis 3.2.5). z = distance times what csm_range.comp found, in [0, span]; where nothing
 * is, span.
 */
layout(local_size_x = 8, local_size_y = 8) in;
#include "lights/csm.glsl"

uniform sampler2DArray raster_maps; /* m; +Inf: nothing */
uniform int faces;                  /* of a map */
uniform float span;
layout(std430, binding = 0) readonly buffer Ranges { vec4 ranges[]; };
layout(rgba32f, binding = 0) writeonly uniform image2DArray images;

void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    int face = int(gl_WorkGroupID.z), layer = CSM_LAYERS * face;
    if (any(greaterThanEqual(at, textureSize(raster_maps, 0).xy)))
        return;
    float z = min(texelFetch(raster_maps, ivec3(at, face), 0).r * ranges[face / faces].x, span);
    csm_phase p = csm_phase_of(z);
    imageStore(images, ivec3(at, layer), vec4(z, 0.0, 0.0, 0.0));
    for (int i = 0; i < CSM_PAIRS; i++) {
        vec4 basis = vec4(p.now.yx, 0.0, 0.0);
        csm_phase_next(p);
        if (2 * i + 2 <= CSM_ORDER)
            basis.zw = p.now.yx;
        csm_phase_next(p);
        imageStore(images, ivec3(at, layer + 1 + i), basis);
        imageStore(images, ivec3(at, layer + 1 + CSM_PAIRS + i), basis * z);
    }
}
