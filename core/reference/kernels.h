/* SPDX-License-Identifier: MIT
 *
 * Private to the room: the integrator's arithmetic on a block of samples, one lane a sample,
 * written as loops that the compiler makes vectors of. Without it half of the time goes into
 * arithmetic instead of rays.
 *
 * Every kernel computes all lanes; those that stand for no sample hold numbers of no meaning. All
 * of them give the same bits on every processor: IEEE operations in the order of the source.
 */
#ifndef IRB_REFERENCE_KERNELS_H
#define IRB_REFERENCE_KERNELS_H

#include "core/reference/light_source.h"
#include "core/reference/surface.h"
#include "core/sampling/sobol.h"

enum { LANES = 16 }; /* samples of a block */

struct lanes3 {
    float x[LANES], y[LANES], z[LANES];
};

static inline struct vec3 lanes3_at(const struct lanes3 *lanes, int i)
{
    return v3(lanes->x[i], lanes->y[i], lanes->z[i]);
}

static inline void lanes3_set(struct lanes3 *lanes, int i, struct vec3 v)
{
    lanes->x[i] = v.x;
    lanes->y[i] = v.y;
    lanes->z[i] = v.z;
}

/* As struct surface_point. */
struct surface_lanes {
    struct lanes3 position, origin, geometric, shading, diffuse;
};

/* What the light does at a surface, were nothing in the way. */
struct incident_lanes {
    int lit[LANES];          /* 0: it does not reach the side in question */
    float irradiance[LANES]; /* on the shading normal, over the light's intensity */
    float density[LANES];    /* of the light's rays by the surface's area, 1/m2 */
    struct lanes3 direction; /* of the shadow ray from the surface's origin */
    float far[LANES];        /* and its end, in lengths of the direction */
};

/* A connection to a light vertex. */
struct connection_lanes {
    int facing[LANES];       /* 0: they do not see each other's sides */
    struct lanes3 direction; /* from origin to origin */
    struct lanes3 value;
};

struct light_lanes {
    struct surface_lanes surface; /* on the lit side */
    struct incident_lanes incident;
    struct lanes3 radiance; /* diffuse, W/(m2 sr) */
};

struct kernels {
    /* Points first..first+LANES-1 of a set: in the unit square, in the unit disc (z is not set by
     * these two), or directions with density cos/pi about (0,0,1). */
    void (*square)(const struct irb_sobol_set *set, uint32_t first, struct lanes3 *out);
    void (*disc)(const struct irb_sobol_set *set, uint32_t first, struct lanes3 *out);
    void (*cosine)(const struct irb_sobol_set *set, uint32_t first, struct lanes3 *out);
    /* Turns `local` into the frames of the shading normals; above = 0 for what goes below the true
     * surface. */
    void (*orient)(const struct surface_lanes *x, const struct lanes3 *local,
                   struct lanes3 *direction, int *above);
    /* surface_face() on every lane. */
    void (*face)(float offset, const struct lanes3 *direction, struct surface_lanes *y);
    void (*light)(const struct light_source *light, const struct surface_lanes *y,
                  struct incident_lanes *out);
    /* value = throughput * diffuse * irradiance, for a ray of hemisphere cosine `cosine` and
     * length t; with `connected` times its weight p_a/(p_a + p_b). */
    void (*gather)(const struct light_source *light, const struct surface_lanes *y,
                   const struct incident_lanes *incident, const struct lanes3 *direction,
                   const float *cosine, const float *t, bool connected,
                   const struct lanes3 *throughput, struct lanes3 *value);
    /* value = throughput * radiance * G/(p_a + p_b) between x and a light vertex. */
    void (*connect)(const struct surface_lanes *x, const struct light_lanes *light,
                    const struct lanes3 *throughput, struct connection_lanes *out);
};

/* Those for the processor that this runs on, and those for any; static. */
const struct kernels *kernels_choose(void);
const struct kernels *kernels_portable(void);

#endif
