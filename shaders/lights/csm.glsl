/* SPDX-License-Identifier: MIT
 *
 * Layout of the basis images of convolution soft shadow maps (core/lights/csm.h). CSM_ORDER is M.
 * A face of a map has CSM_LAYERS layers of RGBA:
 *
 *     0                      z; 0; 0; 0
 *     1 .. CSM_PAIRS         sin(c_k z), cos(c_k z), sin(c_(k+1) z), cos(c_(k+1) z), k = 1, 3, ..
 *     CSM_PAIRS + 1 ..       the same times z
 *
 * with c_k = pi (2k - 1) (thesis eq. 3.5); what an odd M leaves over is 0.
 */
#include "gl/constants.glsl"

#define CSM_PAIRS ((CSM_ORDER + 1) / 2)
#define CSM_LAYERS (1 + 2 * CSM_PAIRS)

/* (cos(pi x), sin(pi x)) is the first c_k; each next one turns by twice that. */
struct csm_phase {
    vec2 now, turn;
};

csm_phase csm_phase_of(float x)
{
    csm_phase p;
    p.now = vec2(cos(PI * x), sin(PI * x));
    p.turn = vec2(p.now.x * p.now.x - p.now.y * p.now.y, 2.0 * p.now.x * p.now.y);
    return p;
}

void csm_phase_next(inout csm_phase p)
{
    p.now = vec2(p.now.x * p.turn.x - p.now.y * p.turn.y, p.now.x * p.turn.y + p.now.y * p.turn.x);
}
