/* SPDX-License-Identifier: MIT */
#include "core/experiment/render_trial.h"
#include "core/base/clock.h"
#include "core/base/fs.h"
#include "core/experiment/frame_file.h"
#include "core/experiment/paths.h"
#include "core/experiment/provenance.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool keeps_history(const struct irb_trial_run *trial)
{
    return trial->needs & IRB_NEEDS_HISTORY;
}

/* ---- what is there ---- */

static bool image_done(const struct irb_run *run, const char *scene, const struct irb_trial *trial,
                       int64_t id, int frame)
{
    if (irb_store_has_scores(run->store, id, frame))
        return true;
    char *path = irb_run_file(run->dir, scene, trial->folder, "frame", frame, "exr");
    bool done = irb_store_has_frame(run->store, id, frame) && irb_fs_exists(path);
    free(path);
    return done;
}

static bool frame_done(const struct irb_trial_run *trial, const struct irb_passes *passes,
                       int frame)
{
    const struct irb_run *run = passes->run;
    return trial->repeat
               ? irb_store_has_repeat(run->store, trial->id, trial->repeat, frame)
               : image_done(run, passes->sequence->entry->name, trial->trial, trial->id, frame);
}

bool irb_trial_is_rendered(const struct irb_run *run, const struct irb_sequence *sequence,
                           const struct irb_trial *trial)
{
    const char *scene = sequence->entry->name;
    int64_t id = irb_store_trial_find(run->store, scene, trial->name, trial->seed);
    bool all = id > 0;
    for (int i = 0; all && i < sequence->frame_count; i++)
        all = image_done(run, scene, trial, id, i);
    return all;
}

/* A trial's parameters as a JSON object of texts. Malloc'ed. */
static char *params_json(const struct irb_trial *trial)
{
    struct irb_str json = {0}, value = {0};
    irb_str_printf(&json, "{");
    const struct irb_option *o;
    for (int i = 0; (o = irb_trial_option(trial->method, i)); i++) {
        if (irb_trial_option_is_core(o) && irb_trial_is_default(trial, o))
            continue;
        value.length = 0;
        irb_trial_print(trial, o, &value);
        irb_str_printf(&json, "%s\"%s\": ", json.length == 1 ? "" : ", ", o->name);
        if (o->type == IRB_TYPE_ENUM || irb_trial_has_track(trial, o))
            irb_str_json_string(&json, irb_str_text(&value));
        else
            irb_str_printf(&json, "%s", irb_str_text(&value));
    }
    irb_str_printf(&json, "}");
    irb_str_free(&value);
    return json.text;
}

static void say_without_layers(const struct irb_trial_run *trial, const struct irb_run *run,
                               const char *scene)
{
    int done = 0;
    for (int i = 0; i < run->config->render.frames; i++)
        done += image_done(run, scene, trial->trial, trial->id, i);
    if (done)
        irb_info(run->log, "%s: %d frames are rendered already and get no more debug layers",
                 trial->trial->folder, done);
}

bool irb_trial_run_open(struct irb_trial_run *trial, struct irb_run *run,
                        const struct irb_sequence *sequence, const struct irb_trial *of,
                        struct irb_error *err)
{
    const char *scene = sequence->entry->name;
    char *json = params_json(of);
    *trial = (struct irb_trial_run){
        .trial = of,
        .id = irb_store_trial(run->store, scene, of->method->name, of->name, json, of->seed, err),
        .needs = irb_trial_needs(of, run->config->render.frames),
        .last_frame = -1,
    };
    free(json);
    if (!trial->id || !irb_provenance_store_stages(run, of->method, err))
        return false;
    char *folder = irb_run_folder(run->dir, scene, of->folder);
    bool ok = irb_fs_make_dirs(folder, err);
    irb_fs_remove_stale(folder);
    free(folder);
    if (run->config->output.debug_layers)
        say_without_layers(trial, run, scene);
    return ok;
}

void irb_trial_run_look(struct irb_trial_run *trial, const struct irb_passes *passes, int repeat)
{
    trial->repeat = repeat;
    trial->last_frame = -1;
    for (int i = 0; i < passes->sequence->frame_count; i++)
        if (!frame_done(trial, passes, i))
            trial->last_frame = i;
}

bool irb_trial_run_needs_frame(const struct irb_trial_run *trial, const struct irb_passes *passes,
                               int frame)
{
    if (trial->last_frame < 0 || frame > trial->last_frame)
        return false;
    if (keeps_history(trial))
        return frame >= -irb_settle_frames(&passes->run->config->render);
    return frame < 0 ? frame >= -IRB_WARM_UP_FRAMES : !frame_done(trial, passes, frame);
}

/* ---- state ---- */

/* The clock when all that was asked of the GPU is done. */
static double finished_s(const struct irb_run *run)
{
    run->gl->api.Finish();
    return irb_clock_s();
}

bool irb_trial_run_begin(struct irb_trial_run *trial, struct irb_passes *passes,
                         struct irb_error *err)
{
    struct irb_run *run = passes->run;
    const struct irb_render_settings *render = &run->config->render;
    const struct irb_method *method = trial->trial->method;
    if (passes->sequence->moves && (trial->needs & IRB_NEEDS_STATIC_GEOMETRY))
        return irb_fail(err, IRB_E_USAGE, "%s: needs objects that rest, but those of %s move",
                        method->name, passes->sequence->entry->name);
    trial->params = calloc(1, method->params_size ? method->params_size : 1);
    if (!trial->params)
        return irb_fail(err, IRB_E_MEMORY, "no memory for the parameters of %s", method->name);
    trial->timer = irb_timer_create(run->gl, err);
    if (!trial->timer)
        return false;
    int64_t before = run->gl->bytes;
    double begin = finished_s(run);
    trial->state = method->create(run->gl, passes->scene, render->width, render->height,
                                  trial->trial->params, err);
    double created = finished_s(run);
    bool ok = trial->state && method->begin_sequence(trial->state, trial->trial->params,
                                                     (uint64_t)trial->trial->seed, err);
    trial->create_ms = 1e3 * (created - begin);
    trial->settle_ms = 1e3 * (finished_s(run) - created);
    trial->bytes = run->gl->bytes - before;
    return ok;
}

void irb_trial_run_end(struct irb_trial_run *trial)
{
    if (trial->state)
        trial->trial->method->destroy(trial->state);
    irb_timer_destroy(trial->timer);
    free(trial->params);
    trial->state = trial->params = NULL;
    trial->timer = NULL;
}

/* ---- a frame ---- */

/* What irb_output_statistic() had no room for. */
static bool check_statistics(const struct irb_frame_output *output, struct irb_error *err)
{
    return (output->statistic_count >= 0 && output->statistic_count <= IRB_MAX_STATISTICS) ||
           irb_fail(err, IRB_E_INPUT, "expected at most %d statistics of a method, found %d",
                    IRB_MAX_STATISTICS, output->statistic_count);
}

/* A history that has no frames to settle in begins with frame 0, whatever was rendered to warm up.
 */
static bool forget_warm_up(struct irb_trial_run *trial, const struct irb_run *run,
                           struct irb_error *err)
{
    const struct irb_trial *of = trial->trial;
    return !keeps_history(trial) || run->config->render.settle > 0 ||
           of->method->begin_sequence(trial->state, of->params, (uint64_t)of->seed, err);
}

static bool render(struct irb_trial_run *trial, struct irb_passes *passes, int frame, bool debug,
                   struct irb_frame_output *output, double ms[IRB_MAX_STAGES],
                   struct irb_error *err)
{
    const struct irb_sequence_frame *pose = &passes->sequence->frames[frame < 0 ? 0 : frame];
    struct irb_gl *gl = passes->run->gl;
    irb_trial_params(trial->trial, frame, trial->params);
    struct irb_frame_inputs inputs = {
        .scene = passes->scene,
        .light = &pose->light,
        .camera = &pose->camera,
        .gbuffer = irb_passes_gbuffer(passes),
        .rsm = irb_passes_rsm(passes, trial->trial)->rsm,
        .frame = frame,
        .seed = (uint64_t)trial->trial->seed,
        .params = trial->params,
        .timer = trial->timer,
        .debug = debug,
    };
    int64_t before = gl->bytes;
    double begin = frame < 0 ? finished_s(passes->run) : 0;
    *output = (struct irb_frame_output){.uncovered_flux = NAN, .clamped_light = NAN};
    bool ok = trial->trial->method->render_frame(trial->state, &inputs, output, err) &&
              check_statistics(output, err) && irb_gl_check(gl, trial->trial->name, err);
    irb_timer_collect(trial->timer, ms);
    ok = ok && (frame >= 0 || forget_warm_up(trial, passes->run, err));
    if (frame < 0)
        trial->settle_ms += 1e3 * (finished_s(passes->run) - begin);
    trial->bytes += gl->bytes - before; /* a method may allocate when it first draws */
    return ok || irb_error_prefix(err, "%s: frame %d", trial->trial->folder, frame);
}

/* Images to files. The debug layers are read back here, after the stages' times. */
static bool save_output(struct irb_trial_run *trial, const struct irb_passes *passes, int frame,
                        const struct irb_frame_output *output, struct irb_error *err)
{
    struct irb_run *run = passes->run;
    const char *name = passes->sequence->entry->name;
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

/* Times of the core's stages and of the method's; returns how many. */
static int list_stages(const struct irb_trial_run *trial, const struct irb_passes *passes,
                       const double ms[IRB_MAX_STAGES],
                       struct irb_store_value out[IRB_CORE_STAGE_COUNT + IRB_MAX_STAGES])
{
    int count = 0;
    for (int i = 0; i < IRB_CORE_STAGE_COUNT; i++)
        out[count++] = (struct irb_store_value){
            irb_core_stages[i],
            i == IRB_CORE_RSM ? irb_passes_rsm(passes, trial->trial)->ms : passes->ms[i]};
    const char *const *names = trial->trial->method->stages;
    for (int i = 0; names[i] && i < IRB_MAX_STAGES; i++)
        out[count++] = (struct irb_store_value){names[i], ms[i]};
    return count;
}

static int list_statistics(const struct irb_trial_run *trial, const struct irb_frame_output *output,
                           struct irb_store_value out[IRB_MAX_STATISTICS + 3])
{
    int count = 0;
    out[count++] = (struct irb_store_value){"uncovered_flux", output->uncovered_flux};
    out[count++] = (struct irb_store_value){"clamped_light", output->clamped_light};
    out[count++] = (struct irb_store_value){"gl_bytes", (double)trial->bytes};
    for (int i = 0; i < output->statistic_count; i++)
        out[count++] =
            (struct irb_store_value){output->statistics[i].name, output->statistics[i].value};
    return count;
}

static bool store_frame(struct irb_trial_run *trial, const struct irb_passes *passes, int frame,
                        const struct irb_frame_output *output, const double ms[IRB_MAX_STAGES],
                        struct irb_error *err)
{
    struct irb_store *store = passes->run->store;
    struct irb_store_value stages[IRB_CORE_STAGE_COUNT + IRB_MAX_STAGES];
    struct irb_store_value statistics[IRB_MAX_STATISTICS + 3];
    int stage_count = list_stages(trial, passes, ms, stages);
    if (trial->repeat)
        return irb_store_repeat(store, trial->id, trial->repeat, frame, stages, stage_count, err);
    return save_output(trial, passes, frame, output, err) &&
           irb_store_frame(store, trial->id, frame, irb_timer_clock(trial->timer), stages,
                           stage_count, statistics, list_statistics(trial, output, statistics),
                           err);
}

/* ---- costs, and whether repeats are the same ---- */

static bool store_costs(const struct irb_trial_run *trial, const struct irb_passes *passes,
                        struct irb_error *err)
{
    struct irb_store *store = passes->run->store;
    return irb_store_cost(store, trial->id, "create_ms", trial->create_ms, err) &&
           irb_store_cost(store, trial->id, "settle_ms", trial->settle_ms, err);
}

/* Hash of what the method returned. */
static bool output_key(const struct irb_frame_output *output, struct irb_key *key,
                       struct irb_error *err)
{
    const struct irb_texture *const textures[] = {output->irradiance, output->radiance};
    struct irb_hash *hash = irb_hash_create();
    bool ok = true;
    for (int i = 0; ok && i < 2; i++) {
        struct irb_image image = {0};
        ok = !textures[i] || irb_texture_read(textures[i], 3, &image, err);
        if (ok && textures[i])
            irb_hash_floats(hash, image.data, 3 * irb_image_pixels(&image));
        irb_image_destroy(&image);
    }
    *key = irb_hash_finish(hash);
    return ok;
}

/* The image of the sequence's last frame in repeat 0 is remembered by its hash; in every later
 * repeat it has to be the same, bit for bit. */
static bool check_repeat(const struct irb_trial_run *trial, const struct irb_passes *passes,
                         int frame, const struct irb_frame_output *output, struct irb_error *err)
{
    struct irb_key key;
    if (frame != passes->sequence->frame_count - 1)
        return true;
    if (!output_key(output, &key, err))
        return false;
    struct irb_store *store = passes->run->store;
    char *name = irb_asprintf("trial/%lld/last_image", (long long)trial->id);
    char *first = trial->repeat ? irb_store_get_meta(store, name) : NULL;
    bool ok = trial->repeat || irb_store_set_meta(store, name, key.hex, err);
    if (first && strcmp(first, key.hex))
        ok = irb_fail(err, IRB_E_BACKEND,
                      "%s: frame %d: repeat %d is not the image of repeat 0, bit for bit: the "
                      "method, or the driver, does not do the same twice",
                      trial->trial->folder, frame, trial->repeat);
    free(first);
    free(name);
    return ok;
}

bool irb_trial_run_frame(struct irb_trial_run *trial, struct irb_passes *passes, int frame,
                         struct irb_error *err)
{
    struct irb_run *run = passes->run;
    struct irb_frame_output output;
    double ms[IRB_MAX_STAGES];
    bool stored = frame >= 0 && !frame_done(trial, passes, frame);
    bool debug = stored && !trial->repeat && run->config->output.debug_layers;
    irb_run_work(run, IRB_WORK_RENDER);
    if (!render(trial, passes, frame, debug, &output, ms, err))
        return false;
    irb_run_work(run, IRB_WORK_STORE);
    return !stored || ((frame || trial->repeat || store_costs(trial, passes, err)) &&
                       check_repeat(trial, passes, frame, &output, err) &&
                       store_frame(trial, passes, frame, &output, ms, err));
}
