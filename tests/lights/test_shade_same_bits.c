/* SPDX-License-Identifier: MIT
 *
 * The lighting of a split G-buffer has the same bits (tests/gl/same_bits.h), whatever visibility it
 * has.
 */
#include "tests/support/compare.h"
#include "tests/gl/same_bits.h"
#include "tests/lights/shade_receivers.h"

enum { WIDTH = 45, HEIGHT = 31, LIGHTS = 40, MAP = 32, VISIBILITIES = 3 };

/* No scene at all: distances that vary from texel to texel. */
static double noise(const void *scene, const double from[3], const double along[3])
{
    (void)scene;
    return 0.4 + 0.3 * sin(40 * along[0] + 7 * from[0]) * sin(50 * along[1]);
}

static void make(struct receiver *receivers, struct shade_light *lights)
{
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        receivers[i] = (struct receiver){{0, 0, 0}, {0, 0, 1}};
        receivers[i].position[0] = (float)(i % WIDTH) / WIDTH - 0.5f;
        receivers[i].position[1] = (float)(i / WIDTH) / HEIGHT - 0.5f;
        random_normal(1, i, 0.8, receivers[i].normal);
    }
    for (uint32_t l = 0; l < LIGHTS; l++) {
        lights[l] = (struct shade_light){.area = 0.02f, .flux = {1, 0.5f, 0.25f}};
        for (uint32_t c = 0; c < 3; c++)
            lights[l].position[c] = (float)uniform(2, 3 * l + c) - (c < 2 ? 0.5f : -0.3f);
        random_normal(3, l, 0.2, lights[l].normal);
        lights[l].normal[2] *= -1;
    }
}

static void render(struct irb_gl *gl, struct irb_image *images)
{
    struct irb_error err = {0};
    static struct receiver receivers[WIDTH * HEIGHT];
    struct shade_light lights[LIGHTS];
    struct irb_ism ism;
    struct shading s;
    struct irb_shade *shade = irb_shade_create(gl, &err);
    make(receivers, lights);
    struct irb_buffer *buffer = shade_lights_upload(gl, lights, LIGHTS, &err);
    REQUIRE_OK(shade && buffer && shade_maps_create(&ism, gl, MAP, LIGHTS, &err));
    for (int l = 0; l < LIGHTS; l++)
        shade_map_fill(&ism, l, &lights[l], noise, NULL, NULL);
    shading_create(&s, shade, gl, receivers, WIDTH, HEIGHT, 3, 3);
    for (int v = 0; v < VISIBILITIES; v++) {
        const struct irb_shade_settings settings = {.visibility = v,
                                                    .bias = 0.01f,
                                                    .slope = 1,
                                                    .taps = 16,
                                                    .blocker_taps = 16,
                                                    .search_scale = 3,
                                                    .penumbra_scale = 1,
                                                    .bound = 2};
        struct irb_image split =
            shading_run(&s, &(struct irb_virtual_lights){buffer, LIGHTS}, &ism, &settings);
        irb_image_destroy(&split);
        images[v] = shading_filter(&s);
    }
    shading_destroy(&s);
    irb_shade_destroy(shade);
    irb_texture_destroy(ism.atlas);
    irb_buffer_destroy(buffer);
}

static void test_same_bits(void **state)
{
    (void)state;
    struct irb_image images[VISIBILITIES];
    fixture_same_bits(render, images, VISIBILITIES);
    for (int v = 0; v < VISIBILITIES; v++) {
        REQUIRE_NEAR(fixture_sum(&images[v], 3) > 0, v > 0, 0); /* shadows where there may be */
        irb_image_destroy(&images[v]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_same_bits)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
