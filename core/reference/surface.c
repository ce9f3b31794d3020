/* SPDX-License-Identifier: MIT */
#include "core/reference/surface.h"

#include <stdlib.h>
#include <string.h>

/* Normals that differ from the triangle's by less (squared length) count as flat. */
static const float flat_tolerance = 1e-10f;

/* IEC 61966-2-1 */
static float srgb_decode(int value)
{
    double c = value / 255.0;
    return (float)(c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4));
}

static struct vec3 transform_point(const float m[16], struct vec3 p)
{
    return v3(m[0] * p.x + m[4] * p.y + m[8] * p.z + m[12],
              m[1] * p.x + m[5] * p.y + m[9] * p.z + m[13],
              m[2] * p.x + m[6] * p.y + m[10] * p.z + m[14]);
}

/* Normals go by the cofactors of the linear part: right for any scaling, defined where it is
 * singular. */
static struct vec3 transform_normal(const float m[16], struct vec3 n)
{
    struct vec3 a = v3_load(m), b = v3_load(m + 4), c = v3_load(m + 8);
    struct vec3 out = v3_scale(v3_cross(b, c), n.x);
    out = v3_mad(out, n.y, v3_cross(c, a));
    out = v3_mad(out, n.z, v3_cross(a, b));
    return v3_normalize_safe(out);
}

static bool is_flat(const struct surface_detail *detail, struct vec3 geometric)
{
    for (int i = 0; i < 3; i++) {
        struct vec3 n = detail->normal[i];
        struct vec3 difference =
            v3_sub(n, v3_dot(n, geometric) < 0 ? v3_scale(geometric, -1) : geometric);
        if (v3_dot(n, n) > 0 && v3_dot(difference, difference) > flat_tolerance)
            return false;
    }
    return true;
}

static void fill_triangle(struct surface_set *set, uint32_t index, const struct irb_scene *scene,
                          const struct irb_object *object, int *details)
{
    const uint32_t *corner = scene->indices + 3 * (size_t)index;
    const struct irb_material *material = &scene->materials[object->material];
    struct surface_triangle *t = &set->triangles[index];
    struct surface_detail *d = &set->details[*details];
    const float *positions = irb_scene_current_positions(scene);
    const float *normals = irb_scene_current_normals(scene);
    for (int i = 0; i < 3; i++) {
        struct vec3 p = v3_load(positions + 3 * (size_t)corner[i]);
        struct vec3 n = v3_load(normals + 3 * (size_t)corner[i]);
        t->vertex[i] = transform_point(object->transform, p);
        d->normal[i] = transform_normal(object->transform, n);
        memcpy(d->texcoord[i], scene->texcoords + 2 * (size_t)corner[i], sizeof d->texcoord[i]);
    }
    /* unit edges first: their product neither under- nor overflows */
    struct vec3 edge1 = v3_normalize_safe(v3_sub(t->vertex[1], t->vertex[0]));
    struct vec3 edge2 = v3_normalize_safe(v3_sub(t->vertex[2], t->vertex[0]));
    t->geometric = v3_normalize_safe(v3_cross(edge1, edge2));
    t->diffuse = v3_load(material->diffuse);
    d->texture = material->diffuse_texture;
    d->alpha_cutoff = material->alpha_cutoff;
    set->masked = set->masked || d->alpha_cutoff > 0;
    bool plain = d->texture < 0 && !(d->alpha_cutoff > 0) && is_flat(d, t->geometric);
    t->detail = plain ? -1 : (*details)++;
}

static bool copy_textures(struct surface_set *set, const struct irb_scene *scene)
{
    set->texture_count = scene->texture_count;
    set->textures = calloc((size_t)scene->texture_count + 1, sizeof *set->textures);
    for (int i = 0; set->textures && i < scene->texture_count; i++) {
        const struct irb_scene_texture *from = &scene->textures[i];
        size_t size = 4 * (size_t)from->width * (size_t)from->height;
        set->textures[i] = (struct surface_texture){from->width, from->height, malloc(size)};
        if (!set->textures[i].rgba)
            return false;
        memcpy(set->textures[i].rgba, from->rgba, size);
    }
    return set->textures != NULL;
}

static struct irb_key content_key(const struct surface_set *set, int details)
{
    struct irb_hash *hash = irb_hash_create();
    irb_hash_bytes(hash, set->triangles, set->triangle_count * sizeof *set->triangles);
    irb_hash_bytes(hash, set->details, (size_t)details * sizeof *set->details);
    for (int i = 0; i < set->texture_count; i++) {
        const struct surface_texture *t = &set->textures[i];
        irb_hash_u64(hash, (uint64_t)t->width);
        irb_hash_bytes(hash, t->rgba, 4 * (size_t)t->width * (size_t)t->height);
    }
    return irb_hash_finish(hash);
}

static float diagonal(const struct surface_set *set)
{
    struct vec3 low = v3(INFINITY, INFINITY, INFINITY), high = v3_scale(low, -1);
    for (uint32_t i = 0; i < set->triangle_count; i++) {
        for (int k = 0; k < 3; k++) {
            struct vec3 p = set->triangles[i].vertex[k];
            low = v3(fminf(low.x, p.x), fminf(low.y, p.y), fminf(low.z, p.z));
            high = v3(fmaxf(high.x, p.x), fmaxf(high.y, p.y), fmaxf(high.z, p.z));
        }
    }
    struct vec3 d = v3_sub(high, low);
    return hypotf(hypotf(d.x, d.y), d.z);
}

bool surface_set_create(struct surface_set *set, const struct irb_scene *scene,
                        struct irb_error *err)
{
    *set = (struct surface_set){.triangle_count = scene->triangle_count};
    if (!scene->triangle_count)
        return irb_fail(err, IRB_E_INPUT, "scene %s has no triangles", scene->name);
    size_t size = scene->triangle_count * sizeof *set->triangles;
    set->triangles = aligned_alloc(SURFACE_TRIANGLE_ALIGNMENT, size);
    /* one more, as fill_triangle writes before it knows whether the record is kept */
    set->details = calloc((size_t)scene->triangle_count + 1, sizeof *set->details);
    if (!set->triangles || !set->details || !copy_textures(set, scene)) {
        surface_set_destroy(set);
        return irb_fail(err, IRB_E_MEMORY, "no memory to trace %u triangles",
                        scene->triangle_count);
    }
    memset(set->triangles, 0, size); /* those of no object are points, which no ray hits */
    int details = 0;
    for (int i = 0; i < scene->object_count; i++) {
        const struct irb_object *object = &scene->objects[i];
        for (uint32_t k = 0; k < object->triangle_count; k++)
            fill_triangle(set, object->first_triangle + k, scene, object, &details);
    }
    for (int i = 0; i < 256; i++)
        set->srgb[i] = srgb_decode(i);
    set->offset = SURFACE_OFFSET * diagonal(set);
    set->key = content_key(set, details);
    return true;
}

void surface_set_destroy(struct surface_set *set)
{
    for (int i = 0; set->textures && i < set->texture_count; i++)
        free(set->textures[i].rgba);
    free(set->textures);
    free(set->details);
    free(set->triangles);
    *set = (struct surface_set){0};
}

static int wrap(int i, int size)
{
    i %= size;
    return i < 0 ? i + size : i;
}

/* The four texels round a point, wrapped, and their weights: bilinear between texel centres, as
 * OpenGL has it. Row 0 is v = 0. False where u or v is no number. */
static bool find_texels(const struct surface_texture *t, float u, float v,
                        const unsigned char *texels[4], float weights[4])
{
    u -= floorf(u);
    v -= floorf(v);
    if (!isfinite(u) || !isfinite(v))
        return false;
    float x = u * (float)t->width - 0.5f, y = v * (float)t->height - 0.5f;
    int x0 = (int)floorf(x), y0 = (int)floorf(y);
    float fx = x - (float)x0, fy = y - (float)y0;
    for (int k = 0; k < 4; k++) {
        int dx = k & 1, dy = k >> 1;
        texels[k] = t->rgba + 4 * ((size_t)wrap(y0 + dy, t->height) * (size_t)t->width +
                                   (size_t)wrap(x0 + dx, t->width));
        weights[k] = (dx ? fx : 1 - fx) * (dy ? fy : 1 - fy);
    }
    return true;
}

/* Decoded before it is filtered, as OpenGL does. */
struct vec3 surface_texture_sample(const struct surface_set *set, int texture, float u, float v)
{
    const unsigned char *texels[4];
    float weights[4];
    if (!find_texels(&set->textures[texture], u, v, texels, weights))
        return v3(1, 1, 1);
    struct vec3 sum = v3(0, 0, 0);
    for (int k = 0; k < 4; k++)
        sum = v3_mad(sum, weights[k],
                     v3(set->srgb[texels[k][0]], set->srgb[texels[k][1]], set->srgb[texels[k][2]]));
    return sum;
}

static const struct surface_detail *detail_of(const struct surface_set *set, uint32_t index)
{
    int detail = set->triangles[index].detail;
    return detail < 0 ? NULL : &set->details[detail];
}

bool surface_is_masked(const struct surface_set *set, uint32_t index)
{
    const struct surface_detail *d = detail_of(set, index);
    return d && d->alpha_cutoff > 0;
}

bool surface_is_there(const struct surface_set *set, uint32_t index, float u, float v)
{
    const struct surface_detail *d = detail_of(set, index);
    const unsigned char *texels[4];
    float weights[4], w = 1 - u - v, alpha = 0;
    if (!d || !(d->alpha_cutoff > 0))
        return true;
    if (d->texture < 0)
        return 1 >= d->alpha_cutoff;
    float s = w * d->texcoord[0][0] + u * d->texcoord[1][0] + v * d->texcoord[2][0];
    float t = w * d->texcoord[0][1] + u * d->texcoord[1][1] + v * d->texcoord[2][1];
    if (!find_texels(&set->textures[d->texture], s, t, texels, weights))
        return true;
    for (int k = 0; k < 4; k++)
        alpha += weights[k] * (float)texels[k][3] / 255;
    return alpha >= d->alpha_cutoff;
}
