/* SPDX-License-Identifier: MIT
 *
 * Look-ups in convolution soft shadow maps.
 */
layout(local_size_x = 64) in;
#include "lights/csm_fetch.glsl"

struct query {
    vec4 q;        /* in the light's frame, m; w: map */
    vec4 settings; /* radius, m; kind: 0 visibility, 1 s_f, 2 z_avg; side, texels; z of the receiver */
};

uniform uint count;
layout(std430, binding = 0) readonly buffer Queries { query queries[]; };
layout(std430, binding = 1) writeonly buffer Answers { float answers[]; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= count)
        return;
    int map = int(queries[i].q.w), kind = int(queries[i].settings.y);
    vec3 q = queries[i].q.xyz;
    float z = queries[i].settings.w;
    if (kind == 0) {
        answers[i] = csm_visibility(map, q, queries[i].settings.x);
        return;
    }
    csm_place p = csm_place_of(map, normalize(q));
    csm_footprint f = csm_footprint_of(p, queries[i].settings.z);
    answers[i] = kind == 1 ? csm_lit(f, p.layer, z - csm_offset)
                           : csm_blocker(f, p.layer, z - csm_search_offset, z);
}
