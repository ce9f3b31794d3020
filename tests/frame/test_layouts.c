/* SPDX-License-Identifier: MIT
 *
 * The slim layouts of G-buffer and RSM against the full ones of the same view, and their encoding
 * of normals on its own.
 *
 *     test_layouts BACKEND SHADERS     SHADERS: tests/frame/shaders
 */
#include "tests/support/compare.h"
#include "tests/frame/fixture.h"

static struct irb_gl *gl;

static double angle_between(const float a[3], const float b[3])
{
    double cross = 0;
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        double c = (double)a[j] * b[k] - (double)a[k] * b[j];
        cross += c * c;
    }
    return atan2(sqrt(cross), fixture_dot(a, b));
}

/* Unit normals all round, the poles and their neighbourhood first: the sign of z comes back (the
 * thesis's own pair of formulas loses it), the poles are no 0/0, and the error is bounded by the
 * step 1/32767 on the half of the sphere that faces the viewer, and grows towards (0,0,-1). */
static void test_spheremap(void **state)
{
    (void)state;
    enum { COUNT = 20000 };
    static float given[COUNT][4], found[COUNT][4];
    struct irb_error err = {0};
    for (int i = 0; i < COUNT; i++) {
        double z = 1 - 2.0 * i / (COUNT - 1), phi = 2.399963 * i;
        double r = sqrt(fmax(0, 1 - z * z));
        if (i == 1 || i == COUNT - 2)
            r = 1e-4, z = i == 1 ? 1 : -1;
        given[i][0] = (float)(r * cos(phi));
        given[i][1] = (float)(r * sin(phi));
        given[i][2] = (float)z;
    }
    struct irb_buffer *buffer = irb_buffer_create(gl, "normals", sizeof given, given, &err);
    struct irb_program *program = irb_program_create(
        gl, &(struct irb_program_desc){.name = "spheremap", .compute = "test_spheremap.comp"},
        &err);
    REQUIRE_OK(buffer);
    REQUIRE_OK(program);
    irb_program_use(program);
    gl->api.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer->id);
    gl->api.DispatchCompute((COUNT + 63) / 64, 1, 1);
    REQUIRE_OK(irb_buffer_read(buffer, 0, sizeof found, found, &err));
    double worst[2] = {0};
    for (int i = 0; i < COUNT; i++) {
        REQUIRE_REL(sqrt(fixture_dot(found[i], found[i])), 1, 1e-5);
        double angle = angle_between(given[i], found[i]);
        worst[given[i][2] < 0] = fmax(worst[given[i][2] < 0], angle);
    }
    print_message("spheremap: worst angle %.2g rad facing the viewer, %.2g facing away\n", worst[0],
                  worst[1]);
    REQUIRE_CMP(worst[0], <, 1e-4);
    REQUIRE_CMP(worst[1], <, 0.02);
    for (int i = 0; i < 3; i++) { /* the poles themselves come back exactly */
        REQUIRE_NEAR(found[0][i], i == 2, 0);
        REQUIRE_NEAR(found[COUNT - 1][i], i == 2 ? -1 : 0, 1e-6);
    }
    irb_program_destroy(program);
    irb_buffer_destroy(buffer);
}

static void test_sizes(void **state)
{
    (void)state;
    struct irb_error err = {0};
    const int expected[2] = {5 * 16 + 4, 4 * 4}, expected_rsm[2] = {4 * 16 + 4, 4 * 4};
    for (int layout = 0; layout < 2; layout++) {
        struct irb_gbuffer *g = irb_gbuffer_create_layout(gl, (enum irb_layout)layout, 17, 9, &err);
        struct irb_rsm *rsm = irb_rsm_create_layout(gl, (enum irb_layout)layout, 21, &err);
        REQUIRE_OK(g);
        REQUIRE_OK(rsm);
        assert_int_equal(irb_gbuffer_pixel_bytes(g), expected[layout]);
        assert_int_equal(irb_rsm_texel_bytes(rsm), expected_rsm[layout]);
        struct irb_gbuffer_image image;
        assert_int_equal(irb_gbuffer_read(g, &image, &err), layout == IRB_LAYOUT_FULL);
        irb_gbuffer_image_destroy(&image);
        irb_gbuffer_destroy(g);
        irb_rsm_destroy(rsm);
    }
}

/* What a layout's fetch functions give, for every pixel or texel: position, normal, and flux or
 * k_d, k_s. */
struct fetched {
    struct irb_image layer[4];
};

static struct fetched fetch(const struct fixture_frame *f, bool light)
{
    struct irb_error err = {0};
    struct fetched out;
    const int width = light ? f->rsm->resolution : f->gbuffer->width;
    const int height = light ? f->rsm->resolution : f->gbuffer->height;
    const char *const defines[] = {light ? "LIGHT 1" : "LIGHT 0",
                                   irb_gbuffer_define(f->gbuffer->layout),
                                   irb_rsm_define(f->rsm->layout), NULL};
    struct irb_program *program =
        irb_program_create(gl,
                           &(struct irb_program_desc){
                               .name = "fetch", .compute = "test_fetch.comp", .defines = defines},
                           &err);
    REQUIRE_OK(program);
    irb_program_use(program);
    if (light)
        irb_rsm_bind(f->rsm, program, 0);
    else
        irb_gbuffer_bind(f->gbuffer, program, 0);
    const struct irb_texture_desc desc = {
        .name = "fetched", .format = GL_RGBA32F, .width = width, .height = height};
    for (int layer = 0; layer < 4; layer++) {
        struct irb_texture *texture = irb_texture_create(gl, &desc, &err);
        REQUIRE_OK(texture);
        irb_program_int(program, "layer", layer);
        gl->api.BindImageTexture(0, texture->id, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
        gl->api.DispatchCompute((unsigned)(width + 7) / 8, (unsigned)(height + 7) / 8, 1);
        gl->api.MemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
        out.layer[layer] = fixture_read(texture, 4);
        irb_texture_destroy(texture);
    }
    irb_program_destroy(program);
    return out;
}

/* unit: of the third layer, what 8 bits count. */
static void compare_layers(const struct fixture_frame *f, const struct fixture_frame *slim,
                           bool light, const float unit[3])
{
    struct fetched a = fetch(f, light), b = fetch(slim, light);
    const float *eye = light ? f->light.position : f->camera.position;
    double position = 0, angle = 0, allowed = 0;
    int covered = 0, sides = 0;
    for (size_t i = 0; i < irb_image_pixels(&a.layer[0]); i++) {
        const float *x = a.layer[0].data + 4 * i, *y = b.layer[0].data + 4 * i;
        assert_int_equal(x[3] > 0, y[3] > 0);
        if (x[3] == 0) {
            for (int layer = 0; layer < 3; layer++)
                for (size_t c = 0; c < 3; c++)
                    REQUIRE_NEAR(b.layer[layer].data[4 * i + c], 0, 0);
            continue;
        }
        double away = 0, far = 0;
        for (int c = 0; c < 3; c++) {
            away += (x[c] - y[c]) * (x[c] - y[c]);
            far += (x[c] - eye[c]) * (x[c] - eye[c]);
            REQUIRE_NEAR(b.layer[2].data[4 * i + (size_t)c], a.layer[2].data[4 * i + (size_t)c],
                         unit[c] * 0.502 / 255 + 1e-12);
            REQUIRE_NEAR(b.layer[3].data[4 * i + (size_t)c], a.layer[3].data[4 * i + (size_t)c],
                         0.502 / 255);
        }
        REQUIRE_REL(b.layer[3].data[4 * i + 3] + 1, a.layer[3].data[4 * i + 3] + 1, 0.023);
        /* A step of the camera's hardware depth in 32-bit floats is 2^-24 z^2/z_near; that of the
         * light is reversed and does not lose with the distance. A few steps for the way there. */
        double step = light ? 0 : sqrt(far) / f->camera.z_near * 0x1p-24;
        REQUIRE_CMP(sqrt(away / far), <, 4 * step + 1e-5);
        allowed = fmax(allowed, 4 * step + 1e-5);
        position = fmax(position, sqrt(away / far));
        angle = fmax(angle, angle_between(a.layer[1].data + 4 * i, b.layer[1].data + 4 * i));
        covered++;
        sides += fixture_dot(a.layer[1].data + 4 * i, b.layer[1].data + 4 * i) > 0;
    }
    print_message(
        "%s %s: position off by %.2g of the distance (allowed %.2g), normal by %.2g rad\n",
        f->scene->name, light ? "RSM" : "G-buffer", position, allowed, angle);
    REQUIRE_CMP(covered, >, 100);
    assert_int_equal(sides, covered);
    REQUIRE_CMP(angle, <, 1e-3);
    for (int layer = 0; layer < 4; layer++) {
        irb_image_destroy(&a.layer[layer]);
        irb_image_destroy(&b.layer[layer]);
    }
}

static void test_round_trip(void **state)
{
    (void)state;
    struct irb_error err = {0};
    const char *const names[] = {"cornell-objects", "sphere", "squares"}; /* squares: a beam */
    for (int s = 0; s < 3; s++) {
        struct fixture_frame f, slim;
        fixture_frame_create(&f, gl, fixture_scene(names[s]), 61, 43, 48);
        fixture_view(f.scene, &f.light, &f.camera);
        if (f.light.type == IRB_LIGHT_SPOT)
            f.light.falloff = IRB_FALLOFF_COSINE; /* above 1 on the axis */
        slim = f;
        REQUIRE_OK(slim.gbuffer = irb_gbuffer_create_layout(gl, IRB_LAYOUT_SLIM, 61, 43, &err));
        REQUIRE_OK(slim.rsm = irb_rsm_create_layout(gl, IRB_LAYOUT_SLIM, 48, &err));
        fixture_frame_render(&f);
        fixture_frame_render(&slim);
        compare_layers(&f, &slim, false, (const float[]){1, 1, 1});
        compare_layers(&f, &slim, true, slim.rsm->flux_scale);
        irb_gbuffer_destroy(slim.gbuffer);
        irb_rsm_destroy(slim.rsm);
        fixture_frame_destroy(&f);
    }
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), argc > 2 ? argv[2] : NULL);
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_spheremap),
                                       cmocka_unit_test(test_sizes),
                                       cmocka_unit_test(test_round_trip)};
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failed;
}
