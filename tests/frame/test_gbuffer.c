/* SPDX-License-Identifier: MIT
 *
 * The camera's G-buffer against rays that the test casts itself, in double precision.
 */
#include "tests/support/compare.h"
#include "tests/frame/fixture.h"

static struct irb_gl *gl;
static const float grey[3] = {0.5f, 0.25f, 0.75f};

/* Direction of the ray through the centre of pixel (x, y), row 0 at the top; not normalised. */
static void camera_ray(const struct irb_camera *c, int width, int height, int x, int y,
                       double out[3])
{
    double f[3], r[3], u[3], length = 0;
    for (int i = 0; i < 3; i++) {
        f[i] = (double)c->target[i] - c->position[i];
        length += f[i] * f[i];
    }
    for (int i = 0; i < 3; i++)
        f[i] /= sqrt(length);
    length = 0;
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        r[i] = f[j] * c->up[k] - f[k] * c->up[j];
        length += r[i] * r[i];
    }
    for (int i = 0; i < 3; i++)
        r[i] /= sqrt(length);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        u[i] = r[j] * f[k] - r[k] * f[j];
    }
    double t = tan(c->vertical_fov / 2.0);
    double px = ((x + 0.5) / width * 2 - 1) * t * width / height;
    double py = (1 - (y + 0.5) / height * 2) * t;
    for (int i = 0; i < 3; i++)
        out[i] = f[i] + px * r[i] + py * u[i];
}

static struct irb_gbuffer_image render(struct irb_scene *scene, const struct irb_camera *camera,
                                       int width, int height)
{
    struct irb_error err = {0};
    struct irb_gbuffer_image image;
    struct irb_scene_gl *scene_gl = irb_scene_gl_create(gl, scene, &err);
    REQUIRE_OK(scene_gl);
    struct irb_gbuffer *gbuffer = irb_gbuffer_create(gl, width, height, &err);
    REQUIRE_OK(gbuffer);
    REQUIRE_OK(irb_gbuffer_render(gbuffer, scene_gl, camera, &err));
    REQUIRE_OK(irb_gbuffer_read(gbuffer, &image, &err));
    irb_gbuffer_destroy(gbuffer);
    irb_scene_gl_destroy(scene_gl);
    return image;
}

static void require_empty(const struct irb_gbuffer_image *g, size_t i)
{
    for (size_t c = 0; c < 4; c++) {
        REQUIRE_NEAR(g->position.data[4 * i + c], 0, 0);
        REQUIRE_NEAR(g->normal.data[4 * i + c], 0, 0);
        REQUIRE_NEAR(g->specular.data[4 * i + c], 0, 0);
        if (c < 3) {
            REQUIRE_NEAR(g->geometric.data[3 * i + c], 0, 0);
            REQUIRE_NEAR(g->diffuse.data[3 * i + c], 0, 0);
        }
    }
}

/* The quad y = 0 over [-half, half]^2, seen from any side: every value of every pixel. */
static void check_floor(const struct irb_camera *camera, int width, int height, double half)
{
    struct irb_scene *scene = fixture_floor(half, grey);
    memcpy(scene->materials[0].specular, (float[]){0.1f, 0.2f, 0.3f}, 12);
    scene->materials[0].exponent = 17;
    struct irb_gbuffer_image g = render(scene, camera, width, height);
    const float side = camera->position[1] > 0 ? 1 : -1;
    size_t covered = 0;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            size_t i = (size_t)y * (size_t)width + (size_t)x;
            double ray[3], at[3], r = 0;
            camera_ray(camera, width, height, x, y, ray);
            double t = -camera->position[1] / ray[1];
            for (int k = 0; k < 3; k++) {
                at[k] = camera->position[k] + t * ray[k];
                r += (at[k] - camera->position[k]) * (at[k] - camera->position[k]);
            }
            double rim = fmax(fabs(at[0]), fabs(at[2])) / half;
            if (t > 0 && fabs(rim - 1) < 1e-3)
                continue; /* the outline is the rasteriser's */
            if (t <= 0 || rim > 1) {
                require_empty(&g, i);
                continue;
            }
            covered++;
            REQUIRE_NEAR(g.position.data[4 * i + 3], 1, 0);
            for (size_t k = 0; k < 3; k++) {
                REQUIRE_NEAR(g.position.data[4 * i + k], at[k], 4e-6 * sqrt(r));
                REQUIRE_NEAR(g.normal.data[4 * i + k], k == 1 ? side : 0, 0);
                REQUIRE_NEAR(g.geometric.data[3 * i + k], k == 1 ? side : 0, 0);
                REQUIRE_NEAR(g.diffuse.data[3 * i + k], grey[k], 0);
                REQUIRE_NEAR(g.specular.data[4 * i + k], scene->materials[0].specular[k], 0);
            }
            REQUIRE_REL(g.normal.data[4 * i + 3], sqrt(r), 4e-6);
            REQUIRE_NEAR(g.specular.data[4 * i + 3], 17, 0);
        }
    REQUIRE_CMP(covered, >, 0);
    irb_gbuffer_image_destroy(&g);
    irb_scene_destroy(scene);
}

static void test_plane(void **state)
{
    (void)state;
    const float up[3] = {0, 1, 0};
    struct irb_camera camera =
        fixture_camera((float[]){0.3f, 1.5f, 2}, (float[]){0.1f, 0, 0}, up, 60);
    check_floor(&camera, 61, 43, 1);
    check_floor(&camera, 1, 1, 1);
    /* from below: the other side is seen */
    camera = fixture_camera((float[]){0.3f, -1.5f, 2}, (float[]){0.1f, 0, 0}, up, 60);
    check_floor(&camera, 40, 64, 1);
    /* reaches behind the eye, so that it is clipped */
    camera = fixture_camera((float[]){0.3f, 0.2f, 0.5f}, (float[]){0.1f, 0, -1}, up, 80);
    check_floor(&camera, 64, 48, 3);
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
    /* from above, and where the walls reach behind the eye */
    const struct irb_camera cameras[] = {
        fixture_camera((float[]){0, 60, 0}, (float[]){0.3f, 0, 0.2f}, (float[]){0, 0, -1}, 70),
        fixture_camera((float[]){0, 5, 20}, (float[]){0, 0, -20}, (float[]){0, 1, 0}, 70)};
    for (int view = 0; view < 2; view++) {
        struct irb_camera camera = cameras[view];
        camera.z_near = 1e-4f * irb_scene_diagonal(scene); /* what a config without it gets */
        camera.z_far = 200;
        struct irb_gbuffer_image g = render(scene, &camera, 64, 48);
        size_t covered = 0, front_seen = 0;
        for (size_t i = 0; i < irb_image_pixels(&g.position); i++) {
            covered += irb_gbuffer_image_covered(&g, i);
            front_seen += g.diffuse.data[3 * i] == 1;
        }
        REQUIRE_CMP(covered, >, 0);
        REQUIRE_CMP(front_seen, ==, covered);
        irb_gbuffer_image_destroy(&g);
    }
    irb_scene_destroy(scene);
}

/* The inside of the built-in unit sphere: positions on it, smooth normals to its centre, and the
 * flat ones perpendicular to nothing else than their triangle (chord height of 512 x 256). */
static void test_sphere(void **state)
{
    (void)state;
    struct irb_scene *scene = fixture_scene("sphere");
    struct irb_light light;
    struct irb_camera camera;
    fixture_view(scene, &light, &camera);
    struct irb_gbuffer_image g = render(scene, &camera, 80, 60);
    for (size_t i = 0; i < irb_image_pixels(&g.position); i++) {
        const float *p = g.position.data + 4 * i, *n = g.normal.data + 4 * i;
        const float *f = g.geometric.data + 3 * i;
        REQUIRE_NEAR(p[3], 1, 0);
        double radius = sqrt(fixture_dot(p, p));
        REQUIRE_CMP(radius, <=, 1 + 1e-6);
        REQUIRE_CMP(radius, >=, 1 - 2e-4);
        REQUIRE_NEAR(fixture_dot(n, n), 1, 1e-6);
        REQUIRE_NEAR(fixture_dot(f, f), 1, 1e-6);
        REQUIRE_CMP(fixture_dot(n, p) / radius, <, -1 + 1e-6);
        REQUIRE_CMP(fixture_dot(f, p) / radius, <, -1 + 3e-4);
    }
    irb_gbuffer_image_destroy(&g);
    irb_scene_destroy(scene);
}

/* An object that is moved, turned and squeezed: position and normal follow. */
static void test_transform(void **state)
{
    (void)state;
    struct irb_scene *scene = fixture_floor(1, grey);
    /* (x, y, z) -> (x, y/2 + z, 2 y - 3): the floor becomes the wall z = -3 */
    const float transform[16] = {1, 0, 0, 0, 0, 0.5f, 2, 0, 0, 1, 0, 0, 0, 0, -3, 1};
    memcpy(scene->objects[0].transform, transform, sizeof transform);
    struct irb_camera camera =
        fixture_camera((float[]){0, 0, 0}, (float[]){0, 0, -1}, (float[]){0, 1, 0}, 30);
    struct irb_gbuffer_image g = render(scene, &camera, 20, 20);
    for (size_t i = 0; i < irb_image_pixels(&g.position); i++) {
        REQUIRE_NEAR(g.position.data[4 * i + 2], -3, 1e-6);
        REQUIRE_NEAR(g.geometric.data[3 * i + 2], 1, 1e-6);
        REQUIRE_NEAR(g.normal.data[4 * i + 2], 1, 1e-6);
    }
    irb_gbuffer_image_destroy(&g);
    irb_scene_destroy(scene);
}

/* An sRGB texture of 2 x 2 texels, magnified: the middle of each texel shows its linear value, and
 * row 0 lies at v = 0. */
static void test_texture(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct irb_builder builder;
    irb_builder_begin(&builder, "textured");
    unsigned char *rgba = malloc(16);
    memcpy(rgba,
           (unsigned char[]){255, 0, 0, 255, 0, 255, 0, 255, /* row 0 */
                             188, 188, 188, 255, 0, 0, 255, 255},
           16);
    int texture = irb_builder_texture(&builder, "t", 2, 2, rgba);
    int material = irb_builder_material(&builder, "m", (float[]){1, 1, 0.5f});
    builder.scene->materials[material].diffuse_texture = texture;
    irb_builder_object(&builder, "quad", material);
    uint32_t v[4];
    for (int i = 0; i < 4; i++) { /* u to the right, v down, as glTF has it */
        const double uv[2] = {i & 1, i >> 1}, normal[3] = {0, 0, 1};
        const double position[3] = {2 * uv[0] - 1, 1 - 2 * uv[1], 0};
        v[i] = irb_builder_vertex(&builder, position, normal, uv);
    }
    irb_builder_triangle(&builder, v[0], v[2], v[3]);
    irb_builder_triangle(&builder, v[0], v[3], v[1]);
    struct irb_scene *scene = irb_builder_finish(&builder, &err);
    REQUIRE_OK(scene);
    struct irb_camera camera =
        fixture_camera((float[]){0, 0, 1}, (float[]){0, 0, 0}, (float[]){0, 1, 0}, 90);
    struct irb_gbuffer_image g = render(scene, &camera, 66, 66); /* pixel 16 is at 1/4 */
    /* sRGB 188 is 0.502886 linear */
    const float expected[4][3] = {
        {1, 0, 0}, {0, 1, 0}, {0.502886f, 0.502886f, 0.251443f}, {0, 0, 0.5f}};
    for (int i = 0; i < 4; i++)
        for (int c = 0; c < 3; c++)
            REQUIRE_NEAR(irb_image_at(&g.diffuse, i & 1 ? 49 : 16, i >> 1 ? 49 : 16)[c],
                         expected[i][c], 4e-3);
    irb_gbuffer_image_destroy(&g);
    irb_scene_destroy(scene);
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_plane),           cmocka_unit_test(test_sphere),
        cmocka_unit_test(test_depth_precision), cmocka_unit_test(test_transform),
        cmocka_unit_test(test_texture),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failed;
}
