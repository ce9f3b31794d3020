/* SPDX-License-Identifier: MIT
 *
 * The VALs that k-means came to: place, extent, flux and count of each, as a record.
 */
layout(local_size_x = 64) in;
#include "gl/constants.glsl"
#include "lights/virtual_light.glsl"
#include "lights/vals_statistics.glsl"

layout(std430, binding = 0) readonly buffer Vpls { vec4 vpls[]; };
layout(std430, binding = 1) writeonly buffer Vals { vec4 vals[]; };
layout(std430, binding = 2) readonly buffer Assignment { uint assignment[]; };
layout(std430, binding = 5) buffer Means { vec4 means[]; }; /* position, 1; normal, 0 */

uniform int vpl_count, val_count;
uniform int area_kind; /* 0 second moment, 1 farthest VPL */
uniform int stand;  /* of the map: 0 mean, 1 lifted, 2 the member nearest to the mean */

void main()
{
    int v = int(gl_GlobalInvocationID.x);
    if (v >= val_count)
        return;
    vec3 c = means[2 * v].xyz, n = means[2 * v + 1].xyz, member = c, flux = vec3(0.0);
    float count = 0.0, height = 0.0, moment = 0.0, farthest = 0.0, area = 0.0;
    float least = uintBitsToFloat(0x7f7fffffu); /* largest float */
    for (int l = 0; l < vpl_count; l++)
        if (assignment[l] == uint(v)) {
            vec3 x = vpls[VPL_VECTORS * l].xyz, d = x - c;
            float r2 = dot(d, d), own = vpls[VPL_VECTORS * l].w * (1.0 / PI); /* 0 of a point */
            float reach = sqrt(r2) + sqrt(own);
            moment += r2 + 0.5 * own;
            farthest = max(farthest, own > 0.0 ? reach * reach : r2);
            area = vpls[VPL_VECTORS * l].w;
            height = max(height, dot(n, d));
            member = r2 < least ? x : member;
            least = min(least, r2);
            flux += vpls[VPL_VECTORS * l + 2].xyz;
            count += 1.0;
        }
    float radius2 = area_kind == 0 ? 2.0 * moment / max(count, 1.0) : farthest;
    /* one VPL keeps its own area, whatever its mean is rounded to */
    area = count > 1.0 ? PI * radius2 : area;
    vals[VPL_VECTORS * v] = vec4(stand == 0 ? c : stand == 1 ? c + height * n : member, area);
    vals[VPL_VECTORS * v + 1] = count > 0.0 ? vec4(n, count) : vec4(0.0);
    vals[VPL_VECTORS * v + 2] = vec4(flux, 0.0);
    means[2 * v].w = count > 0.0 ? 1.0 : 0.0; /* who takes part in what starts from here */
    if (count > 0.0)
        atomicAdd(statistics.in_use, 1u);
}
