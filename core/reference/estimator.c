/* SPDX-License-Identifier: MIT
 *
 * E_1(x) = integral over the surfaces of  L(y) G(x,y) V(x,y) dA,
 *     L(y) = k_d(y)/pi E_0(y),  G = max(0, n_x.w) |g_y.w| / r^2,
 * with n_x the shading normal, g_y the geometric normal (it is what relates solid angle to area) and
 * E_0(y) the light's irradiance on y's shading normal. Two estimators of it, each with one sample:
 *   (a) a direction w with density cos/pi: density of y by area  p_a = G/pi;
 *   (b) a ray of the light: density of y by area  p_b = p_L |g_y.l| (p_L per perpendicular area).
 * The balance heuristic (Veach and Guibas 1995) gives both the same weighted contribution
 * L G V / (p_a + p_b), bounded by pi L as by the light's power. The same holds at any later vertex
 * of the path, where the density of the path up to it cancels.
 */
#include "core/reference/estimator.h"

#include <float.h>

#define INV_PI 0.31830988618379067154f

enum {
    /* Bounces that are also estimated by light-subpath samples: one more shadow ray each. Deeper
     * ones vary too little for it to pay (ours). */
    CONNECTED_BOUNCES = 2,
    /* Roulette ends paths after this bounce. */
    ROULETTE_BOUNCE = 4,
    MAX_HITS_ALONG_RAY = 4096, /* ends a gather that rounding keeps in place */
};

/* A ray between two points ends this share of its length early (ours: origins are off their
 * surfaces already). */
static const float shorten = 1 - 1e-5f;

/* Where a ray of the light lands. */
struct light_vertex {
    bool valid;
    struct surface_point point; /* on the lit side */
    struct vec3 radiance;       /* L(y), diffuse */
    float density;              /* p_b */
};

/* Sums of one batch. In double, as a batch may have a million samples. */
struct batch_sums {
    double bounce1[3], bounce2[3], rest[3], unoccluded[3];
};

struct sample_sets {
    struct irb_sobol_set light, bounce[MAX_BOUNCES];
    uint32_t roulette;
};

static inline void add(double sum[3], struct vec3 value)
{
    /* A value that is not finite comes from intensities near the end of float's range only; one
     * such sample must not take the pixel with it. */
    if (!(value.x + value.y + value.z <= FLT_MAX))
        return;
    sum[0] += (double)value.x;
    sum[1] += (double)value.y;
    sum[2] += (double)value.z;
}

static inline void add_bounce(struct estimator *e, struct batch_sums *sums, int bounce,
                              struct vec3 value)
{
    float luminance = v3_luminance(value);
    add(bounce == 1 ? sums->bounce1 : bounce == 2 ? sums->bounce2 : sums->rest, value);
    if (luminance <= FLT_MAX)
        e->luminance[bounce - 1] += (double)luminance;
}

static inline bool light_at(const struct estimator *e, const struct surface_point *point,
                            struct light_incident *incident)
{
    return light_source_incident(e->light, point->position, point->geometric, point->shading,
                                 incident);
}

/* From the offset origin towards the light itself, or along the beam. */
static inline bool light_blocked(struct estimator *e, const struct surface_point *point,
                                 const struct light_incident *incident)
{
    if (e->light->type == IRB_LIGHT_DIRECTIONAL)
        return trace_occluded(&e->trace, point->origin, incident->to_light, 0,
                              incident->distance - e->light->offset);
    return trace_occluded(&e->trace, point->origin, v3_sub(e->light->position, point->origin), 0,
                          1 - e->light->offset * incident->inverse_distance);
}

/* (a): L(y) pi at the end of a hemisphere ray, times the weight of (a) against (b); p_a =
 * cosines/(pi t^2). Zero where the light does not reach y on this side. */
static inline struct vec3 gather_hit(struct estimator *e, const struct surface_point *y,
                                     float cosines, float t, bool connected)
{
    struct light_incident incident;
    if (!light_at(e, y, &incident) || light_blocked(e, y, &incident))
        return v3(0, 0, 0);
    float scale = incident.factor * incident.cos_shading;
    if (connected) {
        float a = INV_PI * cosines, b = incident.density * incident.cos_geometric * t * t;
        scale *= a / (a + b);
    }
    return v3_scale(v3_mul(y->diffuse, e->light->intensity), scale);
}

static inline void sample_light(struct estimator *e, float u, float v, struct light_vertex *out)
{
    struct vec3 origin, direction;
    struct trace_hit hit;
    struct light_incident incident;
    light_source_emit(e->light, u, v, &origin, &direction);
    if (!trace_closest(&e->trace, origin, direction, e->light->offset, INFINITY, &hit))
        return;
    surface_at(e->trace.surfaces, hit.triangle, hit.u, hit.v, direction, &out->point);
    if (!light_at(e, &out->point, &incident))
        return;
    out->radiance = v3_scale(v3_mul(out->point.diffuse, e->light->intensity),
                             INV_PI * incident.factor * incident.cos_shading);
    out->density = incident.density * incident.cos_geometric;
    out->valid = true;
}

/* (b): G/(p_a + p_b) between x and the light's vertex; 0 where they do not face each other. */
static inline float connection(const struct surface_point *x, const struct light_vertex *y)
{
    struct vec3 w = v3_sub(y->point.position, x->position);
    float r2 = v3_dot(w, w), cos_x = v3_dot(x->shading, w), cos_y = -v3_dot(y->point.geometric, w);
    float g = cos_x * cos_y; /* G r^4 */
    if (!((cos_x > 0) & (cos_y > 0) & (v3_dot(x->geometric, w) > 0)))
        return 0;
    return g / (g * INV_PI + y->density * r2 * r2);
}

static inline bool connection_blocked(struct estimator *e, const struct surface_point *x,
                                      const struct light_vertex *y)
{
    struct vec3 w = v3_sub(y->point.origin, x->origin);
    return trace_occluded(&e->trace, x->origin, w, 0, shorten);
}

/* Every further hit along a ray from x, each seen as if nothing were before it. */
static void gather_behind(struct estimator *e, const struct surface_point *x, struct vec3 direction,
                          float cos_x, float t, struct batch_sums *sums)
{
    const struct surface_set *set = e->trace.surfaces;
    for (int i = 0; i < MAX_HITS_ALONG_RAY; i++) {
        struct trace_hit hit;
        struct surface_point y;
        float step = SURFACE_OFFSET * t + set->offset;
        if (!trace_closest(&e->trace, x->origin, direction, t + step, INFINITY, &hit))
            return;
        t = hit.t;
        surface_at(set, hit.triangle, hit.u, hit.v, direction, &y);
        float cosines = cos_x * -v3_dot(y.geometric, direction);
        add(sums->unoccluded, gather_hit(e, &y, cosines, t, true));
    }
}

/* (b) for bounce number `bounce` at the end `x` of a path. */
static inline void connect(struct estimator *e, const struct surface_point *x,
                           const struct light_vertex *lit, struct vec3 throughput, int bounce,
                           struct batch_sums *sums)
{
    float weight = connection(x, lit);
    if (!(weight > 0))
        return;
    struct vec3 value = v3_scale(v3_mul(throughput, lit->radiance), weight);
    if (bounce == 1 && e->unoccluded)
        add(sums->unoccluded, value);
    if (!connection_blocked(e, x, lit))
        add_bounce(e, sums, bounce, value);
}

/* The points of SAMPLE_BLOCK samples. */
struct sample_points {
    const struct sample_sets *sets;
    uint32_t first; /* index of the block's first sample */
    int bounces;    /* for which directions have been made */
    struct point_block light;
    struct point_block direction[MAX_BOUNCES];
};

/* A ray from the end of a path. */
struct path_ray {
    struct vec3 direction;
    float cosine; /* to the shading normal */
};

/* The ray of bounce number `bounce` from x. Most paths are short, so points are made for a bounce when
 * the block's first path gets there. */
static inline void choose_ray(const struct estimator *e, struct sample_points *points, int bounce,
                              int sample, const struct surface_point *x, struct path_ray *ray)
{
    struct point_block *b = &points->direction[bounce - 1];
    if (bounce > points->bounces) {
        points->bounces = bounce;
        e->makers.direction(&points->sets->bounce[bounce - 1], points->first, b);
    }
    struct vec3 s, t;
    v3_basis(x->shading, &s, &t);
    ray->cosine = b->z[sample];
    struct vec3 d = v3_mad(v3_scale(x->shading, ray->cosine), b->x[sample], s);
    ray->direction = v3_mad(d, b->y[sample], t);
}

/* Traces a path's next ray from x to y; false where it ends. */
static inline bool extend(struct estimator *e, const struct surface_point *x,
                          const struct path_ray *ray, float *t, struct surface_point *y)
{
    struct trace_hit hit;
    if (!(v3_dot(ray->direction, x->geometric) > 0) ||
        !trace_closest(&e->trace, x->origin, ray->direction, 0, INFINITY, &hit))
        return false;
    surface_at(e->trace.surfaces, hit.triangle, hit.u, hit.v, ray->direction, y);
    *t = hit.t;
    return true;
}

/* (a) for bounce number `bounce`, whose ray from x ended at y. */
static inline void gather(struct estimator *e, const struct surface_point *x,
                          const struct path_ray *ray, float t, const struct surface_point *y,
                          struct vec3 throughput, int bounce, struct batch_sums *sums)
{
    float cosines = ray->cosine * -v3_dot(y->geometric, ray->direction);
    struct vec3 value =
        v3_mul(throughput, gather_hit(e, y, cosines, t, bounce <= CONNECTED_BOUNCES));
    add_bounce(e, sums, bounce, value);
    if (bounce == 1 && e->unoccluded) {
        add(sums->unoccluded, value);
        gather_behind(e, x, ray->direction, ray->cosine, t, sums);
    }
}

/* Russian roulette: scales the throughput of a path that goes on, false where it ends. */
static inline bool survives(const struct sample_points *points, int bounce, int sample,
                            struct vec3 diffuse, struct vec3 *throughput)
{
    float survival = v3_max(diffuse);
    if (bounce <= ROULETTE_BOUNCE || survival >= 1)
        return survival > 0;
    uint32_t number = irb_hash_u32(points->sets->roulette + (uint32_t)bounce,
                                   points->first + (uint32_t)sample);
    if (irb_unit_float(number) >= survival)
        return false;
    *throughput = v3_scale(*throughput, 1 / survival);
    return true;
}

/* One path from `start` and one ray of the light. The path's next ray is chosen before the shadow
 * ray of its end, so that the processor overlaps the two computations. */
static void add_sample(struct estimator *e, const struct surface_point *start,
                       struct sample_points *points, int sample, struct batch_sums *sums)
{
    struct light_vertex lit = {0};
    struct surface_point path[2]; /* ends of the path, in turn */
    const struct surface_point *x = start;
    struct path_ray ray, next = {0};
    struct vec3 throughput = v3(1, 1, 1);
    choose_ray(e, points, 1, sample, start, &next);
    sample_light(e, points->light.x[sample], points->light.y[sample], &lit);
    for (int bounce = 1; bounce <= e->bounces; bounce++) {
        struct surface_point *y = &path[bounce & 1];
        float t;
        ray = next;
        if (lit.valid && bounce <= CONNECTED_BOUNCES)
            connect(e, x, &lit, throughput, bounce, sums);
        if (!extend(e, x, &ray, &t, y))
            return;
        if (bounce < e->bounces)
            choose_ray(e, points, bounce + 1, sample, y, &next);
        gather(e, x, &ray, t, y, throughput, bounce, sums);
        throughput = v3_mul(throughput, y->diffuse);
        if (!survives(points, bounce, sample, y->diffuse, &throughput))
            return;
        x = y;
    }
}

/* Samples first..last-1 of a batch. */
static void add_samples(struct estimator *e, const struct surface_point *point,
                        const struct sample_sets *sets, uint32_t first, uint32_t last,
                        struct batch_sums *sums)
{
    struct sample_points points;
    point_block_fn make_light =
        e->light->type == IRB_LIGHT_SPOT ? e->makers.disc : e->makers.square;
    points.sets = sets;
    for (points.first = first; points.first < last; points.first += SAMPLE_BLOCK) {
        uint32_t count = last - points.first;
        points.bounces = 0;
        make_light(&sets->light, points.first, &points.light);
        for (uint32_t i = 0; i < SAMPLE_BLOCK && i < count; i++)
            add_sample(e, point, &points, (int)i, sums);
    }
}

static void seed_sets(struct sample_sets *sets, uint64_t seed, int bounces)
{
    sets->light = irb_sobol_seed(seed, 0);
    for (int i = 0; i < bounces; i++)
        sets->bounce[i] = irb_sobol_seed(seed, 1 + (uint32_t)i);
    sets->roulette = irb_hash_u32((uint32_t)seed, 3 * (MAX_BOUNCES + 1));
}

static void add_sums(float out[3], const double sums[3])
{
    for (int c = 0; c < 3; c++)
        out[c] += (float)sums[c];
}

static double luminance(const double rgb[3])
{
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

void estimator_add(struct estimator *estimator, const struct surface_point *point, uint64_t seed,
                   uint32_t first, uint32_t last, struct point_layers *sums)
{
    if (estimator->light->dark)
        return;
    for (uint32_t batch = 0; batch < IRB_REFERENCE_BATCHES; batch++) {
        struct sample_sets sets;
        struct batch_sums b = {0};
        seed_sets(&sets, irb_hash_mix(seed, batch), estimator->bounces);
        add_samples(estimator, point, &sets, first, last, &b);
        add_sums(sums->bounce1, b.bounce1);
        add_sums(sums->bounce2, b.bounce2);
        add_sums(sums->rest, b.rest);
        add_sums(sums->unoccluded, b.unoccluded);
        sums->bounce1_batch[batch] += (float)luminance(b.bounce1);
        sums->unoccluded_batch[batch] += (float)luminance(b.unoccluded);
    }
}

struct vec3 estimator_direct(struct estimator *estimator, const struct surface_point *point,
                             struct vec3 specular, float exponent, struct vec3 eye)
{
    struct light_incident incident;
    if (estimator->light->dark || !light_at(estimator, point, &incident) ||
        light_blocked(estimator, point, &incident))
        return v3(0, 0, 0);
    struct vec3 view = v3_normalize_safe(v3_sub(eye, point->position));
    struct vec3 half = v3_normalize_safe(v3_add(view, incident.to_light));
    float cos_h = v3_dot(point->shading, half);
    struct vec3 reflectance = v3_scale(point->diffuse, incident.cos_shading);
    if (cos_h > 0)
        reflectance = v3_mad(reflectance, powf(cos_h, exponent), specular);
    struct vec3 radiance = v3_mul(reflectance, estimator->light->intensity);
    return v3_scale(radiance, INV_PI * incident.factor);
}
