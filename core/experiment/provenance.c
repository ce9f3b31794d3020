/* SPDX-License-Identifier: MIT */
#include "core/experiment/provenance.h"
#include "core/base/clock.h"
#include "core/base/fs.h"
#include "core/base/parallel.h"
#include "core/base/str.h"
#include "core/experiment/version.h"
#include "core/gl/program.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>

/* The processor's name as Linux gives it; "" where it does not. */
static void cpu_name(char out[128])
{
    out[0] = 0;
    FILE *file = fopen("/proc/cpuinfo", "r");
    char line[256];
    while (file && fgets(line, sizeof line, file)) {
        if (strncmp(line, "model name", 10))
            continue;
        const char *colon = strchr(line, ':');
        snprintf(out, 128, "%.*s", (int)strcspn(colon ? colon + 2 : "", "\n"),
                 colon ? colon + 2 : "");
        break;
    }
    if (file)
        fclose(file);
}

struct pair {
    const char *name, *value;
};

static bool store_all(struct irb_run *run, const struct pair *pairs, size_t count,
                      struct irb_error *err)
{
    for (size_t i = 0; i < count; i++)
        if (!irb_store_set_meta(run->store, pairs[i].name, pairs[i].value ? pairs[i].value : "",
                                err))
            return false;
    return true;
}

bool irb_provenance_store_host(struct irb_run *run, struct irb_error *err)
{
    char cpu[128], date[32], threads[16], cores[16];
    struct utsname host;
    cpu_name(cpu);
    irb_clock_utc(date);
    snprintf(cores, sizeof cores, "%d", irb_core_count());
    snprintf(threads, sizeof threads, "%d",
             run->options->threads > 0 ? run->options->threads : irb_core_count());
    uname(&host);
    char *text = NULL;
    const size_t largest_config = 1 << 20;
    bool ok = irb_fs_read(run->config->path, largest_config, &text, NULL, err);
    const struct pair pairs[] = {
        {"irbench_version", IRB_VERSION},
        {"git_commit", IRB_GIT_COMMIT},
        {"config_name", run->config->name},
        {"config_path", run->config->path},
        {"config_key", run->config_key.hex},
        {"config_text", text},
        {"command_line", run->options->command_line},
        {"date", date},
        {"cpu", cpu},
        {"cores", cores},
        {"threads", threads},
        {"llvmpipe_threads", getenv("LP_NUM_THREADS")},
        {"system", host.sysname},
        {"system_release", host.release},
        {"machine", host.machine},
    };
    ok = ok && store_all(run, pairs, sizeof pairs / sizeof *pairs, err);
    free(text);
    return ok;
}

/* Frames of one run come from one driver and one set of shaders: times and bits of several would
 * look like those of one. */
static bool same_as_before(struct irb_run *run, const struct pair *now, struct irb_error *err)
{
    char *before = irb_store_get_meta(run->store, now->name);
    bool same = !before || !strcmp(before, now->value);
    if (!same)
        irb_fail(err, IRB_E_USAGE,
                 "%s: was rendered with another %s ('%s', now '%s'); choose another --out",
                 run->dir, now->name, before, now->value);
    free(before);
    return same;
}

bool irb_provenance_store_gl(struct irb_run *run, struct irb_error *err)
{
    char shaders[33];
    irb_shader_hash(run->gl, shaders);
    const struct pair pairs[] = {
        {"gl_vendor", run->gl->vendor},
        {"gl_renderer", run->gl->renderer},
        {"gl_version", run->gl->version},
        {"gl_platform", run->gl->platform},
        {"gl_software", run->gl->software ? "true" : "false"},
        {"shader_hash", shaders},
    };
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
        if (!same_as_before(run, &pairs[i], err))
            return false;
    return store_all(run, pairs, sizeof pairs / sizeof *pairs, err);
}

bool irb_provenance_store_stages(struct irb_run *run, const struct irb_method *method,
                                 struct irb_error *err)
{
    struct irb_str names = {0};
    for (int i = 0; irb_core_stages[i]; i++)
        irb_str_printf(&names, "%s\n", irb_core_stages[i]);
    for (int i = 0; method->stages[i]; i++)
        irb_str_printf(&names, "%s\n", method->stages[i]);
    char *key = irb_asprintf("method/%s/stages", method->name);
    bool ok = irb_store_set_meta(run->store, key, irb_str_text(&names), err);
    free(key);
    irb_str_free(&names);
    return ok;
}

bool irb_provenance_store_seconds(struct irb_run *run, struct irb_error *err)
{
    for (int i = 0; i < IRB_WORK_COUNT; i++) {
        char name[64], value[32];
        snprintf(name, sizeof name, "seconds_%s", irb_work_names[i]);
        snprintf(value, sizeof value, "%.3f", run->seconds[i]);
        if (!irb_store_set_meta(run->store, name, value, err))
            return false;
    }
    return true;
}
