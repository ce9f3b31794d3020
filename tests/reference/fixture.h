/* SPDX-License-Identifier: MIT
 *
 * Scenes, lights and G-buffers without OpenGL for the tests of the reference.
 */
#ifndef IRB_TESTS_REFERENCE_FIXTURE_H
#define IRB_TESTS_REFERENCE_FIXTURE_H

#include "core/reference/reference.h"
#include "core/scene/builder.h"

/* A scene, its tracer, a light, and points to shade. */
struct fixture {
    struct irb_scene *scene;
    struct irb_tracer *tracer;
    struct irb_light light;
    struct irb_camera camera;
    struct irb_gbuffer_image gbuffer;
    struct irb_reference_settings settings; /* the defaults, noise 0, 64 samples, bounces 1 */
    int threads;
    const char *checkpoint;
    const volatile sig_atomic_t *stop;
};

/* All of these fail the running test when something goes wrong. */

/* Takes over the scene (from irb_builder_finish or a built-in's build). */
void fixture_create(struct fixture *fixture, struct irb_scene *scene);
void fixture_destroy(struct fixture *fixture);
/* A built-in scene with its default light and camera. */
void fixture_builtin(struct fixture *fixture, const char *name);

void fixture_spot(struct fixture *fixture, const double position[3], const double target[3],
                  double half_angle_degrees, double intensity);
void fixture_beam(struct fixture *fixture, const double position[3], const double target[3],
                  double half_width, double intensity);

/* An empty G-buffer, and one point of it: normals of any length, k_d = 1/2. */
void fixture_gbuffer(struct fixture *fixture, int width, int height);
void fixture_point(struct fixture *fixture, int x, int y, const double position[3],
                   const double normal[3]);
/* What the camera sees, by tracing rays through pixel centres. */
void fixture_look(struct fixture *fixture, int width, int height);

bool fixture_render(struct fixture *fixture, struct irb_reference_image *out,
                    struct irb_error *err);
/* Must succeed. */
void fixture_must_render(struct fixture *fixture, struct irb_reference_image *out);

/* Mean of channel 0 over all pixels. */
double fixture_mean(const struct irb_image *image);
/* sqrt(mean (a-b)^2) over all values. */
double fixture_rmse(const struct irb_image *a, const struct irb_image *b);

#endif
