/* SPDX-License-Identifier: MIT */
#include "core/report/tradeoff_images.h"
#include "core/base/fs.h"
#include "core/frame/composite.h"
#include "core/image/exr.h"
#include "core/image/imageio.h"
#include "core/report/measure_text.h"
#include "core/score/falsecolour.h"

#include <stdlib.h>
#include <string.h>

enum { ROWS = 2, GAP = 4 /* pixels between the panels */, MOST_SIDE = IRB_EXR_MAX_SIDE };

/* ---- where the images are ---- */

static int frames_of(const struct irb_analysis_scene *scene)
{
    int most = 0;
    for (int t = 0; t < scene->trial_count; t++)
        for (int i = 0; i < scene->trials[t].seed_count; i++)
            if (scene->trials[t].seeds[i].frame_count > most)
                most = scene->trials[t].seeds[i].frame_count;
    return most;
}

/* The kept image of the scene's middle frame, or NULL where there is none. Malloc'ed. */
static char *image_path(const char *run_dir, const struct irb_analysis_scene *scene, int trial)
{
    const struct irb_analysis_trial *of = &scene->trials[trial];
    char *path = NULL, *folder = irb_fs_short_name(of->trial);
    for (int seeds = 0; seeds < 2; seeds++) { /* in a folder of the seed where there are several */
        char *seed = seeds ? irb_asprintf("/seed-%d", of->seeds[0].seed) : irb_strdup("");
        free(path);
        path = irb_asprintf("%s/%s/%s%s/image-%04d.exr", run_dir, scene->name, folder, seed,
                            frames_of(scene) / 2);
        free(seed);
        if (irb_fs_exists(path)) {
            free(folder);
            return path;
        }
    }
    free(folder);
    free(path);
    return NULL;
}

/* ---- one picture ---- */

struct picture {
    struct irb_image image; /* sRGB; empty until the first panel says its size */
    int columns, width, height;
    double exposure;
};

static bool place(struct picture *p, const struct irb_image *panel, int column, int row,
                  struct irb_error *err)
{
    if (!p->image.data) {
        p->width = panel->width;
        p->height = panel->height;
        int width = p->columns * (p->width + GAP) - GAP;
        if (width > MOST_SIDE)
            return irb_fail(err, IRB_E_MEMORY, "a picture of %d columns would be %d pixels wide",
                            p->columns, width);
        if (!irb_image_create(&p->image, width, ROWS * (p->height + GAP) - GAP, 3, err))
            return false;
    }
    if (panel->width != p->width || panel->height != p->height)
        return irb_fail(err, IRB_E_INPUT, "the kept images of a scene have several sizes");
    for (int y = 0; y < p->height; y++)
        memcpy(irb_image_at(&p->image, column * (p->width + GAP), row * (p->height + GAP) + y),
               irb_image_at(panel, 0, y), 3 * sizeof(float) * (size_t)p->width);
    return true;
}

static bool place_radiance(struct picture *p, const struct irb_image *radiance, int column,
                           struct irb_error *err)
{
    struct irb_image panel = {0};
    bool ok = irb_tonemap(radiance, p->exposure, &panel, err) && place(p, &panel, column, 0, err);
    irb_image_destroy(&panel);
    return ok;
}

/* A method's image and FLIP; its reference too in the first column. */
static bool place_trial(struct picture *p, const char *path, int column, struct irb_error *err)
{
    static const struct irb_exr_layer layers[] = {{"indirect", "RGB", NULL},
                                                  {"reference_indirect", "RGB", NULL},
                                                  {"flip_indirect", "Y", NULL}};
    struct irb_image images[3] = {{0}}, panel = {0};
    if (!irb_exr_read_layers(path, layers, images, 3, err))
        return false;
    bool ok = place_radiance(p, &images[0], column, err) && place_radiance(p, &images[1], 0, err) &&
              irb_falsecolour(&images[2], 1, &panel, err) && place(p, &panel, column, 1, err);
    irb_image_destroy(&panel);
    for (int i = 0; i < 3; i++)
        irb_image_destroy(&images[i]);
    return ok;
}

/* ---- a scene ---- */

struct showing {
    const char *folder, *run_dir;
    struct irb_store *store;
    const struct irb_analysis *analysis;
    const struct irb_tradeoff_options *options;
    struct irb_str *markdown;
};

static double exposure_of(struct irb_store *store, const char *scene)
{
    double exposure = irb_store_scene_number(store, scene, "preview_exposure");
    return exposure > 0 ? exposure : 1;
}

/* Adds a column for each method and its name to `names`. */
static bool place_methods(struct picture *p, const struct showing *s, struct irb_question *q,
                          const struct irb_methods *methods, struct irb_str *names,
                          struct irb_error *err)
{
    const struct irb_analysis_scene *scene = &s->analysis->scenes[q->scene];
    bool ok = true;
    for (int m = 0; ok && m < methods->count; m++) {
        q->method = methods->list[m];
        struct irb_answer answer = irb_ask(s->analysis, q);
        char *path = answer.trial < 0 ? NULL : image_path(s->run_dir, scene, answer.trial);
        if (path)
            ok = place_trial(p, path, m + 1, err);
        irb_str_printf(names, ", `%s`%s",
                       answer.trial < 0 ? q->method : scene->trials[answer.trial].trial,
                       answer.trial < 0 ? " (none within the budget)"
                       : path           ? ""
                                        : " (no image kept)");
        free(path);
        irb_answer_free(&answer);
    }
    return ok;
}

static bool show(const struct showing *s, int scene_index, bool by_time, struct irb_error *err)
{
    const struct irb_analysis_scene *scene = &s->analysis->scenes[scene_index];
    double budgets[IRB_MOST_BUDGETS];
    int count = irb_tradeoff_budgets(scene, s->options, by_time, budgets);
    if (!count)
        return true;
    struct irb_question q =
        irb_tradeoff_question(s->options, scene_index, by_time, budgets[count / 2], NULL);
    struct irb_methods methods = irb_scene_methods(scene);
    struct picture p = {.columns = methods.count + 1,
                        .exposure = exposure_of(s->store, scene->name)};
    struct irb_str names = {0};
    bool ok = place_methods(&p, s, &q, &methods, &names, err);
    if (ok && p.image.data) {
        char *name = irb_asprintf("%s-equal-%s.png", scene->name, by_time ? "time" : "error");
        char *path = irb_asprintf("%s/%s", s->folder, name);
        ok = irb_png_write(path, &p.image, err);
        irb_str_printf(s->markdown, "![%s](%s)\n\n*%s, equal %s, at most ", name, name, scene->name,
                       by_time ? "time" : "error");
        irb_metric_text(s->markdown, q.bounded, q.bound);
        irb_str_printf(s->markdown, ", frame %d. From the left: reference%s.*\n\n",
                       frames_of(scene) / 2, irb_str_text(&names));
        free(path);
        free(name);
    }
    irb_str_free(&names);
    irb_image_destroy(&p.image);
    free(methods.list);
    return ok;
}

bool irb_tradeoff_images(const char *folder, const char *run_dir, struct irb_store *store,
                         const struct irb_analysis *analysis,
                         const struct irb_tradeoff_options *options, struct irb_str *markdown,
                         struct irb_error *err)
{
    struct showing s = {folder, run_dir, store, analysis, options, markdown};
    struct irb_str text = {0};
    bool ok = irb_fs_make_dirs(folder, err);
    s.markdown = &text;
    for (int i = 0; IRB_HAVE_IMAGES && ok && i < analysis->scene_count; i++)
        ok = show(&s, i, true, err) && show(&s, i, false, err);
    if (text.length)
        irb_str_printf(markdown,
                       "## Images\n\nIndirect light above, HDR-FLIP below (0 black, 1 pale "
                       "yellow).\n\n%s",
                       irb_str_text(&text));
    irb_str_free(&text);
    return ok;
}
