/* SPDX-License-Identifier: MIT */
#include "tests/reference/fixture.h"
#include "core/reference/tracer.h"
#include "core/scene/builtin.h"
#include "tests/support/compare.h"

#include <string.h>

static void to_float(const double from[3], float to[3])
{
    for (int i = 0; i < 3; i++)
        to[i] = (float)from[i];
}

void fixture_create(struct fixture *fixture, struct irb_scene *scene)
{
    struct irb_error err = {0};
    *fixture = (struct fixture){.scene = scene};
    assert_non_null(scene);
    fixture->tracer = irb_tracer_create(scene, &err);
    if (!fixture->tracer)
        fail_msg("%s", err.message);
    irb_options_default(irb_reference_options, &fixture->settings);
    fixture->settings.min_samples = fixture->settings.max_samples = 64;
    fixture->settings.noise = 0;
    fixture->settings.bounces = 1;
    fixture->camera = (struct irb_camera){
        .target = {0, 0, -1}, .up = {0, 1, 0}, .vertical_fov = 1, .z_near = 0.01f, .z_far = 100};
}

void fixture_destroy(struct fixture *fixture)
{
    irb_gbuffer_image_destroy(&fixture->gbuffer);
    irb_tracer_destroy(fixture->tracer);
    irb_scene_destroy(fixture->scene);
    *fixture = (struct fixture){0};
}

void fixture_builtin(struct fixture *fixture, const char *name)
{
    struct irb_error err = {0};
    const struct irb_builtin *builtin = irb_builtin_find(name);
    assert_non_null(builtin);
    struct irb_animation animation;
    fixture_create(fixture, builtin->build(&err));
    builtin->view(&animation);
    irb_animation_light(&animation, fixture->scene, 0, &fixture->light);
    irb_animation_camera(&animation, fixture->scene, 0, &fixture->camera);
    irb_animation_destroy(&animation);
}

static void aim(struct irb_light *light, const double position[3], const double target[3])
{
    double d[3] = {target[0] - position[0], target[1] - position[1], target[2] - position[2]};
    double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    to_float(position, light->position);
    for (int i = 0; i < 3; i++)
        light->direction[i] = (float)(d[i] / length);
}

void fixture_spot(struct fixture *fixture, const double position[3], const double target[3],
                  double half_angle_degrees, double intensity)
{
    float i = (float)intensity;
    fixture->light = (struct irb_light){.type = IRB_LIGHT_SPOT, .intensity = {i, i, i}};
    fixture->light.outer = (float)(half_angle_degrees * M_PI / 180);
    aim(&fixture->light, position, target);
}

void fixture_beam(struct fixture *fixture, const double position[3], const double target[3],
                  double half_width, double intensity)
{
    float i = (float)intensity;
    fixture->light = (struct irb_light){.type = IRB_LIGHT_DIRECTIONAL, .intensity = {i, i, i}};
    fixture->light.half_width = (float)half_width;
    aim(&fixture->light, position, target);
}

void fixture_gbuffer(struct fixture *fixture, int width, int height)
{
    struct irb_error err = {0};
    irb_gbuffer_image_destroy(&fixture->gbuffer);
    REQUIRE_OK(irb_gbuffer_image_create(&fixture->gbuffer, width, height, &err));
}

void fixture_point(struct fixture *fixture, int x, int y, const double position[3],
                   const double normal[3])
{
    struct irb_gbuffer_image *g = &fixture->gbuffer;
    to_float(position, irb_image_at(&g->position, x, y));
    irb_image_at(&g->position, x, y)[3] = 1;
    to_float(normal, irb_image_at(&g->normal, x, y));
    to_float(normal, irb_image_at(&g->geometric, x, y));
    for (int c = 0; c < 3; c++)
        irb_image_at(&g->diffuse, x, y)[c] = 0.5f;
    irb_image_at(&g->specular, x, y)[3] = 1;
}

static void look_at_pixel(struct fixture *fixture, struct trace_context *context,
                          struct vec3 direction, int x, int y)
{
    struct irb_gbuffer_image *g = &fixture->gbuffer;
    struct trace_hit hit;
    struct surface_point p;
    struct trace_ray ray = {
        .origin = v3_load(fixture->camera.position), .direction = direction, .far = INFINITY};
    trace_closest(context, &ray, 1, &hit);
    if (hit.triangle == TRACE_MISS)
        return;
    surface_at(context->surfaces, hit.triangle, hit.u, hit.v, direction, &p);
    memcpy(irb_image_at(&g->position, x, y), &p.position, 3 * sizeof(float));
    irb_image_at(&g->position, x, y)[3] = 1;
    memcpy(irb_image_at(&g->normal, x, y), &p.shading, 3 * sizeof(float));
    memcpy(irb_image_at(&g->geometric, x, y), &p.geometric, 3 * sizeof(float));
    memcpy(irb_image_at(&g->diffuse, x, y), &p.diffuse, 3 * sizeof(float));
    irb_image_at(&g->specular, x, y)[3] = 1;
}

void fixture_look(struct fixture *fixture, int width, int height)
{
    const struct irb_camera *camera = &fixture->camera;
    struct trace_context context = {.tracer = fixture->tracer,
                                    .surfaces = irb_tracer_surfaces(fixture->tracer)};
    struct vec3 forward =
        v3_normalize_safe(v3_sub(v3_load(camera->target), v3_load(camera->position)));
    struct vec3 right = v3_normalize_safe(v3_cross(forward, v3_load(camera->up)));
    struct vec3 up = v3_cross(right, forward);
    float size = tanf(camera->vertical_fov / 2), aspect = (float)width / (float)height;
    fixture_gbuffer(fixture, width, height);
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            float a = (2 * ((float)x + 0.5f) / (float)width - 1) * size * aspect;
            float b = (1 - 2 * ((float)y + 0.5f) / (float)height) * size;
            struct vec3 d = v3_normalize_safe(v3_mad(v3_mad(forward, a, right), b, up));
            look_at_pixel(fixture, &context, d, x, y);
        }
    }
}

bool fixture_render(struct fixture *fixture, struct irb_reference_image *out, struct irb_error *err)
{
    struct irb_reference_job job = {
        .tracer = fixture->tracer,
        .light = &fixture->light,
        .camera = &fixture->camera,
        .gbuffer = &fixture->gbuffer,
        .settings = &fixture->settings,
        .threads = fixture->threads,
        .checkpoint = fixture->checkpoint,
        .stop = fixture->stop,
    };
    return irb_reference_render(&job, out, err);
}

void fixture_must_render(struct fixture *fixture, struct irb_reference_image *out)
{
    struct irb_error err = {0};
    REQUIRE_OK(fixture_render(fixture, out, &err));
}

double fixture_mean(const struct irb_image *image)
{
    double sum = 0;
    for (size_t i = 0; i < irb_image_pixels(image); i++)
        sum += (double)image->data[i * (size_t)image->channels];
    return sum / (double)irb_image_pixels(image);
}

double fixture_rmse(const struct irb_image *a, const struct irb_image *b)
{
    double sum = 0;
    size_t count = irb_image_pixels(a) * (size_t)a->channels;
    for (size_t i = 0; i < count; i++)
        sum +=
            ((double)a->data[i] - (double)b->data[i]) * ((double)a->data[i] - (double)b->data[i]);
    return sqrt(sum / (double)count);
}
