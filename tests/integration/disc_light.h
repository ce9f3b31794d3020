/* SPDX-License-Identifier: MIT
 *
 * Scenes of one blocker between a disc light and the floor, and the share of the light that points
 * of the floor see: by rays (Embree), and by what convolution soft shadow maps would give were
 * their shadow test exact. Include after compare.h.
 */
#ifndef IRB_TESTS_INTEGRATION_DISC_LIGHT_H
#define IRB_TESTS_INTEGRATION_DISC_LIGHT_H

#include "core/reference/tracer.h"
#include "tests/lights/raster_fixture.h"

/* The light looks down. Metres; the scene is away from the origin. */
static const double disc_at[3] = {1, 2.5, -0.5}, disc_radius = 0.4, disc_floor = 2;

/* (u, v) beside the light's axis, at `depth` below the light. */
static inline void disc_point(double u, double v, double depth, double out[3])
{
    out[0] = disc_at[0] + u;
    out[1] = disc_at[1] - depth;
    out[2] = disc_at[2] + v;
}

static inline void disc_sheet(struct irb_builder *builder, const double low[2],
                              const double high[2], double depth)
{
    double c[4][3];
    disc_point(low[0], high[1], depth, c[0]);
    disc_point(high[0], high[1], depth, c[1]);
    disc_point(high[0], low[1], depth, c[2]);
    disc_point(low[0], low[1], depth, c[3]);
    irb_builder_quad(builder, (const double(*)[3])c);
}

/* Radius 0.5 m, 1 m below the light; of 128 corners, which leave out 0.04 % of the area. */
static inline void disc_add_disc(struct irb_builder *builder)
{
    enum { CORNERS = 128 };
    for (int i = 0; i < CORNERS; i += 2) {
        double c[4][3];
        disc_point(0, 0, 1, c[0]);
        for (int k = 0; k < 3; k++) {
            const double angle = 2 * M_PI * (i + k) / CORNERS;
            disc_point(0.5 * cos(angle), 0.5 * sin(angle), 1, c[k + 1]);
        }
        irb_builder_quad(builder, (const double(*)[3])c);
    }
}

/* 1.4 x 1.4 x 0.1 m with a hole of 0.6 x 0.6 m. */
static inline void disc_add_slab(struct irb_builder *builder)
{
    static const double in = 0.3, out = 0.7, depth[2] = {0.9, 1.0};
    for (int side = 0; side < 2; side++) {
        disc_sheet(builder, (double[]){-out, -out}, (double[]){out, -in}, depth[side]);
        disc_sheet(builder, (double[]){-out, in}, (double[]){out, out}, depth[side]);
        disc_sheet(builder, (double[]){-out, -in}, (double[]){-in, in}, depth[side]);
        disc_sheet(builder, (double[]){in, -in}, (double[]){out, in}, depth[side]);
    }
    for (int wall = 0; wall < 8; wall++) {
        const double r = wall < 4 ? in : out, s = wall % 2 ? r : -r;
        double c[4][3];
        for (int k = 0; k < 4; k++) {
            const double t = k == 1 || k == 2 ? r : -r;
            disc_point(wall / 2 % 2 ? s : t, wall / 2 % 2 ? t : s, depth[k / 2], c[k]);
        }
        irb_builder_quad(builder, (const double(*)[3])c);
    }
}

/* Point of a (2,3) torus knot some 1.2 m wide, 1 m below the light. */
static inline void disc_knot(double t, double out[3])
{
    const double r = 0.2 * (2 + cos(3 * t));
    disc_point(r * cos(2 * t), r * sin(2 * t), 1 + 0.2 * sin(3 * t), out);
}

/* Corner `k` of the tube's ring at `t`: 0.07 m from the knot, round its chord. */
static inline void disc_tube(double t, double angle, double out[3])
{
    double p[3], q[3], along[3], side[3], up[3], length = 0;
    disc_knot(t, p);
    disc_knot(t + 1e-4, q);
    for (int i = 0; i < 3; i++)
        length += (q[i] - p[i]) * (q[i] - p[i]);
    for (int i = 0; i < 3; i++)
        along[i] = (q[i] - p[i]) / sqrt(length);
    const double flat = hypot(along[0], along[2]);
    side[0] = along[2] / flat;
    side[1] = 0;
    side[2] = -along[0] / flat;
    for (int i = 0; i < 3; i++)
        up[i] = along[(i + 1) % 3] * side[(i + 2) % 3] - along[(i + 2) % 3] * side[(i + 1) % 3];
    for (int i = 0; i < 3; i++)
        out[i] = p[i] + 0.07 * (cos(angle) * side[i] + sin(angle) * up[i]);
}

static inline void disc_add_knot(struct irb_builder *builder)
{
    enum { RINGS = 160, SIDES = 12 };
    for (int i = 0; i < RINGS; i++)
        for (int k = 0; k < SIDES; k++) {
            double c[4][3];
            for (int corner = 0; corner < 4; corner++)
                disc_tube(2 * M_PI * (i + corner / 2) / RINGS,
                          2 * M_PI * (k + (corner == 1 || corner == 2)) / SIDES, c[corner]);
            irb_builder_quad(builder, (const double(*)[3])c);
        }
}

/* Two half planes, the classical leak: a near one that ends at the axis, and one 0.5 m above the
 * floor that reaches farther, whose sharp shadow the near one's wide penumbra is laid over. */
static inline void disc_add_steps(struct irb_builder *builder)
{
    disc_sheet(builder, (double[]){-3, -3}, (double[]){0, 3}, 0.6);
    disc_sheet(builder, (double[]){-3, -3}, (double[]){0.5, 3}, 1.5);
}

enum disc_blocker { DISC_DISC, DISC_SLAB, DISC_KNOT, DISC_STEPS, DISC_BLOCKERS };
static const char *const disc_names[] = {"disc", "slab", "knot", "steps"};

static inline struct irb_scene *disc_scene(enum disc_blocker blocker)
{
    static void (*const add[])(struct irb_builder *) = {disc_add_disc, disc_add_slab, disc_add_knot,
                                                        disc_add_steps};
    struct irb_error err = {0};
    struct irb_builder builder;
    irb_builder_begin(&builder, disc_names[blocker]);
    irb_builder_object(&builder, "all",
                       irb_builder_material(&builder, "grey", (float[]){0.5f, 0.5f, 0.5f}));
    disc_sheet(&builder, (double[]){-3, -3}, (double[]){3, 3}, disc_floor);
    add[blocker](&builder);
    struct irb_scene *scene = irb_builder_finish(&builder, &err);
    REQUIRE_OK(scene);
    return scene;
}

/* Point of the unit disc for one of the unit square; areas keep their ratio (Shirley and Chiu
 * 1997). */
static inline void disc_concentric(double a, double b, double out[2])
{
    const double x = 2 * a - 1, y = 2 * b - 1;
    const bool wide = fabs(x) > fabs(y);
    const double r = wide ? x : y;
    const double angle = r == 0 ? 0 : wide ? M_PI / 4 * y / x : M_PI / 2 - M_PI / 4 * x / y;
    out[0] = r * cos(angle);
    out[1] = r * sin(angle);
}

/* Share of the light that the floor's (u, v) sees: a ray to each of RAYS cells of it. */
static inline double disc_seen(struct trace_context *context, double u, double v, uint64_t *random)
{
    enum { CELLS = 32, RAYS = CELLS * CELLS };
    struct trace_ray rays[RAYS];
    bool occluded[RAYS];
    double from[3], to[3], on[2];
    int seen = 0;
    disc_point(u, v, disc_floor - 1e-4, from);
    for (int i = 0; i < RAYS; i++) {
        disc_concentric((i % CELLS + fixture_random(random)) / CELLS,
                        (i / CELLS + fixture_random(random)) / CELLS, on);
        disc_point(disc_radius * on[0], disc_radius * on[1], 0, to);
        rays[i] =
            (struct trace_ray){.origin = v3((float)from[0], (float)from[1], (float)from[2]),
                               .direction = v3((float)(to[0] - from[0]), (float)(to[1] - from[1]),
                                               (float)(to[2] - from[2])),
                               .far = 1};
    }
    trace_occluded(context, rays, RAYS, occluded);
    for (int i = 0; i < RAYS; i++)
        seen += !occluded[i];
    return (double)seen / RAYS;
}

/* A paraboloid map that was read back; q: receiver in the light's frame. */
struct disc_map {
    const struct irb_image *image;
    int size;
};

/* Square of the map round q with the solid angle of a disc of radius w at q: as csm_fetch.glsl's
 * tables have it. */
static inline double disc_box(const struct disc_map *map, const double q[3], double w,
                              double box[4])
{
    const double r = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]), z = q[2] / r;
    const double angle = fmin(w * sqrt(z) / r, 1);
    const double side =
        fmin(fmax(sqrt(M_PI) * angle * map->size / 2 / (1 + z), 1), (double)map->size);
    for (int i = 0; i < 4; i++) {
        const double centre = (q[i % 2] / r / (1 + z) + 1) * map->size / 2;
        box[i] = fmin(fmax(centre + (i < 2 ? -0.5 : 0.5) * side, 0), map->size);
    }
    return side;
}

/* Share of the box that is not floor, and the mean distance of that. */
static inline double disc_search(const struct disc_map *map, const double box[4], double *mean)
{
    double cover = 0, all = 0;
    *mean = 0;
    for (int y = (int)box[1]; y < map->size && y < box[3]; y++)
        for (int x = (int)box[0]; x < map->size && x < box[2]; x++) {
            double d[3], distance;
            const double weight =
                (fmin(x + 1, box[2]) - fmax(x, box[0])) * (fmin(y + 1, box[3]) - fmax(y, box[1]));
            all += weight;
            distance = (double)map->image->data[(map->size - 1 - y) * map->size + x];
            if (!fixture_texel_direction(IRB_RASTER_PARABOLOID, map->size, 0, x, y, d) ||
                !isfinite(distance) || distance * d[2] > disc_floor - 0.01)
                continue;
            cover += weight;
            *mean += weight * distance;
        }
    *mean = cover > 0 ? *mean / cover : 0;
    return cover / all;
}

/* What the two look-ups and eq. 3.2 give with an exact test: the series of infinite order, to which
 * the floor never is a blocker. *blocker: distance, 0 for none. */
static inline double disc_model(const struct disc_map *map, const double q[3], double search_scale,
                                double *blocker, double *side)
{
    const double r = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]);
    double box[4], mean;
    *side = disc_box(map, q, search_scale * disc_radius, box);
    const double cover = disc_search(map, box, blocker);
    if (cover < 0.02) { /* CSM_LEAST_COVER */
        *blocker = 0;
        return 1;
    }
    const double w = disc_radius * (r - *blocker) / *blocker;
    disc_box(map, q, fmin(w, search_scale * disc_radius), box);
    return 1 - disc_search(map, box, &mean);
}

#endif
