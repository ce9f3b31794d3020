/* SPDX-License-Identifier: MIT
 *
 * The reflective shadow map: solid angles, flux, positions, against closed forms.
 */
#include "tests/support/compare.h"
#include "tests/frame/fixture.h"

static struct irb_gl *gl;

static struct irb_rsm *render(struct irb_scene *scene, const struct irb_light *light,
                              int resolution)
{
    struct irb_error err = {0};
    struct irb_scene_gl *scene_gl = irb_scene_gl_create(gl, scene, &err);
    REQUIRE_OK(scene_gl);
    struct irb_rsm *rsm = irb_rsm_create(gl, resolution, &err);
    REQUIRE_OK(rsm);
    REQUIRE_OK(irb_rsm_render(rsm, scene_gl, light, &err));
    irb_scene_gl_destroy(scene_gl);
    return rsm;
}

/* Solid angle of [x0,x1] x [y0,y1] at z = 1 from its four corners, in double precision. */
static double rectangle_solid_angle(double x0, double y0, double x1, double y1)
{
    const double x[2] = {x0, x1}, y[2] = {y0, y1};
    double sum = 0;
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++)
            sum += (i == j ? 1 : -1) * atan(x[i] * y[j] / sqrt(1 + x[i] * x[i] + y[j] * y[j]));
    return sum;
}

/* Every texel's solid angle by another formula; cones from narrow to nearly a half space. */
static void test_texel_solid_angles(void **state)
{
    (void)state;
    const float grey[3] = {0.5f, 0.5f, 0.5f};
    const double cones[] = {1, 20, 45, 80};
    const int resolutions[] = {1, 2, 7, 64};
    struct irb_scene *scene = fixture_floor(1000, grey);
    for (int c = 0; c < 4; c++)
        for (int k = 0; k < 4; k++) {
            struct irb_light light = fixture_spot((float[]){0, 1, 0}, (float[]){0, 0, 0}, cones[c]);
            int n = resolutions[k];
            double t = tan((double)light.outer), side = 2 * t / n;
            struct irb_rsm *rsm = render(scene, &light, n);
            struct irb_image flux = fixture_read(rsm->flux, 4);
            for (int y = 0; y < n; y++)
                for (int x = 0; x < n; x++) {
                    double x0 = x * side - t, y0 = t - (y + 1) * side;
                    double angle = rectangle_solid_angle(x0, y0, x0 + side, y0 + side);
                    double cx = x0 + side / 2, cy = y0 + side / 2;
                    double rim = sqrt(cx * cx + cy * cy) / t;
                    const float *found = irb_image_at(&flux, x, y);
                    if (fabs(rim - 1) < 1e-4)
                        continue;
                    if (rim > 1) {
                        REQUIRE_NEAR(found[0] + found[1] + found[2] + found[3], 0, 0);
                        continue;
                    }
                    /* the four corners cancel in the oracle itself for tiny texels */
                    REQUIRE_NEAR(found[3], 2 * angle, 4e-6 * angle + 1e-14);
                    for (int i = 0; i < 3; i++)
                        REQUIRE_REL(found[i], 0.5 * (3 - i) * angle, 4e-6 + 1e-14 / angle);
                }
            irb_image_destroy(&flux);
            irb_rsm_destroy(rsm);
        }
    irb_scene_destroy(scene);
}

/* Sum of the reflected flux = albedo * power of the light, inside closed scenes of one albedo. */
static void test_flux_sum(void **state)
{
    (void)state;
    const char *const names[] = {"sphere", "furnace"};
    const double cones[] = {15, 35, 75};
    for (int s = 0; s < 2; s++) {
        struct irb_scene *scene = fixture_scene(names[s]);
        for (int c = 0; c < 3; c++)
            for (int falloff = 0; falloff < 3; falloff++) {
                struct irb_light light =
                    fixture_spot((float[]){0.3f, 0.4f, 0.2f}, (float[]){-0.3f, -1, 0.5f}, cones[c]);
                light.falloff = (enum irb_falloff)falloff;
                double power[3];
                irb_light_power(&light, power);
                struct irb_rsm *rsm = render(scene, &light, 256);
                struct irb_image flux = fixture_read(rsm->flux, 4);
                for (int i = 0; i < 3; i++)
                    REQUIRE_REL(fixture_sum(&flux, i), 0.5 * power[i], 5e-3);
                REQUIRE_REL(fixture_sum(&flux, 3), (power[0] + power[1] + power[2]) / 3, 5e-3);
                irb_image_destroy(&flux);
                irb_rsm_destroy(rsm);
            }
        irb_scene_destroy(scene);
    }
}

/* A beam: every texel gets E times its area; it starts at the light's plane, so that the upper
 * square behind it stays dark. */
static void test_directional(void **state)
{
    (void)state;
    struct irb_scene *scene = fixture_scene("squares");
    struct irb_light light;
    struct irb_camera camera;
    fixture_view(scene, &light, &camera);
    double power[3];
    irb_light_power(&light, power);
    struct irb_rsm *rsm = render(scene, &light, 50);
    struct irb_image flux = fixture_read(rsm->flux, 4), position = fixture_read(rsm->position, 4);
    struct irb_image normal = fixture_read(rsm->normal, 4);
    for (int i = 0; i < 3; i++)
        REQUIRE_REL(fixture_sum(&flux, i), 0.5 * power[i], 1e-5);
    for (size_t i = 0; i < irb_image_pixels(&flux); i++) {
        REQUIRE_REL(flux.data[4 * i], 0.5 * power[0] / 2500, 1e-6);
        REQUIRE_NEAR(position.data[4 * i + 1], 0, 1e-6);
        REQUIRE_NEAR(normal.data[4 * i + 1], 1, 0);
        REQUIRE_NEAR(normal.data[4 * i + 3], 0.5, 1e-6);
    }
    irb_image_destroy(&flux);
    irb_image_destroy(&position);
    irb_image_destroy(&normal);
    irb_rsm_destroy(rsm);
    irb_scene_destroy(scene);
}

/* Positions lie on the texel's ray and on the plane, the normal on the lit side, the distance is
 * Euclidean: from both sides of a floor. */
static void test_positions(void **state)
{
    (void)state;
    const float grey[3] = {0.5f, 0.5f, 0.5f};
    struct irb_scene *scene = fixture_floor(30, grey);
    for (int side = -1; side <= 1; side += 2) {
        struct irb_light light =
            fixture_spot((float[]){0.2f, (float)side, -0.1f}, (float[]){0.7f, 0, 0.4f}, 40);
        float right[3], up[3];
        irb_light_basis(&light, right, up);
        struct irb_rsm *rsm = render(scene, &light, 33);
        struct irb_image position = fixture_read(rsm->position, 4);
        struct irb_image normal = fixture_read(rsm->normal, 4);
        double t = tan((double)light.outer);
        for (int y = 0; y < 33; y++)
            for (int x = 0; x < 33; x++) {
                double px = ((x + 0.5) / 33 * 2 - 1) * t, py = (1 - (y + 0.5) / 33 * 2) * t;
                double ray[3], r = 0;
                for (int i = 0; i < 3; i++) {
                    ray[i] = light.direction[i] + px * right[i] + py * up[i];
                    r += ray[i] * ray[i];
                }
                double k = -light.position[1] / ray[1];
                if (!(k > 0) || k > 20)
                    continue; /* misses the floor, or grazes it */
                for (int i = 0; i < 3; i++)
                    REQUIRE_NEAR(irb_image_at(&position, x, y)[i], light.position[i] + k * ray[i],
                                 1e-5 * k);
                REQUIRE_NEAR(irb_image_at(&normal, x, y)[1], side, 0);
                REQUIRE_REL(irb_image_at(&normal, x, y)[3], k * sqrt(r), 1e-5);
            }
        irb_image_destroy(&position);
        irb_image_destroy(&normal);
        irb_rsm_destroy(rsm);
    }
    irb_scene_destroy(scene);
}

/* Of two walls a part in 100 000 of the scene's size apart, the nearer one is seen everywhere. */
static void test_depth_precision(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct irb_builder builder;
    irb_builder_begin(&builder, "walls");
    const float dark[3] = {0, 0, 0}, bright[3] = {1, 1, 1};
    const int back = irb_builder_material(&builder, "back", dark);
    const int front = irb_builder_material(&builder, "front", bright);
    for (int i = 0; i < 2; i++) {
        const double y = i ? 1e-3 : 0, h = 50;
        const double corners[4][3] = {{-h, y, h}, {h, y, h}, {h, y, -h}, {-h, y, -h}};
        irb_builder_object(&builder, i ? "front" : "back", i ? front : back);
        irb_builder_quad(&builder, corners);
    }
    struct irb_scene *scene = irb_builder_finish(&builder, &err);
    REQUIRE_OK(scene);
    struct irb_light light = fixture_spot((float[]){0, 60, 0}, (float[]){0.3f, 0, 0.2f}, 30);
    struct irb_rsm *rsm = render(scene, &light, 64);
    struct irb_image flux = fixture_read(rsm->flux, 4);
    for (size_t i = 0; i < irb_image_pixels(&flux); i++)
        if (flux.data[4 * i + 3] > 0)
            REQUIRE_CMP(flux.data[4 * i], >, 0);
    irb_image_destroy(&flux);
    irb_rsm_destroy(rsm);
    irb_scene_destroy(scene);
}

/* The light looks away from everything. */
static void test_nothing_seen(void **state)
{
    (void)state;
    const float grey[3] = {0.5f, 0.5f, 0.5f};
    struct irb_scene *scene = fixture_floor(1, grey);
    struct irb_light light = fixture_spot((float[]){0, 1, 0}, (float[]){0, 2, 0}, 40);
    for (int type = 0; type < 2; type++) {
        light.type = (enum irb_light_type)type;
        light.half_width = 0.5f;
        struct irb_rsm *rsm = render(scene, &light, 9);
        const struct irb_texture *const layers[] = {rsm->position, rsm->normal, rsm->flux,
                                                    rsm->specular};
        for (int l = 0; l < 4; l++) {
            struct irb_image image = fixture_read(layers[l], 4);
            for (size_t i = 0; i < 4 * irb_image_pixels(&image); i++)
                REQUIRE_NEAR(image.data[i], 0, 0);
            irb_image_destroy(&image);
        }
        irb_rsm_destroy(rsm);
    }
    irb_scene_destroy(scene);
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_texel_solid_angles), cmocka_unit_test(test_flux_sum),
        cmocka_unit_test(test_directional),        cmocka_unit_test(test_positions),
        cmocka_unit_test(test_depth_precision),    cmocka_unit_test(test_nothing_seen),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failed;
}
