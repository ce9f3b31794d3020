/* SPDX-License-Identifier: MIT
 *
 * Plain reflective shadow maps: one-bounce light from RSM texels taken as virtual point lights,
 * without indirect visibility. Mode `polar` is the paper's, with the low-resolution gather and
 * interpolation of its section 4.2.
 */
#include "methods/method.h"
#include "core/sampling/halton.h"
#include "methods/rsm/energy.h"
#include "methods/rsm/gather.h"
#include "methods/rsm/lowres.h"
#include "methods/rsm/polar.h"

#include <math.h>
#include <stdlib.h>

extern const struct irb_method irb_method_rsm;

/* After MODE_POLAR in the order of enum irb_vpl_sampling. */
enum { MODE_POLAR, MODE_ALL, MODE_UNIFORM, MODE_IMPORTANCE };
static const char *const modes[] = {"polar", "all", "uniform", "importance", NULL};

enum { SCALE_AUTO, SCALE_1, SCALE_2, SCALE_4, SCALE_8 };
static const char *const scales[] = {"auto", "1", "2", "4", "8", NULL};

struct rsm_params {
    int mode;
    int samples;
    float r_max;
    int weight; /* enum rsm_weight */
    int fetch;  /* enum rsm_fetch */
    float normal_offset;
    float clamp;
    int gather_scale;
    float position_threshold;
    float normal_threshold;
};

enum { SAMPLES_DEFAULT = 400, SAMPLES_MOST = 1 << 20 };

static const struct irb_option params[] = {
    IRB_OPTION_ENUM(struct rsm_params, mode, MODE_POLAR, modes,
                    "which texels light a pixel: those round its place in the light's image, all "
                    "of them, Halton points over the map, or Halton points warped by flux",
                    "Dachsbacher and Stamminger 2005; Clarberg et al. 2005"),
    IRB_OPTION_INT(struct rsm_params, samples, SAMPLES_DEFAULT, 1, SAMPLES_MOST, "",
                   "texels that are drawn, one pattern for all pixels (without effect on mode=all)",
                   "Dachsbacher and Stamminger 2005, section 4"),
    IRB_OPTION_FLOAT(struct rsm_params, r_max, 0.3, 1e-4, 2, "",
                     "polar: radius of the samples as a share of the map's side; sqrt(2) reaches "
                     "every texel from everywhere",
                     "Dachsbacher and Stamminger 2005, section 4"),
    IRB_OPTION_ENUM(struct rsm_params, weight, RSM_WEIGHT_XI2, rsm_weight_names,
                    "polar: of a sample: xi_1^2, normalised so that a constant is exact (the "
                    "paper's; biased), or 2 pi r_max^2 xi_1/N (unbiased)",
                    "Dachsbacher and Stamminger 2005, section 4; xi1: ours"),
    IRB_OPTION_ENUM(struct rsm_params, fetch, RSM_FETCH_PACKED, rsm_fetch_names,
                    "polar: texels packed into 16 bytes (irradiance within 1e-3), or position, "
                    "normal and flux from the RSM as it is",
                    "ours"),
    IRB_OPTION_FLOAT(struct rsm_params, normal_offset, 0, 0, 1, "",
                     "shift of the lights against their normals, as a share of the scene's "
                     "diagonal, for edges that surfaces share",
                     "Dachsbacher and Stamminger 2005, section 4; unit: ours"),
    IRB_OPTION_FLOAT(
        struct rsm_params, clamp, 0, 0, 1e12, "",
        "largest cos cos d^2/r^2 of a light and a pixel, d the diagonal of the scene's "
        "bounds; 0 = no clamp",
        "thesis 3.2.1; unit: ours"),
    IRB_OPTION_ENUM(struct rsm_params, gather_scale, SCALE_AUTO, scales,
                    "gather for every n-th pixel, interpolate between, gather again where that "
                    "fails; auto = 4 for polar, which is the paper's whole method, else 1 (off)",
                    "Dachsbacher and Stamminger 2005, section 4.2; value: ours"),
    IRB_OPTION_FLOAT(struct rsm_params, position_threshold, 0.05, 0, 10, "",
                     "farthest a sample may be from the pixel that it is interpolated for, as a "
                     "share of the scene's diagonal",
                     "ours"),
    IRB_OPTION_FLOAT(struct rsm_params, normal_threshold, 0.9, -1, 1, "",
                     "least cosine between the normals of a pixel and a sample that it is "
                     "interpolated from",
                     "ours"),
    IRB_OPTION_END,
};

enum { STAGE_SAMPLE, STAGE_GATHER, STAGE_INTERPOLATE, STAGE_REFINE };
static const char *const stages[] = {"sample", "gather", "interpolate", "refine", NULL};

struct rsm_state {
    struct irb_gl *gl;              /* borrowed */
    struct irb_texture *irradiance; /* RGBA32F, W/m2; alpha: mean irradiance that the clamp took */
    struct rsm_programs gather;
    struct rsm_polar *polar;
    struct rsm_energy *energy;
    struct rsm_lowres *lowres;  /* made when first asked for */
    struct irb_vpl_set *lights; /* made when the first frame shows the RSM's resolution */
    int rsm_resolution;         /* that `lights` is made for */
};

static void rsm_destroy(void *user)
{
    struct rsm_state *state = user;
    if (!state)
        return;
    irb_texture_destroy(state->irradiance);
    rsm_programs_destroy(&state->gather);
    rsm_polar_destroy(state->polar);
    rsm_energy_destroy(state->energy);
    rsm_lowres_destroy(state->lowres);
    irb_vpl_set_destroy(state->lights);
    free(state);
}

static bool rsm_resize(void *user, int width, int height, struct irb_error *err)
{
    struct rsm_state *state = user;
    const struct irb_texture_desc desc = {
        .name = "rsm: irradiance", .format = GL_RGBA32F, .width = width, .height = height};
    struct irb_texture *irradiance = irb_texture_create(state->gl, &desc, err);
    struct rsm_energy *energy = irradiance ? rsm_energy_create(state->gl, height, err) : NULL;
    if (!energy) {
        irb_texture_destroy(irradiance);
        return false;
    }
    irb_texture_destroy(state->irradiance);
    rsm_energy_destroy(state->energy);
    rsm_lowres_destroy(state->lowres);
    state->irradiance = irradiance;
    state->energy = energy;
    state->lowres = NULL;
    return true;
}

static void *rsm_create(struct irb_gl *gl, const struct irb_scene_gl *scene, int width, int height,
                        const void *settings, struct irb_error *err)
{
    (void)scene;
    (void)settings;
    struct rsm_state *state = calloc(1, sizeof *state);
    if (!state) {
        irb_fail(err, IRB_E_MEMORY, "rsm: out of memory");
        return NULL;
    }
    state->gl = gl;
    rsm_programs_init(&state->gather, gl, rsm_gather_shader, RSM_GATHER_TILE);
    state->polar = rsm_polar_create(gl, err);
    if (state->polar && rsm_resize(state, width, height, err))
        return state;
    rsm_destroy(state);
    return NULL;
}

static bool rsm_begin_sequence(void *user, const void *settings, uint64_t seed,
                               struct irb_error *err)
{
    (void)user;
    (void)settings;
    (void)seed;
    (void)err;
    return true; /* no history */
}

/* Lengths relative to the scene, in metres. The bounds are those at rest: the same in all frames.
 */
struct lengths {
    float bound;         /* of cos cos/r^2, 1/m2; 0 for no clamp */
    float normal_offset; /* m */
    float position;      /* m */
};

static struct lengths lengths_of(const struct rsm_params *p, const struct irb_scene_gl *scene)
{
    const float diagonal = irb_scene_diagonal(scene->scene);
    return (struct lengths){
        .bound = diagonal > 0 ? p->clamp / (diagonal * diagonal) : 0,
        .normal_offset = p->normal_offset * diagonal,
        .position = p->position_threshold * diagonal,
    };
}

/* Makes the set of lights anew where mode, RSM or number of samples ask for another one. */
static bool prepare_lights(struct rsm_state *state, const struct rsm_params *p, int rsm_resolution,
                           struct irb_error *err)
{
    const enum irb_vpl_sampling sampling = (enum irb_vpl_sampling)(p->mode - MODE_ALL);
    struct irb_vpl_set *set = state->lights;
    if (set && set->sampling == sampling && state->rsm_resolution == rsm_resolution &&
        (p->mode == MODE_ALL || set->capacity >= p->samples))
        return true;
    irb_vpl_set_destroy(set);
    state->lights = irb_vpl_set_create(state->gl, sampling, rsm_resolution,
                                       p->mode == MODE_ALL ? 1 : p->samples, err);
    state->rsm_resolution = rsm_resolution;
    return state->lights != NULL;
}

/* The frame's lights, or what the polar gather looks up. */
static bool sample(struct rsm_state *state, const struct irb_frame_inputs *in,
                   const struct lengths *lengths, struct irb_error *err)
{
    const struct rsm_params *p = in->params;
    const unsigned first = irb_halton_stretch(in->seed, 0, (uint32_t)p->samples);
    if (p->mode == MODE_POLAR) {
        const struct rsm_pattern pattern = {.samples = p->samples,
                                            .radius = p->r_max,
                                            .weight = p->weight,
                                            .first = first,
                                            .resolution = in->rsm->resolution};
        return rsm_polar_prepare(state->polar, in->rsm, &pattern, p->fetch, err);
    }
    if (!prepare_lights(state, p, in->rsm->resolution, err))
        return false;
    state->lights->normal_offset = lengths->normal_offset;
    return irb_vpl_set_sample(state->lights, in->rsm, p->samples, first, err);
}

static bool gather(struct rsm_state *state, const struct irb_frame_inputs *in,
                   const struct lengths *lengths, const struct rsm_pixels *pixels,
                   struct irb_error *err)
{
    const struct rsm_params *p = in->params;
    const struct rsm_polar_settings settings = {
        .fetch = p->fetch, .bound = lengths->bound, .normal_offset = lengths->normal_offset};
    if (p->mode == MODE_POLAR)
        return rsm_polar_run(state->polar, pixels, in->rsm, &settings, err);
    return rsm_gather_run(&state->gather, pixels, state->lights, lengths->bound, err);
}

static int scale_of(const struct rsm_params *p)
{
    const int choice = p->gather_scale != SCALE_AUTO ? p->gather_scale
                       : p->mode == MODE_POLAR       ? SCALE_4
                                                     : SCALE_1;
    return 1 << (choice - SCALE_1);
}

static bool prepare_lowres(struct rsm_state *state, int scale, struct irb_error *err)
{
    if (scale == 1 || (state->lowres && state->lowres->scale == scale))
        return true;
    rsm_lowres_destroy(state->lowres);
    state->lowres = rsm_lowres_create(state->gl, state->irradiance->width,
                                      state->irradiance->height, scale, err);
    return state->lowres != NULL;
}

/* Every scale-th pixel, interpolation, and the gather for what it leaves. */
static bool gather_lowres(struct rsm_state *state, const struct irb_frame_inputs *in,
                          const struct lengths *lengths, struct irb_error *err)
{
    const struct rsm_params *p = in->params;
    struct rsm_lowres *low = state->lowres;
    const struct rsm_agreement agreement = {lengths->position, p->normal_threshold};
    const struct rsm_pixels grid = {
        .gbuffer = in->gbuffer, .target = low->image, .scale = low->scale};
    const struct rsm_pixels rest = {.gbuffer = in->gbuffer,
                                    .target = state->irradiance,
                                    .scale = 1,
                                    .list = low->list,
                                    .work = low->work};
    const struct rsm_programs *programs =
        p->mode == MODE_POLAR ? &state->polar->programs : &state->gather;
    bool ok = true;
    IRB_STAGE(ok, in, STAGE_GATHER, gather(state, in, lengths, &grid, err));
    IRB_STAGE(ok, in, STAGE_INTERPOLATE,
              rsm_lowres_interpolate(low, in->gbuffer, &agreement, state->irradiance,
                                     rsm_programs_group_pixels(programs), err));
    IRB_STAGE(ok, in, STAGE_REFINE, gather(state, in, lengths, &rest, err));
    return ok;
}

static bool gather_full(struct rsm_state *state, const struct irb_frame_inputs *in,
                        const struct lengths *lengths, struct irb_error *err)
{
    const struct rsm_pixels every = {
        .gbuffer = in->gbuffer, .target = state->irradiance, .scale = 1};
    bool ok = true;
    IRB_STAGE(ok, in, STAGE_GATHER, gather(state, in, lengths, &every, err));
    return ok;
}

/* Outside the stages: the report is no part of the method's cost. */
static bool report(struct rsm_state *state, const struct rsm_params *p, float bound, bool lowres,
                   struct irb_frame_output *out, struct irb_error *err)
{
    double share = 0;
    if (bound > 0 && !rsm_energy_lost(state->energy, state->irradiance, &out->clamped_light, err))
        return false;
    /* which texels a pixel leaves out depends on its place in the light's image */
    out->uncovered_flux = p->mode == MODE_POLAR ? NAN : 0;
    if (lowres && !rsm_lowres_share(state->lowres, &share, err))
        return false;
    irb_output_statistic(out, "vpls", p->mode == MODE_POLAR ? p->samples : state->lights->count);
    if (lowres)
        irb_output_statistic(out, "reevaluated", share);
    return true;
}

static bool rsm_render_frame(void *user, const struct irb_frame_inputs *in,
                             struct irb_frame_output *out, struct irb_error *err)
{
    struct rsm_state *state = user;
    const struct rsm_params *p = in->params;
    const struct lengths lengths = lengths_of(p, in->scene);
    const int scale = scale_of(p);

    *out = (struct irb_frame_output){.irradiance = state->irradiance};
    if (!prepare_lowres(state, scale, err))
        return false;
    bool ok = true;
    IRB_STAGE(ok, in, STAGE_SAMPLE, sample(state, in, &lengths, err));
    if (!ok)
        return false;
    ok =
        scale > 1 ? gather_lowres(state, in, &lengths, err) : gather_full(state, in, &lengths, err);
    return ok && report(state, p, lengths.bound, scale > 1, out, err);
}

const struct irb_method irb_method_rsm = {
    .abi = IRB_METHOD_ABI,
    .name = "rsm",
    .title = "Reflective shadow maps",
    .citation = "C. Dachsbacher and M. Stamminger, Reflective Shadow Maps, I3D 2005",
    .path_classes = "LDDE",
    .params_size = sizeof(struct rsm_params),
    .params = params,
    .stages = stages,
    .create = rsm_create,
    .resize = rsm_resize,
    .begin_sequence = rsm_begin_sequence,
    .render_frame = rsm_render_frame,
    .destroy = rsm_destroy,
};
