/* SPDX-License-Identifier: MIT
 *
 * Which pixels an invocation gathers for: TILE x TILE of them at once, so that what all pixels
 * share (a light, a sample's offset) is loaded once for all; on a software rasteriser that load is
 * much of the cost. Lanes lie side by side, an invocation's own pixels GROUP columns or rows apart.
 *
 * LIST 0: a grid, every scale-th pixel of the G-buffer; `target` is the grid's own image.
 * LIST 1: the pixels of a list; `target` is the image in full resolution.
 */
#define GROUP 8
#define PIXELS (TILE * TILE)
layout(local_size_x = GROUP, local_size_y = GROUP) in;

#if LIST
layout(std430, binding = 1) readonly buffer List { uint list[]; };        /* x | y << 16 */
layout(std430, binding = 2) readonly buffer Work { uvec3 groups; uint listed; };

/* Outside the image for invocations beyond the end. */
ivec2 target_of(int j)
{
    uint entry = (gl_WorkGroupID.x * uint(PIXELS) + uint(j)) * uint(GROUP * GROUP) +
                 gl_LocalInvocationIndex;
    uint pixel = list[min(entry, max(listed, 1u) - 1u)];
    return entry < listed ? ivec2(pixel & 0xffffu, pixel >> 16) : ivec2(-1);
}

ivec2 pixel_of(ivec2 target)
{
    return max(target, ivec2(0));
}
#else
uniform int scale;

ivec2 target_of(int j)
{
    return ivec2(gl_WorkGroupID.xy) * (GROUP * TILE) + ivec2(gl_LocalInvocationID.xy) +
           GROUP * ivec2(j % TILE, j / TILE);
}

ivec2 pixel_of(ivec2 target)
{
    return min(target * scale + scale / 2, gbuffer_size() - 1);
}
#endif
