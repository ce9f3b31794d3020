/* SPDX-License-Identifier: MIT */
#include "core/scene/light.h"

#include "core/scene/vec.h"

#include <string.h>

const char *const irb_light_type_names[] = {"spot", "directional", NULL};
const char *const irb_falloff_names[] = {"constant", "smooth", "cosine", NULL};

/* KHR_lights_punctual divides by max(0.001, cos inner - cos outer). */
#define SMOOTH_MIN_WIDTH 0.001

static double smooth_width(const struct irb_light *light)
{
    return fmax(SMOOTH_MIN_WIDTH, cos((double)light->inner) - cos((double)light->outer));
}

/* The frame that the shortest rotation from straight down to `direction` takes along: continuous
 * in every direction but straight up, so that the image of a moving light never jumps (a switch of
 * the up vector would show as flicker of the methods that sample in it). */
void irb_light_basis(const struct irb_light *light, float right[3], float up[3])
{
    double d[3], k, across;

    vec_from_float(light->direction, d);
    across = d[0] * d[0] + d[2] * d[2];
    if (d[1] > 0 && across == 0) {
        memcpy(right, (const float[3]){1, 0, 0}, 3 * sizeof(float));
        memcpy(up, (const float[3]){0, 0, 1}, 3 * sizeof(float));
        return;
    }
    /* 1/(1 - d_y); above the horizon without the cancellation */
    k = d[1] > 0 ? (1 + d[1]) / across : 1 / (1 - d[1]);
    right[0] = (float)(1 - d[0] * d[0] * k);
    right[1] = (float)d[0];
    right[2] = (float)(-d[0] * d[2] * k);
    up[0] = (float)(d[0] * d[2] * k);
    up[1] = (float)-d[2];
    up[2] = (float)(d[2] * d[2] * k - 1);
}

double irb_light_falloff(const struct irb_light *light, double cos_theta)
{
    double cos_outer = cos((double)light->outer);

    if (!(cos_theta >= cos_outer))
        return 0;
    switch (light->falloff) {
    case IRB_FALLOFF_SMOOTH: {
        double attenuation = fmin(1, (cos_theta - cos_outer) / smooth_width(light));

        return attenuation * attenuation;
    }
    case IRB_FALLOFF_COSINE:
        return cos_theta / cos_outer;
    case IRB_FALLOFF_CONSTANT:
    default:
        return 1;
    }
}

/* Integral of the falloff over the solid angle of the cone, sr: 2 pi int_{cos outer}^1 f(c) dc. */
static double falloff_integral(const struct irb_light *light)
{
    double cos_outer = cos((double)light->outer);
    /* 1 - cos, without the cancellation for narrow cones */
    double cap = 2 * sin(light->outer / 2.0) * sin(light->outer / 2.0);

    switch (light->falloff) {
    case IRB_FALLOFF_SMOOTH: {
        double width = smooth_width(light);

        if (width >= cap) /* the inner cone is narrower than the clamp allows: f < 1 on the axis */
            return 2 * M_PI * cap * cap * cap / (3 * width * width);
        return 2 * M_PI * (cap - width + width / 3);
    }
    case IRB_FALLOFF_COSINE:
        return M_PI * sin((double)light->outer) * sin((double)light->outer) / cos_outer;
    case IRB_FALLOFF_CONSTANT:
    default:
        return 2 * M_PI * cap;
    }
}

void irb_light_power(const struct irb_light *light, double watts[3])
{
    double width = 2 * (double)light->half_width;
    double measure = light->type == IRB_LIGHT_DIRECTIONAL ? width * width : falloff_integral(light);

    for (int i = 0; i < 3; i++)
        watts[i] = light->intensity[i] * measure;
}

static double spot_factor(const struct irb_light *light, const double offset[3],
                          const double direction[3], double to_light[3], double *distance)
{
    double r = vec_length(offset);

    *distance = r;
    if (!(r > 0)) {
        for (int i = 0; i < 3; i++)
            to_light[i] = -direction[i];
        return 0;
    }
    for (int i = 0; i < 3; i++)
        to_light[i] = -offset[i] / r;
    return irb_light_falloff(light, -vec_dot(to_light, direction)) / (r * r);
}

static double beam_factor(const struct irb_light *light, const double offset[3],
                          const double direction[3], double to_light[3], double *distance)
{
    float basis[2][3];

    for (int i = 0; i < 3; i++)
        to_light[i] = -direction[i];
    *distance = vec_dot(offset, direction);
    if (!(*distance > 0))
        return 0;
    irb_light_basis(light, basis[0], basis[1]);
    for (int side = 0; side < 2; side++) {
        double axis[3];

        vec_from_float(basis[side], axis);
        if (!(fabs(vec_dot(offset, axis)) <= light->half_width))
            return 0;
    }
    return 1;
}

void irb_light_incident(const struct irb_light *light, const float point[3], float irradiance[3],
                        float to_light[3], float *distance)
{
    double offset[3], direction[3], towards[3], way, factor;

    for (int i = 0; i < 3; i++) {
        offset[i] = (double)point[i] - light->position[i];
        direction[i] = light->direction[i];
    }
    factor = light->type == IRB_LIGHT_DIRECTIONAL
                 ? beam_factor(light, offset, direction, towards, &way)
                 : spot_factor(light, offset, direction, towards, &way);
    for (int i = 0; i < 3; i++)
        irradiance[i] = (float)(light->intensity[i] * factor);
    vec_to_float(towards, to_light);
    *distance = (float)way;
}

/* Only what the light's type and falloff use, so that an unused field never misses a cache. */
void irb_light_hash(const struct irb_light *light, struct irb_hash *hash)
{
    irb_hash_string(hash, "light 1");
    irb_hash_u64(hash, (uint64_t)light->type);
    irb_hash_floats(hash, light->position, 3);
    irb_hash_floats(hash, light->direction, 3);
    irb_hash_floats(hash, light->intensity, 3);
    if (light->type == IRB_LIGHT_DIRECTIONAL) {
        irb_hash_floats(hash, &light->half_width, 1);
        return;
    }
    irb_hash_u64(hash, (uint64_t)light->falloff);
    irb_hash_floats(hash, &light->outer, 1);
    if (light->falloff == IRB_FALLOFF_SMOOTH)
        irb_hash_floats(hash, &light->inner, 1);
}
