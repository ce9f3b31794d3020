/* SPDX-License-Identifier: MIT
 *
 * For tests of the lighting: receivers that are written into a G-buffer one by one, and runs of
 * split, shade, merge and filter. Include after compare.h.
 */
#ifndef IRB_TESTS_LIGHTS_SHADE_RECEIVERS_H
#define IRB_TESTS_LIGHTS_SHADE_RECEIVERS_H

#include "core/lights/shade.h"
#include "core/sampling/sobol.h"
#include "tests/frame/fixture.h"
#include "tests/lights/shade_scene.h"

struct receiver {
    float position[3], normal[3];
    float geometric[3]; /* of the triangle; 0 0 0: as `normal` */
};

/* In [0,1): number i of sequence `seed`. */
static inline double uniform(uint32_t seed, uint32_t i)
{
    return irb_unit_float(irb_hash_u32(seed, i));
}

static inline void unit(float v[3])
{
    double length = sqrt(fixture_dot(v, v));
    for (int c = 0; c < 3; c++)
        v[c] = (float)(v[c] / length);
}

/* Any direction with the third component at least `least`, seed and number giving which. */
static inline void random_normal(uint32_t seed, uint32_t i, double least, float out[3])
{
    double z = least + (1 - least) * uniform(seed, 2 * i);
    double angle = 2 * M_PI * uniform(seed, 2 * i + 1), r = sqrt(fmax(0, 1 - z * z));
    out[0] = (float)(r * cos(angle));
    out[1] = (float)(r * sin(angle));
    out[2] = (float)z;
    unit(out);
}

/* What a run needs; lights and maps are the test's own. The lighting is the file's, so that its
 * programs are compiled once. */
struct shading {
    struct irb_gbuffer *gbuffer;
    struct irb_interleave *interleave;
    struct irb_shade *shade; /* borrowed */
};

/* receivers: width x height, row 0 at the top. */
static inline void shading_create(struct shading *s, struct irb_shade *shade, struct irb_gl *gl,
                                  const struct receiver *receivers, int width, int height, int n,
                                  int m)
{
    struct irb_error err = {0};
    struct irb_image position, normal, geometric;
    REQUIRE_OK(irb_image_create(&position, width, height, 4, &err));
    REQUIRE_OK(irb_image_create(&normal, width, height, 4, &err));
    REQUIRE_OK(irb_image_create(&geometric, width, height, 4, &err));
    for (size_t i = 0; i < irb_image_pixels(&position); i++) {
        memcpy(position.data + 4 * i, receivers[i].position, 12);
        memcpy(normal.data + 4 * i, receivers[i].normal, 12);
        const float *g = receivers[i].geometric;
        memcpy(geometric.data + 4 * i, fixture_dot(g, g) > 0 ? g : receivers[i].normal, 12);
        position.data[4 * i + 3] = 1;
        normal.data[4 * i + 3] = 1; /* m from the camera */
    }
    REQUIRE_OK(s->gbuffer = irb_gbuffer_create(gl, width, height, &err));
    REQUIRE_OK(irb_texture_write(s->gbuffer->position, &position, &err));
    REQUIRE_OK(irb_texture_write(s->gbuffer->normal, &normal, &err));
    REQUIRE_OK(irb_texture_write(s->gbuffer->geometric, &geometric, &err));
    REQUIRE_OK(s->interleave = irb_interleave_create(gl, width, height, n, m, &err));
    REQUIRE_OK(irb_interleave_split(s->interleave, s->gbuffer, &err));
    s->shade = shade;
    irb_image_destroy(&position);
    irb_image_destroy(&normal);
    irb_image_destroy(&geometric);
}

static inline void shading_destroy(struct shading *s)
{
    irb_interleave_destroy(s->interleave);
    irb_gbuffer_destroy(s->gbuffer);
}

/* Merged, not filtered: irradiance without what is in shadow; that (mean of the channels). */
static inline struct irb_image shading_run(struct shading *s,
                                           const struct irb_virtual_lights *lights,
                                           const struct irb_ism *ism,
                                           const struct irb_shade_settings *settings)
{
    struct irb_error err = {0};
    REQUIRE_OK(irb_shade_run(s->shade, s->interleave, lights, ism, settings, &err));
    REQUIRE_OK(irb_interleave_merge(s->interleave, &err));
    struct irb_image image = fixture_read(s->interleave->merged, 4);
    for (size_t i = 0; i < 4 * irb_image_pixels(&image); i++)
        if (!(isfinite(image.data[i]) && image.data[i] >= 0))
            fail_msg("value %zu of the image is %g", i, image.data[i]);
    return image;
}

/* Merged and filtered, all of a flat receiver alike. */
static inline struct irb_image shading_filter(struct shading *s)
{
    struct irb_error err = {0};
    const struct irb_texture_desc desc = {.name = "filtered",
                                          .format = GL_RGBA32F,
                                          .width = s->gbuffer->width,
                                          .height = s->gbuffer->height};
    struct irb_texture *out = irb_texture_create(s->gbuffer->gl, &desc, &err);
    REQUIRE_OK(out);
    REQUIRE_OK(irb_interleave_merge(s->interleave, &err));
    REQUIRE_OK(irb_interleave_filter(s->interleave, s->gbuffer, 1, 0.9f, out, &err));
    struct irb_image image = fixture_read(out, 4);
    irb_texture_destroy(out);
    return image;
}

/* cos_x cos_y / (pi r^2 + A) in double (thesis eq. 5.5), with pi F cut at `bound` where it isn't 0.
 */
static inline double form_factor(const struct receiver *x, const struct shade_light *y, double area)
{
    double cos_x = 0, cos_y = 0, r2 = 0;
    for (int c = 0; c < 3; c++) {
        double d = (double)y->position[c] - x->position[c];
        r2 += d * d;
        cos_x += d * x->normal[c];
        cos_y -= d * y->normal[c];
    }
    if (!(r2 > 0) || cos_x <= 0 || cos_y <= 0)
        return 0;
    return cos_x * cos_y / r2 / (M_PI * r2 + area);
}

#endif
