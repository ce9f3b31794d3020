/* SPDX-License-Identifier: MIT
 *
 * A clustering with its importance map, read-backs of it, and the light that moves from wall to
 * wall. Include after compare.h.
 */
#ifndef IRB_TESTS_METHODS_ACRSM_FIXTURE_H
#define IRB_TESTS_METHODS_ACRSM_FIXTURE_H

#include "methods/acrsm/clusters.h"
#include "tests/frame/fixture.h"

struct acrsm_fixture {
    struct irb_gl *gl;
    struct fixture_frame f;
    struct irb_importance *importance;
    struct irb_pyramid *pyramid;
    struct acrsm_clusters *clusters;
    struct acrsm_settings settings;
    int resolution;
};

static inline struct acrsm_settings acrsm_fixture_settings(int clusters, int square, double extent)
{
    return (struct acrsm_settings){.clusters = clusters,
                                   .square = square,
                                   .adaptive = true,
                                   .reseed = true,
                                   .merge = 0.4f,
                                   .split = 0.15f,
                                   .share = 1 / 3.0f,
                                   .neighbourhood = 2,
                                   .split_radius = 1,
                                   .w_position = 0.9f,
                                   .w_normal = 0.08f,
                                   .w_importance = 0.02f,
                                   .extent = (float)extent,
                                   .warp_levels = 16,
                                   .tiles = 9};
}

/* A quarter of the map for a square, as 128 texels of 512 are. */
static inline void acrsm_fixture_create(struct acrsm_fixture *a, struct irb_gl *gl,
                                        struct irb_scene *scene, int resolution, int clusters)
{
    struct irb_error err = {0};
    a->gl = gl;
    a->resolution = resolution;
    fixture_frame_create(&a->f, gl, scene, 1, 1, resolution);
    REQUIRE_OK(a->importance = irb_importance_create(gl, resolution, &err));
    REQUIRE_OK(a->pyramid = irb_pyramid_create(gl, resolution, &err));
    REQUIRE_OK(a->clusters = acrsm_clusters_create(gl, resolution, &err));
    a->settings = acrsm_fixture_settings(clusters, resolution / 4, irb_scene_diagonal(scene));
}

static inline void acrsm_fixture_destroy(struct acrsm_fixture *a)
{
    acrsm_clusters_destroy(a->clusters);
    irb_pyramid_destroy(a->pyramid);
    irb_importance_destroy(a->importance);
    fixture_frame_destroy(&a->f);
}

/* The Cornell box with a spot that turns from the back wall (t = 0) to the right one (t = 1). */
static inline struct irb_light acrsm_fixture_light(double t)
{
    const double angle = t * M_PI / 2;
    const float position[3] = {0.2f, 0.3f, 0.2f};
    const float target[3] = {0.2f + (float)sin(angle), 0.28f, 0.2f + (float)cos(angle)};
    struct irb_light light = fixture_spot(position, target, 35);
    light.falloff = IRB_FALLOFF_COSINE;
    return light;
}

static inline void acrsm_fixture_rsm(struct acrsm_fixture *a, const struct irb_light *light)
{
    struct irb_error err = {0};
    const struct irb_importance_settings weights = {.diffuse_weight = 1};
    a->f.light = *light;
    REQUIRE_OK(irb_rsm_render(a->f.rsm, a->f.scene_gl, light, &err));
    REQUIRE_OK(irb_importance_compute(a->importance, a->f.rsm, light, NULL, &weights, &err));
    REQUIRE_OK(irb_pyramid_build(a->pyramid, a->importance->map, &err));
}

/* The steps of a frame up to mapping, and from there on. */
static inline void acrsm_fixture_begin_frame(struct acrsm_fixture *a)
{
    struct irb_error err = {0};
    const struct irb_rsm *rsm = a->f.rsm;
    REQUIRE_OK(acrsm_clusters_frame(a->clusters, rsm, &a->settings, &err));
    REQUIRE_OK(acrsm_evaluate(a->clusters, rsm, &a->settings, &err));
    REQUIRE_OK(acrsm_carry(a->clusters, rsm, &a->settings, &err));
    REQUIRE_OK(acrsm_seed(a->clusters, rsm, a->importance->map, a->pyramid, &a->settings, &err));
}

static inline void acrsm_fixture_end_frame(struct acrsm_fixture *a)
{
    struct irb_error err = {0};
    const struct irb_rsm *rsm = a->f.rsm;
    REQUIRE_OK(acrsm_map(a->clusters, rsm, a->importance->map, &a->settings, &err));
    REQUIRE_OK(
        acrsm_average(a->clusters, rsm, &a->f.light, a->importance->map, &a->settings, &err));
}

static inline void acrsm_fixture_frame(struct acrsm_fixture *a)
{
    acrsm_fixture_begin_frame(a);
    acrsm_fixture_end_frame(a);
}

static inline struct acrsm_report acrsm_fixture_report(struct acrsm_fixture *a)
{
    struct irb_error err = {0};
    struct acrsm_report report;
    REQUIRE_OK(acrsm_clusters_report(a->clusters, a->f.rsm, &report, &err));
    return report;
}

static inline void acrsm_fixture_state(const struct acrsm_fixture *a,
                                       struct acrsm_cluster state[ACRSM_CLUSTERS_MOST])
{
    struct irb_error err = {0};
    REQUIRE_OK(irb_buffer_read(a->clusters->state, 0, ACRSM_CLUSTERS_MOST * (int64_t)sizeof *state,
                               state, &err));
}

/* Red and green of the texels, row by row from the bottom; the caller frees it. */
static inline int32_t *acrsm_fixture_map(const struct acrsm_fixture *a)
{
    const size_t bytes = (size_t)a->resolution * (size_t)a->resolution * 8;
    int32_t *map = malloc(bytes);
    a->gl->api.MemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    a->gl->api.GetTextureImage(a->clusters->map->id, 0, GL_RG_INTEGER, GL_UNSIGNED_INT,
                               (GLsizei)bytes, map);
    assert_int_equal(a->gl->api.GetError(), GL_NO_ERROR);
    return map;
}

/* What the clustering reads, texel by texel. */
struct acrsm_texels {
    int resolution;
    struct irb_image position, normal, flux, importance;
};

static inline struct acrsm_texels acrsm_fixture_texels(const struct acrsm_fixture *a)
{
    return (struct acrsm_texels){.resolution = a->resolution,
                                 .position = fixture_read(a->f.rsm->position, 4),
                                 .normal = fixture_read(a->f.rsm->normal, 4),
                                 .flux = fixture_read(a->f.rsm->flux, 4),
                                 .importance = fixture_read(a->importance->map, 1)};
}

static inline void acrsm_texels_destroy(struct acrsm_texels *t)
{
    irb_image_destroy(&t->position);
    irb_image_destroy(&t->normal);
    irb_image_destroy(&t->flux);
    irb_image_destroy(&t->importance);
}

/* Texel `p` of the map's order; images have their first row at the top. */
static inline const float *acrsm_texel(const struct irb_image *image, int p)
{
    return irb_image_at(image, p % image->width, image->height - 1 - p / image->width);
}

static inline bool acrsm_is_lit(const struct acrsm_texels *t, int p)
{
    const float *flux = acrsm_texel(&t->flux, p);
    return flux[0] > 0 || flux[1] > 0 || flux[2] > 0;
}

/* Texel of a cluster's centre; in single precision, since means often lie on a border of texels. */
static inline int acrsm_centre_x(const struct acrsm_cluster *c, int resolution)
{
    const float x = c->uv[0] * (float)resolution;
    return x < (float)resolution ? (int)x : resolution - 1;
}

static inline int acrsm_centre_y(const struct acrsm_cluster *c, int resolution)
{
    const float y = c->uv[1] * (float)resolution;
    return y < (float)resolution ? (int)y : resolution - 1;
}

/* Whether texel (x, y) lies in the square of `side` texels round the cluster's centre: from
 * side/2 texels before it on. */
static inline bool acrsm_in_square(const struct acrsm_cluster *c, int x, int y, int side,
                                   int resolution)
{
    int left = acrsm_centre_x(c, resolution) - side / 2;
    int bottom = acrsm_centre_y(c, resolution) - side / 2;
    return x >= left && x < left + side && y >= bottom && y < bottom + side;
}

#endif
