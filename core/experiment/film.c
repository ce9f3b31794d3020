/* SPDX-License-Identifier: MIT */
#include "core/experiment/film.h"
#include "core/base/fs.h"
#include "core/base/str.h"
#include "core/image/imageio.h"

#include <stdlib.h>

/* A picture of 320 x 240 pixels takes 10 to 15 KB, a noisy map as well; source: ours. */
enum { QUALITY = 85, MAP_QUALITY = 70 };

bool irb_film_wanted(const struct irb_config *config)
{
    return IRB_HAVE_IMAGES && config->output.film;
}

bool irb_film_has_trial(const struct irb_config *config, const struct irb_trial *trial)
{
    return irb_film_wanted(config) && trial->seed == config->seeds[0];
}

bool irb_film_open(const char *run, const char *scene, const char *folder, struct irb_error *err)
{
    char *parent = irb_run_folder(run, scene, folder);
    char *film = irb_asprintf("%s/film", parent);
    bool ok = irb_fs_make_dirs(film, err);
    irb_fs_remove_stale(film);
    free(film);
    free(parent);
    return ok;
}

static char *film_path(const struct irb_frame_place *place, const char *picture)
{
    char *stem = irb_asprintf("film/%s", picture);
    char *path = irb_frame_path(place, stem, "jpg");
    free(stem);
    return path;
}

static bool write_radiance(const char *path, const struct irb_image *radiance,
                           const struct irb_film_scale *scale, struct irb_error *err)
{
    struct irb_image coded = {0};
    bool ok = irb_film_encode_image(scale, radiance, &coded, err) &&
              irb_jpeg_write(path, &coded, QUALITY, err);
    irb_image_destroy(&coded);
    return ok;
}

bool irb_film_target(const char *run, const char *scene, int frame, const struct irb_target *target,
                     const struct irb_target_constants *constants, struct irb_error *err)
{
    const struct {
        const char *name;
        const struct irb_image *image;
        const struct irb_film_scale *scale;
    } pictures[] = {
        {"reference", &target->indirect, &constants->film_indirect},
        {"direct", &target->direct, &constants->film_full},
        {"direct_reference", &target->direct_reference, &constants->film_full},
    };
    const struct irb_frame_place place = {run, scene, NULL, frame};
    bool ok = true;
    for (size_t i = 0; ok && i < sizeof pictures / sizeof *pictures; i++) {
        char *path = film_path(&place, pictures[i].name);
        if (pictures[i].image->data && !irb_fs_exists(path))
            ok = write_radiance(path, pictures[i].image, pictures[i].scale, err);
        free(path);
    }
    return ok;
}

static bool write_map(const struct irb_frame_place *place, const char *name,
                      const struct irb_image *map, struct irb_error *err)
{
    if (!map->data)
        return true;
    char *path = film_path(place, name);
    bool ok = irb_jpeg_write(path, map, MAP_QUALITY, err);
    free(path);
    return ok;
}

bool irb_film_trial(const struct irb_frame_place *place, const struct irb_image *indirect,
                    const struct irb_score_maps *maps, const struct irb_target_constants *constants,
                    struct irb_error *err)
{
    char *path = film_path(place, "indirect");
    bool ok = write_radiance(path, indirect, &constants->film_indirect, err) &&
              write_map(place, "flip", &maps->flip, err) &&
              write_map(place, "residual", &maps->residual, err);
    free(path);
    return ok;
}
