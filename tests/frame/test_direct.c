/* SPDX-License-Identifier: MIT
 *
 * Direct light and its shadows against the formula, evaluated here from positions in double.
 */
#include "tests/support/compare.h"
#include "core/frame/direct.h"
#include "tests/frame/fixture.h"

static struct irb_gl *gl;
static const float grey[3] = {0.5f, 0.25f, 0.75f};

static struct irb_image render(struct fixture_frame *f)
{
    struct irb_error err = {0};
    struct irb_direct *direct = irb_direct_create(gl, f->gbuffer->width, f->gbuffer->height, &err);
    REQUIRE_OK(direct);
    fixture_frame_render(f);
    REQUIRE_OK(irb_direct_render(direct, f->gbuffer, f->rsm, &f->light, &f->camera, &err));
    struct irb_image image = fixture_read(direct->radiance, 4);
    irb_direct_destroy(direct);
    return image;
}

/* L of the floor y = 0 at `at`: (k_d n.l + k_s (n.h)^alpha) I(theta)/(pi r^2). */
static double floor_radiance(const struct fixture_frame *f, const float at[3], int channel)
{
    const struct irb_material *m = &f->scene->materials[0];
    double l[3], h[3], r = 0, view = 0, hh = 0, axis = 0;
    for (int i = 0; i < 3; i++) {
        l[i] = (double)f->light.position[i] - at[i];
        h[i] = (double)f->camera.position[i] - at[i];
        r += l[i] * l[i];
        view += h[i] * h[i];
    }
    r = sqrt(r);
    for (int i = 0; i < 3; i++) {
        axis -= l[i] / r * f->light.direction[i];
        h[i] = h[i] / sqrt(view) + l[i] / r;
        hh += h[i] * h[i];
    }
    double c = cos((double)f->light.outer), falloff = axis < c ? 0 : axis / c;
    double brdf = m->diffuse[channel] * l[1] / r +
                  m->specular[channel] * pow(fmax(0, h[1] / sqrt(hh)), m->exponent);
    return brdf * f->light.intensity[channel] * falloff / (M_PI * r * r);
}

/* A floor without anything that could shade it: no acne either, at grazing light too. */
static void check_floor(double height, double tilt, int resolution)
{
    struct fixture_frame f;
    fixture_frame_create(&f, gl, fixture_floor(4, grey), 47, 31, resolution);
    memcpy(f.scene->materials[0].specular, (float[]){0.1f, 0.2f, 0.3f}, 12);
    f.scene->materials[0].exponent = 12;
    f.light = fixture_spot((float[]){0.1f, (float)height, 0.2f}, (float[]){(float)tilt, 0, 0}, 45);
    f.light.falloff = IRB_FALLOFF_COSINE;
    f.camera = fixture_camera((float[]){0, 3, 2}, (float[]){0, 0, 0}, (float[]){0, 1, 0}, 60);
    struct irb_image found = render(&f), position = fixture_read(f.gbuffer->position, 4);
    size_t lit = 0;
    for (size_t i = 0; i < irb_image_pixels(&found); i++) {
        const float *at = position.data + 4 * i;
        double rim = 0, r = 0;
        for (int k = 0; k < 3; k++) {
            rim += ((double)at[k] - f.light.position[k]) * f.light.direction[k];
            r += ((double)at[k] - f.light.position[k]) * ((double)at[k] - f.light.position[k]);
        }
        if (fabs(rim / sqrt(r) - cos((double)f.light.outer)) < 1e-4)
            continue;
        for (int c = 0; c < 3; c++) {
            double expected = at[3] > 0 ? floor_radiance(&f, at, c) : 0;
            REQUIRE_NEAR(found.data[4 * i + (size_t)c], expected, 2e-5 * expected);
            lit += expected > 0;
        }
    }
    REQUIRE_CMP(lit, >, 100);
    irb_image_destroy(&found);
    irb_image_destroy(&position);
    fixture_frame_destroy(&f);
}

static void test_floor(void **state)
{
    (void)state;
    check_floor(1.5, 0.1, 64);
    check_floor(1.5, 0.1, 512);
    check_floor(0.3, 2, 128);
    check_floor(0.3, 2, 16);
}

/* The light is below, the camera above: black. */
static void test_other_side(void **state)
{
    (void)state;
    struct fixture_frame f;
    fixture_frame_create(&f, gl, fixture_floor(4, grey), 20, 20, 64);
    f.light = fixture_spot((float[]){0, -1, 0}, (float[]){0, 0, 0}, 45);
    f.camera = fixture_camera((float[]){0, 3, 2}, (float[]){0, 0, 0}, (float[]){0, 1, 0}, 30);
    struct irb_image found = render(&f);
    for (int c = 0; c < 4; c++)
        REQUIRE_NEAR(fixture_sum(&found, c), 0, 0);
    irb_image_destroy(&found);
    fixture_frame_destroy(&f);
}

/* A square plate of half side 0.2 at height 1 under a lamp at height 2 (or a vertical beam): its
 * shadow is the square of half side 0.4 (0.2), soft over the filter's 5 texels. */
static void check_shadow(enum irb_light_type type)
{
    struct irb_error err = {0};
    struct irb_builder builder;
    irb_builder_begin(&builder, "plate");
    irb_builder_object(&builder, "floor", irb_builder_material(&builder, "m", grey));
    for (int i = 0; i < 2; i++) {
        const double h = i ? 0.2 : 3, y = i;
        const double corners[4][3] = {{-h, y, h}, {h, y, h}, {h, y, -h}, {-h, y, -h}};
        irb_builder_quad(&builder, corners);
    }
    struct irb_scene *scene = irb_builder_finish(&builder, &err);
    REQUIRE_OK(scene);
    struct fixture_frame f;
    fixture_frame_create(&f, gl, scene, 80, 60, 256);
    f.light = fixture_spot((float[]){0, 2, 0}, (float[]){0, 0, 0}, 35);
    f.light.type = type;
    f.light.half_width = 1.2f;
    f.camera = fixture_camera((float[]){0, 0.9f, 2.5f}, (float[]){0, 0, 0}, (float[]){0, 1, 0}, 45);
    struct irb_image found = render(&f), position = fixture_read(f.gbuffer->position, 4);
    const double half = type == IRB_LIGHT_SPOT ? 0.4 : 0.2;
    /* half a 5-texel kernel and half a texel, on the floor */
    const double reach =
        3 * 2 * (type == IRB_LIGHT_SPOT ? 2 * tan((double)f.light.outer) : 1.2) / 256;
    size_t dark = 0, lit = 0;
    for (size_t i = 0; i < irb_image_pixels(&found); i++) {
        const float *at = position.data + 4 * i;
        double edge = fmax(fabs(at[0]), fabs(at[2])) - half;
        double rim = type == IRB_LIGHT_SPOT ? hypot(at[0], at[2]) / (2 * tan(f.light.outer))
                                            : fmax(fabs(at[0]), fabs(at[2])) / 1.2;
        if (at[3] == 0 || at[1] > 0.5f || rim > 0.99)
            continue;
        if (edge < -reach) {
            REQUIRE_NEAR(found.data[4 * i], 0, 0);
            dark++;
        } else if (edge > reach) {
            double r = sqrt(at[0] * at[0] + at[2] * at[2] + 4.0);
            double expected =
                type == IRB_LIGHT_SPOT ? 0.5 * 3 / M_PI * (2 / r) / (r * r) : 0.5 * 3 / M_PI;
            REQUIRE_REL(found.data[4 * i], expected, 2e-5);
            lit++;
        }
    }
    REQUIRE_CMP(dark, >, 20);
    REQUIRE_CMP(lit, >, 200);
    irb_image_destroy(&found);
    irb_image_destroy(&position);
    fixture_frame_destroy(&f);
}

static void test_shadow(void **state)
{
    (void)state;
    check_shadow(IRB_LIGHT_SPOT);
    check_shadow(IRB_LIGHT_DIRECTIONAL);
}

/* The inside of the sphere is lit all over the cone: no acne on curved, smooth-shaded triangles. */
static void test_no_acne(void **state)
{
    (void)state;
    struct fixture_frame f;
    struct irb_scene *scene = fixture_scene("sphere");
    fixture_frame_create(&f, gl, scene, 64, 48, 128);
    fixture_view(scene, &f.light, &f.camera);
    struct irb_image found = render(&f), position = fixture_read(f.gbuffer->position, 4);
    size_t lit = 0;
    for (size_t i = 0; i < irb_image_pixels(&found); i++) {
        float irradiance[3], to_light[3], distance;
        irb_light_incident(&f.light, position.data + 4 * i, irradiance, to_light, &distance);
        double n_l = -fixture_dot(position.data + 4 * i, to_light);
        if (!(irradiance[0] > 0) || n_l < 0.05)
            continue;
        lit++;
        REQUIRE_REL(found.data[4 * i], 0.5 * n_l * irradiance[0] / M_PI, 2e-3);
    }
    REQUIRE_CMP(lit, >, 100);
    irb_image_destroy(&found);
    irb_image_destroy(&position);
    fixture_frame_destroy(&f);
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_floor),
        cmocka_unit_test(test_other_side),
        cmocka_unit_test(test_shadow),
        cmocka_unit_test(test_no_acne),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failed;
}
