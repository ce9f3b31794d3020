/* SPDX-License-Identifier: MIT
 *
 * Small scenes, lights and cameras for tests of the frame, the virtual lights and the methods.
 * Include after compare.h.
 */
#ifndef IRB_TESTS_FRAME_FIXTURE_H
#define IRB_TESTS_FRAME_FIXTURE_H

#include "core/frame/gbuffer.h"
#include "core/frame/rsm.h"
#include "core/scene/builder.h"
#include "core/scene/builtin.h"
#include "tests/gl/fixture.h"

#include <math.h>

/* A scene of one quad (corners counter-clockwise seen from its front) with the given albedo. */
static inline struct irb_scene *fixture_quad(const double corners[4][3], const float diffuse[3])
{
    struct irb_error err = {0};
    struct irb_builder builder;
    irb_builder_begin(&builder, "quad");
    irb_builder_object(&builder, "quad", irb_builder_material(&builder, "m", diffuse));
    irb_builder_quad(&builder, corners);
    struct irb_scene *scene = irb_builder_finish(&builder, &err);
    REQUIRE_OK(scene);
    return scene;
}

/* y = 0 over [-half, half]^2, front up. */
static inline struct irb_scene *fixture_floor(double half, const float diffuse[3])
{
    const double corners[4][3] = {
        {-half, 0, half}, {half, 0, half}, {half, 0, -half}, {-half, 0, -half}};
    return fixture_quad(corners, diffuse);
}

static inline struct irb_scene *fixture_scene(const char *name)
{
    struct irb_error err = {0};
    struct irb_scene *scene = irb_scene_load(name, NULL, &err);
    REQUIRE_OK(scene);
    return scene;
}

/* The default view of a built-in. */
static inline void fixture_view(const struct irb_scene *scene, struct irb_light *light,
                                struct irb_camera *camera)
{
    struct irb_animation animation;
    irb_builtin_find(scene->name)->view(&animation);
    irb_animation_light(&animation, scene, 0, light);
    irb_animation_camera(&animation, scene, 0, camera);
    irb_animation_destroy(&animation);
}

static inline struct irb_light fixture_spot(const float position[3], const float target[3],
                                            double cone_degrees)
{
    struct irb_light light = {.type = IRB_LIGHT_SPOT,
                              .intensity = {3, 2, 1},
                              .outer = (float)(cone_degrees * M_PI / 180),
                              .inner = (float)(cone_degrees * M_PI / 360)};
    double length = 0;
    for (int i = 0; i < 3; i++) {
        light.position[i] = position[i];
        light.direction[i] = target[i] - position[i];
        length += (double)light.direction[i] * light.direction[i];
    }
    for (int i = 0; i < 3; i++)
        light.direction[i] = (float)(light.direction[i] / sqrt(length));
    return light;
}

static inline struct irb_camera fixture_camera(const float position[3], const float target[3],
                                               const float up[3], double fov_degrees)
{
    struct irb_camera camera = {
        .vertical_fov = (float)(fov_degrees * M_PI / 180), .z_near = 0.01f, .z_far = 100};
    memcpy(camera.position, position, sizeof camera.position);
    memcpy(camera.target, target, sizeof camera.target);
    memcpy(camera.up, up, sizeof camera.up);
    return camera;
}

/* One frame's inputs on the GPU. */
struct fixture_frame {
    struct irb_scene *scene; /* owned */
    struct irb_scene_gl *scene_gl;
    struct irb_gbuffer *gbuffer;
    struct irb_rsm *rsm;
    struct irb_light light;
    struct irb_camera camera;
};

static inline void fixture_frame_create(struct fixture_frame *f, struct irb_gl *gl,
                                        struct irb_scene *scene, int width, int height,
                                        int resolution)
{
    struct irb_error err = {0};
    f->scene = scene;
    REQUIRE_OK(f->scene_gl = irb_scene_gl_create(gl, scene, &err));
    REQUIRE_OK(f->gbuffer = irb_gbuffer_create(gl, width, height, &err));
    REQUIRE_OK(f->rsm = irb_rsm_create(gl, resolution, &err));
}

static inline void fixture_frame_render(struct fixture_frame *f)
{
    struct irb_error err = {0};
    REQUIRE_OK(irb_gbuffer_render(f->gbuffer, f->scene_gl, &f->camera, &err));
    REQUIRE_OK(irb_rsm_render(f->rsm, f->scene_gl, &f->light, &err));
}

static inline void fixture_frame_destroy(struct fixture_frame *f)
{
    irb_rsm_destroy(f->rsm);
    irb_gbuffer_destroy(f->gbuffer);
    irb_scene_gl_destroy(f->scene_gl);
    irb_scene_destroy(f->scene);
}

static inline struct irb_image fixture_read(const struct irb_texture *texture, int channels)
{
    struct irb_error err = {0};
    struct irb_image image;
    REQUIRE_OK(irb_texture_read(texture, channels, &image, &err));
    return image;
}

/* Sum of one channel in double precision. */
static inline double fixture_sum(const struct irb_image *image, int channel)
{
    double sum = 0;
    for (size_t i = 0; i < irb_image_pixels(image); i++)
        sum += image->data[i * (size_t)image->channels + (size_t)channel];
    return sum;
}

static inline double fixture_dot(const float a[3], const float b[3])
{
    return (double)a[0] * b[0] + (double)a[1] * b[1] + (double)a[2] * b[2];
}

#endif
