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
 *
 * A block of samples goes through each step together: their long chains of arithmetic then overlap
 * in the processor, rays are traced in tight loops, and which of them go on is decided by compaction
 * instead of branches that can't be predicted. Against one sample at a time this is a third faster.
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

/* A block of samples of one point: a path each, and a ray of the light each. */
struct block {
    const struct sample_sets *sets;
    const struct surface_point *start;
    struct batch_sums *sums;
    uint32_t first; /* index of the first sample */
    int count;
    int bounce; /* the one that is being computed, from 1 */
    /* a sample each: */
    struct surface_point end[SAMPLE_BLOCK]; /* of the path */
    struct vec3 throughput[SAMPLE_BLOCK];
    struct light_vertex light[SAMPLE_BLOCK];
    bool lit[SAMPLE_BLOCK]; /* whether light[] is there */
    /* samples whose path goes on */
    int active[SAMPLE_BLOCK], active_count;
};

/* Rays of a step, with what belongs to each. */
struct ray_queue {
    int count;
    struct trace_ray ray[SAMPLE_BLOCK];
    int sample[SAMPLE_BLOCK];
    float cosine[SAMPLE_BLOCK];      /* to the shading normal at the ray's origin */
    struct trace_hit hit[SAMPLE_BLOCK];
};

/* Shadow rays, with what is added where nothing is in the way. */
struct shadow_queue {
    int count;
    struct trace_ray ray[SAMPLE_BLOCK];
    struct vec3 value[SAMPLE_BLOCK];
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

static double luminance(const double rgb[3])
{
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

/* Traces the shadow rays and returns the sum of what gets through. */
static void sum_visible(struct estimator *e, const struct shadow_queue *queue, double sum[3])
{
    bool occluded[SAMPLE_BLOCK];
    trace_occluded(&e->trace, queue->ray, queue->count, occluded);
    for (int i = 0; i < queue->count; i++)
        add(sum, v3_scale(queue->value[i], occluded[i] ? 0 : 1));
}

/* Adds to the layer of the block's bounce. */
static void add_bounce(struct estimator *e, struct block *b, const double sum[3])
{
    double *layer = b->bounce == 1   ? b->sums->bounce1
                    : b->bounce == 2 ? b->sums->bounce2
                                     : b->sums->rest;
    for (int c = 0; c < 3; c++)
        layer[c] += sum[c];
    e->luminance[b->bounce - 1] += luminance(sum);
}

static inline bool light_at(const struct estimator *e, const struct surface_point *point,
                            struct light_incident *incident)
{
    return light_source_incident(e->light, point->position, point->geometric, point->shading,
                                 incident);
}

/* From the offset origin towards the light itself, or along the beam. */
static inline struct trace_ray light_ray(const struct light_source *light,
                                         const struct surface_point *point,
                                         const struct light_incident *incident)
{
    if (light->type == IRB_LIGHT_DIRECTIONAL)
        return (struct trace_ray){.origin = point->origin,
                                  .direction = incident->to_light,
                                  .far = incident->distance - light->offset};
    return (struct trace_ray){.origin = point->origin,
                              .direction = v3_sub(light->position, point->origin),
                              .far = 1 - light->offset * incident->inverse_distance};
}

/* (a): queues L(y) pi times the weight of (a) against (b), where the light may reach y on this side;
 * p_a = cosines/(pi t^2). */
static inline void queue_gather(const struct estimator *e, const struct surface_point *y,
                                float cosines, float t, bool connected, struct vec3 throughput,
                                struct shadow_queue *queue)
{
    struct light_incident incident;
    bool lit = light_at(e, y, &incident);
    float scale = incident.factor * incident.cos_shading;
    if (connected) {
        float a = INV_PI * cosines, b = incident.density * incident.cos_geometric * t * t;
        scale *= a / (a + b);
    }
    struct vec3 value = v3_mul(v3_mul(throughput, y->diffuse), e->light->intensity);
    queue->ray[queue->count] = light_ray(e->light, y, &incident);
    queue->value[queue->count] = v3_scale(value, scale);
    queue->count += lit;
}

/* Keeps the rays that hit something. */
static void compact_hits(struct ray_queue *queue)
{
    int kept = 0;
    for (int i = 0; i < queue->count; i++) {
        bool hit = queue->hit[i].triangle != TRACE_MISS;
        queue->ray[kept] = queue->ray[i];
        queue->sample[kept] = queue->sample[i];
        queue->cosine[kept] = queue->cosine[i];
        queue->hit[kept] = queue->hit[i];
        kept += hit;
    }
    queue->count = kept;
}

/* A ray of the light for each sample. */
static void sample_light(struct estimator *e, struct block *b)
{
    struct point_block points;
    struct ray_queue queue;
    queue.count = b->count;
    (e->light->type == IRB_LIGHT_SPOT ? e->makers.disc : e->makers.square)(&b->sets->light,
                                                                          b->first, &points);
    for (int i = 0; i < b->count; i++) {
        struct trace_ray *ray = &queue.ray[i];
        light_source_emit(e->light, points.x[i], points.y[i], &ray->origin, &ray->direction);
        ray->near = e->light->offset;
        ray->far = INFINITY;
        queue.sample[i] = i;
        b->lit[i] = false;
    }
    trace_closest(&e->trace, queue.ray, queue.count, queue.hit);
    compact_hits(&queue);
    for (int i = 0; i < queue.count; i++) {
        struct light_vertex *y = &b->light[queue.sample[i]];
        const struct trace_hit *hit = &queue.hit[i];
        struct light_incident incident;
        surface_at(e->trace.surfaces, hit->triangle, hit->u, hit->v, queue.ray[i].direction,
                   &y->point);
        b->lit[queue.sample[i]] = light_at(e, &y->point, &incident);
        y->radiance = v3_scale(v3_mul(y->point.diffuse, e->light->intensity),
                               INV_PI * incident.factor * incident.cos_shading);
        y->density = incident.density * incident.cos_geometric;
    }
}

/* (b): G/(p_a + p_b) between x and the light's vertex; 0 where they do not face each other. */
static inline float connection(const struct surface_point *x, const struct light_vertex *y)
{
    struct vec3 w = v3_sub(y->point.position, x->position);
    float r2 = v3_dot(w, w), cos_x = v3_dot(x->shading, w), cos_y = -v3_dot(y->point.geometric, w);
    float g = cos_x * cos_y; /* G r^4 */
    bool facing = (cos_x > 0) & (cos_y > 0) & (v3_dot(x->geometric, w) > 0);
    return facing ? g / (g * INV_PI + y->density * r2 * r2) : 0;
}

/* (b) at the end of every path. */
static void connect(struct estimator *e, struct block *b)
{
    struct shadow_queue queue;
    double sum[3] = {0, 0, 0};
    queue.count = 0;
    for (int i = 0; i < b->active_count; i++) {
        int s = b->active[i];
        const struct surface_point *x = &b->end[s];
        const struct light_vertex *y = &b->light[s];
        if (!b->lit[s])
            continue;
        float weight = connection(x, y);
        queue.ray[queue.count] = (struct trace_ray){
            .origin = x->origin, .direction = v3_sub(y->point.origin, x->origin), .far = shorten};
        queue.value[queue.count] = v3_scale(v3_mul(b->throughput[s], y->radiance), weight);
        queue.count += weight > 0;
    }
    if (b->bounce == 1 && e->unoccluded)
        for (int i = 0; i < queue.count; i++)
            add(b->sums->unoccluded, queue.value[i]);
    sum_visible(e, &queue, sum);
    add_bounce(e, b, sum);
}

/* A cosine-distributed ray from the end of every path, but for those below the true surface. */
static void choose_rays(const struct estimator *e, struct block *b, struct ray_queue *queue)
{
    struct point_block points;
    e->makers.direction(&b->sets->bounce[b->bounce - 1], b->first, &points);
    queue->count = 0;
    for (int i = 0; i < b->active_count; i++) {
        int s = b->active[i];
        const struct surface_point *x = &b->end[s];
        struct trace_ray *ray = &queue->ray[queue->count];
        struct vec3 tangent, bitangent;
        v3_basis(x->shading, &tangent, &bitangent);
        struct vec3 d = v3_mad(v3_scale(x->shading, points.z[s]), points.x[s], tangent);
        d = v3_mad(d, points.y[s], bitangent);
        *ray = (struct trace_ray){.origin = x->origin, .direction = d, .far = INFINITY};
        queue->sample[queue->count] = s;
        queue->cosine[queue->count] = points.z[s];
        queue->count += v3_dot(d, x->geometric) > 0;
    }
}

/* Every further hit along the first rays, each seen as if nothing were before it. */
static void gather_behind(struct estimator *e, struct block *b, struct ray_queue *queue)
{
    const struct surface_set *set = e->trace.surfaces;
    for (int round = 0; round < MAX_HITS_ALONG_RAY && queue->count; round++) {
        struct shadow_queue shadows;
        for (int i = 0; i < queue->count; i++)
            queue->ray[i].near = queue->hit[i].t + SURFACE_OFFSET * queue->hit[i].t + set->offset;
        trace_closest(&e->trace, queue->ray, queue->count, queue->hit);
        compact_hits(queue);
        shadows.count = 0;
        for (int i = 0; i < queue->count; i++) {
            const struct trace_hit *hit = &queue->hit[i];
            struct vec3 direction = queue->ray[i].direction;
            struct surface_point y;
            surface_at(set, hit->triangle, hit->u, hit->v, direction, &y);
            float cosines = queue->cosine[i] * -v3_dot(y.geometric, direction);
            queue_gather(e, &y, cosines, hit->t, true, v3(1, 1, 1), &shadows);
        }
        sum_visible(e, &shadows, b->sums->unoccluded);
    }
}

/* Russian roulette, and the throughput of paths that go on. */
static inline bool survives(struct block *b, int sample)
{
    struct vec3 diffuse = b->end[sample].diffuse;
    float survival = v3_max(diffuse);
    b->throughput[sample] = v3_mul(b->throughput[sample], diffuse);
    if (b->bounce <= ROULETTE_BOUNCE || survival >= 1)
        return survival > 0;
    uint32_t number =
        irb_hash_u32(b->sets->roulette + (uint32_t)b->bounce, b->first + (uint32_t)sample);
    b->throughput[sample] = v3_scale(b->throughput[sample], 1 / survival);
    return irb_unit_float(number) < survival;
}

/* (a): extends every path by one ray, and adds what its end reflects. */
static void extend(struct estimator *e, struct block *b)
{
    struct ray_queue queue;
    struct shadow_queue shadows;
    double sum[3] = {0, 0, 0};
    choose_rays(e, b, &queue);
    trace_closest(&e->trace, queue.ray, queue.count, queue.hit);
    compact_hits(&queue);
    shadows.count = 0;
    for (int i = 0; i < queue.count; i++) {
        const struct trace_hit *hit = &queue.hit[i];
        struct vec3 direction = queue.ray[i].direction;
        int s = queue.sample[i];
        struct surface_point *y = &b->end[s];
        surface_at(e->trace.surfaces, hit->triangle, hit->u, hit->v, direction, y);
        float cosines = queue.cosine[i] * -v3_dot(y->geometric, direction);
        queue_gather(e, y, cosines, hit->t, b->bounce <= CONNECTED_BOUNCES, b->throughput[s],
                     &shadows);
    }
    sum_visible(e, &shadows, sum);
    add_bounce(e, b, sum);
    b->active_count = 0;
    for (int i = 0; i < queue.count; i++) {
        b->active[b->active_count] = queue.sample[i];
        b->active_count += survives(b, queue.sample[i]);
    }
    if (b->bounce == 1 && e->unoccluded) {
        for (int c = 0; c < 3; c++)
            b->sums->unoccluded[c] += sum[c];
        gather_behind(e, b, &queue);
    }
}

static void add_block(struct estimator *e, struct block *b)
{
    sample_light(e, b);
    b->active_count = b->count;
    for (int i = 0; i < b->count; i++) {
        b->active[i] = i;
        b->end[i] = *b->start;
        b->throughput[i] = v3(1, 1, 1);
    }
    for (b->bounce = 1; b->bounce <= e->bounces && b->active_count; b->bounce++) {
        if (b->bounce <= CONNECTED_BOUNCES)
            connect(e, b);
        extend(e, b);
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

void estimator_add(struct estimator *estimator, const struct surface_point *point, uint64_t seed,
                   uint32_t first, uint32_t last, struct point_layers *sums)
{
    if (estimator->light->dark)
        return;
    for (uint32_t batch = 0; batch < IRB_REFERENCE_BATCHES; batch++) {
        struct sample_sets sets;
        struct batch_sums s = {0};
        struct block block;
        seed_sets(&sets, irb_hash_mix(seed, batch), estimator->bounces);
        block.sets = &sets;
        block.start = point;
        block.sums = &s;
        for (block.first = first; block.first < last; block.first += SAMPLE_BLOCK) {
            uint32_t left = last - block.first;
            block.count = left < SAMPLE_BLOCK ? (int)left : SAMPLE_BLOCK;
            add_block(estimator, &block);
        }
        add_sums(sums->bounce1, s.bounce1);
        add_sums(sums->bounce2, s.bounce2);
        add_sums(sums->rest, s.rest);
        add_sums(sums->unoccluded, s.unoccluded);
        sums->bounce1_batch[batch] += (float)luminance(s.bounce1);
        sums->unoccluded_batch[batch] += (float)luminance(s.unoccluded);
    }
}

struct vec3 estimator_direct(struct estimator *estimator, const struct surface_point *point,
                             struct vec3 specular, float exponent, struct vec3 eye)
{
    struct light_incident incident;
    bool occluded;
    if (estimator->light->dark || !light_at(estimator, point, &incident))
        return v3(0, 0, 0);
    struct trace_ray ray = light_ray(estimator->light, point, &incident);
    trace_occluded(&estimator->trace, &ray, 1, &occluded);
    if (occluded)
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
