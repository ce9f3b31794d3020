/* SPDX-License-Identifier: MIT
 *
 * E_1(x) = integral over the surfaces of  L(y) G(x,y) V(x,y) dA,
 *     L(y) = k_d(y)/pi E_0(y),  G = max(0, n_x.w) |g_y.w| / r^2,
 * with n_x the shading normal, g_y the geometric normal (it is what relates solid angle to area)
 * and E_0(y) the light's irradiance on y's shading normal. Two estimators of it, each with one
 * sample: (a) a direction w with density cos/pi: density of y by area  p_a = G/pi; (b) a ray of the
 * light: density of y by area  p_b = p_L |g_y.l| (p_L per perpendicular area). The balance
 * heuristic (Veach and Guibas 1995) gives both the same weighted contribution L G V / (p_a + p_b),
 * bounded by pi L as by the light's power. The same holds at any later vertex of the path, where
 * the density of the path up to it cancels.
 *
 * A block of samples goes through each step together, a lane each: the arithmetic is done in
 * vectors (kernels.h), rays are traced in tight loops, and which samples go on is decided by
 * compaction instead of branches that can't be predicted.
 */
#include "core/reference/estimator.h"

#include <float.h>
#include <string.h>

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
    struct batch_sums *sums;
    uint32_t first; /* index of the first sample */
    int count;
    int bounce; /* the one that is being computed, from 1 */
    struct light_lanes light;
    struct surface_lanes end; /* of the paths */
    struct lanes3 throughput;
    /* samples whose path goes on */
    int active[LANES], active_count;
};

/* Rays of a step, each of one sample. */
struct ray_queue {
    int count;
    struct trace_ray ray[LANES];
    int sample[LANES];
    struct trace_hit hit[LANES];
};

/* What the rays of a step are made of, a lane each. */
struct step {
    struct lanes3 direction;
    float cosine[LANES]; /* to the shading normal where they start */
    float t[LANES];      /* their length */
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

/* Puts a ray at the end of the queue, which keeps it only if `keep` is 1. */
static inline void queue_ray(struct ray_queue *queue, int sample, int keep, struct vec3 origin,
                             struct vec3 direction, float near, float far)
{
    struct trace_ray *ray = &queue->ray[queue->count];
    ray->origin = origin;
    ray->near = near;
    ray->direction = direction;
    ray->far = far;
    queue->sample[queue->count] = sample;
    queue->count += keep;
}

/* Traces shadow rays; adds the values of those samples that nothing is in the way of. */
static void add_visible(struct estimator *e, const struct ray_queue *queue,
                        const struct lanes3 *value, double sum[3])
{
    bool occluded[LANES];
    trace_occluded(&e->trace, queue->ray, queue->count, occluded);
    for (int i = 0; i < queue->count; i++)
        add(sum, v3_scale(lanes3_at(value, queue->sample[i]), occluded[i] ? 0 : 1));
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

/* Traces the rays and keeps those that hit something. */
static void trace_and_compact(struct estimator *e, struct ray_queue *queue)
{
    int kept = 0;
    trace_closest(&e->trace, queue->ray, queue->count, queue->hit);
    for (int i = 0; i < queue->count; i++) {
        queue->ray[kept] = queue->ray[i];
        queue->sample[kept] = queue->sample[i];
        queue->hit[kept] = queue->hit[i];
        kept += queue->hit[i].triangle != TRACE_MISS;
    }
    queue->count = kept;
}

/* Shading normal and albedo of what is curved or textured. */
static void refine(const struct surface_set *set, const struct trace_hit *hit, int lane,
                   struct surface_lanes *y)
{
    struct surface_point point = {.geometric = lanes3_at(&y->geometric, lane),
                                  .shading = lanes3_at(&y->shading, lane),
                                  .diffuse = lanes3_at(&y->diffuse, lane)};
    surface_detail_at(set, &set->triangles[hit->triangle], hit->u, hit->v, &point);
    lanes3_set(&y->shading, lane, point.shading);
    lanes3_set(&y->diffuse, lane, point.diffuse);
}

/* The surfaces that the rays hit, on the sides that they see. */
static void land(const struct estimator *e, const struct ray_queue *queue,
                 const struct lanes3 *direction, struct surface_lanes *y)
{
    const struct surface_set *set = e->trace.surfaces;
    for (int i = 0; i < queue->count; i++) {
        const struct trace_hit *hit = &queue->hit[i];
        struct surface_point point;
        surface_load(set, hit->triangle, hit->u, hit->v, &point);
        lanes3_set(&y->position, queue->sample[i], point.position);
        lanes3_set(&y->geometric, queue->sample[i], point.geometric);
        lanes3_set(&y->diffuse, queue->sample[i], point.diffuse);
    }
    e->kernels->face(set->offset, direction, y);
    for (int i = 0; i < queue->count; i++)
        if (set->triangles[queue->hit[i].triangle].detail >= 0)
            refine(set, &queue->hit[i], queue->sample[i], y);
}

/* A ray of the light for each sample. */
static void sample_light(struct estimator *e, struct block *b)
{
    const struct light_source *light = e->light;
    struct lanes3 points, direction;
    struct ray_queue queue;
    struct light_lanes *y = &b->light;
    (light->type == IRB_LIGHT_SPOT ? e->kernels->disc : e->kernels->square)(&b->sets->light,
                                                                            b->first, &points);
    queue.count = 0;
    for (int i = 0; i < LANES; i++) {
        struct vec3 origin, d;
        light_source_emit(light, points.x[i], points.y[i], &origin, &d);
        lanes3_set(&direction, i, d);
        if (i < b->count)
            queue_ray(&queue, i, 1, origin, d, light->offset, INFINITY);
    }
    trace_and_compact(e, &queue);
    land(e, &queue, &direction, &y->surface);
    e->kernels->light(light, &y->surface, &y->incident);
    int lit[LANES] = {0};
    for (int i = 0; i < queue.count; i++) {
        int s = queue.sample[i];
        lit[s] = y->incident.lit[s];
        lanes3_set(&y->radiance, s,
                   v3_scale(v3_mul(lanes3_at(&y->surface.diffuse, s), light->intensity),
                            INV_PI * y->incident.irradiance[s]));
    }
    memcpy(y->incident.lit, lit, sizeof lit);
}

/* (b) at the end of every path. */
static void connect(struct estimator *e, struct block *b)
{
    struct connection_lanes connection;
    struct ray_queue queue;
    double sum[3] = {0, 0, 0};
    e->kernels->connect(&b->end, &b->light, &b->throughput, &connection);
    queue.count = 0;
    for (int i = 0; i < b->active_count; i++) {
        int s = b->active[i];
        queue_ray(&queue, s, connection.facing[s], lanes3_at(&b->end.origin, s),
                  lanes3_at(&connection.direction, s), 0, shorten);
    }
    if (b->bounce == 1 && e->unoccluded)
        for (int i = 0; i < queue.count; i++)
            add(b->sums->unoccluded, lanes3_at(&connection.value, queue.sample[i]));
    add_visible(e, &queue, &connection.value, sum);
    add_bounce(e, b, sum);
}

/* A cosine-distributed ray from the end of every path, but for those below the true surface. */
static void choose_rays(const struct estimator *e, const struct block *b, struct ray_queue *queue,
                        struct step *step)
{
    struct lanes3 local;
    int above[LANES];
    e->kernels->cosine(&b->sets->bounce[b->bounce - 1], b->first, &local);
    e->kernels->orient(&b->end, &local, &step->direction, above);
    memcpy(step->cosine, local.z, sizeof step->cosine);
    queue->count = 0;
    for (int i = 0; i < b->active_count; i++) {
        int s = b->active[i];
        queue_ray(queue, s, above[s], lanes3_at(&b->end.origin, s), lanes3_at(&step->direction, s),
                  0, INFINITY);
    }
}

/* (a): adds what the hits at y reflect. */
static void gather(struct estimator *e, const struct ray_queue *queue, const struct step *step,
                   const struct surface_lanes *y, bool connected, const struct lanes3 *throughput,
                   double sum[3])
{
    struct incident_lanes incident;
    struct lanes3 value;
    struct ray_queue shadows;
    e->kernels->light(e->light, y, &incident);
    e->kernels->gather(e->light, y, &incident, &step->direction, step->cosine, step->t, connected,
                       throughput, &value);
    shadows.count = 0;
    for (int i = 0; i < queue->count; i++) {
        int s = queue->sample[i];
        queue_ray(&shadows, s, incident.lit[s], lanes3_at(&y->origin, s),
                  lanes3_at(&incident.direction, s), 0, incident.far[s]);
    }
    add_visible(e, &shadows, &value, sum);
}

/* Every further hit along the first rays, each seen as if nothing were before it. */
static void gather_behind(struct estimator *e, struct block *b, struct ray_queue *queue,
                          struct step *step)
{
    const struct surface_set *set = e->trace.surfaces;
    struct surface_lanes y = b->end; /* lanes that end keep something defined */
    struct lanes3 one;
    for (int i = 0; i < LANES; i++)
        lanes3_set(&one, i, v3(1, 1, 1));
    for (int round = 0; round < MAX_HITS_ALONG_RAY && queue->count; round++) {
        for (int i = 0; i < queue->count; i++)
            queue->ray[i].near = queue->hit[i].t + SURFACE_OFFSET * queue->hit[i].t + set->offset;
        trace_and_compact(e, queue);
        for (int i = 0; i < queue->count; i++)
            step->t[queue->sample[i]] = queue->hit[i].t;
        land(e, queue, &step->direction, &y);
        gather(e, queue, step, &y, true, &one, b->sums->unoccluded);
    }
}

/* Russian roulette, and the throughput of a path that goes on. */
static inline int survives(struct block *b, int sample)
{
    struct vec3 diffuse = lanes3_at(&b->end.diffuse, sample);
    struct vec3 throughput = v3_mul(lanes3_at(&b->throughput, sample), diffuse);
    float survival = v3_max(diffuse);
    int alive = survival > 0;
    if (b->bounce > ROULETTE_BOUNCE && survival < 1) {
        uint32_t number =
            irb_hash_u32(b->sets->roulette + (uint32_t)b->bounce, b->first + (uint32_t)sample);
        throughput = v3_scale(throughput, 1 / survival);
        alive = irb_unit_float(number) < survival;
    }
    lanes3_set(&b->throughput, sample, throughput);
    return alive;
}

/* (a): extends every path by one ray, and adds what its end reflects. */
static void extend(struct estimator *e, struct block *b)
{
    struct ray_queue queue;
    struct step step;
    double sum[3] = {0, 0, 0};
    choose_rays(e, b, &queue, &step);
    trace_and_compact(e, &queue);
    memset(step.t, 0, sizeof step.t);
    for (int i = 0; i < queue.count; i++)
        step.t[queue.sample[i]] = queue.hit[i].t;
    land(e, &queue, &step.direction, &b->end);
    gather(e, &queue, &step, &b->end, b->bounce <= CONNECTED_BOUNCES, &b->throughput, sum);
    add_bounce(e, b, sum);
    b->active_count = 0;
    for (int i = 0; i < queue.count; i++) {
        b->active[b->active_count] = queue.sample[i];
        b->active_count += survives(b, queue.sample[i]);
    }
    if (b->bounce == 1 && e->unoccluded) {
        for (int c = 0; c < 3; c++)
            b->sums->unoccluded[c] += sum[c];
        gather_behind(e, b, &queue, &step);
    }
}

static void start_paths(struct block *b, const struct surface_point *start)
{
    b->active_count = b->count;
    for (int i = 0; i < LANES; i++) {
        b->active[i] = i;
        lanes3_set(&b->end.position, i, start->position);
        lanes3_set(&b->end.origin, i, start->origin);
        lanes3_set(&b->end.geometric, i, start->geometric);
        lanes3_set(&b->end.shading, i, start->shading);
        lanes3_set(&b->end.diffuse, i, start->diffuse);
        lanes3_set(&b->throughput, i, v3(1, 1, 1));
    }
}

static void add_block(struct estimator *e, const struct surface_point *start, struct block *b)
{
    sample_light(e, b);
    start_paths(b, start);
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
    struct block block = {0};
    for (uint32_t batch = 0; batch < IRB_REFERENCE_BATCHES; batch++) {
        struct sample_sets sets;
        struct batch_sums s = {0};
        seed_sets(&sets, irb_hash_mix(seed, batch), estimator->bounces);
        block.sets = &sets;
        block.sums = &s;
        for (block.first = first; block.first < last; block.first += LANES) {
            uint32_t left = last - block.first;
            block.count = left < LANES ? (int)left : LANES;
            add_block(estimator, point, &block);
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
    const struct light_source *light = estimator->light;
    struct light_incident incident;
    bool occluded;
    if (light->dark || !light_source_incident(light, light->type, light->falloff, point->position,
                                              point->geometric, point->shading, &incident))
        return v3(0, 0, 0);
    struct trace_ray ray = {.origin = point->origin};
    light_source_shadow(light, light->type, &incident, point->origin, &ray.direction, &ray.far);
    trace_occluded(&estimator->trace, &ray, 1, &occluded);
    if (occluded)
        return v3(0, 0, 0);
    struct vec3 view = v3_normalize_safe(v3_sub(eye, point->position));
    struct vec3 half = v3_normalize_safe(v3_add(view, incident.to_light));
    float cos_h = v3_dot(point->shading, half);
    struct vec3 reflectance = v3_scale(point->diffuse, incident.cos_shading);
    if (cos_h > 0)
        reflectance = v3_mad(reflectance, powf(cos_h, exponent), specular);
    struct vec3 radiance = v3_mul(reflectance, light->intensity);
    return v3_scale(radiance, INV_PI * incident.factor);
}
