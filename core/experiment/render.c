/* SPDX-License-Identifier: MIT
 *
 * Render: every frame of every trial of one scene. Frames are the outer loop, so that the trials
 * are interleaved in time (A B A B ...) and share the G-buffer, the RSM and the direct light.
 */
#include "core/base/clock.h"
#include "core/base/fs.h"
#include "core/experiment/frame_file.h"
#include "core/experiment/paths.h"
#include "core/experiment/provenance.h"
#include "core/experiment/render.h"
#include "core/frame/direct.h"
#include "core/image/exr.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Warm-up frames of a method that keeps no history: they only load caches and compile shaders. */
enum { WARM_UP_FRAMES = 1 };

/* Above this share of differing pixels the reference belongs to another image altogether. */
static const double largest_masked_share = 0.05;

struct trial_run {
    const struct irb_trial *trial;
    int64_t id;
    unsigned needs; /* enum irb_method_needs */
    void *state;    /* the method's; NULL when there is nothing to render */
    void *params;   /* of the frame that is being rendered; owned */
    int last_frame; /* last frame that has to be rendered, -1 for none */
    struct irb_timer *timer;
    int64_t bytes; /* of GL objects that the method holds */
};

struct scene_run {
    struct irb_run *run;
    struct irb_sequence *sequence;
    struct irb_scene_gl *scene;
    struct irb_gbuffer *gbuffer; /* full precision: direct light, masks */
    struct irb_rsm *rsm;
    struct irb_gbuffer *slim_gbuffer; /* what methods get instead, NULL where they get the full */
    struct irb_rsm *slim_rsm;
    struct irb_direct *direct;
    struct irb_timer *timer; /* of the core's stages */
    double core_ms[IRB_MAX_STAGES];
    struct trial_run *trials;
    int trial_count;
};

static bool keeps_history(const struct trial_run *trial)
{
    return trial->needs & IRB_NEEDS_HISTORY;
}

static bool frame_done(struct scene_run *scene, const struct trial_run *trial, int frame)
{
    if (irb_store_has_scores(scene->run->store, trial->id, frame))
        return true;
    char *path = irb_run_file(scene->run->dir, scene->sequence->entry->name, trial->trial->folder,
                              "frame", frame, "exr");
    bool done = irb_store_has_frame(scene->run->store, trial->id, frame) && irb_fs_exists(path);
    free(path);
    return done;
}

/* A trial's parameters as a JSON object of texts. Malloc'ed. */
static char *params_json(const struct irb_trial *trial)
{
    struct irb_str json = {0}, value = {0};
    irb_str_printf(&json, "{");
    for (const struct irb_option *o = trial->method->params; o->name; o++) {
        value.length = 0;
        irb_trial_print(trial, o, &value);
        irb_str_printf(&json, "%s\"%s\": ", o == trial->method->params ? "" : ", ", o->name);
        if (o->type == IRB_TYPE_ENUM || irb_trial_has_track(trial, o))
            irb_str_json_string(&json, irb_str_text(&value));
        else
            irb_str_printf(&json, "%s", irb_str_text(&value));
    }
    irb_str_printf(&json, "}");
    irb_str_free(&value);
    return json.text;
}

static bool open_trial(struct scene_run *scene, struct trial_run *trial, struct irb_error *err)
{
    struct irb_run *run = scene->run;
    const struct irb_config *config = run->config;
    char *json = params_json(trial->trial);
    trial->id =
        irb_store_trial(run->store, scene->sequence->entry->name, trial->trial->method->name,
                        trial->trial->name, json, trial->trial->seed, err);
    free(json);
    if (!trial->id || !irb_provenance_store_stages(run, trial->trial->method, err))
        return false;
    char *folder = irb_run_folder(run->dir, scene->sequence->entry->name, trial->trial->folder);
    bool ok = irb_fs_make_dirs(folder, err);
    irb_fs_remove_stale(folder);
    free(folder);
    int done = 0;
    trial->needs = irb_trial_needs(trial->trial, config->render.frames);
    trial->last_frame = -1;
    for (int i = 0; i < config->render.frames; i++) {
        if (!frame_done(scene, trial, i))
            trial->last_frame = i;
        else
            done++;
    }
    if (done && config->output.debug_layers)
        irb_info(run->log, "%s: %d frames are rendered already and get no more debug layers",
                 trial->trial->folder, done);
    return ok;
}

static bool create_trial_state(struct scene_run *scene, struct trial_run *trial,
                               struct irb_error *err)
{
    const struct irb_config *config = scene->run->config;
    const struct irb_method *method = trial->trial->method;
    if (scene->sequence->moves && (trial->needs & IRB_NEEDS_STATIC_GEOMETRY))
        return irb_fail(err, IRB_E_USAGE, "%s: needs objects that rest, but those of %s move",
                        method->name, scene->sequence->entry->name);
    trial->params = calloc(1, method->params_size ? method->params_size : 1);
    if (!trial->params)
        return irb_fail(err, IRB_E_MEMORY, "no memory for the parameters of %s", method->name);
    trial->timer = irb_timer_create(scene->run->gl, err);
    if (!trial->timer)
        return false;
    int64_t before = scene->run->gl->bytes;
    trial->state = method->create(scene->run->gl, scene->scene, config->render.width,
                                  config->render.height, trial->trial->params, err);
    bool ok = trial->state && method->begin_sequence(trial->state, trial->trial->params,
                                                     (uint64_t)trial->trial->seed, err);
    trial->bytes = scene->run->gl->bytes - before;
    return ok;
}

static void close_scene(struct scene_run *scene)
{
    for (int i = 0; i < scene->trial_count; i++) {
        struct trial_run *trial = &scene->trials[i];
        if (trial->state)
            trial->trial->method->destroy(trial->state);
        irb_timer_destroy(trial->timer);
        free(trial->params);
    }
    free(scene->trials);
    irb_timer_destroy(scene->timer);
    irb_direct_destroy(scene->direct);
    irb_rsm_destroy(scene->slim_rsm);
    irb_rsm_destroy(scene->rsm);
    irb_gbuffer_destroy(scene->slim_gbuffer);
    irb_gbuffer_destroy(scene->gbuffer);
    irb_scene_gl_destroy(scene->scene);
}

/* The G-buffer and RSM that methods read, where their layout is not the full one. */
static bool open_slim(struct scene_run *scene, struct irb_error *err)
{
    const struct irb_render_settings *render = &scene->run->config->render;
    struct irb_gl *gl = scene->run->gl;
    return (render->gbuffer_layout == IRB_LAYOUT_FULL ||
            (scene->slim_gbuffer =
                 irb_gbuffer_create_layout(gl, (enum irb_layout)render->gbuffer_layout,
                                           render->width, render->height, err))) &&
           (render->rsm_layout == IRB_LAYOUT_FULL ||
            (scene->slim_rsm = irb_rsm_create_layout(gl, (enum irb_layout)render->rsm_layout,
                                                     render->rsm_resolution, err)));
}

static bool open_passes(struct scene_run *scene, struct irb_error *err)
{
    const struct irb_render_settings *render = &scene->run->config->render;
    struct irb_gl *gl = scene->run->gl;
    return irb_sequence_pose(scene->sequence, 0, err) &&
           (scene->scene = irb_scene_gl_create(gl, scene->sequence->scene, err)) &&
           (scene->gbuffer = irb_gbuffer_create(gl, render->width, render->height, err)) &&
           (scene->rsm = irb_rsm_create(gl, render->rsm_resolution, err)) &&
           (scene->direct = irb_direct_create(gl, render->width, render->height, err)) &&
           open_slim(scene, err) && (scene->timer = irb_timer_create(gl, err));
}

/* The passes that all trials share; the times go to core_ms. Of a G-buffer or RSM in two layouts
 * the one that methods read is timed: the other is the harness's own. */
static bool render_core(struct scene_run *scene, int frame, struct irb_error *err)
{
    const struct irb_sequence_frame *pose = &scene->sequence->frames[frame < 0 ? 0 : frame];
    struct irb_gbuffer *gbuffer = scene->slim_gbuffer ? scene->slim_gbuffer : scene->gbuffer;
    struct irb_rsm *rsm = scene->slim_rsm ? scene->slim_rsm : scene->rsm;
    bool ok =
        irb_sequence_pose(scene->sequence, frame, err) && irb_scene_gl_update(scene->scene, err);
    irb_timer_begin(scene->timer, IRB_CORE_GBUFFER);
    ok = ok && irb_gbuffer_render(gbuffer, scene->scene, &pose->camera, err);
    irb_timer_end(scene->timer);
    irb_timer_begin(scene->timer, IRB_CORE_RSM);
    ok = ok && irb_rsm_render(rsm, scene->scene, &pose->light, err);
    irb_timer_end(scene->timer);
    ok = ok &&
         (gbuffer == scene->gbuffer ||
          irb_gbuffer_render(scene->gbuffer, scene->scene, &pose->camera, err)) &&
         (rsm == scene->rsm || irb_rsm_render(scene->rsm, scene->scene, &pose->light, err));
    irb_timer_begin(scene->timer, IRB_CORE_DIRECT);
    ok = ok && irb_direct_render(scene->direct, scene->gbuffer, scene->rsm, &pose->light,
                                 &pose->camera, err);
    irb_timer_end(scene->timer);
    irb_timer_collect(scene->timer, scene->core_ms);
    return ok;
}

/* What irb_output_statistic() had no room for. */
static bool check_statistics(const struct irb_frame_output *output, struct irb_error *err)
{
    return (output->statistic_count >= 0 && output->statistic_count <= IRB_MAX_STATISTICS) ||
           irb_fail(err, IRB_E_INPUT, "expected at most %d statistics of a method, found %d",
                    IRB_MAX_STATISTICS, output->statistic_count);
}

static bool render_trial(struct scene_run *scene, struct trial_run *trial, int frame, bool debug,
                         struct irb_frame_output *output, double ms[IRB_MAX_STAGES],
                         struct irb_error *err)
{
    const struct irb_sequence_frame *pose = &scene->sequence->frames[frame < 0 ? 0 : frame];
    irb_trial_params(trial->trial, frame, trial->params);
    struct irb_frame_inputs inputs = {
        .scene = scene->scene,
        .light = &pose->light,
        .camera = &pose->camera,
        .gbuffer = scene->slim_gbuffer ? scene->slim_gbuffer : scene->gbuffer,
        .rsm = scene->slim_rsm ? scene->slim_rsm : scene->rsm,
        .frame = frame,
        .seed = (uint64_t)trial->trial->seed,
        .params = trial->params,
        .timer = trial->timer,
        .debug = debug,
    };
    int64_t before = scene->run->gl->bytes;
    *output = (struct irb_frame_output){.uncovered_flux = NAN, .clamped_light = NAN};
    bool ok = trial->trial->method->render_frame(trial->state, &inputs, output, err) &&
              check_statistics(output, err) &&
              irb_gl_check(scene->run->gl, trial->trial->name, err);
    irb_timer_collect(trial->timer, ms);
    trial->bytes += scene->run->gl->bytes - before; /* a method may allocate when it first draws */
    return ok || irb_error_prefix(err, "%s: frame %d", trial->trial->folder, frame);
}

/* Images to files. The debug layers are read back here, after the stages' times. */
static bool save_output(struct scene_run *scene, struct trial_run *trial, int frame,
                        const struct irb_frame_output *output, struct irb_error *err)
{
    struct irb_run *run = scene->run;
    const char *name = scene->sequence->entry->name;
    const struct irb_frame_place place = {run->dir, name, trial->trial->folder, frame};
    struct irb_debug_layers debug = {0};
    struct irb_frame_provenance from;
    irb_frame_provenance(&from, name, trial->trial, frame, &run->config_key);
    char *path = irb_frame_path(&place, "frame", "exr");
    /* the frame file last: with it the frame is there */
    bool ok = (!run->config->output.debug_layers || irb_debug_layers_read(&debug, output, err) ||
               irb_error_prefix(err, "%s: frame %d", trial->trial->folder, frame)) &&
              irb_debug_layers_save_apart(&debug, &place, from.list, IRB_FRAME_ATTRIBUTES, err) &&
              irb_frame_file_save(path, output, &debug, err);
    free(path);
    irb_debug_layers_destroy(&debug);
    return ok;
}

static bool store_frame(struct scene_run *scene, struct trial_run *trial, int frame,
                        const struct irb_frame_output *output, const double ms[IRB_MAX_STAGES],
                        struct irb_error *err)
{
    struct irb_run *run = scene->run;
    bool ok = save_output(scene, trial, frame, output, err);
    struct irb_store_value stages[IRB_CORE_STAGE_COUNT + IRB_MAX_STAGES];
    int stage_count = 0;
    for (int i = 0; i < IRB_CORE_STAGE_COUNT; i++)
        stages[stage_count++] = (struct irb_store_value){irb_core_stages[i], scene->core_ms[i]};
    const char *const *names = trial->trial->method->stages;
    for (int i = 0; names[i] && i < IRB_MAX_STAGES; i++)
        stages[stage_count++] = (struct irb_store_value){names[i], ms[i]};
    struct irb_store_value statistics[IRB_MAX_STATISTICS + 3];
    int statistic_count = 0;
    statistics[statistic_count++] =
        (struct irb_store_value){"uncovered_flux", output->uncovered_flux};
    statistics[statistic_count++] =
        (struct irb_store_value){"clamped_light", output->clamped_light};
    statistics[statistic_count++] = (struct irb_store_value){"gl_bytes", (double)trial->bytes};
    for (int i = 0; i < output->statistic_count; i++)
        statistics[statistic_count++] =
            (struct irb_store_value){output->statistics[i].name, output->statistics[i].value};
    return ok && irb_store_frame(run->store, trial->id, frame, irb_timer_clock(trial->timer),
                                 stages, stage_count, statistics, statistic_count, err);
}

/* Writes the mask of the pixels where this driver's G-buffer is not the reference's. */
static bool store_mask(struct scene_run *scene, int frame, const struct irb_gbuffer_image *mine,
                       const char *cached, struct irb_error *err)
{
    struct irb_run *run = scene->run;
    const char *name = scene->sequence->entry->name;
    struct irb_gbuffer_image prepared = {0};
    struct irb_image mask = {0};
    double share = 0;
    bool ok = irb_gbuffer_image_load(&prepared, cached, err) &&
              irb_gbuffer_difference(mine, &prepared, &mask, &share, err);
    if (ok && share > largest_masked_share)
        ok = irb_fail(err, IRB_E_BACKEND,
                      "%s: frame %d: %.1f %% of the pixels see another surface than the reference "
                      "does (at most %.0f %% can be masked)",
                      name, frame, 100 * share, 100 * largest_masked_share);
    char *path = irb_run_file(run->dir, name, NULL, "mask", frame, "exr");
    struct irb_exr_layer layer = {"mask", "Y", &mask};
    ok = ok && irb_exr_write(path, &layer, 1, NULL, 0, IRB_EXR_ZIP, err);
    free(path);
    if (ok)
        irb_warn(run->log,
                 "%s: frame %d: %.3f %% of the pixels are masked: this driver's G-buffer differs "
                 "from the reference's",
                 name, frame, 100 * share);
    irb_image_destroy(&mask);
    irb_gbuffer_image_destroy(&prepared);
    return ok;
}

/* Direct light and, once a camera pose, the check against the reference's G-buffer. */
static bool store_shared(struct scene_run *scene, int frame, struct irb_error *err)
{
    struct irb_run *run = scene->run;
    const struct irb_key *expected = &scene->sequence->frames[frame].gbuffer;
    char *direct =
        irb_run_file(run->dir, scene->sequence->entry->name, NULL, "direct", frame, "exr");
    bool ok = irb_fs_exists(direct) || irb_direct_file_save(direct, scene->direct->radiance, err);
    free(direct);
    if (!ok || irb_sequence_same_view(scene->sequence, frame))
        return ok;
    struct irb_gbuffer_image mine = {0};
    if (!irb_gbuffer_read(scene->gbuffer, &mine, err))
        return false;
    struct irb_key key = irb_gbuffer_image_key(&mine);
    if (strcmp(key.hex, expected->hex)) {
        char *cached = irb_cache_gbuffer(run->cache, expected);
        ok = store_mask(scene, frame, &mine, cached, err);
        free(cached);
    }
    irb_gbuffer_image_destroy(&mine);
    return ok;
}

static bool trial_frame(struct scene_run *scene, struct trial_run *trial, int frame,
                        struct irb_error *err)
{
    struct irb_run *run = scene->run;
    bool warm_up = frame < 0;
    if (!trial->state || frame > trial->last_frame)
        return true;
    if (warm_up && !keeps_history(trial) && frame < -WARM_UP_FRAMES)
        return true;
    bool done = !warm_up && frame_done(scene, trial, frame);
    if (done && !keeps_history(trial))
        return true;
    struct irb_frame_output output;
    double ms[IRB_MAX_STAGES];
    irb_run_work(run, IRB_WORK_RENDER);
    bool stored = !done && !warm_up;
    bool debug = stored && run->config->output.debug_layers;
    if (!render_trial(scene, trial, frame, debug, &output, ms, err))
        return false;
    irb_run_work(run, IRB_WORK_STORE);
    return !stored || store_frame(scene, trial, frame, &output, ms, err);
}

/* The first frame (a negative one while settling) that anything has to be rendered for. */
static int first_frame(struct scene_run *scene)
{
    int first = scene->run->config->render.frames;
    for (int t = 0; t < scene->trial_count; t++) {
        const struct trial_run *trial = &scene->trials[t];
        if (trial->last_frame < 0)
            continue;
        int settle = keeps_history(trial) ? scene->run->config->render.settle : WARM_UP_FRAMES;
        if (-settle < first)
            first = -settle;
    }
    return first;
}

static bool render_frames(struct scene_run *scene, struct irb_error *err)
{
    struct irb_run *run = scene->run;
    int frames = run->config->render.frames, first = first_frame(scene);
    double start = irb_clock_s();
    for (int frame = first; frame < frames; frame++) {
        irb_run_work(run, IRB_WORK_RENDER);
        if (irb_run_stopped(run, err) || !render_core(scene, frame, err))
            return false;
        irb_run_work(run, IRB_WORK_STORE);
        if (frame >= 0 && !store_shared(scene, frame, err))
            return false;
        for (int t = 0; t < scene->trial_count; t++) {
            if (irb_run_stopped(run, err) || !trial_frame(scene, &scene->trials[t], frame, err))
                return false;
            double done = frame - first + (t + 1.0) / scene->trial_count;
            irb_log_progress(run->log, "render", done / (frames - first), irb_clock_s() - start);
        }
    }
    return true;
}

bool irb_render_sequence(struct irb_run *run, struct irb_sequence *sequence, struct irb_error *err)
{
    struct scene_run scene = {.run = run, .sequence = sequence};
    scene.trials = calloc((size_t)run->config->trial_count, sizeof *scene.trials);
    if (!scene.trials)
        return irb_fail(err, IRB_E_MEMORY, "no memory for %d trials", run->config->trial_count);
    scene.trial_count = run->config->trial_count;
    int to_render = 0;
    bool ok = irb_run_need_gl(run, err) && irb_provenance_store_gl(run, err);
    irb_run_work(run, IRB_WORK_STORE);
    for (int i = 0; ok && i < scene.trial_count; i++) {
        scene.trials[i].trial = &run->config->trials[i];
        ok = open_trial(&scene, &scene.trials[i], err);
        to_render += scene.trials[i].last_frame >= 0;
    }
    irb_run_work(run, IRB_WORK_RENDER);
    if (ok && to_render) {
        irb_info(run->log, "%s: rendering %d of %d trials, %d frames", sequence->entry->name,
                 to_render, scene.trial_count, run->config->render.frames);
        ok = open_passes(&scene, err);
        for (int i = 0; ok && i < scene.trial_count; i++)
            if (scene.trials[i].last_frame >= 0)
                ok = create_trial_state(&scene, &scene.trials[i], err);
        ok = ok && render_frames(&scene, err);
        irb_log_progress_done(run->log);
    }
    close_scene(&scene);
    return ok;
}
