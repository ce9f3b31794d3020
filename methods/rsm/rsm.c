/* SPDX-License-Identifier: MIT
 *
 * Plain reflective shadow maps: one-bounce light from RSM texels taken as virtual point lights,
 * without indirect visibility.
 */
#include "methods/method.h"
#include "methods/rsm/gather.h"

#include <stdlib.h>

extern const struct irb_method irb_method_rsm;

struct rsm_params {
    int mode; /* enum irb_vpl_sampling */
    int samples;
    float clamp;
};

enum { SAMPLES_DEFAULT = 400, SAMPLES_MOST = 1 << 20 };

static const struct irb_option params[] = {
    IRB_OPTION_ENUM(struct rsm_params, mode, IRB_VPL_UNIFORM, irb_vpl_sampling_names,
                    "which texels light the scene: all of them, Halton points over the map, or "
                    "Halton points warped by flux",
                    "Dachsbacher and Stamminger 2005; Clarberg et al. 2005"),
    IRB_OPTION_INT(struct rsm_params, samples, SAMPLES_DEFAULT, 1, SAMPLES_MOST, "",
                   "texels that are drawn, the same for all pixels (without effect on mode=all)",
                   "Dachsbacher and Stamminger 2005, section 4"),
    IRB_OPTION_FLOAT(
        struct rsm_params, clamp, 0, 0, 1e12, "",
        "largest cos cos d^2/r^2 of a light and a pixel, d the diagonal of the scene's "
        "bounds; 0 = no clamp",
        "thesis 3.2.1; the unit: ours"),
    IRB_OPTION_END,
};

enum { STAGE_SAMPLE, STAGE_GATHER };
static const char *const stages[] = {"sample", "gather", NULL};

struct rsm_state {
    struct irb_gl *gl; /* borrowed */
    struct rsm_gather *gather;
    struct irb_vpl_set *lights; /* made when the first frame shows the RSM's resolution */
    int rsm_resolution;         /* that `lights` is made for */
};

static void rsm_destroy(void *user)
{
    struct rsm_state *state = user;
    if (!state)
        return;
    rsm_gather_destroy(state->gather);
    irb_vpl_set_destroy(state->lights);
    free(state);
}

static bool rsm_resize(void *user, int width, int height, struct irb_error *err)
{
    struct rsm_state *state = user;
    struct rsm_gather *gather = rsm_gather_create(state->gl, width, height, err);
    if (!gather)
        return false;
    rsm_gather_destroy(state->gather);
    state->gather = gather;
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
    if (rsm_resize(state, width, height, err))
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

/* Makes the set of lights anew where mode, RSM or number of samples ask for another one. */
static bool prepare_lights(struct rsm_state *state, const struct rsm_params *p, int rsm_resolution,
                           struct irb_error *err)
{
    struct irb_vpl_set *set = state->lights;
    if (set && (int)set->sampling == p->mode && state->rsm_resolution == rsm_resolution &&
        (p->mode == IRB_VPL_ALL || set->capacity >= p->samples))
        return true;
    irb_vpl_set_destroy(set);
    state->lights = irb_vpl_set_create(state->gl, (enum irb_vpl_sampling)p->mode, rsm_resolution,
                                       p->mode == IRB_VPL_ALL ? 1 : p->samples, err);
    state->rsm_resolution = rsm_resolution;
    return state->lights != NULL;
}

/* Seed s takes the s-th stretch of the Halton sequence, so that seeds share no points; 2^30 points
 * are exact in the radical inverses. */
static unsigned first_point(uint64_t seed, int samples)
{
    return (unsigned)((seed * (uint64_t)samples) & ((1u << 30) - 1));
}

/* cos cos/r^2 in 1/m2; 0 for no clamp. The bounds are those at rest: the same in all frames. */
static float clamp_bound(const struct rsm_params *p, const struct irb_scene_gl *scene)
{
    float diagonal = irb_scene_diagonal(scene->scene);
    return diagonal > 0 ? p->clamp / (diagonal * diagonal) : 0;
}

static bool rsm_render_frame(void *user, const struct irb_frame_inputs *in,
                             struct irb_frame_output *out, struct irb_error *err)
{
    struct rsm_state *state = user;
    const struct rsm_params *p = in->params;
    const float bound = clamp_bound(p, in->scene);

    *out = (struct irb_frame_output){0};
    irb_timer_begin(in->timer, STAGE_SAMPLE);
    bool ok = prepare_lights(state, p, in->rsm->resolution, err) &&
              irb_vpl_set_sample(state->lights, in->rsm, p->samples,
                                 first_point(in->seed, p->samples), err);
    irb_timer_end(in->timer);
    if (!ok)
        return false;
    irb_timer_begin(in->timer, STAGE_GATHER);
    ok = rsm_gather_run(state->gather, in->gbuffer, state->lights, bound, err);
    irb_timer_end(in->timer);
    /* measured outside the stages: the report is no part of the method's cost */
    if (!ok || (bound > 0 && !rsm_gather_lost(state->gather, &out->lost_energy, err)))
        return false;
    out->irradiance = state->gather->irradiance;
    out->statistics[out->statistic_count].name = "vpls";
    out->statistics[out->statistic_count++].value = state->lights->count;
    return true;
}

const struct irb_method irb_method_rsm = {
    .abi = IRB_METHOD_ABI,
    .name = "rsm",
    .title = "Reflective shadow maps",
    .citation = "C. Dachsbacher and M. Stamminger, Reflective Shadow Maps, I3D 2005",
    .path_classes = "LDDE",
    .claims_visibility = false,
    .needs = IRB_NEEDS_NOTHING,
    .params_size = sizeof(struct rsm_params),
    .params = params,
    .stages = stages,
    .create = rsm_create,
    .resize = rsm_resize,
    .begin_sequence = rsm_begin_sequence,
    .render_frame = rsm_render_frame,
    .destroy = rsm_destroy,
};
