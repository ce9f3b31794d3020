/* SPDX-License-Identifier: MIT */
#include "core/report/html.h"
#include "core/base/fs.h"
#include "core/base/hash.h"
#include "core/report/html_parts.h"
#include "core/report/html_text.h"
#include "core/report/palette.h"
#include "core/report/web.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

static const char *web_file(const char *path)
{
    for (size_t i = 0; i < irb_web_files_count; i++)
        if (!strcmp(irb_web_files[i].path, path))
            return irb_web_files[i].text;
    return "";
}

/* ---- the short parts */

/* The config's name, else the folder's. */
static char *run_name(const struct irb_html_page *page)
{
    char *name = irb_html_meta(page, "config_name");
    if (*name)
        return name;
    free(name);
    char *folder = irb_strdup(page->run_dir);
    size_t length = strlen(folder);
    while (length > 1 && folder[length - 1] == '/')
        folder[--length] = 0;
    const char *slash = strrchr(folder, '/');
    name = irb_strdup(slash && slash[1] ? slash + 1 : folder);
    free(folder);
    return name;
}

static void put_name(struct irb_str *out, const struct irb_html_page *page)
{
    char *name = run_name(page);
    irb_html_text(out, name);
    free(name);
}

static void put_title(struct irb_str *out, const struct irb_html_page *page)
{
    put_name(out, page);
    irb_str_printf(out, " &ndash; irbench");
}

/* "2 scenes, 10 trials · 2026-11-25 · llvmpipe ..., AMD ... · irbench 0.1.0 (commit)" */
static void put_subtitle(struct irb_str *out, const struct irb_html_page *page)
{
    static const struct {
        const char *name, *before, *after;
    } parts[] = {{"date", " &middot; ", ""},
                 {"gl_renderer", " &middot; ", ""},
                 {"cpu", ", ", ""},
                 {"threads", ", ", " threads"},
                 {"irbench_version", " &middot; irbench ", ""},
                 {"git_commit", " (", ")"}};
    int trials = 0, scenes = page->analysis.scene_count;
    for (int s = 0; s < scenes; s++)
        trials += page->analysis.scenes[s].trial_count;
    irb_str_printf(out, "%d scene%s, %d trial%s", scenes, scenes == 1 ? "" : "s", trials,
                   trials == 1 ? "" : "s");
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        char *value = irb_html_meta(page, parts[i].name);
        if (*value) {
            irb_str_printf(out, "%s", parts[i].before);
            irb_html_text(out, value);
            irb_str_printf(out, "%s", parts[i].after);
        }
        free(value);
    }
}

static void put_version(struct irb_str *out, const struct irb_html_page *page)
{
    irb_html_text(out, page->options->version);
}

static void put_nonce(struct irb_str *out, const struct irb_html_page *page)
{
    irb_str_printf(out, "%s", page->nonce);
}

static void put_style(struct irb_str *out, const struct irb_html_page *page)
{
    (void)page;
    irb_str_printf(out, "%s", web_file("report.css"));
}

static void put_script(struct irb_str *out, const struct irb_html_page *page)
{
    (void)page;
    irb_str_printf(out, "%s", web_file("viewer.js"));
}

static void put_figures(struct irb_str *out, const struct irb_html_page *page)
{
    irb_str_printf(out, "%s", irb_str_text(&page->figures));
}

static void put_image_notes(struct irb_str *out, const struct irb_html_page *page)
{
    irb_str_printf(out, "%s", irb_str_text(&page->images.notes));
}

/* ---- the page */

static const struct part {
    const char *name; /* {{name}} in report.html */
    void (*put)(struct irb_str *out, const struct irb_html_page *page);
} parts[] = {
    {"title", put_title},        {"name", put_name},          {"subtitle", put_subtitle},
    {"version", put_version},    {"nonce", put_nonce},        {"style", put_style},
    {"script", put_script},      {"notes", irb_html_notes},   {"glance", irb_html_glance},
    {"tables", irb_html_tables}, {"images", put_image_notes}, {"provenance", irb_html_provenance},
    {"data", irb_html_data},     {"figures", put_figures},
};

static void put_part(struct irb_str *out, const struct irb_html_page *page, const char *name,
                     size_t length)
{
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        if (strlen(parts[i].name) == length && !strncmp(parts[i].name, name, length))
            parts[i].put(out, page);
}

/* Fills the template in; the films, which are large, go to the file on their own: what stands
 * before and behind them is returned. */
static void fill(const struct irb_html_page *page, struct irb_str *before, struct irb_str *behind)
{
    static const char films[] = "films";
    struct irb_str *out = before;
    const char *text = web_file("report.html");
    for (const char *open; (open = strstr(text, "{{"));) {
        const char *name = open + 2, *close = strstr(name, "}}");
        if (!close)
            break;
        irb_str_append(out, text, (size_t)(open - text));
        size_t length = (size_t)(close - name);
        if (length == strlen(films) && !strncmp(name, films, length))
            out = behind;
        else
            put_part(out, page, name, length);
        text = close + 2;
    }
    irb_str_printf(out, "%s", text);
}

static bool write_file(FILE *file, const struct irb_html_page *page, const struct irb_str *before,
                       const struct irb_str *behind, struct irb_error *err)
{
    return (fwrite(before->text, 1, before->length, file) == before->length &&
            irb_html_images_write(file, &page->images, NULL) &&
            fwrite(behind->text, 1, behind->length, file) == behind->length) ||
           irb_fail(err, IRB_E_IO, "cannot write: %s", strerror(errno));
}

static bool write_page(const struct irb_html_page *page, const char *path,
                       const struct irb_str *before, const struct irb_str *behind,
                       struct irb_error *err)
{
    char *temp = irb_fs_temp_name(path);
    FILE *file = fopen(temp, "wb");
    bool ok = file || irb_fail(err, IRB_E_IO, "cannot write: %s", strerror(errno));
    ok = ok && write_file(file, page, before, behind, err);
    if (file && fclose(file) && ok)
        ok = irb_fail(err, IRB_E_IO, "cannot write: %s", strerror(errno));
    if (!ok) {
        remove(temp);
        irb_error_prefix(err, "%s", path);
    }
    ok = ok && irb_fs_commit(temp, path, err);
    free(temp);
    return ok;
}

/* ---- what the page is made from */

static void hash_meta(void *user, const char *name, const char *value)
{
    irb_hash_string(user, name);
    irb_hash_string(user, value);
}

/* Not known to who wrote the config's texts, and the same for the same run. */
static bool make_nonce(struct irb_html_page *page, struct irb_error *err)
{
    struct irb_hash *hash = irb_hash_create();
    bool ok = irb_store_read_meta(page->store, hash_meta, hash, err);
    struct irb_key key = irb_hash_finish(hash);
    memcpy(page->nonce, key.hex, sizeof page->nonce);
    return ok;
}

static void find_others(struct irb_html_page *page)
{
    for (int s = 0; s < page->analysis.scene_count; s++)
        for (int t = 0; t < page->analysis.scenes[s].trial_count; t++) {
            const char *method = page->analysis.scenes[s].trials[t].method;
            bool own = false;
            for (const struct irb_palette_line *line = irb_palette; line->method; line++)
                own = own || !strcmp(line->method, method);
            if (!own)
                irb_names_index(&page->others, method);
        }
}

static bool gather(struct irb_html_page *page, struct irb_error *err)
{
    return make_nonce(page, err) &&
           irb_analysis_read(&page->analysis, page->store, IRB_CONFIDENCE, err) &&
           irb_table_data_read(&page->table, page->store, false, err) &&
           irb_html_images_find(&page->images, page->run_dir, &page->analysis, page->options, err);
}

bool irb_html_write(const char *run_dir, const char *path, const struct irb_html_options *options,
                    struct irb_error *err)
{
    const double rest = 0.4e6; /* bytes of a page without figures and images: generous */
    struct irb_html_page page = {.run_dir = run_dir, .options = options};
    struct irb_str before = {0}, behind = {0};
    page.store = irb_store_open_snapshot(run_dir, err);
    bool ok = page.store && gather(&page, err);
    if (ok) {
        find_others(&page);
        irb_html_figures(&page.figures, &page);
        irb_html_images_choose(&page.images, &page.analysis,
                               1e6 * options->max_mb - rest - (double)page.figures.length,
                               options->log);
        fill(&page, &before, &behind);
        ok = write_page(&page, path, &before, &behind, err);
    }
    irb_str_free(&before);
    irb_str_free(&behind);
    irb_str_free(&page.figures);
    irb_html_images_destroy(&page.images);
    irb_table_data_destroy(&page.table);
    irb_analysis_destroy(&page.analysis);
    irb_names_destroy(&page.others);
    if (page.store)
        irb_store_close(page.store);
    return ok;
}
