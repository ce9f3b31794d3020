/* SPDX-License-Identifier: MIT
 *
 * The choice of images within a budget: html_images.h says by which rules.
 */
#include "core/base/log.h"
#include "core/report/html_images.h"
#include "core/report/html_text.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct choice {
    struct irb_html_images *images;
    const struct irb_analysis *analysis;
    struct irb_log *log;
    double budget; /* bytes of text */
    int stride;    /* of frames */
    bool residuals;
};

static double text_bytes(size_t file_bytes)
{
    return (double)irb_html_base64_length(file_bytes) + (double)strlen("\"\",");
}

static double strip_bytes(const struct irb_html_strip *strip, const bool *frames)
{
    double bytes = 0;
    for (int i = 0; i < strip->count; i++)
        if (strip->paths[i] && (!frames || frames[i]))
            bytes += text_bytes(strip->bytes[i]);
    return bytes;
}

static double film_bytes(const struct choice *choice, const struct irb_html_scene_images *scene)
{
    double bytes = 0;
    bool any = false;
    for (int t = 0; t < scene->trial_count; t++) {
        const struct irb_html_trial_images *trial = &scene->trials[t];
        if (!trial->wanted)
            continue;
        any = true;
        bytes += strip_bytes(&trial->indirect, scene->frames) +
                 strip_bytes(&trial->flip, scene->frames) +
                 (choice->residuals ? strip_bytes(&trial->residual, scene->frames) : 0) +
                 strip_bytes(&trial->profile, NULL) + strip_bytes(&trial->flicker, NULL);
    }
    if (any)
        bytes += strip_bytes(&scene->reference, scene->frames) +
                 strip_bytes(&scene->direct, scene->frames) +
                 strip_bytes(&scene->direct_reference, scene->frames);
    return bytes;
}

static bool fits(const struct choice *choice)
{
    double bytes = 0;
    for (int s = 0; s < choice->images->scene_count; s++)
        bytes += film_bytes(choice, &choice->images->scenes[s]);
    return bytes <= choice->budget;
}

/* Every stride-th frame, and the worst ones of each method's best trial. */
static void choose_frames(struct choice *choice)
{
    for (int s = 0; s < choice->images->scene_count; s++) {
        struct irb_html_scene_images *scene = &choice->images->scenes[s];
        for (int f = 0; f < scene->frame_count; f++)
            scene->frames[f] = f % choice->stride == 0;
        for (int t = 0; t < scene->trial_count; t++)
            if (scene->method[t] && scene->trials[t].wanted)
                scene->frames[scene->trials[t].worst] = true;
    }
}

static void choose_trials(struct choice *choice, bool all)
{
    for (int s = 0; s < choice->images->scene_count; s++) {
        struct irb_html_scene_images *scene = &choice->images->scenes[s];
        for (int t = 0; t < scene->trial_count; t++)
            scene->trials[t].wanted =
                scene->trials[t].has_film && (all || scene->method[t] || scene->trials[t].asked);
    }
    choose_frames(choice);
}

static double flip_of(const struct choice *choice, int scene, int trial)
{
    return choice->analysis->scenes[scene]
        .trials[trial]
        .measures[IRB_METRIC_indirect_flip]
        .interval.value;
}

/* Drops the trial with the largest FLIP, of those that nobody asked for while there are any; false
 * where none is left. */
static bool drop_one(struct choice *choice)
{
    struct irb_html_trial_images *worst = NULL;
    double most = 0;
    for (int asked = 0; asked < 2 && !worst; asked++) {
        for (int s = 0; s < choice->images->scene_count; s++) {
            for (int t = 0; t < choice->images->scenes[s].trial_count; t++) {
                struct irb_html_trial_images *trial = &choice->images->scenes[s].trials[t];
                double flip = flip_of(choice, s, t);
                if (!trial->wanted || trial->asked != (asked == 1) || (worst && !(flip > most)))
                    continue;
                worst = trial;
                most = flip;
            }
        }
    }
    if (worst)
        worst->wanted = false;
    choose_frames(choice);
    return worst;
}

static int longest(const struct choice *choice)
{
    int frames = 1;
    for (int s = 0; s < choice->images->scene_count; s++)
        if (choice->images->scenes[s].frame_count > frames)
            frames = choice->images->scenes[s].frame_count;
    return frames;
}

/* ---- what is left out */

__attribute__((format(printf, 2, 3))) static void note(struct choice *choice, const char *format,
                                                       ...)
{
    char text[2048];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    irb_str_printf(&choice->images->notes, "<p class=\"note\">");
    irb_html_text(&choice->images->notes, text);
    irb_str_printf(&choice->images->notes, "</p>\n");
    if (choice->log)
        irb_warn(choice->log, "report: %s", text);
}

static void note_trials(struct choice *choice)
{
    struct irb_str names = {0};
    int count = 0;
    for (int s = 0; s < choice->images->scene_count; s++) {
        for (int t = 0; t < choice->images->scenes[s].trial_count; t++) {
            const struct irb_html_trial_images *trial = &choice->images->scenes[s].trials[t];
            if (!trial->has_film || trial->wanted)
                continue;
            if (count++ < 24)
                irb_str_printf(&names, "%s%s %s", names.length ? ", " : "",
                               choice->analysis->scenes[s].name,
                               choice->analysis->scenes[s].trials[t].trial);
        }
    }
    if (count)
        note(choice,
             "The images of %d trial%s are left out, for the size of the file (%.3g MB for "
             "images): %s%s. Name a trial with --trial, or raise --max-mb.",
             count, count == 1 ? "" : "s", choice->budget / 1e6, irb_str_text(&names),
             count > 24 ? ", ..." : "");
    irb_str_free(&names);
}

static void note_frames(struct choice *choice)
{
    if (!choice->residuals)
        note(
            choice,
            "The maps of the temporal residual are left out, for the size of the file (%.3g MB for "
            "images); --max-mb raises it.",
            choice->budget / 1e6);
    if (choice->stride > 1)
        note(choice,
             "The film has one frame in %d, and each method's worst, for the size of the file "
             "(%.3g MB for images); --max-mb raises it.",
             choice->stride, choice->budget / 1e6);
}

static bool has_images(const struct irb_html_scene_images *scene)
{
    for (int t = 0; t < scene->trial_count; t++)
        for (int f = 0; f < scene->trials[t].sheets.count; f++)
            if (scene->trials[t].sheets.paths[f])
                return true;
    return scene->best >= 0;
}

static void note_missing(struct choice *choice)
{
    for (int s = 0; s < choice->images->scene_count; s++)
        if (!has_images(&choice->images->scenes[s]))
            note(choice, "The run has no images of the scene %s.",
                 choice->analysis->scenes[s].name);
}

/* ---- contact sheets of scenes without a film */

/* Forgets the sheets that the budget has no room for, each trial's worst frame last. */
static void choose_sheets(struct choice *choice)
{
    double left = choice->budget;
    int dropped = 0;
    for (int s = 0; s < choice->images->scene_count; s++)
        left -= film_bytes(choice, &choice->images->scenes[s]);
    for (int worst = 1; worst >= 0; worst--) {
        for (int s = 0; s < choice->images->scene_count; s++) {
            struct irb_html_scene_images *scene = &choice->images->scenes[s];
            for (int t = 0; scene->best < 0 && t < scene->trial_count; t++) {
                struct irb_html_strip *sheets = &scene->trials[t].sheets;
                for (int f = 0; f < sheets->count; f++) {
                    double bytes = sheets->paths[f] ? text_bytes(sheets->bytes[f]) : 0;
                    if (!bytes || (f == scene->trials[t].worst) != worst)
                        continue;
                    if (bytes <= left) {
                        left -= bytes;
                        continue;
                    }
                    free(sheets->paths[f]);
                    sheets->paths[f] = NULL;
                    dropped++;
                }
            }
        }
    }
    if (dropped)
        note(choice, "%d contact sheet%s left out, for the size of the file; --max-mb raises it.",
             dropped, dropped == 1 ? " is" : "s are");
}

/* ---- numbers of the blocks */

static void number_strip(struct irb_html_images *images, struct irb_html_strip *strip,
                         const bool *frames)
{
    if (strip_bytes(strip, frames) > 0)
        strip->id = images->block_count++;
}

static void number_scene(const struct choice *choice, struct irb_html_scene_images *scene)
{
    struct irb_html_images *images = choice->images;
    bool any = false;
    for (int t = 0; t < scene->trial_count; t++) {
        struct irb_html_trial_images *trial = &scene->trials[t];
        if (trial->wanted) {
            number_strip(images, &trial->indirect, scene->frames);
            number_strip(images, &trial->flip, scene->frames);
            if (choice->residuals)
                number_strip(images, &trial->residual, scene->frames);
            number_strip(images, &trial->profile, NULL);
            number_strip(images, &trial->flicker, NULL);
        } else if (scene->best < 0) {
            number_strip(images, &trial->sheets, NULL);
        }
        any = any || trial->wanted;
    }
    if (!any)
        return;
    number_strip(images, &scene->reference, scene->frames);
    number_strip(images, &scene->direct, scene->frames);
    number_strip(images, &scene->direct_reference, scene->frames);
}

void irb_html_images_choose(struct irb_html_images *images, const struct irb_analysis *analysis,
                            double budget, struct irb_log *log)
{
    struct choice choice = {images, analysis, log, budget > 0 ? budget : 0, 1, true};
    choose_trials(&choice, true);
    if (!fits(&choice))
        choose_trials(&choice, false);
    choice.residuals = fits(&choice);
    for (; !fits(&choice) && choice.stride < longest(&choice); choose_frames(&choice))
        choice.stride *= 2;
    while (!fits(&choice) && drop_one(&choice))
        ;
    note_trials(&choice);
    note_frames(&choice);
    note_missing(&choice);
    choose_sheets(&choice);
    for (int s = 0; s < images->scene_count; s++)
        number_scene(&choice, &images->scenes[s]);
}
