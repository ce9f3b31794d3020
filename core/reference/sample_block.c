/* SPDX-License-Identifier: MIT */
#include "core/reference/sample_block.h"
#include "core/reference/sample_map.h"

/* Forced into each version below, which compiles it for its own instructions. */
#define BODY static inline __attribute__((always_inline)) void

BODY make_square(const struct irb_sobol_set *set, uint32_t first, struct point_block *out)
{
    uint32_t x[SAMPLE_BLOCK], y[SAMPLE_BLOCK];
    for (uint32_t i = 0; i < SAMPLE_BLOCK; i++)
        irb_sobol_2d_bits(set, irb_reverse_bits(first + i), &x[i], &y[i]);
    for (int i = 0; i < SAMPLE_BLOCK; i++) {
        out->x[i] = irb_unit_float(x[i]);
        out->y[i] = irb_unit_float(y[i]);
    }
}

BODY make_disc(const struct irb_sobol_set *set, uint32_t first, struct point_block *out)
{
    make_square(set, first, out);
    for (int i = 0; i < SAMPLE_BLOCK; i++)
        map_to_disc(out->x[i], out->y[i], &out->x[i], &out->y[i]);
}

BODY make_direction(const struct irb_sobol_set *set, uint32_t first, struct point_block *out)
{
    make_square(set, first, out);
    for (int i = 0; i < SAMPLE_BLOCK; i++) {
        struct vec3 d = map_to_cosine(out->x[i], out->y[i]);
        out->x[i] = d.x;
        out->y[i] = d.y;
        out->z[i] = d.z;
    }
}

/* The three functions of point_makers, for one kind of processor. */
#define DEFINE_MAKERS(kind, attributes)                                                            \
    attributes static void square_##kind(const struct irb_sobol_set *set, uint32_t first,          \
                                         struct point_block *out)                                  \
    {                                                                                              \
        make_square(set, first, out);                                                              \
    }                                                                                              \
    attributes static void disc_##kind(const struct irb_sobol_set *set, uint32_t first,            \
                                       struct point_block *out)                                    \
    {                                                                                              \
        make_disc(set, first, out);                                                                \
    }                                                                                              \
    attributes static void direction_##kind(const struct irb_sobol_set *set, uint32_t first,       \
                                            struct point_block *out)                               \
    {                                                                                              \
        make_direction(set, first, out);                                                           \
    }

DEFINE_MAKERS(any, )
#ifdef __x86_64__
DEFINE_MAKERS(avx2, __attribute__((target("avx2"))))
#endif

struct point_makers point_makers_choose(void)
{
#ifdef __x86_64__
    if (__builtin_cpu_supports("avx2"))
        return (struct point_makers){square_avx2, disc_avx2, direction_avx2};
#endif
    return (struct point_makers){square_any, disc_any, direction_any};
}
