/* SPDX-License-Identifier: MIT
 *
 * For tests that demand the same bits of OSMesa and EGL, where both are llvmpipe, of one thread and
 * two, and of the same twice. Include after compare.h.
 */
#ifndef IRB_TESTS_GL_SAME_BITS_H
#define IRB_TESTS_GL_SAME_BITS_H

#include "core/image/image.h"
#include "tests/gl/fixture.h"

/* Ends the test as skipped where the backend is missing, or a GPU, whose bits are its own. */
static inline struct irb_gl *fixture_software_gl(enum irb_backend backend, const char *threads)
{
    setenv("LP_NUM_THREADS", threads, 1); /* llvmpipe reads it for each context */
    struct irb_gl *gl = fixture_gl(backend, NULL);
    if (!gl->software) {
        printf("skipped: %s is no software rasteriser\n", gl->renderer);
        exit(TEST_SKIPPED);
    }
    return gl;
}

/* Fills the images; leaves nothing in OpenGL. */
typedef void fixture_renderer(struct irb_gl *gl, struct irb_image *images);

static inline void fixture_render_on(fixture_renderer *render, enum irb_backend backend,
                                     const char *threads, struct irb_image *images)
{
    struct irb_gl *gl = fixture_software_gl(backend, threads);
    render(gl, images);
    assert_int_equal(gl->bytes, 0);
    irb_gl_destroy(gl);
}

/* `count` images, the same everywhere, are left in `images`; the caller destroys them. */
static inline void fixture_same_bits(fixture_renderer *render, struct irb_image *images, int count)
{
    static const struct {
        enum irb_backend backend;
        const char *threads;
    } others[] = {{IRB_BACKEND_OSMESA, "2"}, {IRB_BACKEND_OSMESA, "1"}, {IRB_BACKEND_EGL, "2"}};
    irb_gl_destroy(fixture_gl(IRB_BACKEND_EGL, NULL)); /* skips where it is missing */
    fixture_render_on(render, IRB_BACKEND_OSMESA, "2", images);
    struct irb_image *found = calloc((size_t)count, sizeof *found);
    for (size_t o = 0; o < sizeof others / sizeof *others; o++) {
        fixture_render_on(render, others[o].backend, others[o].threads, found);
        for (int i = 0; i < count; i++) {
            size_t values = irb_image_pixels(&images[i]) * (size_t)images[i].channels;
            if (memcmp(found[i].data, images[i].data, values * sizeof(float)))
                fail_msg("image %d differs: %s, %s threads", i,
                         irb_backend_names[others[o].backend], others[o].threads);
            irb_image_destroy(&found[i]);
        }
    }
    free(found);
}

#endif
