/* SPDX-License-Identifier: MIT
 *
 * What the page's script is told: scenes, trials, and where their images are. The script's head
 * (web/viewer.js) and this file are the two ends of it.
 */
#include "core/report/html_parts.h"
#include "core/report/html_text.h"
#include "core/score/falsecolour.h"

#include <math.h>
#include <stdlib.h>

/* A comma, but behind an opening bracket. */
static void separate(struct irb_str *out)
{
    char last = out->text[out->length - 1];
    irb_str_printf(out, "%s", last == '{' || last == '[' ? "" : ",");
}

static void member(struct irb_str *out, const char *name)
{
    separate(out);
    irb_str_printf(out, "\"%s\":", name);
}

static void entry(struct irb_str *out, int value)
{
    separate(out);
    irb_str_printf(out, "%d", value);
}

static void number(struct irb_str *out, const char *name, double value)
{
    member(out, name);
    irb_str_json_number(out, value);
}

static void text(struct irb_str *out, const char *name, const char *value)
{
    member(out, name);
    irb_str_json_string(out, value);
}

/* The id of the strip's block, or null. */
static void block(struct irb_str *out, const char *name, const struct irb_html_strip *strip)
{
    member(out, name);
    if (strip->id >= 0)
        irb_str_printf(out, "\"film-%d\"", strip->id);
    else
        irb_str_printf(out, "null");
}

/* [v0, vmax] of the logarithmic code, null where the run has none. */
static void coding(struct irb_str *out, const struct irb_html_page *page, const char *scene,
                   const char *name)
{
    char *v0_name = irb_asprintf("film_v0_%s", name),
         *vmax_name = irb_asprintf("film_vmax_%s", name);
    double v0 = irb_store_scene_number(page->store, scene, v0_name);
    double vmax = irb_store_scene_number(page->store, scene, vmax_name);
    member(out, name);
    if (v0 > 0 && vmax > 0)
        irb_str_printf(out, "[%.9g,%.9g]", v0, vmax);
    else
        irb_str_printf(out, "null");
    free(v0_name);
    free(vmax_name);
}

/* "RRGGBB" for 256 values, lowest to 1. */
static void colours(struct irb_str *out, const char *name, bool is_signed)
{
    struct irb_image ramp = {0}, rgb = {0};
    bool ok = irb_image_create(&ramp, 256, 1, 1, NULL);
    for (int i = 0; ok && i < 256; i++)
        ramp.data[i] = is_signed ? (float)i / 127.5F - 1 : (float)i / 255;
    ok = ok && (is_signed ? irb_falsecolour_signed(&ramp, 1, &rgb, NULL)
                          : irb_falsecolour(&ramp, 1, &rgb, NULL));
    member(out, name);
    irb_str_printf(out, "\"");
    for (int i = 0; ok && i < 3 * 256; i++)
        irb_str_printf(out, "%02x", (unsigned)lrintf(255 * rgb.data[i]));
    irb_str_printf(out, "\"");
    irb_image_destroy(&rgb);
    irb_image_destroy(&ramp);
}

static void sheets(struct irb_str *out, const struct irb_html_strip *strip)
{
    member(out, "sheets");
    if (strip->id < 0) {
        irb_str_printf(out, "null");
        return;
    }
    irb_str_printf(out, "{");
    block(out, "id", strip);
    irb_str_printf(out, ",\"frames\":[");
    for (int f = 0; f < strip->count; f++)
        if (strip->paths[f])
            entry(out, f);
    irb_str_printf(out, "]}");
}

static void trial(struct irb_str *out, const struct irb_html_page *page,
                  const struct irb_analysis_trial *trial,
                  const struct irb_html_trial_images *images)
{
    irb_str_printf(out, "{");
    text(out, "name", trial->trial);
    text(out, "method", trial->method);
    text(out, "colour", irb_html_colour(page, trial->method));
    number(out, "worst", images->worst);
    number(out, "worstFlip", images->worst_flip);
    member(out, "film");
    if (images->wanted) {
        irb_str_printf(out, "{");
        block(out, "indirect", &images->indirect);
        block(out, "flip", &images->flip);
        block(out, "residual", &images->residual);
        irb_str_printf(out, "}");
    } else {
        irb_str_printf(out, "null");
    }
    block(out, "profile", &images->profile);
    block(out, "flicker", &images->flicker);
    sheets(out, &images->sheets);
    irb_str_printf(out, "}");
}

static void scene(struct irb_str *out, const struct irb_html_page *page, int s)
{
    const struct irb_analysis_scene *scene = &page->analysis.scenes[s];
    const struct irb_html_scene_images *images = &page->images.scenes[s];
    irb_str_printf(out, "{");
    text(out, "name", scene->name);
    double exposure = irb_store_scene_number(page->store, scene->name, "preview_exposure");
    number(out, "exposure", exposure > 0 ? exposure : 1);
    double mean = irb_store_scene_number(page->store, scene->name, "mean_indirect");
    number(out, "mean", mean > 0 ? mean : 1);
    number(out, "profileRow", irb_store_scene_number(page->store, scene->name, "profile_row"));
    number(out, "total", images->frame_count);
    number(out, "best", images->best);
    member(out, "coding");
    irb_str_printf(out, "{");
    coding(out, page, scene->name, "indirect");
    coding(out, page, scene->name, "direct");
    irb_str_printf(out, "}");
    member(out, "films");
    irb_str_printf(out, "{");
    block(out, "reference", &images->reference);
    block(out, "direct", &images->direct);
    block(out, "directReference", &images->direct_reference);
    irb_str_printf(out, "},\"frames\":[");
    for (int f = 0; f < images->frame_count; f++)
        if (images->frames[f])
            entry(out, f);
    irb_str_printf(out, "],\"fails\":[");
    for (int t = 0; t < images->trial_count; t++)
        if (images->method[t] && images->trials[t].wanted)
            entry(out, t);
    irb_str_printf(out, "],\"trials\":[");
    for (int t = 0; t < scene->trial_count; t++) {
        irb_str_printf(out, "%s", t ? ",\n" : "\n");
        trial(out, page, &scene->trials[t], &images->trials[t]);
    }
    irb_str_printf(out, "]}");
}

void irb_html_data(struct irb_str *out, const struct irb_html_page *page)
{
    struct irb_str json = {0};
    irb_str_printf(&json, "{");
    colours(&json, "magma", false);
    colours(&json, "signed", true);
    irb_str_printf(&json, ",\"scenes\":[");
    for (int s = 0; s < page->analysis.scene_count; s++) {
        irb_str_printf(&json, "%s", s ? ",\n" : "");
        scene(&json, page, s);
    }
    irb_str_printf(&json, "]}");
    irb_html_json(out, irb_str_text(&json));
    irb_str_free(&json);
}
