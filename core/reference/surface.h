/* SPDX-License-Identifier: MIT
 *
 * Private to the room: the scene's surfaces as the integrator reads them at a hit, one packed
 * record a triangle, in world space with the objects' transforms applied.
 */
#ifndef IRB_REFERENCE_SURFACE_H
#define IRB_REFERENCE_SURFACE_H

#include "core/reference/vec3.h"
#include "core/scene/scene.h"

/* Offset of a ray's origin along the geometric normal, as a share of the largest coordinate and of
 * the scene's diagonal. Coordinates and hits carry errors of some 2^-23 of these; 2^-18 is 32 times
 * that (ours; tests/reference covers scenes of millimetres, kilometres and far from the origin). */
#define SURFACE_OFFSET 0x1p-18f

/* One cache line. */
struct surface_triangle {
    struct vec3 vertex[3];
    struct vec3 geometric; /* unit normal of the winding; 0 where degenerate */
    struct vec3 diffuse;   /* k_d without texture */
    int detail;            /* index into details, -1: flat and without texture */
};
enum { SURFACE_TRIANGLE_ALIGNMENT = sizeof(struct surface_triangle) };

/* What only curved or textured triangles need. */
struct surface_detail {
    struct vec3 normal[3];
    float texcoord[3][2];
    int texture;        /* -1: none */
    float alpha_cutoff; /* 0: opaque */
};

struct surface_texture {
    int width, height;
    unsigned char *rgba; /* owned copy */
};

struct surface_set {
    struct surface_triangle *triangles; /* owned, like all below */
    struct surface_detail *details;
    struct surface_texture *textures;
    uint32_t triangle_count;
    int texture_count;
    float srgb[256];    /* decoded 8-bit values */
    bool masked;        /* some triangle has an alpha mask */
    float offset;       /* SURFACE_OFFSET times the scene's diagonal, metres */
    struct irb_key key; /* of all that is traced */
};

bool surface_set_create(struct surface_set *set, const struct irb_scene *scene,
                        struct irb_error *err);
void surface_set_destroy(struct surface_set *set);
struct vec3 surface_texture_sample(const struct surface_set *set, int texture, float u, float v);

/* Whether triangle `index` has an alpha mask, and whether that leaves the point (u, v) of it. */
bool surface_is_masked(const struct surface_set *set, uint32_t index);
bool surface_is_there(const struct surface_set *set, uint32_t index, float u, float v);

/* A point of a surface, on the side that a ray sees. */
struct surface_point {
    struct vec3 position;
    struct vec3 origin;    /* where rays from it start: off the surface, on that side */
    struct vec3 geometric; /* unit, on that side */
    struct vec3 shading;   /* unit, on that side */
    struct vec3 diffuse;   /* k_d */
};

static inline struct vec3 surface_offset(const struct surface_set *set, struct vec3 position,
                                         struct vec3 geometric)
{
    float distance = SURFACE_OFFSET * v3_max_abs(position) + set->offset;
    return v3_mad(position, distance, geometric);
}

/* Shading normal and albedo of a curved or textured triangle. */
static inline void surface_detail_at(const struct surface_set *set,
                                     const struct surface_triangle *triangle, float u, float v,
                                     struct surface_point *point)
{
    const struct surface_detail *d = &set->details[triangle->detail];
    float w = 1 - u - v;
    struct vec3 n = v3_scale(d->normal[0], w);
    n = v3_normalize_safe(v3_mad(v3_mad(n, u, d->normal[1]), v, d->normal[2]));
    float side = v3_dot(n, point->geometric);
    if (side != 0)
        point->shading = side < 0 ? v3_scale(n, -1) : n;
    if (d->texture >= 0) {
        float s = w * d->texcoord[0][0] + u * d->texcoord[1][0] + v * d->texcoord[2][0];
        float t = w * d->texcoord[0][1] + u * d->texcoord[1][1] + v * d->texcoord[2][1];
        point->diffuse = v3_mul(point->diffuse, surface_texture_sample(set, d->texture, s, t));
    }
}

/* Position, albedo and the winding's normal, without side, of a point of a triangle. */
static inline void surface_load(const struct surface_set *set, uint32_t index, float u, float v,
                                struct surface_point *point)
{
    const struct surface_triangle *triangle = &set->triangles[index];
    struct vec3 position = v3_scale(triangle->vertex[0], 1 - u - v);
    position = v3_mad(position, u, triangle->vertex[1]);
    point->position = v3_mad(position, v, triangle->vertex[2]);
    point->geometric = triangle->geometric;
    point->diffuse = triangle->diffuse;
}

/* Turns the geometric normal against `direction`, and sets the origin of rays. */
static inline void surface_face(float offset, struct vec3 direction, struct surface_point *point)
{
    float side = copysignf(1, -v3_dot(point->geometric, direction));
    point->geometric = v3_scale(point->geometric, side);
    float distance = SURFACE_OFFSET * v3_max_abs(point->position) + offset;
    point->origin = v3_mad(point->position, distance, point->geometric);
}

/* The point with barycentrics (u, v) of a triangle, on the side that faces against `direction`. */
static inline void surface_at(const struct surface_set *set, uint32_t index, float u, float v,
                              struct vec3 direction, struct surface_point *point)
{
    surface_load(set, index, u, v, point);
    surface_face(set->offset, direction, point);
    point->shading = point->geometric;
    if (set->triangles[index].detail >= 0)
        surface_detail_at(set, &set->triangles[index], u, v, point);
}

#endif
