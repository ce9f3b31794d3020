/* SPDX-License-Identifier: MIT
 *
 * Private to the room: what the integrator asks of the tracer. All calls of Embree are in tracer.c.
 */
#ifndef IRB_REFERENCE_TRACER_H
#define IRB_REFERENCE_TRACER_H

#include "core/reference/reference.h"
#include "core/reference/surface.h"
#include "core/reference/vec3.h"

/* Directions need not be unit: distances count in their length. */
struct trace_ray {
    struct vec3 origin;
    float near;
    struct vec3 direction;
    float far;
};

#define TRACE_MISS UINT32_MAX

struct trace_hit {
    float t, u, v;
    uint32_t triangle; /* TRACE_MISS: nothing was hit, the rest is undefined */
};

/* Rays as they were traced, for the benchmark, which traces the same in a bare loop. */
struct trace_recording {
    struct trace_ray *rays; /* owned by the caller, like occlusion */
    bool *occlusion;
    size_t count, capacity; /* further rays are not recorded */
};

/* One thread's view of the tracer. */
struct trace_context {
    const struct irb_tracer *tracer;
    const struct surface_set *surfaces;
    uint64_t rays;
    struct trace_recording *recording; /* NULL but in the benchmark */
};

/* Nearest hit of each ray in (near, far). */
void trace_closest(struct trace_context *context, const struct trace_ray *rays, int count,
                   struct trace_hit *hits);
/* Whether anything lies in (near, far) of each ray. */
void trace_occluded(struct trace_context *context, const struct trace_ray *rays, int count,
                    bool *occluded);

const struct surface_set *irb_tracer_surfaces(const struct irb_tracer *tracer);
/* The RTCScene, for the benchmark's bare loop. */
void *irb_tracer_embree_scene(const struct irb_tracer *tracer);

#endif
