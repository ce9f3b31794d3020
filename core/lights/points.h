/* SPDX-License-Identifier: MIT
 *
 * Point sets of a scene's surfaces, from which imperfect shadow maps are splatted (Ritschel et al.
 * 2008; thesis 3.2.4, 5.2). A point is a triangle and barycentric weights there, so it follows its
 * object's transform and animated vertices.
 *
 *     AREA          random triangles, each as likely as its area at rest, and a uniformly random
 *                   point on each (Ritschel et al. 2008); or as likely as weights of the caller's
 *                   (core/lights/point_need.h)
 *     TESSELLATION  algorithm 5.2 of the thesis over every triangle
 *
 * Points stand in the order of objects, and of triangles within them; those of one triangle in the
 * algorithm's order, or independent of one another (AREA). Point i of the whole set goes to shadow
 * map i mod N, so that AREA gives each map random points, and of every triangle as many as any
 * other map, up to one. Triangles without area have no points; points that an alpha mask cuts away
 * are left out.
 *
 * Algorithm 5.2 as it is printed: with the steps s_a = 1/(t_a + t_A), s_b and s_c alike, rows run
 * along edge c at gamma = 0, s_c, 2 s_c, ... <= 1. A row starts at alpha = 1 - gamma, beta = 0, and
 * while alpha > 0 takes a point, then lowers alpha by
 *     (1 - alpha) s_a + (1 - beta) s_b + (1 - gamma) s_c
 * and sets beta = 1 - alpha - gamma. For equal steps s that is 2 s everywhere (the three weights
 * sum to 2): points lie twice as far apart along a row as rows do, a triangle of factors f gets
 * about f^2 + f of them (f = 5: 30), and the row gamma = 1 none. The loops run on rounded numbers
 * and are kept as printed, in double precision: where a row would end exactly at alpha = 0,
 * rounding may leave 1e-17 and one more point, on edge a (f = 5: 34).
 */
#ifndef IRB_LIGHTS_POINTS_H
#define IRB_LIGHTS_POINTS_H

#include "core/frame/scene_gl.h"

enum irb_points_kind { IRB_POINTS_AREA, IRB_POINTS_TESSELLATION };

struct irb_points_desc {
    int kind;             /* enum irb_points_kind */
    int count;            /* AREA: points, >= 0 */
    uint64_t seed;        /* AREA */
    const float *weights; /* AREA: NULL, or borrowed until the points are made: a weight for each of
                             the scene's triangles, finite and >= 0, that stands for its area. The
                             k-th point of a triangle then lies at the same place of it whatever the
                             weights are, so that points stay where these change little */
    float f_min, f_max;   /* TESSELLATION: f[min,max] of eqs 5.3 and 5.4 */
    int smoothstep;       /* TESSELLATION: order of the polynomial, 3 or 5 */
    int64_t most_bytes;   /* bound on the points' memory; 0: IRB_POINTS_MOST_BYTES */
    int64_t chunk_bytes;  /* of one buffer; 0: IRB_POINTS_CHUNK_BYTES, which is the most */
};

/* The most that the built-in scenes take is atrium's 555 MiB at the thesis's f[16,64], 72.6 million
 * points in 9 chunks; tests hold it below 600 MiB. */
enum { IRB_POINTS_CHUNK_BYTES = 64 << 20, IRB_POINTS_MOST_BYTES = 1 << 30 };

struct irb_point {
    uint32_t triangle;
    uint16_t u, v; /* weights of corners 1 and 2 in 1/65535, u + v <= 65535 */
};

/* Points of one object: consecutive in the whole set. */
struct irb_points_run {
    int object;
    uint32_t first, count;
};

/* ---- Without OpenGL ---- */

/* A whole set in memory. */
struct irb_point_list {
    struct irb_point *points; /* owned */
    uint64_t count;
    struct irb_points_run *runs; /* owned; objects without points have none */
    int run_count;
    float *density; /* owned; points that each triangle has before alpha masks; AREA: is expected to
                       have, count * its share of the area or weights */
    double area;    /* of all objects at rest, m2 */
};

/* How many points the set will have, found without making them; before alpha masks. Above the
 * memory bound, IRB_E_MEMORY with an estimate of what it would take; IRB_E_INPUT for factors or
 * counts out of range. */
bool irb_points_count(const struct irb_scene *scene, const struct irb_points_desc *desc,
                      uint64_t *count, struct irb_error *err);
/* Fails as irb_points_count does. Same scene and desc, same points. A scene without area gives 0
 * points. */
bool irb_points_generate(const struct irb_scene *scene, const struct irb_points_desc *desc,
                         struct irb_point_list *list, struct irb_error *err);
void irb_point_list_destroy(struct irb_point_list *list); /* frees what it owns, zeroes it */

/* ---- In OpenGL ---- */

struct irb_points_chunk {
    struct irb_buffer *points; /* struct irb_point; at most IRB_POINTS_CHUNK_BYTES */
    unsigned texture;          /* the buffer as GL_RG32UI texels: triangle; u | v << 16 */
    uint32_t first, count;     /* index of its first point in the whole set; points */
};

struct irb_points {
    struct irb_gl *gl; /* borrowed */
    uint64_t count;
    double area; /* of all objects at rest, m2 */
    struct irb_points_chunk *chunks;
    int chunk_count;
    struct irb_points_run *runs;
    int run_count;
    struct irb_buffer *density;     /* float a triangle, as in struct irb_point_list */
    int64_t bytes;                  /* of all buffers */
    struct irb_points_desc made_by; /* without the weights */
    bool weighted;                  /* whether there were any */
};

/* The set of a scene at rest, generated on the CPU and uploaded chunk by chunk: at no time do CPU
 * and GPU hold more than one chunk twice. */
struct irb_points *irb_points_create(struct irb_gl *gl, const struct irb_scene_gl *scene,
                                     const struct irb_points_desc *desc, struct irb_error *err);
/* The same into *points, unless they are made so already; what was there is destroyed. Points with
 * weights are always made anew. */
bool irb_points_prepare(struct irb_points **points, struct irb_gl *gl,
                        const struct irb_scene_gl *scene, const struct irb_points_desc *desc,
                        struct irb_error *err);
void irb_points_destroy(struct irb_points *points);

#endif
