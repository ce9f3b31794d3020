/* SPDX-License-Identifier: MIT
 *
 * Basis images of the first map (lights/csm.glsl) as colours; out of summed-area tables they come
 * by differences.
 */
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2DArray images;
uniform int pairs;  /* layers of plain basis images a face */
uniform int tables; /* 1: `images` are summed-area tables */
layout(rgba32f, binding = 0) writeonly uniform image2DArray picture;

vec4 value(ivec2 at, int layer)
{
    return any(lessThan(at, ivec2(0))) ? vec4(0.0) : texelFetch(images, ivec3(at, layer), 0);
}

void main()
{
    ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at.xy, imageSize(picture).xy)))
        return;
    int layer = at.z / pairs * (1 + 2 * pairs) + 1 + at.z % pairs;
    vec4 basis = value(at.xy, layer);
    if (tables != 0)
        basis += value(at.xy - 1, layer) - value(at.xy - ivec2(1, 0), layer) -
                 value(at.xy - ivec2(0, 1), layer);
    imageStore(picture, at, clamp(0.5 + 0.5 * basis, 0.0, 1.0));
}
