/* SPDX-License-Identifier: MIT
 *
 * `irbench compare IMAGE REFERENCE`: the image metrics between two files, bounds on them, maps.
 */
#include "core/base/fs.h"
#include "core/base/str.h"
#include "core/cli/cli.h"
#include "core/image/exr.h"
#include "core/image/imageio.h"
#include "core/score/compare.h"
#include "core/score/falsecolour.h"
#include "core/score/metrics.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* ---- bounds ---- */

struct bound {
    int metric;
    bool most; /* --max, else --min */
    double value;
};

static bool parse_bound(const struct irb_cli_bound *given, struct bound *bound,
                        struct irb_error *err)
{
    const char *option = given->most ? "--max" : "--min", *equals = strchr(given->text, '=');
    if (!equals)
        return irb_fail(err, IRB_E_USAGE, "%s: expected METRIC=VALUE; found '%.64s'", option,
                        given->text);
    char *name = irb_asprintf("%.*s", (int)(equals - given->text), given->text), *end;
    *bound = (struct bound){.metric = irb_compare_find(name, err), .most = given->most};
    free(name);
    if (bound->metric < 0)
        return irb_error_prefix(err, "%s", option);
    errno = 0;
    bound->value = strtod(equals + 1, &end);
    if (end == equals + 1 || *end || errno || !isfinite(bound->value))
        return irb_fail(err, IRB_E_USAGE, "%s %.64s: expected a number; found '%.64s'", option,
                        given->text, equals + 1);
    return true;
}

/* An undefined value holds no bound. */
static bool holds(const struct bound *bound, const struct irb_comparison *c)
{
    double value = c->values[bound->metric];
    return bound->most ? value <= bound->value : value >= bound->value;
}

/* One line for all bounds that do not hold. */
static bool check_bounds(const struct bound *bounds, int count, const struct irb_comparison *c,
                         struct irb_error *err)
{
    struct irb_str line = {0};
    for (int i = 0; i < count; i++)
        if (!holds(&bounds[i], c))
            irb_str_printf(&line, "%s%s is %.6g, expected at %s %.6g", line.length ? "; " : "",
                           irb_compare_metrics[bounds[i].metric].name, c->values[bounds[i].metric],
                           bounds[i].most ? "most" : "least", bounds[i].value);
    bool ok = !line.length || irb_fail(err, IRB_E_CHECK, "%s", irb_str_text(&line));
    irb_str_free(&line);
    return ok;
}

/* ---- files ---- */

static bool ends_with(const char *path, const char *end)
{
    size_t n = strlen(path), m = strlen(end);
    return n >= m && !strcasecmp(path + n - m, end);
}

/* Formats that hold what a display shows; all others hold radiance. */
static bool is_display_referred(const char *path)
{
    static const char *const endings[] = {".png", ".jpg", ".jpeg", ".webp", ".bmp", ".tga", ".gif"};
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++)
        if (ends_with(path, endings[i]))
            return true;
    return false;
}

/* A layer of one channel ("relmse.Y") counts as grey. */
static bool read_grey(const char *path, const char *layer, struct irb_image *image,
                      struct irb_error *err)
{
    struct irb_image grey;
    if (!irb_exr_read(path, layer, "Y", &grey, err))
        return false;
    bool ok = irb_image_create(image, grey.width, grey.height, 3, err);
    for (size_t i = 0; ok && i < 3 * irb_image_pixels(image); i++)
        image->data[i] = grey.data[i / 3];
    irb_image_destroy(&grey);
    return ok;
}

static bool read_image(const char *path, const char *layer, struct irb_image *image,
                       struct irb_error *err)
{
    bool exr = ends_with(path, ".exr");
    if (!irb_fs_exists(path))
        return irb_fail(err, IRB_E_INPUT, "%s: no such file", path);
    if (layer && !exr)
        return irb_fail(err, IRB_E_USAGE, "%s: --layer: only OpenEXR files (.exr) have layers",
                        path);
    struct irb_error grey_err;
    if (!exr)
        return irb_image_read_rgb(path, image, err);
    if (irb_exr_read(path, layer ? layer : "", "RGB", image, err) ||
        read_grey(path, layer ? layer : "", image, &grey_err))
        return true;
    /* tiles, deep data, luminance and chroma: the default layer of what the other reader knows */
    return !layer && IRB_HAVE_IMAGES && irb_image_read_rgb(path, image, &grey_err);
}

/* ---- output ---- */

static void print_text(const struct irb_comparison *c)
{
    for (int i = 0; i < IRB_COMPARE_COUNT; i++) {
        const struct irb_compare_info *info = &irb_compare_metrics[i];
        char value[32] = "-";
        if (!isnan(c->values[i]))
            snprintf(value, sizeof value, "%.6g", c->values[i]);
        printf("%-13s %12s %-7s %s\n", info->name, value, info->unit, info->doc);
    }
    printf("\neps %.4g, PSNR peak %.6g, ", c->eps, c->peak);
    if (c->lit)
        printf("FLIP exposures %.4g to %.4g in %d steps, ", c->exposures.start, c->exposures.stop,
               c->exposures.count);
    if (c->exposure > 0)
        printf("displayed by Reinhard at exposure %.4g; %g pixels per degree\n", c->exposure,
               IRB_FLIP_PPD);
    else
        printf("displayed as they are; %g pixels per degree\n", IRB_FLIP_PPD);
}

static void json_number(struct irb_str *out, const char *name, double value)
{
    irb_str_printf(out, ", \"%s\": ", name);
    irb_str_json_number(out, value);
}

static void print_json(const struct irb_cli *cli, const struct irb_comparison *c)
{
    struct irb_str out = {0};
    irb_str_printf(&out, "{\"image\": ");
    irb_str_json_string(&out, cli->arguments[0]);
    irb_str_printf(&out, ", \"reference\": ");
    irb_str_json_string(&out, cli->arguments[1]);
    for (int i = 0; i < IRB_COMPARE_COUNT; i++)
        json_number(&out, irb_compare_metrics[i].name, c->values[i]);
    json_number(&out, "eps", c->eps);
    json_number(&out, "peak", c->peak);
    json_number(&out, "exposure", c->exposure);
    json_number(&out, "flip_start", c->lit ? c->exposures.start : NAN);
    json_number(&out, "flip_stop", c->lit ? c->exposures.stop : NAN);
    json_number(&out, "flip_exposures", c->lit ? c->exposures.count : NAN);
    printf("%s}\n", irb_str_text(&out));
    irb_str_free(&out);
}

/* ---- maps ---- */

static bool write_colours(const char *folder, const char *name, const struct irb_image *map,
                          double maximum, struct irb_error *err)
{
    struct irb_image rgb = {0};
    char *path = irb_asprintf("%s/%s.png", folder, name);
    bool is_signed = map->channels == 3;
    struct irb_image mean = {0};
    bool ok = !is_signed || irb_image_create(&mean, map->width, map->height, 1, err);
    for (size_t i = 0; ok && is_signed && i < irb_image_pixels(map); i++)
        mean.data[i] = (map->data[3 * i] + map->data[3 * i + 1] + map->data[3 * i + 2]) / 3;
    ok = ok &&
         (is_signed ? irb_falsecolour_signed(&mean, maximum, &rgb, err)
                    : irb_falsecolour(map, maximum, &rgb, err)) &&
         irb_png_write(path, &rgb, err);
    irb_image_destroy(&mean);
    irb_image_destroy(&rgb);
    free(path);
    return ok;
}

/* Dissimilarity, so that dark is good in all pictures. */
static bool write_ssim(const char *folder, const struct irb_image *ssim, struct irb_error *err)
{
    struct irb_image map;
    if (!irb_image_create(&map, ssim->width, ssim->height, 1, err))
        return false;
    for (size_t i = 0; i < irb_image_pixels(ssim); i++)
        map.data[i] = 1 - ssim->data[i];
    bool ok = write_colours(folder, "dissimilarity", &map, 1, err);
    irb_image_destroy(&map);
    return ok;
}

/* The difference that the field's figures print: of the images as they are shown, times 8 (Prutkin
 * et al. 2012, figure 1). */
static bool write_amplified(const char *folder, const struct irb_image *difference,
                            struct irb_error *err)
{
    static const float factor = 8;
    struct irb_image map;
    if (!irb_image_create(&map, difference->width, difference->height, 3, err))
        return false;
    for (size_t i = 0; i < 3 * irb_image_pixels(&map); i++)
        map.data[i] = factor * difference->data[i];
    char *path = irb_asprintf("%s/difference_x8.png", folder);
    bool ok = irb_png_write(path, &map, err);
    free(path);
    irb_image_destroy(&map);
    return ok;
}

static bool write_pictures(const char *folder, const struct irb_comparison *c,
                           struct irb_error *err)
{
    const struct irb_image *relmse = &c->relmse;
    double level = 100 * sqrt(c->eps); /* the mean reference */
    double bright = irb_value_percentile(&relmse, NULL, 1, 0.99);
    return write_colours(folder, "difference", &c->difference, level, err) &&
           write_amplified(folder, &c->displayed_difference, err) &&
           write_colours(folder, "relmse", relmse, bright > 0 ? bright : 1, err) &&
           write_colours(folder, "flip", &c->flip, 1, err) &&
           write_colours(folder, "ldr_flip", &c->ldr_flip, 1, err) &&
           write_ssim(folder, &c->ssim, err);
}

static bool write_maps(const struct irb_cli *cli, const struct irb_comparison *c,
                       struct irb_error *err)
{
    const struct irb_exr_layer layers[] = {
        {"", "RGB", &c->difference}, {"relmse", "Y", &c->relmse},     {"flip", "Y", &c->flip},
        {"ssim", "Y", &c->ssim},     {"ldr_flip", "Y", &c->ldr_flip},
    };
    const struct irb_exr_attribute attributes[] = {{"irbench:image", cli->arguments[0]},
                                                   {"irbench:reference", cli->arguments[1]}};
    if (!irb_fs_make_dirs(cli->out, err))
        return false;
    char *path = irb_asprintf("%s/maps.exr", cli->out);
    bool ok = irb_exr_write(path, layers, sizeof layers / sizeof *layers, attributes, 2,
                            IRB_EXR_ZIP, err);
    free(path);
    return ok && (!IRB_HAVE_IMAGES || write_pictures(cli->out, c, err));
}

/* ---- the command ---- */

static bool is_json(const struct irb_cli *cli, bool *json, struct irb_error *err)
{
    *json = cli->format && !strcmp(cli->format, "json");
    return *json || !cli->format || !strcmp(cli->format, "text") ||
           irb_fail(err, IRB_E_USAGE, "compare: --format: expected text or json; found '%.64s'",
                    cli->format);
}

static bool compare_files(const struct irb_cli *cli, struct irb_comparison *c,
                          struct irb_error *err)
{
    const char *image_path = cli->arguments[0], *reference_path = cli->arguments[1];
    struct irb_image image = {0}, reference = {0};
    bool displayed = is_display_referred(image_path) && is_display_referred(reference_path);
    bool ok = read_image(image_path, cli->layer, &image, err) &&
              read_image(reference_path, cli->layer, &reference, err) &&
              (irb_compare(c, &image, &reference, displayed, cli->threads, err) ||
               irb_error_prefix(err, "%s, %s", image_path, reference_path));
    irb_image_destroy(&image);
    irb_image_destroy(&reference);
    return ok;
}

bool irb_command_compare(struct irb_cli *cli, struct irb_error *err)
{
    struct bound bounds[IRB_CLI_MAX_ARGUMENTS];
    struct irb_comparison comparison;
    bool json;
    if (!is_json(cli, &json, err))
        return false;
    for (int i = 0; i < cli->bound_count; i++)
        if (!parse_bound(&cli->bounds[i], &bounds[i], err))
            return false;
    if (!compare_files(cli, &comparison, err))
        return false;
    if (json)
        print_json(cli, &comparison);
    else
        print_text(&comparison);
    bool ok = (!cli->out || write_maps(cli, &comparison, err)) &&
              check_bounds(bounds, cli->bound_count, &comparison, err);
    irb_comparison_destroy(&comparison);
    return ok;
}
