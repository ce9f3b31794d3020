/* SPDX-License-Identifier: MIT
 *
 * Each kernel is one body, forced into a version for any processor and one for AVX2. Results go to
 * local variables first: the compiler then knows that they do not overlap the inputs.
 */
#include "core/reference/kernels.h"
#include "core/reference/sample_map.h"

#define INV_PI 0.31830988618379067154f

#define BODY static inline __attribute__((always_inline)) void

BODY square_body(const struct irb_sobol_set *set, uint32_t first, struct lanes3 *restrict out)
{
    uint32_t x[LANES], y[LANES];
    for (uint32_t i = 0; i < LANES; i++)
        irb_sobol_2d_bits(set, irb_reverse_bits(first + i), &x[i], &y[i]);
    for (int i = 0; i < LANES; i++) {
        out->x[i] = irb_unit_float(x[i]);
        out->y[i] = irb_unit_float(y[i]);
    }
}

BODY disc_body(const struct irb_sobol_set *set, uint32_t first, struct lanes3 *restrict out)
{
    square_body(set, first, out);
    for (int i = 0; i < LANES; i++)
        map_to_disc(out->x[i], out->y[i], &out->x[i], &out->y[i]);
}

BODY cosine_body(const struct irb_sobol_set *set, uint32_t first, struct lanes3 *restrict out)
{
    square_body(set, first, out);
    for (int i = 0; i < LANES; i++)
        lanes3_set(out, i, map_to_cosine(out->x[i], out->y[i]));
}

BODY orient_body(const struct surface_lanes *restrict x, const struct lanes3 *restrict local,
                 struct lanes3 *restrict direction, int *restrict above)
{
    struct lanes3 o;
    for (int i = 0; i < LANES; i++) {
        struct vec3 n = lanes3_at(&x->shading, i), s, t;
        v3_basis(n, &s, &t);
        struct vec3 d = v3_mad(v3_scale(n, local->z[i]), local->x[i], s);
        d = v3_mad(d, local->y[i], t);
        lanes3_set(&o, i, d);
        above[i] = v3_dot(d, lanes3_at(&x->geometric, i)) > 0;
    }
    *direction = o;
}

BODY face_body(float offset, const struct lanes3 *restrict direction,
               struct surface_lanes *restrict y)
{
    for (int i = 0; i < LANES; i++) {
        struct surface_point p = {.position = lanes3_at(&y->position, i),
                                  .geometric = lanes3_at(&y->geometric, i)};
        surface_face(offset, lanes3_at(direction, i), &p);
        lanes3_set(&y->geometric, i, p.geometric);
        lanes3_set(&y->shading, i, p.geometric);
        lanes3_set(&y->origin, i, p.origin);
    }
}

/* With type and falloff known, the loop has no branch. */
BODY light_loop(const struct light_source *light, enum irb_light_type type,
                enum irb_falloff falloff, const struct surface_lanes *restrict y,
                struct incident_lanes *restrict out)
{
    const struct light_source l = *light;
    struct incident_lanes o;
    for (int i = 0; i < LANES; i++) {
        struct light_incident at;
        o.lit[i] =
            light_source_incident(&l, type, falloff, lanes3_at(&y->position, i),
                                  lanes3_at(&y->geometric, i), lanes3_at(&y->shading, i), &at);
        o.irradiance[i] = at.factor * at.cos_shading;
        o.density[i] = at.density * at.cos_geometric;
        struct vec3 d;
        light_source_shadow(&l, type, &at, lanes3_at(&y->origin, i), &d, &o.far[i]);
        lanes3_set(&o.direction, i, d);
    }
    *out = o;
}

BODY light_body(const struct light_source *light, const struct surface_lanes *restrict y,
                struct incident_lanes *restrict out)
{
    if (light->type == IRB_LIGHT_DIRECTIONAL)
        light_loop(light, IRB_LIGHT_DIRECTIONAL, IRB_FALLOFF_CONSTANT, y, out);
    else if (light->falloff == IRB_FALLOFF_SMOOTH)
        light_loop(light, IRB_LIGHT_SPOT, IRB_FALLOFF_SMOOTH, y, out);
    else if (light->falloff == IRB_FALLOFF_COSINE)
        light_loop(light, IRB_LIGHT_SPOT, IRB_FALLOFF_COSINE, y, out);
    else
        light_loop(light, IRB_LIGHT_SPOT, IRB_FALLOFF_CONSTANT, y, out);
}

BODY gather_body(const struct light_source *light, const struct surface_lanes *restrict y,
                 const struct incident_lanes *restrict incident,
                 const struct lanes3 *restrict direction, const float *restrict cosine,
                 const float *restrict t, bool connected, const struct lanes3 *restrict throughput,
                 struct lanes3 *restrict value)
{
    struct vec3 intensity = light->intensity;
    struct lanes3 o;
    float scale[LANES];
    for (int i = 0; i < LANES; i++)
        scale[i] = incident->irradiance[i];
    for (int i = 0; connected && i < LANES; i++) {
        float cos_y = -v3_dot(lanes3_at(&y->geometric, i), lanes3_at(direction, i));
        float a = INV_PI * cosine[i] * cos_y, b = incident->density[i] * t[i] * t[i];
        scale[i] *= a / (a + b);
    }
    for (int i = 0; i < LANES; i++) {
        struct vec3 v = v3_mul(lanes3_at(throughput, i), lanes3_at(&y->diffuse, i));
        lanes3_set(&o, i, v3_scale(v3_mul(v, intensity), scale[i]));
    }
    *value = o;
}

BODY connect_body(const struct surface_lanes *restrict x, const struct light_lanes *restrict light,
                  const struct lanes3 *restrict throughput, struct connection_lanes *restrict out)
{
    const struct surface_lanes *y = &light->surface;
    struct connection_lanes o;
    for (int i = 0; i < LANES; i++) {
        struct vec3 w = v3_sub(lanes3_at(&y->position, i), lanes3_at(&x->position, i));
        float r2 = v3_dot(w, w), cos_x = v3_dot(lanes3_at(&x->shading, i), w);
        float cos_y = -v3_dot(lanes3_at(&y->geometric, i), w);
        float g = cos_x * cos_y; /* G r^4 */
        o.facing[i] = light->incident.lit[i] & (cos_x > 0) & (cos_y > 0) &
                      (v3_dot(lanes3_at(&x->geometric, i), w) > 0);
        float weight = g / (g * INV_PI + light->incident.density[i] * r2 * r2);
        struct vec3 v = v3_mul(lanes3_at(throughput, i), lanes3_at(&light->radiance, i));
        lanes3_set(&o.value, i, v3_scale(v, weight));
        lanes3_set(&o.direction, i, v3_sub(lanes3_at(&y->origin, i), lanes3_at(&x->origin, i)));
    }
    *out = o;
}

#define DEFINE_KERNELS(kind, attributes)                                                           \
    attributes static void square_##kind(const struct irb_sobol_set *set, uint32_t first,          \
                                         struct lanes3 *out)                                       \
    {                                                                                              \
        square_body(set, first, out);                                                              \
    }                                                                                              \
    attributes static void disc_##kind(const struct irb_sobol_set *set, uint32_t first,            \
                                       struct lanes3 *out)                                         \
    {                                                                                              \
        disc_body(set, first, out);                                                                \
    }                                                                                              \
    attributes static void cosine_##kind(const struct irb_sobol_set *set, uint32_t first,          \
                                         struct lanes3 *out)                                       \
    {                                                                                              \
        cosine_body(set, first, out);                                                              \
    }                                                                                              \
    attributes static void orient_##kind(const struct surface_lanes *x,                            \
                                         const struct lanes3 *local, struct lanes3 *direction,     \
                                         int *above)                                               \
    {                                                                                              \
        orient_body(x, local, direction, above);                                                   \
    }                                                                                              \
    attributes static void face_##kind(float offset, const struct lanes3 *direction,               \
                                       struct surface_lanes *y)                                    \
    {                                                                                              \
        face_body(offset, direction, y);                                                           \
    }                                                                                              \
    attributes static void light_##kind(const struct light_source *light,                          \
                                        const struct surface_lanes *y, struct incident_lanes *out) \
    {                                                                                              \
        light_body(light, y, out);                                                                 \
    }                                                                                              \
    attributes static void gather_##kind(                                                          \
        const struct light_source *light, const struct surface_lanes *y,                           \
        const struct incident_lanes *incident, const struct lanes3 *direction,                     \
        const float *cosine, const float *t, bool connected, const struct lanes3 *throughput,      \
        struct lanes3 *value)                                                                      \
    {                                                                                              \
        gather_body(light, y, incident, direction, cosine, t, connected, throughput, value);       \
    }                                                                                              \
    attributes static void connect_##kind(                                                         \
        const struct surface_lanes *x, const struct light_lanes *light,                            \
        const struct lanes3 *throughput, struct connection_lanes *out)                             \
    {                                                                                              \
        connect_body(x, light, throughput, out);                                                   \
    }                                                                                              \
    static const struct kernels kernels_##kind = {square_##kind, disc_##kind,   cosine_##kind,     \
                                                  orient_##kind, face_##kind,   light_##kind,      \
                                                  gather_##kind, connect_##kind};

DEFINE_KERNELS(any, )
#ifdef __x86_64__
DEFINE_KERNELS(avx2, __attribute__((target("avx2"))))
#endif

const struct kernels *kernels_portable(void)
{
    return &kernels_any;
}

const struct kernels *kernels_choose(void)
{
#ifdef __x86_64__
    if (__builtin_cpu_supports("avx2"))
        return &kernels_avx2;
#endif
    return &kernels_any;
}
