/* SPDX-License-Identifier: MIT
 *
 * Private to the room: what the integrator asks of the tracer. All calls of Embree are in tracer.c.
 */
#ifndef IRB_REFERENCE_TRACER_H
#define IRB_REFERENCE_TRACER_H

#include "core/reference/reference.h"
#include "core/reference/surface.h"
#include "core/reference/vec3.h"

/* A ray as it was traced; recorded for the benchmark, which traces the same rays in a bare loop. */
struct trace_record {
    struct vec3 origin, direction;
    float near, far;
    bool occlusion;
};

struct trace_recording {
    struct trace_record *records; /* owned by the caller */
    size_t count, capacity;       /* further rays are not recorded */
};

/* One thread's view of the tracer. */
struct trace_context {
    const struct irb_tracer *tracer;
    const struct surface_set *surfaces;
    uint64_t rays;
    struct trace_recording *recording; /* NULL but in the benchmark */
};

struct trace_hit {
    float t, u, v;
    uint32_t triangle;
};

/* Nearest hit in (near, far); directions need not be unit, t counts in their length. */
bool trace_closest(struct trace_context *context, struct vec3 origin, struct vec3 direction,
                   float near, float far, struct trace_hit *hit);
/* Whether anything lies in (near, far). */
bool trace_occluded(struct trace_context *context, struct vec3 origin, struct vec3 direction,
                    float near, float far);

const struct surface_set *irb_tracer_surfaces(const struct irb_tracer *tracer);
/* The RTCScene, for the benchmark's bare loop. */
void *irb_tracer_embree_scene(const struct irb_tracer *tracer);

#endif
