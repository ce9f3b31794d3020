/* SPDX-License-Identifier: MIT */
#include "core/experiment/render_passes.h"
#include "core/base/fs.h"
#include "core/experiment/frame_file.h"
#include "core/experiment/paths.h"
#include "core/image/exr.h"

#include <stdlib.h>
#include <string.h>

/* Above this share of differing pixels the reference belongs to another image altogether. */
static const double largest_masked_share = 0.05;

static struct irb_passes_rsm *find_rsm(const struct irb_passes *p, int resolution)
{
    for (int i = 0; i < p->rsm_count; i++)
        if (p->rsms[i].resolution == resolution)
            return &p->rsms[i];
    return NULL;
}

static bool add_rsm(struct irb_passes *p, int resolution, struct irb_error *err)
{
    const struct irb_render_settings *render = &p->run->config->render;
    enum irb_layout layout = (enum irb_layout)render->rsm_layout;
    struct irb_passes_rsm *added = &p->rsms[p->rsm_count++];
    *added = (struct irb_passes_rsm){.resolution = resolution,
                                     .shared = layout == IRB_LAYOUT_FULL &&
                                               resolution == render->rsm_resolution};
    added->rsm =
        added->shared ? p->rsm : irb_rsm_create_layout(p->run->gl, layout, resolution, err);
    return added->rsm && (added->timer = irb_timer_create(p->run->gl, err));
}

/* The G-buffer and RSMs that methods read. */
static bool open_for_methods(struct irb_passes *p, struct irb_error *err)
{
    const struct irb_config *config = p->run->config;
    const struct irb_render_settings *render = &config->render;
    enum irb_layout layout = (enum irb_layout)render->gbuffer_layout;
    p->rsms = calloc((size_t)config->trial_count, sizeof *p->rsms);
    if (!p->rsms)
        return irb_fail(err, IRB_E_MEMORY, "no memory for %d trials", config->trial_count);
    for (int i = 0; i < config->trial_count; i++) {
        int resolution = irb_trial_rsm_resolution(&config->trials[i], render);
        if (!find_rsm(p, resolution) && !add_rsm(p, resolution, err))
            return false;
    }
    return layout == IRB_LAYOUT_FULL ||
           (p->slim_gbuffer =
                irb_gbuffer_create_layout(p->run->gl, layout, render->width, render->height, err));
}

bool irb_passes_open(struct irb_passes *p, struct irb_error *err)
{
    const struct irb_render_settings *render = &p->run->config->render;
    struct irb_gl *gl = p->run->gl;
    p->stored = calloc((size_t)p->sequence->frame_count, sizeof *p->stored);
    if (!p->stored)
        return irb_fail(err, IRB_E_MEMORY, "no memory for %d frames", p->sequence->frame_count);
    return irb_sequence_pose(p->sequence, 0, err) &&
           (p->scene = irb_scene_gl_create(gl, p->sequence->scene, err)) &&
           (p->gbuffer = irb_gbuffer_create(gl, render->width, render->height, err)) &&
           (p->rsm = irb_rsm_create(gl, render->rsm_resolution, err)) &&
           (p->direct = irb_direct_create(gl, render->width, render->height, err)) &&
           open_for_methods(p, err) && (p->timer = irb_timer_create(gl, err));
}

void irb_passes_close(struct irb_passes *p)
{
    free(p->stored);
    irb_timer_destroy(p->timer);
    irb_direct_destroy(p->direct);
    for (int i = 0; i < p->rsm_count; i++) {
        irb_timer_destroy(p->rsms[i].timer);
        if (!p->rsms[i].shared)
            irb_rsm_destroy(p->rsms[i].rsm);
    }
    free(p->rsms);
    irb_rsm_destroy(p->rsm);
    irb_gbuffer_destroy(p->slim_gbuffer);
    irb_gbuffer_destroy(p->gbuffer);
    irb_scene_gl_destroy(p->scene);
}

const struct irb_gbuffer *irb_passes_gbuffer(const struct irb_passes *p)
{
    return p->slim_gbuffer ? p->slim_gbuffer : p->gbuffer;
}

const struct irb_passes_rsm *irb_passes_rsm(const struct irb_passes *p,
                                            const struct irb_trial *trial)
{
    return find_rsm(p, irb_trial_rsm_resolution(trial, &p->run->config->render));
}

/* Those of the methods, each on its own time; and the harness's, unless it is one of them. */
static bool render_rsms(struct irb_passes *p, const struct irb_light *light, struct irb_error *err)
{
    double ms[IRB_MAX_STAGES];
    bool ok = true, shared = false;
    for (int i = 0; ok && i < p->rsm_count; i++) {
        struct irb_passes_rsm *rsm = &p->rsms[i];
        IRB_TIMED(ok, rsm->timer, IRB_CORE_RSM, irb_rsm_render(rsm->rsm, p->scene, light, err));
        irb_timer_collect(rsm->timer, ms);
        rsm->ms = ms[IRB_CORE_RSM];
        shared = shared || rsm->shared;
    }
    return ok && (shared || irb_rsm_render(p->rsm, p->scene, light, err));
}

/* Of a G-buffer in two layouts the one that methods read is timed: the other is the harness's own.
 */
bool irb_passes_render(struct irb_passes *p, int frame, struct irb_error *err)
{
    const struct irb_sequence_frame *pose = &p->sequence->frames[frame < 0 ? 0 : frame];
    struct irb_gbuffer *gbuffer = p->slim_gbuffer ? p->slim_gbuffer : p->gbuffer;
    bool ok = irb_sequence_pose(p->sequence, frame, err) && irb_scene_gl_update(p->scene, err);
    IRB_TIMED(ok, p->timer, IRB_CORE_GBUFFER,
              irb_gbuffer_render(gbuffer, p->scene, &pose->camera, err));
    ok = ok &&
         (gbuffer == p->gbuffer || irb_gbuffer_render(p->gbuffer, p->scene, &pose->camera, err)) &&
         render_rsms(p, &pose->light, err);
    IRB_TIMED(ok, p->timer, IRB_CORE_DIRECT,
              irb_direct_render(p->direct, p->gbuffer, p->rsm, &pose->light, &pose->camera, err));
    irb_timer_collect(p->timer, p->ms);
    return ok;
}

/* Writes the mask of the pixels where this driver's G-buffer is not the reference's. */
static bool store_mask(struct irb_passes *p, int frame, const struct irb_gbuffer_image *mine,
                       const char *cached, struct irb_error *err)
{
    struct irb_run *run = p->run;
    const char *name = p->sequence->entry->name;
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

bool irb_passes_store(struct irb_passes *p, int frame, struct irb_error *err)
{
    struct irb_run *run = p->run;
    const struct irb_key *expected = &p->sequence->frames[frame].gbuffer;
    if (p->stored[frame])
        return true;
    char *direct = irb_run_file(run->dir, p->sequence->entry->name, NULL, "direct", frame, "exr");
    bool ok = irb_fs_exists(direct) || irb_direct_file_save(direct, p->direct->radiance, err);
    free(direct);
    p->stored[frame] = ok;
    if (!ok || irb_sequence_same_view(p->sequence, frame))
        return ok;
    struct irb_gbuffer_image mine = {0};
    if (!irb_gbuffer_read(p->gbuffer, &mine, err))
        return false;
    struct irb_key key = irb_gbuffer_image_key(&mine);
    if (strcmp(key.hex, expected->hex)) {
        char *cached = irb_cache_gbuffer(run->cache, expected);
        ok = store_mask(p, frame, &mine, cached, err);
        free(cached);
    }
    irb_gbuffer_image_destroy(&mine);
    return ok;
}
