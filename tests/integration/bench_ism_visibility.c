/* SPDX-License-Identifier: MIT
 *
 * How the parameters of imperfect shadow maps that no source gives a value for were chosen, and how
 * much they matter: error of the irradiance from 512 lights against the same lights with exact
 * visibility (Embree), on scenes that are in no table.
 *
 *     bench_ism_visibility [auto|osmesa|egl] [name=value]... [--search]
 *
 * Prints, for every value of every parameter in turn, all others at their defaults or as given, the
 * mean of |E - E_exact| over the mean of E_exact, and the mean of E - E_exact likewise (leaks above
 * 0, false shadows below), of each scene. --search goes down by coordinates: it keeps the best
 * value of each parameter (by the mean of the logarithms of the scenes' errors) before it tries the
 * next, in two rounds; that is the budget. 77 without a backend.
 *
 * Interleaving is off but for the parameters of its filter; the geometry term is bounded, so that
 * light, not the singularity, counts.
 */
#include "tests/support/compare.h"
#include "methods/method.h"
#include "tests/integration/exact_lights.h"

extern const struct irb_method irb_method_ism;
static const struct irb_method *const ism = &irb_method_ism;

enum { WIDTH = 96, HEIGHT = 72, RESOLUTION = 128, LIGHTS = 512, SCENES = 2, ROUNDS = 2 };
static const char *const scene_names[SCENES] = {"doorway", "corridor"};
static const char bound_text[] = "100"; /* cos cos d^2/r^2 */

/* What is tried. */
static const struct {
    const char *name;
    const char *values[10];
} tried[] = {
    {"splat_size", {"even", "surface"}},
    {"splat_scale", {"0.5", "0.7", "1", "1.4", "2", "2.8", "4"}},
    {"pull_push", {"0", "1", "2", "3", "4"}},
    {"splat_most", {"1", "3", "5", "9", "17"}},
    {"slope", {"0", "0.7", "1", "1.5", "2", "3", "4"}},
    {"bias", {"0", "0.005", "0.01", "0.02", "0.03", "0.05", "0.1"}},
    {"offset", {"0", "0.0005", "0.001", "0.002", "0.005", "0.01", "0.02"}},
    {"near", {"0", "0.001", "0.002", "0.005", "0.01", "0.02"}},
    {"filter_depth", {"0.005", "0.01", "0.02", "0.05", "0.1", "0.2"}},
    {"filter_cosine", {"-1", "0.5", "0.7", "0.8", "0.9", "0.95", "0.99"}},
};
enum { TRIED = sizeof tried / sizeof *tried };

struct bench {
    struct irb_gl *gl;
    struct fixture_frame frame;
    struct irb_image exact; /* with visibility; without */
    double mean;            /* of the former */
    void *state;
};

static void open_scene(struct bench *b, const char *name, const void *params)
{
    struct irb_error err = {0};
    struct irb_gbuffer_image gbuffer;
    int count;
    fixture_frame_create(&b->frame, b->gl, fixture_scene(name), WIDTH, HEIGHT, RESOLUTION);
    fixture_view(b->frame.scene, &b->frame.light, &b->frame.camera);
    fixture_frame_render(&b->frame);
    REQUIRE_OK(irb_gbuffer_read(b->frame.gbuffer, &gbuffer, &err));
    struct exact_light *lights = exact_lights(b->gl, b->frame.rsm, LIGHTS, &count);
    const double diagonal = irb_scene_diagonal(b->frame.scene);
    exact_image(b->frame.scene, &gbuffer, lights, count, atof(bound_text) / (diagonal * diagonal),
                &b->exact);
    b->mean = fixture_sum(&b->exact, 0);
    printf("%s: %d lights, light in shadow %.3f\n", name, count,
           1 - b->mean / fixture_sum(&b->exact, 1));
    REQUIRE_OK(b->state = ism->create(b->gl, b->frame.scene_gl, WIDTH, HEIGHT, params, &err));
    REQUIRE_OK(ism->begin_sequence(b->state, params, 0, &err));
    irb_gbuffer_image_destroy(&gbuffer);
    free(lights);
}

struct error {
    double absolute, bias;
};

static struct error measure(struct bench *b, const void *params)
{
    struct irb_error err = {0};
    struct irb_frame_output out;
    struct error error = {0};
    const struct irb_frame_inputs inputs = {.scene = b->frame.scene_gl,
                                            .light = &b->frame.light,
                                            .camera = &b->frame.camera,
                                            .gbuffer = b->frame.gbuffer,
                                            .rsm = b->frame.rsm,
                                            .params = params};
    REQUIRE_OK(ism->render_frame(b->state, &inputs, &out, &err));
    struct irb_image e = fixture_read(out.irradiance, 4);
    for (size_t i = 0; i < irb_image_pixels(&e); i++) {
        error.absolute += fabs((double)e.data[4 * i + 1] - b->exact.data[2 * i]) / b->mean;
        error.bias += ((double)e.data[4 * i + 1] - b->exact.data[2 * i]) / b->mean;
    }
    irb_image_destroy(&e);
    return error;
}

/* Mean of the logarithms of the scenes' errors, which are printed. */
static double evaluate(struct bench *benches, const void *params, const char *name,
                       const char *value)
{
    double score = 0;
    printf("%-12s %-7s", name, value);
    for (int i = 0; i < SCENES; i++) {
        struct error e = measure(&benches[i], params);
        printf("  %s %.4f %+.4f", scene_names[i], e.absolute, e.bias);
        score += log(e.absolute) / SCENES;
    }
    printf("  | %.4f\n", exp(score));
    fflush(stdout);
    return score;
}

static void set(void *params, const char *name, const char *value)
{
    struct irb_error err = {0};
    REQUIRE_OK(irb_option_set(ism->params, params, name, value, &err));
}

static void set_tiles(void *params, const char *side)
{
    set(params, "interleave_n", side);
    set(params, "interleave_m", side);
}

/* Tries the values of one parameter; leaves the best, or what was there. */
static void try_values(struct bench *benches, void *params, int index, bool search)
{
    const struct irb_option *option = irb_option_find(ism->params, tried[index].name);
    struct irb_str before = {0};
    irb_option_print(option, params, &before);
    const char *best = irb_str_text(&before);
    double best_score = INFINITY;
    set_tiles(params, !strncmp(option->name, "filter", 6) ? "3" : "1");
    for (int k = 0; tried[index].values[k]; k++) {
        set(params, option->name, tried[index].values[k]);
        double score = evaluate(benches, params, option->name, tried[index].values[k]);
        if (search && score < best_score) {
            best_score = score;
            best = tried[index].values[k];
        }
    }
    set(params, option->name, best);
    if (search)
        printf("  -> %s = %s\n", option->name, best);
    irb_str_free(&before);
}

/* The arguments behind the backend: settings, and whether to search. */
static bool read_arguments(int argc, char **argv, void *params)
{
    bool search = false;
    set_tiles(params, "1");
    set(params, "clamp", bound_text);
    for (int i = 1; i < argc; i++) {
        char *equals = strchr(argv[i], '=');
        search = search || !strcmp(argv[i], "--search");
        if (!equals)
            continue;
        *equals = 0;
        set(params, argv[i], equals + 1);
    }
    return search;
}

int main(int argc, char **argv)
{
    struct bench benches[SCENES] = {0};
    struct irb_gl *gl = fixture_gl(fixture_backend(argc, argv), NULL);
    void *params = calloc(1, ism->params_size);
    irb_options_default(ism->params, params);
    const bool search = read_arguments(argc, argv, params);
    for (int i = 0; i < SCENES; i++) {
        benches[i].gl = gl;
        open_scene(&benches[i], scene_names[i], params);
    }
    evaluate(benches, params, "start", "");
    for (int round = 0; round < (search ? ROUNDS : 1); round++)
        for (int i = 0; i < TRIED; i++)
            try_values(benches, params, i, search);
    for (int i = 0; i < SCENES; i++) {
        ism->destroy(benches[i].state);
        irb_image_destroy(&benches[i].exact);
        fixture_frame_destroy(&benches[i].frame);
    }
    free(params);
    irb_gl_destroy(gl);
    return 0;
}
