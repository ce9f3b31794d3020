/* SPDX-License-Identifier: MIT
 *
 * Irradiance from virtual point lights with exact visibility (Embree), against which shadow maps of
 * the same lights are measured. Include after compare.h.
 */
#ifndef IRB_TESTS_INTEGRATION_EXACT_LIGHTS_H
#define IRB_TESTS_INTEGRATION_EXACT_LIGHTS_H

#include "core/lights/vpl.h"
#include "core/reference/tracer.h"
#include "tests/frame/fixture.h"

/* As core/lights/virtual_light.h has them. */
struct exact_light {
    float position[4], normal[4], flux[4];
};

/* The lights that a method draws by flux; the caller frees them. */
static inline struct exact_light *exact_lights(struct irb_gl *gl, const struct irb_rsm *rsm,
                                               int samples, int *count)
{
    struct irb_error err = {0};
    struct irb_vpl_set *set =
        irb_vpl_set_create(gl, IRB_VPL_IMPORTANCE, rsm->resolution, samples, &err);
    REQUIRE_OK(set);
    REQUIRE_OK(irb_vpl_set_sample(set, rsm, samples, 0, &err));
    struct exact_light *lights = malloc(((size_t)set->count + 1) * sizeof *lights);
    REQUIRE_OK(irb_buffer_read(set->lights, 0, set->count * (int64_t)sizeof *lights, lights, &err));
    *count = set->count;
    irb_vpl_set_destroy(set);
    return lights;
}

/* Of one receiver x with normal n and triangle's normal g. */
struct exact_receiver {
    struct vec3 x, n, g;
    float epsilon; /* m: how far both ends of a shadow ray stand off their surfaces */
};

/* cos cos/r^2, at most `bound` where that is not 0. */
static inline double exact_term(const struct exact_receiver *r, const struct exact_light *light,
                                double bound)
{
    const struct vec3 d = v3_sub(v3_load(light->position), r->x);
    const double r2 = (double)v3_dot(d, d);
    const double cos_x = fmax(0, (double)v3_dot(r->n, d));
    const double cos_y = fmax(0, (double)-v3_dot(v3_load(light->normal), d));
    const double g = r2 > 0 ? cos_x * cos_y / (r2 * r2) : 0;
    return bound > 0 ? fmin(g, bound) : g;
}

static inline struct trace_ray exact_ray(const struct exact_receiver *r,
                                         const struct exact_light *light)
{
    const struct vec3 from = v3_mad(r->x, r->epsilon, r->g);
    const struct vec3 to = v3_mad(v3_load(light->position), r->epsilon, v3_load(light->normal));
    return (struct trace_ray){
        .origin = from, .near = 0, .direction = v3_sub(to, from), .far = 0.9999f};
}

/* Green irradiance of one receiver: [0] with exact visibility, [1] without any. `occluded` and
 * `rays` have room for `count`. */
static inline void exact_gather(struct trace_context *context, const struct exact_receiver *r,
                                const struct exact_light *lights, int count, double bound,
                                struct trace_ray *rays, bool *occluded, double e[2])
{
    for (int i = 0; i < count; i++)
        rays[i] = exact_ray(r, &lights[i]);
    trace_occluded(context, rays, count, occluded);
    e[0] = e[1] = 0;
    for (int i = 0; i < count; i++) {
        double part = (double)lights[i].flux[1] / M_PI * exact_term(r, &lights[i], bound);
        e[1] += part;
        e[0] += occluded[i] ? 0 : part;
    }
}

/* Of every pixel: *image is created with 2 channels. */
static inline void exact_image(const struct irb_scene *scene, const struct irb_gbuffer_image *g,
                               const struct exact_light *lights, int count, double bound,
                               struct irb_image *image)
{
    struct irb_error err = {0};
    struct irb_tracer *tracer = irb_tracer_create(scene, &err);
    REQUIRE_OK(tracer);
    REQUIRE_OK(irb_image_create(image, g->width, g->height, 2, &err));
    struct trace_context context = {.tracer = tracer, .surfaces = irb_tracer_surfaces(tracer)};
    struct trace_ray *rays = calloc((size_t)count + 1, sizeof *rays);
    bool *occluded = calloc((size_t)count + 1, sizeof *occluded);
    for (size_t i = 0; i < irb_image_pixels(image); i++) {
        if (!irb_gbuffer_image_covered(g, i))
            continue;
        const struct exact_receiver receiver = {
            v3_load(g->position.data + 4 * i), v3_load(g->normal.data + 4 * i),
            v3_load(g->geometric.data + 3 * i), 1e-5f * irb_scene_diagonal(scene)};
        double e[2];
        exact_gather(&context, &receiver, lights, count, bound, rays, occluded, e);
        image->data[2 * i] = (float)e[0];
        image->data[2 * i + 1] = (float)e[1];
    }
    free(rays);
    free(occluded);
    irb_tracer_destroy(tracer);
}

#endif
