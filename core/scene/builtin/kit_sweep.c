/* SPDX-License-Identifier: MIT */
#include "core/scene/builtin/kit.h"

#include "core/scene/vec.h"

/* Joints of a profile that turn by less than this are rounded in shading. */
#define SMOOTH_COSINE 0.766 /* cos 40 degrees */

static double radians(double degrees)
{
    return degrees * (M_PI / 180);
}

/* ---- Profiles ---- */

void kit_profile_point(struct kit_profile *profile, double a, double b)
{
    const double *last = profile->points[profile->count > 0 ? profile->count - 1 : 0];

    if (profile->count >= KIT_PROFILE_POINTS ||
        (profile->count > 0 && hypot(last[0] - a, last[1] - b) < 1e-9))
        return; /* a joint that is there already */
    profile->points[profile->count][0] = a;
    profile->points[profile->count++][1] = b;
}

void kit_profile_arc(struct kit_profile *profile, double a, double b, double radius_a,
                     double radius_b, double from, double to, int segments)
{
    for (int i = 0; i <= segments; i++) {
        double t = radians(from + (to - from) * i / segments);

        kit_profile_point(profile, a + radius_a * cos(t), b + radius_b * sin(t));
    }
}

struct kit_profile kit_bar(double a0, double a1, double b0, double b1)
{
    return (struct kit_profile){5, {{a0, b0}, {a1, b0}, {a1, b1}, {a0, b1}, {a0, b0}}};
}

/* Unit normal of the segment from point i on, to the right of the way along it. */
static void segment_normal(const struct kit_profile *profile, int i, double out[2])
{
    double a = profile->points[i + 1][0] - profile->points[i][0];
    double b = profile->points[i + 1][1] - profile->points[i][1];
    double length = hypot(a, b);

    out[0] = b / length;
    out[1] = -a / length;
}

/* The normal at one end of segment i: shared with the segment beyond where the joint is flat. */
static void end_normal(const struct kit_profile *profile, int i, int end, double out[2])
{
    bool closed = hypot(profile->points[0][0] - profile->points[profile->count - 1][0],
                        profile->points[0][1] - profile->points[profile->count - 1][1]) < 1e-9;
    int segments = profile->count - 1, other = end ? i + 1 : i - 1;
    double own[2], beyond[2];

    segment_normal(profile, i, own);
    out[0] = own[0];
    out[1] = own[1];
    if (closed)
        other = (other + segments) % segments;
    if (other < 0 || other >= segments)
        return;
    segment_normal(profile, other, beyond);
    if (own[0] * beyond[0] + own[1] * beyond[1] < SMOOTH_COSINE)
        return;
    out[0] += beyond[0];
    out[1] += beyond[1];
}

/* ---- Sweeps ---- */

static uint32_t section_vertex(const struct kit *kit, const struct kit_section *section,
                               const double point[2], const double normal[2], double u, double v)
{
    double p[3], n[3];

    for (int i = 0; i < 3; i++) {
        p[i] = section->origin[i] + point[0] * section->a[i] + point[1] * section->b[i];
        n[i] = normal[0] * section->a[i] + normal[1] * section->b[i];
    }
    return kit_vertex(kit, p, n, u, v);
}

/* Metres between the two sections at a point of the profile, for texture coordinates. */
static double way_between(const struct kit_section *from, const struct kit_section *to,
                          const double point[2])
{
    double d[3];

    for (int i = 0; i < 3; i++)
        d[i] = to->origin[i] - from->origin[i] + point[0] * (to->a[i] - from->a[i]) +
               point[1] * (to->b[i] - from->b[i]);
    return vec_length(d);
}

/* The strip that one segment of the profile sweeps; `height` is the way along the profile to it. */
static double sweep_segment(const struct kit *kit, const struct kit_profile *profile, int segment,
                            const struct kit_section *sections, int count, double height)
{
    const double *p = profile->points[segment], *q = profile->points[segment + 1];
    double normals[2][2], way = 0, next = height + hypot(q[0] - p[0], q[1] - p[1]);
    uint32_t before[2] = {0, 0};

    end_normal(profile, segment, 0, normals[0]);
    end_normal(profile, segment, 1, normals[1]);
    for (int i = 0; i < count; i++) {
        uint32_t v[2];

        if (i > 0)
            way += way_between(&sections[i - 1], &sections[i], p);
        v[0] = section_vertex(kit, &sections[i], p, normals[0], way, -height);
        v[1] = section_vertex(kit, &sections[i], q, normals[1], way, -next);
        if (i > 0) {
            kit_triangle(kit, before[0], v[0], v[1]);
            kit_triangle(kit, before[0], v[1], before[1]);
        }
        before[0] = v[0];
        before[1] = v[1];
    }
    return next;
}

void kit_sweep(const struct kit *kit, const struct kit_profile *profile,
               const struct kit_section *sections, int count)
{
    double height = 0;

    for (int i = 0; i + 1 < profile->count; i++)
        height = sweep_segment(kit, profile, i, sections, count, height);
}

enum { MAX_SECTIONS = 257 };

void kit_lathe(const struct kit *kit, const struct kit_profile *profile, double x, double z,
               double from, double to, int slices)
{
    struct kit_section sections[MAX_SECTIONS] = {0};
    bool closed = to - from == 360;

    slices = slices < MAX_SECTIONS ? slices : MAX_SECTIONS - 1;
    for (int i = 0; i <= slices; i++) {
        double t = radians(from + (to - from) * i / slices);

        sections[i] = (struct kit_section){{x, 0, z}, {cos(t), 0, sin(t)}, {0, 1, 0}};
    }
    if (closed) /* the same bits, so that nothing shows through the seam */
        sections[slices] = sections[0];
    kit_sweep(kit, profile, sections, slices + 1);
}

void kit_arch(const struct kit *kit, const struct kit_profile *profile, double x, double y,
              double radius_x, double radius_y, double from, double to, int segments)
{
    struct kit_section sections[MAX_SECTIONS] = {0};

    segments = segments < MAX_SECTIONS ? segments : MAX_SECTIONS - 1;
    for (int i = 0; i <= segments; i++) {
        double t = radians(from + (to - from) * i / segments);
        double out[3] = {cos(t) * radius_y, sin(t) * radius_x, 0};

        vec_normalize(out);
        sections[i] = (struct kit_section){
            {x + radius_x * cos(t), y + radius_y * sin(t), 0}, {out[0], out[1], 0}, {0, 0, 1}};
    }
    kit_sweep(kit, profile, sections, segments + 1);
}

void kit_moulding(const struct kit *kit, const struct kit_profile *profile, double x0, double x1)
{
    const struct kit_section sections[2] = {{{x0, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                                            {{x1, 0, 0}, {0, 0, 1}, {0, 1, 0}}};

    kit_sweep(kit, profile, sections, 2);
}
