/* SPDX-License-Identifier: MIT */
#include "core/experiment/paths.h"
#include "core/base/str.h"

#include <stdlib.h>

char *irb_cache_dir(void)
{
    const char *own = getenv("IRBENCH_CACHE");
    if (own && *own)
        return irb_strdup(own);
    const char *xdg = getenv("XDG_CACHE_HOME");
    if (xdg && *xdg)
        return irb_asprintf("%s/irbench", xdg);
    const char *home = getenv("HOME");
    if (home && *home)
        return irb_asprintf("%s/.cache/irbench", home);
    return irb_strdup(".irbench-cache");
}

char *irb_cache_gbuffer(const char *cache, const struct irb_key *key)
{
    return irb_asprintf("%s/gbuffer-%s.exr", cache, key->hex);
}

char *irb_cache_reference(const char *cache, const struct irb_key *key)
{
    return irb_asprintf("%s/reference-%s.exr", cache, key->hex);
}

char *irb_cache_checkpoint(const char *cache, const struct irb_key *key)
{
    return irb_asprintf("%s/reference-%s.partial", cache, key->hex);
}

char *irb_run_folder(const char *run, const char *scene, const char *trial)
{
    return trial ? irb_asprintf("%s/%s/%s", run, scene, trial) : irb_asprintf("%s/%s", run, scene);
}

char *irb_run_file(const char *run, const char *scene, const char *trial, const char *stem,
                   int frame, const char *extension)
{
    char *folder = irb_run_folder(run, scene, trial);
    char *path = irb_asprintf("%s/%s-%04d.%s", folder, stem, frame, extension);
    free(folder);
    return path;
}

char *irb_frame_path(const struct irb_frame_place *place, const char *stem, const char *extension)
{
    return irb_run_file(place->run, place->scene, place->folder, stem, place->frame, extension);
}
