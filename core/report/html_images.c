/* SPDX-License-Identifier: MIT */
#include "core/report/html_images.h"
#include "core/base/fs.h"
#include "core/experiment/paths.h"
#include "core/report/html_text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static void *allocate(size_t count, size_t size)
{
    void *out = calloc(count ? count : 1, size);
    if (!out)
        abort(); /* a list of names: nothing that holds results is lost */
    return out;
}

/* ---- what there is */

static void strip_create(struct irb_html_strip *strip, int count)
{
    strip->paths = allocate((size_t)count, sizeof *strip->paths);
    strip->bytes = allocate((size_t)count, sizeof *strip->bytes);
    strip->count = count;
    strip->id = -1;
}

/* Takes the path. */
static void strip_put(struct irb_html_strip *strip, int index, char *path)
{
    struct stat info;
    if (stat(path, &info) || !S_ISREG(info.st_mode) || info.st_size <= 0) {
        free(path);
        return;
    }
    strip->paths[index] = path;
    strip->bytes[index] = (size_t)info.st_size;
}

static bool strip_any(const struct irb_html_strip *strip)
{
    for (int i = 0; i < strip->count; i++)
        if (strip->paths[i])
            return true;
    return false;
}

static void strip_destroy(struct irb_html_strip *strip)
{
    for (int i = 0; i < strip->count; i++)
        free(strip->paths[i]);
    free(strip->paths);
    free(strip->bytes);
}

/* FOLDER/STEM-0003.EXTENSION of every frame. */
static void find_frames(struct irb_html_strip *strip, struct irb_frame_place place, int frame_count,
                        const char *stem, const char *extension)
{
    strip_create(strip, frame_count);
    for (place.frame = 0; place.frame < frame_count; place.frame++)
        strip_put(strip, place.frame, irb_frame_path(&place, stem, extension));
}

static void find_file(struct irb_html_strip *strip, const char *folder, const char *name)
{
    strip_create(strip, 1);
    strip_put(strip, 0, irb_asprintf("%s/%s", folder, name));
}

/* FOLDER, or where there is none NULL; takes the folder. */
static char *folder_with(const char *run, const char *scene, char *folder, const char *file)
{
    char *path = irb_asprintf("%s/%s/%s/%s", run, scene, folder, file);
    bool there = irb_fs_exists(path);
    free(path);
    if (there)
        return folder;
    free(folder);
    return NULL;
}

/* TRIAL/seed-N of the seed that has a film, which is one of several; else of the first one; TRIAL
 * where a trial has one seed alone. *seed is that seed's index. */
static char *trial_folder(const char *run, const char *scene,
                          const struct irb_analysis_trial *trial, int *seed)
{
    char *name = irb_fs_short_name(trial->trial), *folder = NULL;
    for (*seed = 0; !folder && *seed < trial->seed_count; ++*seed) {
        folder = irb_asprintf("%s/seed-%d", name, trial->seeds[*seed].seed);
        folder = folder_with(run, scene, folder, "film");
    }
    *seed = folder ? *seed - 1 : 0;
    if (!folder) {
        folder = irb_asprintf("%s/seed-%d", name, trial->seeds[0].seed);
        folder = folder_with(run, scene, folder, "");
    }
    if (!folder)
        return name;
    free(name);
    return folder;
}

static void find_worst(struct irb_html_trial_images *images, const struct irb_analysis_seed *seed)
{
    images->worst_flip = NAN;
    for (int f = 0; f < seed->frame_count; f++) {
        double flip = seed->frames[(size_t)f * IRB_METRIC_COUNT + IRB_METRIC_indirect_flip];
        if (isnan(flip) || flip <= images->worst_flip)
            continue;
        images->worst_flip = flip;
        images->worst = f;
    }
}

static void find_trial(struct irb_html_trial_images *images, const char *run, const char *scene,
                       const struct irb_analysis_trial *trial, int frame_count)
{
    int seed = 0;
    char *folder = trial_folder(run, scene, trial, &seed);
    char *path = irb_run_folder(run, scene, folder);
    const struct irb_frame_place place = {run, scene, folder, 0};
    find_frames(&images->indirect, place, frame_count, "film/indirect", "jpg");
    find_frames(&images->flip, place, frame_count, "film/flip", "jpg");
    find_frames(&images->residual, place, frame_count, "film/residual", "jpg");
    find_file(&images->profile, path, "profile.png");
    find_file(&images->flicker, path, "flicker.png");
    find_frames(&images->sheets, place, frame_count, "image", "png");
    images->has_film = strip_any(&images->indirect);
    find_worst(images, &trial->seeds[seed]);
    free(path);
    free(folder);
}

static double flip_of(const struct irb_analysis_trial *trial)
{
    double flip = trial->measures[IRB_METRIC_indirect_flip].interval.value;
    return isnan(flip) ? INFINITY : flip;
}

/* The first with the least FLIP of those with a film; of one method, or of any (NULL). */
static int best_trial(const struct irb_html_scene_images *images,
                      const struct irb_analysis_scene *scene, const char *method)
{
    int best = -1;
    for (int t = 0; t < scene->trial_count; t++) {
        const struct irb_analysis_trial *trial = &scene->trials[t];
        if (!images->trials[t].has_film || (method && strcmp(trial->method, method)))
            continue;
        if (best < 0 || flip_of(trial) < flip_of(&scene->trials[best]))
            best = t;
    }
    return best;
}

static void find_scene(struct irb_html_scene_images *images, const char *run,
                       const struct irb_analysis_scene *scene)
{
    for (int t = 0; t < scene->trial_count; t++)
        if (scene->trials[t].seeds[0].frame_count > images->frame_count)
            images->frame_count = scene->trials[t].seeds[0].frame_count;
    const struct irb_frame_place place = {run, scene->name, "film", 0};
    find_frames(&images->reference, place, images->frame_count, "reference", "jpg");
    find_frames(&images->direct, place, images->frame_count, "direct", "jpg");
    find_frames(&images->direct_reference, place, images->frame_count, "direct_reference", "jpg");
    images->frames = allocate((size_t)images->frame_count, sizeof *images->frames);
    images->trials = allocate((size_t)scene->trial_count, sizeof *images->trials);
    images->method = allocate((size_t)scene->trial_count, sizeof *images->method);
    images->trial_count = scene->trial_count;
    for (int t = 0; t < scene->trial_count; t++)
        find_trial(&images->trials[t], run, scene->name, &scene->trials[t], images->frame_count);
    if (!strip_any(&images->reference))
        for (int t = 0; t < scene->trial_count; t++)
            images->trials[t].has_film = false;
    images->best = best_trial(images, scene, NULL);
    for (int t = 0; t < scene->trial_count; t++)
        images->method[t] = best_trial(images, scene, scene->trials[t].method) == t;
}

static bool mark_asked(struct irb_html_images *images, const struct irb_analysis *analysis,
                       const char *name, struct irb_error *err)
{
    const char *names[256];
    size_t count = 0;
    bool found = false;
    for (int s = 0; s < analysis->scene_count; s++) {
        int t = irb_analysis_trial_find(&analysis->scenes[s], name);
        if (t >= 0)
            found = images->scenes[s].trials[t].asked = true;
        for (int i = 0; i < analysis->scenes[s].trial_count && count < 256; i++)
            names[count++] = analysis->scenes[s].trials[i].trial;
    }
    const char *near = found ? NULL : irb_nearest(name, names, count);
    return found || irb_fail(err, IRB_E_INPUT, "the run has no trial '%s'%s%s%s", name,
                             near ? "; did you mean '" : "", near ? near : "", near ? "'?" : "");
}

bool irb_html_images_find(struct irb_html_images *images, const char *run_dir,
                          const struct irb_analysis *analysis,
                          const struct irb_html_options *options, struct irb_error *err)
{
    *images = (struct irb_html_images){.scene_count = analysis->scene_count};
    images->scenes = allocate((size_t)analysis->scene_count, sizeof *images->scenes);
    for (int s = 0; s < analysis->scene_count; s++)
        find_scene(&images->scenes[s], run_dir, &analysis->scenes[s]);
    for (int i = 0; i < options->trial_count; i++)
        if (!mark_asked(images, analysis, options->trials[i], err))
            return false;
    return true;
}

/* ---- writing */

/* Appends the file as a JSON text, null where it cannot be read. */
static void append_file(struct irb_str *out, const char *path)
{
    const size_t largest = 1 << 26; /* of an image of a report */
    char *data = NULL;
    size_t size = 0;
    if (!path || !irb_fs_read(path, largest, &data, &size, NULL)) {
        irb_str_printf(out, "null");
        return;
    }
    irb_str_append(out, "\"", 1);
    irb_html_base64(out, data, size);
    irb_str_append(out, "\"", 1);
    free(data);
}

/* frames: which of the strip's files the page holds; NULL = those that are there. */
static bool write_strip(FILE *out, const struct irb_html_strip *strip, const bool *frames)
{
    struct irb_str text = {0};
    if (strip->id < 0)
        return true;
    irb_str_printf(&text, "<script type=\"application/json\" id=\"film-%d\">[", strip->id);
    bool first = true;
    for (int i = 0; i < strip->count; i++) {
        if (frames ? !frames[i] : !strip->paths[i])
            continue;
        irb_str_printf(&text, "%s", first ? "" : ",");
        append_file(&text, strip->paths[i]);
        first = false;
    }
    irb_str_printf(&text, "]</script>\n");
    bool ok = fwrite(text.text, 1, text.length, out) == text.length;
    irb_str_free(&text);
    return ok;
}

static bool write_scene(FILE *out, const struct irb_html_scene_images *scene)
{
    bool ok = write_strip(out, &scene->reference, scene->frames) &&
              write_strip(out, &scene->direct, scene->frames) &&
              write_strip(out, &scene->direct_reference, scene->frames);
    for (int t = 0; ok && t < scene->trial_count; t++) {
        const struct irb_html_trial_images *trial = &scene->trials[t];
        ok = write_strip(out, &trial->indirect, scene->frames) &&
             write_strip(out, &trial->flip, scene->frames) &&
             write_strip(out, &trial->residual, scene->frames) &&
             write_strip(out, &trial->profile, NULL) && write_strip(out, &trial->flicker, NULL) &&
             write_strip(out, &trial->sheets, NULL);
    }
    return ok;
}

bool irb_html_images_write(FILE *out, const struct irb_html_images *images, struct irb_error *err)
{
    for (int s = 0; s < images->scene_count; s++)
        if (!write_scene(out, &images->scenes[s]))
            return irb_fail(err, IRB_E_IO, "cannot write the images");
    return true;
}

static void destroy_scene(struct irb_html_scene_images *scene)
{
    strip_destroy(&scene->reference);
    strip_destroy(&scene->direct);
    strip_destroy(&scene->direct_reference);
    for (int t = 0; t < scene->trial_count; t++) {
        strip_destroy(&scene->trials[t].indirect);
        strip_destroy(&scene->trials[t].flip);
        strip_destroy(&scene->trials[t].residual);
        strip_destroy(&scene->trials[t].profile);
        strip_destroy(&scene->trials[t].flicker);
        strip_destroy(&scene->trials[t].sheets);
    }
    free(scene->frames);
    free(scene->trials);
    free(scene->method);
}

void irb_html_images_destroy(struct irb_html_images *images)
{
    for (int s = 0; s < images->scene_count; s++)
        destroy_scene(&images->scenes[s]);
    free(images->scenes);
    irb_str_free(&images->notes);
    *images = (struct irb_html_images){0};
}
