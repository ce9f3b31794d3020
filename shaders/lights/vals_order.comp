/* SPDX-License-Identifier: MIT
 *
 * VPLs by tile, then VAL, then number: each finds its place by counting those of its tile that come
 * before it. Tile t has the VPLs l with l mod tiles = t (core/frame/interleave.h). Dark ones come
 * last, as of VAL -1.
 */
layout(local_size_x = 64) in;
#include "lights/virtual_light.glsl"
#include "lights/vals_tiles.glsl"

layout(std430, binding = 0) readonly buffer Vpls { vec4 vpls[]; };
#include "lights/vals_lit.glsl"
layout(std430, binding = 2) readonly buffer Assignment { uint assignment[]; };
layout(std430, binding = 4) writeonly buffer Ordered { vec4 ordered[]; };

uniform int vpl_count, tiles;

void main()
{
    int l = int(gl_GlobalInvocationID.x);
    if (l >= vpl_count)
        return;
    int tile = l % tiles, place = first_of_tile(tile, vpl_count, tiles);
    uint val = assignment[l];
    for (int other = tile; other < vpl_count; other += tiles)
        place += assignment[other] < val || (assignment[other] == val && other < l) ? 1 : 0;
    ordered[VPL_VECTORS * place] = vpls[VPL_VECTORS * l];
    ordered[VPL_VECTORS * place + 1] = vec4(vpls[VPL_VECTORS * l + 1].xyz, val == NO_VAL ? -1.0 : float(val));
    ordered[VPL_VECTORS * place + 2] = vpls[VPL_VECTORS * l + 2];
}
