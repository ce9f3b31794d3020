/* SPDX-License-Identifier: MIT
 *
 * Colour of FLIP (Andersson et al. 2020, sections 3 and 4.1). Private to core/score.
 *
 * YCxCz (Kolpatzik and Bouman 1992) is an affine map of X/Xn, Y/Yn, Z/Zn. The filters' weights sum
 * to 1, so they are applied to y = Y/Yn, cx = X/Xn - Y/Yn, cz = Y/Yn - Z/Zn, which differ from
 * (Y + 16)/116, Cx/500 and Cz/200 in nothing; the detectors want (Y + 16)/116 = y anyway.
 */
#ifndef IRB_SCORE_FLIP_COLOUR_H
#define IRB_SCORE_FLIP_COLOUR_H

#include "core/score/flip_math.h"

#include <math.h>

struct irb_opponent {
    float y, cx, cz;
};

struct irb_lab {
    float l, a, b;
};

/* Linear sRGB to X/Xn, Y/Yn, Z/Zn: primaries and D65 = (0.950428545, 1, 1.088900371) of
 * IEC 61966-2-1, so that rows sum to 1; and the inverse. */
static inline void irb_rgb_to_xyz(const float rgb[3], float xyz[3])
{
    xyz[0] = 0.433895389f * rgb[0] + 0.376242373f * rgb[1] + 0.189862239f * rgb[2];
    xyz[1] = 0.212636822f * rgb[0] + 0.715182982f * rgb[1] + 0.072180196f * rgb[2];
    xyz[2] = 0.017752423f * rgb[0] + 0.109465629f * rgb[1] + 0.872781948f * rgb[2];
}

static inline void irb_xyz_to_rgb(const float xyz[3], float rgb[3])
{
    rgb[0] = 3.080341988f * xyz[0] - 1.537398969f * xyz[1] - 0.542943019f * xyz[2];
    rgb[1] = -0.921178396f * xyz[0] + 1.875929984f * xyz[1] + 0.045248412f * xyz[2];
    rgb[2] = 0.052881293f * xyz[0] - 0.204011206f * xyz[1] + 1.151129913f * xyz[2];
}

static inline struct irb_opponent irb_rgb_to_opponent(const float rgb[3])
{
    float xyz[3];
    irb_rgb_to_xyz(rgb, xyz);
    return (struct irb_opponent){xyz[1], xyz[0] - xyz[1], xyz[1] - xyz[2]};
}

static inline float irb_unit(float v)
{
    return v < 0 ? 0 : v > 1 ? 1 : v;
}

/* CIE 15:2004, f of L*a*b*. */
static inline float irb_lab_f(float t)
{
    const float delta = 6.0f / 29;
    const float knee = delta * delta * delta;
    float root = irb_cube_root(t > knee ? t : knee);
    return t > knee ? root : t / (3 * delta * delta) + 4.0f / 29;
}

/* CIELab with the Hunt effect: chroma scaled by lightness / 100 (2020 paper, section 4.1). */
static inline struct irb_lab irb_xyz_to_hunt_lab(const float xyz[3])
{
    float fx = irb_lab_f(xyz[0]), fy = irb_lab_f(xyz[1]), fz = irb_lab_f(xyz[2]);
    float l = 116 * fy - 16, hunt = 0.01f * l;
    return (struct irb_lab){l, hunt * 500 * (fx - fy), hunt * 200 * (fy - fz)};
}

/* A filtered colour, brought back into the display's gamut. */
static inline struct irb_lab irb_opponent_to_hunt_lab(struct irb_opponent c)
{
    float xyz[3] = {c.cx + c.y, c.y, c.y - c.cz}, rgb[3];
    irb_xyz_to_rgb(xyz, rgb);
    for (int i = 0; i < 3; i++)
        rgb[i] = irb_unit(rgb[i]);
    irb_rgb_to_xyz(rgb, xyz);
    return irb_xyz_to_hunt_lab(xyz);
}

/* HyAB (Abasi et al. 2020): city block in lightness, Euclidean in chroma. */
static inline float irb_hyab(struct irb_lab p, struct irb_lab q)
{
    float a = p.a - q.a, b = p.b - q.b;
    return fabsf(p.l - q.l) + sqrtf(a * a + b * b);
}

#endif
