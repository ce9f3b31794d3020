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
#include "core/reference/sample_map.h"
#include "core/sampling/sobol.h"

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
    double bounce1[3], bounce2[3], rest[3], unoccluded[3], tail[2];
};

struct sample_sets {
    struct irb_sobol_set light, bounce[MAX_BOUNCES];
    uint32_t roulette;
};

static inline void add(double sum[3], struct vec3 value)
{
    /* A value that is not finite comes from intensities near the end of float's range only; one
     * such sample must not take the pixel with it. */
    if (!(v3_max_abs(value) <= FLT_MAX))
        return;
    sum[0] += (double)value.x;
    sum[1] += (double)value.y;
    sum[2] += (double)value.z;
}

static inline void add_bounce(const struct estimator *e, struct batch_sums *sums, int bounce,
                              struct vec3 value)
{
    add(bounce == 1 ? sums->bounce1 : bounce == 2 ? sums->bounce2 : sums->rest, value);
    if (bounce >= e->bounces - 1 && v3_max_abs(value) <= FLT_MAX)
        sums->tail[bounce - e->bounces + 1] += (double)v3_luminance(value);
}

/* Whether the light reaches the point on its side, and then cos_g = g.l and cos_s = n.l. */
static inline bool lit_cosines(const struct surface_point *point,
                               const struct light_incident *incident, float *cos_g, float *cos_s)
{
    *cos_g = v3_dot(point->geometric, incident->to_light);
    *cos_s = v3_dot(point->shading, incident->to_light);
    return *cos_g > 0 && *cos_s > 0;
}

static inline bool light_blocked(struct estimator *e, const struct surface_point *point,
                                 const struct light_incident *incident)
{
    /* From the offset origin towards the light itself, or along the beam. */
    struct vec3 direction = incident->to_light;
    float distance = incident->distance;
    if (e->light->type == IRB_LIGHT_SPOT) {
        direction = v3_sub(e->light->position, point->origin);
        distance = sqrtf(v3_dot(direction, direction));
        if (!(distance > e->light->offset))
            return false;
        direction = v3_scale(direction, 1 / distance);
    }
    return trace_occluded(&e->trace, point->origin, direction, 0, distance - e->light->offset);
}

/* (a): L(y) pi at the end of a hemisphere ray, times the weight of (a) against (b). `geometry` is
 * p_a. Zero where the light does not reach y on this side. */
static inline struct vec3 gather_hit(struct estimator *e, const struct surface_point *y,
                                     float geometry, bool connected)
{
    struct light_incident incident;
    float cos_g, cos_s;
    if (e->light->dark || !light_source_incident(e->light, y->position, &incident) ||
        !lit_cosines(y, &incident, &cos_g, &cos_s) || light_blocked(e, y, &incident))
        return v3(0, 0, 0);
    float scale = incident.factor * cos_s;
    if (connected) /* p_a/(p_a + p_b), defined for p_a = 0 and infinity as well */
        scale /= 1 + incident.density * cos_g / geometry;
    return v3_scale(v3_mul(y->diffuse, e->light->intensity), scale);
}

static inline void sample_light(struct estimator *e, float u, float v, struct light_vertex *out)
{
    struct vec3 origin, direction;
    struct trace_hit hit;
    struct light_incident incident;
    float cos_g, cos_s;
    if (e->light->dark)
        return;
    light_source_emit(e->light, u, v, &origin, &direction);
    if (!trace_closest(&e->trace, origin, direction, e->light->offset, INFINITY, &hit))
        return;
    surface_at(e->trace.surfaces, hit.triangle, hit.u, hit.v, direction, &out->point);
    if (!light_source_incident(e->light, out->point.position, &incident) ||
        !lit_cosines(&out->point, &incident, &cos_g, &cos_s))
        return;
    out->radiance = v3_scale(v3_mul(out->point.diffuse, e->light->intensity),
                             INV_PI * incident.factor * cos_s);
    out->density = incident.density * cos_g;
    out->valid = true;
}

/* (b): G/(p_a + p_b) between x and the light's vertex; 0 where they do not face each other. */
static inline float connection(const struct surface_point *x, const struct light_vertex *y)
{
    struct vec3 w = v3_sub(y->point.position, x->position);
    float r2 = v3_dot(w, w), cos_x = v3_dot(x->shading, w), cos_y = -v3_dot(y->point.geometric, w);
    if (!(cos_x > 0 && cos_y > 0 && r2 > 0 && v3_dot(x->geometric, w) > 0))
        return 0;
    float g = (cos_x / r2) * (cos_y / r2);
    return 1 / (INV_PI + y->density / g);
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
        float p_a = INV_PI * cos_x * -v3_dot(y.geometric, direction) / (t * t);
        add(sums->unoccluded, gather_hit(e, &y, p_a, true));
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

/* (a) for bounce number `bounce`: extends the path by one ray and moves `x` to its end. False where
 * the path ends. */
static inline bool extend(struct estimator *e, struct surface_point *x, float u, float v,
                          struct vec3 throughput, int bounce, struct batch_sums *sums)
{
    struct vec3 direction;
    struct trace_hit hit;
    struct surface_point y;
    float cos_x = map_to_cosine(u, v, x->shading, &direction);
    if (!(v3_dot(direction, x->geometric) > 0) ||
        !trace_closest(&e->trace, x->origin, direction, 0, INFINITY, &hit))
        return false;
    surface_at(e->trace.surfaces, hit.triangle, hit.u, hit.v, direction, &y);
    float p_a = INV_PI * cos_x * -v3_dot(y.geometric, direction) / (hit.t * hit.t);
    struct vec3 value = v3_mul(throughput, gather_hit(e, &y, p_a, bounce <= CONNECTED_BOUNCES));
    add_bounce(e, sums, bounce, value);
    if (bounce == 1 && e->unoccluded) {
        add(sums->unoccluded, value);
        gather_behind(e, x, direction, cos_x, hit.t, sums);
    }
    *x = y;
    return true;
}

/* One path from `start` and one ray of the light; `mirrored` is the sample's index. */
static void add_sample(struct estimator *e, const struct surface_point *start,
                       const struct sample_sets *sets, uint32_t mirrored, struct batch_sums *sums)
{
    float u, v;
    struct light_vertex lit = {0};
    irb_sobol_2d_mirrored(&sets->light, mirrored, &u, &v);
    sample_light(e, u, v, &lit);
    struct surface_point x = *start;
    struct vec3 throughput = v3(1, 1, 1);
    for (int bounce = 1; bounce <= e->bounces; bounce++) {
        if (lit.valid && bounce <= CONNECTED_BOUNCES)
            connect(e, &x, &lit, throughput, bounce, sums);
        irb_sobol_2d_mirrored(&sets->bounce[bounce - 1], mirrored, &u, &v);
        if (!extend(e, &x, u, v, throughput, bounce, sums))
            return;
        throughput = v3_mul(throughput, x.diffuse);
        float survival = v3_max(x.diffuse);
        if (!(survival > 0))
            return;
        if (bounce > ROULETTE_BOUNCE && survival < 1) {
            uint32_t number = irb_hash_u32(sets->roulette + (uint32_t)bounce, mirrored);
            if (irb_unit_float(number) >= survival)
                return;
            throughput = v3_scale(throughput, 1 / survival);
        }
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
    for (uint32_t batch = 0; batch < IRB_REFERENCE_BATCHES; batch++) {
        struct sample_sets sets;
        struct batch_sums b = {0};
        seed_sets(&sets, irb_hash_mix(seed, batch), estimator->bounces);
        for (uint32_t i = first; i < last; i++)
            add_sample(estimator, point, &sets, irb_reverse_bits(i), &b);
        add_sums(sums->bounce1, b.bounce1);
        add_sums(sums->bounce2, b.bounce2);
        add_sums(sums->rest, b.rest);
        add_sums(sums->unoccluded, b.unoccluded);
        sums->bounce1_batch[batch] += (float)luminance(b.bounce1);
        sums->unoccluded_batch[batch] += (float)luminance(b.unoccluded);
        for (int i = 0; i < 2; i++)
            sums->tail[i] += (float)b.tail[i];
    }
}

struct vec3 estimator_direct(struct estimator *estimator, const struct surface_point *point,
                             struct vec3 specular, float exponent, struct vec3 eye)
{
    struct light_incident incident;
    float cos_g, cos_s;
    if (estimator->light->dark ||
        !light_source_incident(estimator->light, point->position, &incident) ||
        !lit_cosines(point, &incident, &cos_g, &cos_s) ||
        light_blocked(estimator, point, &incident))
        return v3(0, 0, 0);
    struct vec3 view = v3_normalize_safe(v3_sub(eye, point->position));
    struct vec3 half = v3_normalize_safe(v3_add(view, incident.to_light));
    float cos_h = v3_dot(point->shading, half);
    struct vec3 reflectance = v3_scale(point->diffuse, cos_s);
    if (cos_h > 0)
        reflectance = v3_mad(reflectance, powf(cos_h, exponent), specular);
    struct vec3 radiance = v3_mul(reflectance, estimator->light->intensity);
    return v3_scale(radiance, INV_PI * incident.factor);
}
