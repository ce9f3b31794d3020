/* SPDX-License-Identifier: MIT
 *
 * A method module for the registry's tests; IRB_TEST_MODULE picks what is wrong with it.
 */
#include "methods/method.h"

#define GOOD 0
#define OTHER_ABI 1
#define NO_METHOD 2
#define BAD_NAME 3
#define MISSING_FUNCTION 4
#define OUTSIDE_STRUCT 5
#define NO_SYMBOL 6

struct params {
    int samples;
};

static const struct irb_option options[] = {
    IRB_OPTION_INT(struct params, samples, 4, 1, 8, "", "test", "ours"),
    IRB_OPTION_END,
};
static const char *const stages[] = {"gather", NULL};

static void *create(struct irb_gl *gl, const struct irb_scene_gl *scene, int width, int height,
                    const void *params, struct irb_error *err)
{
    (void)gl, (void)scene, (void)width, (void)height, (void)params, (void)err;
    return NULL;
}

static bool resize(void *state, int width, int height, struct irb_error *err)
{
    (void)state, (void)width, (void)height, (void)err;
    return true;
}

static bool begin_sequence(void *state, const void *params, uint64_t seed, struct irb_error *err)
{
    (void)state, (void)params, (void)seed, (void)err;
    return true;
}

static bool render_frame(void *state, const struct irb_frame_inputs *inputs,
                         struct irb_frame_output *output, struct irb_error *err)
{
    (void)state, (void)inputs, (void)output, (void)err;
    return true;
}

static void destroy(void *state)
{
    (void)state;
}

static const struct irb_method method = {
    .abi = IRB_TEST_MODULE == OTHER_ABI ? IRB_METHOD_ABI + 1 : IRB_METHOD_ABI,
    .name = IRB_TEST_MODULE == BAD_NAME ? "Not a name" : "test-module",
    .title = "A method for tests",
    .citation = "none",
    .path_classes = "LDDE",
    .params_size = IRB_TEST_MODULE == OUTSIDE_STRUCT ? 2 : sizeof(struct params),
    .params = options,
    .stages = stages,
    .create = create,
    .resize = resize,
    .begin_sequence = begin_sequence,
    .render_frame = IRB_TEST_MODULE == MISSING_FUNCTION ? NULL : render_frame,
    .destroy = destroy,
};

#if IRB_TEST_MODULE == NO_SYMBOL
#define irb_method_module irb_another_symbol
#endif

const struct irb_method *irb_method_module(void);
const struct irb_method *irb_method_module(void)
{
    return IRB_TEST_MODULE == NO_METHOD ? NULL : &method;
}
