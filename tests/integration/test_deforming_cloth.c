/* SPDX-License-Identifier: MIT
 *
 * The cloth that waves: rasteriser and rays meet the same surface in every frame, flicker leaves it
 * out, and methods that need static geometry do not get it.
 */
#include "tests/support/compare.h"
#include "core/experiment/sequence.h"
#include "core/reference/tracer.h"
#include "tests/frame/fixture.h"

enum { WIDTH = 96, HEIGHT = 96, FRAMES = 4 };

static struct irb_gl *gl;

struct fixture {
    struct irb_config config;
    struct irb_sequence sequence;
    struct irb_scene_gl *scene_gl;
    struct irb_gbuffer *gbuffer;
};

/* A sequence of `cornell-cloth`, 8 frames a wave. */
static void open_cloth(struct fixture *f, const char *animation)
{
    struct irb_error err = {0};
    struct irb_registry registry;
    char *folder = fixture_folder(), *path = irb_asprintf("%s/c.yaml", folder);
    char *text =
        irb_asprintf("scene: cornell-cloth\nframes: %d\n%strials: [rsm]\n", FRAMES, animation);
    REQUIRE_OK(irb_fs_write(path, text, strlen(text), &err));
    irb_registry_init(&registry);
    REQUIRE_OK(irb_config_load(&f->config, path, NULL, &registry, &err));
    irb_registry_close(&registry);
    REQUIRE_OK(irb_sequence_open(&f->sequence, &f->config, &f->config.scenes[0], NULL, &err));
    f->scene_gl = irb_scene_gl_create(gl, f->sequence.scene, &err);
    REQUIRE_OK(f->scene_gl);
    f->gbuffer = irb_gbuffer_create(gl, WIDTH, HEIGHT, &err);
    REQUIRE_OK(f->gbuffer);
    fixture_remove(folder);
    free(path);
    free(text);
}

static void close_cloth(struct fixture *f)
{
    irb_gbuffer_destroy(f->gbuffer);
    irb_scene_gl_destroy(f->scene_gl);
    irb_sequence_close(&f->sequence);
    irb_config_destroy(&f->config);
}

static void render(struct fixture *f, int frame, struct irb_gbuffer_image *image)
{
    struct irb_error err = {0};
    REQUIRE_OK(irb_sequence_pose(&f->sequence, frame, &err));
    REQUIRE_OK(irb_scene_gl_update(f->scene_gl, &err));
    REQUIRE_OK(
        irb_gbuffer_render(f->gbuffer, f->scene_gl, &f->sequence.frames[frame].camera, &err));
    REQUIRE_OK(irb_gbuffer_read(f->gbuffer, image, &err));
}

/* The only surface that is more blue than red and green. */
static bool is_cloth(const struct irb_gbuffer_image *image, size_t i)
{
    const float *k = image->diffuse.data + 3 * i;
    return image->position.data[4 * i + 3] > 0 && k[2] > k[0] && k[2] > k[1];
}

/* Rasterisers place vertices to 1/256 of a pixel, which is 0.5 % of a triangle here (6 mm a
 * pixel, 7.5 mm the shorter sides, slanted): nearer to an edge than this, either triangle's normal
 * is right. */
static const float edge = 0.01f;

/* Rays from the eye through the G-buffer's points end in these, with their normals. A ray may slip
 * past where the point lies on the outline, to within the rounding of its coordinates: such a pixel
 * has a neighbour that is not the cloth's. */
static void require_same_surface(const struct fixture *f, int frame,
                                 const struct irb_gbuffer_image *image)
{
    struct irb_error err = {0};
    struct irb_tracer *tracer = irb_tracer_create(f->sequence.scene, &err);
    REQUIRE_OK(tracer);
    struct trace_context context = {.tracer = tracer, .surfaces = irb_tracer_surfaces(tracer)};
    struct vec3 eye = v3_load(f->sequence.frames[frame].camera.position);
    int cloth = 0;
    for (size_t i = 0; i < irb_image_pixels(&image->position); i++) {
        if (!is_cloth(image, i))
            continue;
        struct vec3 point = v3_load(image->position.data + 4 * i);
        struct trace_ray ray = {.origin = eye, .direction = v3_sub(point, eye), .far = 2};
        struct trace_hit hit;
        struct surface_point found;
        trace_closest(&context, &ray, 1, &hit);
        REQUIRE_CMP(hit.triangle, !=, TRACE_MISS);
        surface_at(context.surfaces, hit.triangle, hit.u, hit.v, ray.direction, &found);
        bool inner = i % WIDTH > 0 && i % WIDTH < WIDTH - 1 && is_cloth(image, i - 1) &&
                     is_cloth(image, i + 1) && is_cloth(image, i - WIDTH) &&
                     is_cloth(image, i + WIDTH);
        if (!inner)
            continue;
        cloth++;
        REQUIRE_NEAR(hit.t, 1, 2e-6);
        REQUIRE_CMP(v3_dot(found.shading, v3_load(image->normal.data + 4 * i)), >, 0.99999f);
        if (fminf(fminf(hit.u, hit.v), 1 - hit.u - hit.v) > edge)
            REQUIRE_CMP(v3_dot(found.geometric, v3_load(image->geometric.data + 3 * i)), >,
                        0.99999f);
    }
    REQUIRE_CMP(cloth, >, 1000);
    irb_tracer_destroy(tracer);
}

/* How far points of the same pixels are apart in two frames, m. */
static double largest_change(const struct irb_gbuffer_image *a, const struct irb_gbuffer_image *b)
{
    double largest = 0;
    for (size_t i = 0; i < irb_image_pixels(&a->position); i++)
        if (is_cloth(a, i) && is_cloth(b, i))
            largest = fmax(largest, fabs((double)a->position.data[4 * i + 1] -
                                         (double)b->position.data[4 * i + 1]));
    return largest;
}

static void raster_and_rays_meet_the_cloth(void **state)
{
    (void)state;
    struct fixture f = {0};
    struct irb_gbuffer_image images[FRAMES];
    open_cloth(&f, "animation: {fps: 4}\n");
    for (int i = 0; i < FRAMES; i++) {
        render(&f, i, &images[i]);
        require_same_surface(&f, i, &images[i]);
        if (i > 0)
            REQUIRE_CMP(largest_change(&images[i - 1], &images[i]), >, 0.001);
    }
    /* and back: what was uploaded for other frames is gone */
    struct irb_gbuffer_image again;
    render(&f, 1, &again);
    struct irb_key first = irb_gbuffer_image_key(&images[1]), now = irb_gbuffer_image_key(&again);
    assert_string_equal(now.hex, first.hex);
    irb_gbuffer_image_destroy(&again);
    for (int i = 0; i < FRAMES; i++)
        irb_gbuffer_image_destroy(&images[i]);
    close_cloth(&f);
}

static void flicker_leaves_the_cloth_out(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct fixture f = {0};
    struct irb_gbuffer_image before, now;
    struct irb_moved_object *moved;
    struct irb_reprojection motion;
    int count, cloth = 0, kept = 0;
    open_cloth(&f, "animation: {fps: 4000}\n"); /* a thousandth of a wave: it all but rests */
    assert_true(f.sequence.moves);
    render(&f, 0, &before);
    render(&f, 1, &now);
    REQUIRE_OK(irb_sequence_moved(&f.sequence, 1, &moved, &count, &err));
    REQUIRE_CMP(count, ==, 1);
    REQUIRE_OK(
        irb_reproject(&motion, &now, &before, &f.sequence.frames[0].camera, moved, count, &err));
    for (size_t i = 0; i < irb_image_pixels(&now.position); i++) {
        cloth += is_cloth(&now, i);
        kept += motion.source[i] >= 0;
        assert_false(is_cloth(&now, i) && motion.source[i] >= 0);
        if (motion.source[i] >= 0)
            assert_false(is_cloth(&before, (size_t)motion.source[i]));
    }
    REQUIRE_CMP(cloth, >, 1000);
    REQUIRE_CMP(kept, >, WIDTH * HEIGHT / 3);
    irb_reprojection_destroy(&motion);
    free(moved);
    irb_gbuffer_image_destroy(&before);
    irb_gbuffer_image_destroy(&now);
    close_cloth(&f);
}

/* The first frame of the animation is the scene at rest, and shares its references. */
static void frames_have_keys_of_their_own(void **state)
{
    (void)state;
    struct fixture moving = {0}, still = {0};
    open_cloth(&moving, "animation: {fps: 4}\n");
    open_cloth(&still, "");
    assert_true(moving.sequence.moves);
    assert_false(still.sequence.moves);
    assert_string_equal(moving.sequence.frames[0].scene.hex, still.sequence.frames[0].scene.hex);
    for (int i = 1; i < FRAMES; i++) {
        assert_false(irb_sequence_same_pose(&moving.sequence, i));
        assert_false(irb_sequence_same_view(&moving.sequence, i));
        assert_true(irb_sequence_same_view(&still.sequence, i));
    }
    close_cloth(&moving);
    close_cloth(&still);
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(raster_and_rays_meet_the_cloth),
        cmocka_unit_test(flicker_leaves_the_cloth_out),
        cmocka_unit_test(frames_have_keys_of_their_own),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failed;
}
