/* SPDX-License-Identifier: MIT
 *
 * The commands that describe: list, show, inspect.
 */
#include "core/cli/cli.h"
#include "core/cli/markdown.h"
#include "core/cli/method_text.h"
#include "core/config/config.h"
#include "core/scene/builtin.h"
#include "core/scene/deform.h"
#include "core/score/metric_list.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void list_methods(const struct irb_cli *cli)
{
    for (int i = 0; i < cli->registry.count; i++)
        printf("%-22s %-6s %s\n", cli->registry.methods[i]->name,
               cli->registry.methods[i]->path_classes, cli->registry.methods[i]->title);
}

static void list_scenes(const struct irb_cli *cli)
{
    (void)cli;
    for (const struct irb_builtin *b = irb_builtins; b->name; b++)
        printf("%-22s %s\n", b->name, b->doc);
}

static void list_metrics(const struct irb_cli *cli)
{
    (void)cli;
    for (int i = 0; i < IRB_METRIC_COUNT; i++)
        printf("%-24s %-10s %-7s %s\n", irb_metrics[i].name, irb_metrics[i].unit,
               irb_better_name(irb_metrics[i].better), irb_metrics[i].doc);
}

static void list_backends(const struct irb_cli *cli)
{
    (void)cli;
    for (int i = 0; irb_backend_names[i]; i++)
        printf("%s\n", irb_backend_names[i]);
}

static const struct {
    const char *name;
    void (*list)(const struct irb_cli *cli);
} lists[] = {{"methods", list_methods},
             {"scenes", list_scenes},
             {"metrics", list_metrics},
             {"backends", list_backends}};

bool irb_command_list(struct irb_cli *cli, struct irb_error *err)
{
    const char *what = cli->argument_count ? cli->arguments[0] : NULL;
    bool found = false;
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) {
        if (what && strcmp(what, lists[i].name))
            continue;
        if (!what)
            printf("%s%s:\n", i ? "\n" : "", lists[i].name);
        lists[i].list(cli);
        found = true;
    }
    return found ||
           irb_fail(err, IRB_E_USAGE,
                    "list: expected methods, scenes, metrics or backends; found '%s'", what);
}

static void print_options(const struct irb_option *options, const void *settings)
{
    for (const struct irb_option *o = options; o->name; o++) {
        struct irb_str value = {0}, allowed = {0};
        irb_option_print(o, settings, &value);
        irb_option_allowed(o, "|", &allowed);
        printf("  %-16s %-10s %s\n  %-16s %s (%s)\n", o->name, irb_str_text(&value),
               irb_str_text(&allowed), "", o->doc, o->source);
        irb_str_free(&value);
        irb_str_free(&allowed);
    }
}

static bool show_method(const struct irb_method *method, struct irb_error *err)
{
    struct irb_trial trial = {0};
    struct irb_registry one = {.methods = {method}, .count = 1};
    if (!irb_trial_parse(&trial, method->name, &one, err))
        return false;
    struct irb_str visibility = {0};
    irb_method_visibility_text(method, "", &visibility);
    printf("%s: %s\n%s\nlight paths: %s; %s\n\nparameters (default, allowed):\n", method->name,
           method->title, method->citation, method->path_classes, irb_str_text(&visibility));
    irb_str_free(&visibility);
    print_options(method->params, trial.params);
    printf("\nand of every trial:\n");
    print_options(irb_trial_options, &trial.core);
    printf("\nstages:");
    for (int i = 0; method->stages[i]; i++)
        printf(" %s", method->stages[i]);
    printf("\n");
    irb_trial_destroy(&trial);
    return true;
}

/* Its name, and every parameter below it. */
static void show_trial(const struct irb_trial *trial)
{
    struct irb_str values = {0};
    const struct irb_option *o;
    for (int i = 0; (o = irb_trial_option(trial->method, i)); i++) {
        if (irb_trial_option_is_core(o) && irb_trial_is_default(trial, o))
            continue;
        irb_str_printf(&values, " %s=", o->name);
        irb_trial_print(trial, o, &values);
    }
    printf("  %s\n     %s\n", trial->name, irb_str_text(&values));
    irb_str_free(&values);
}

static bool show_config(struct irb_cli *cli, const char *path, struct irb_error *err)
{
    struct irb_config config = {0};
    if (!irb_config_load(&config, path, cli->overrides, &cli->registry, err))
        return false;
    printf("%s (key %.8s), seed%s", config.name, irb_config_key(&config).hex,
           config.seed_count > 1 ? "s" : "");
    for (int i = 0; i < config.seed_count; i++)
        printf(" %d", config.seeds[i]);
    if (config.repeats > 1)
        printf(", each %d times", config.repeats);
    printf("\n\nrendering:\n");
    print_options(irb_render_options, &config.render);
    printf("\noutput:\n");
    print_options(irb_output_options, &config.output);
    printf("\nreference:\n");
    print_options(irb_reference_options, &config.reference);
    printf("\nscenes:\n");
    for (int i = 0; i < config.scene_count; i++)
        printf("  %-22s %s, %d light and %d camera keys\n", config.scenes[i].name,
               config.scenes[i].source, config.scenes[i].animation.light_key_count,
               config.scenes[i].animation.camera_key_count);
    printf("\n%d trial%s with %d seed%s:\n", config.trial_count, config.trial_count == 1 ? "" : "s",
           config.seed_count, config.seed_count == 1 ? "" : "s");
    for (int i = 0; i < config.trial_count; i++)
        show_trial(&config.trials[i]);
    irb_config_destroy(&config);
    return true;
}

static void show_scene(const struct irb_builtin *builtin)
{
    printf("%s: %s\nsource: %s\n", builtin->name, builtin->doc, builtin->source);
}

static bool ends_with(const char *text, const char *end)
{
    size_t n = strlen(text), m = strlen(end);
    return n >= m && !strcmp(text + n - m, end);
}

bool irb_command_show(struct irb_cli *cli, struct irb_error *err)
{
    const char *name = cli->arguments[0];
    if (ends_with(name, ".yaml") || ends_with(name, ".yml"))
        return show_config(cli, name, err);
    const struct irb_builtin *builtin = irb_builtin_find(name);
    if (builtin) {
        show_scene(builtin);
        return true;
    }
    int metric = irb_metric_find(name);
    if (metric >= 0) {
        printf("%s: %s\nunit: %s, better: %s\n", name, irb_metrics[metric].doc,
               *irb_metrics[metric].unit ? irb_metrics[metric].unit : "none",
               irb_better_name(irb_metrics[metric].better));
        return true;
    }
    const struct irb_method *method = irb_registry_find(&cli->registry, name, NULL);
    if (method)
        return show_method(method, err);
    return irb_fail(err, IRB_E_USAGE,
                    "show: '%s' is no method, scene, metric or config (.yaml); see irbench list",
                    name);
}

static double triangle_area(const struct irb_scene *scene, uint32_t triangle)
{
    const uint32_t *index = scene->indices + 3 * (size_t)triangle;
    const float *a = scene->positions + 3 * (size_t)index[0];
    const float *b = scene->positions + 3 * (size_t)index[1];
    const float *c = scene->positions + 3 * (size_t)index[2];
    double u[3], v[3];
    for (int i = 0; i < 3; i++) {
        u[i] = (double)b[i] - a[i];
        v[i] = (double)c[i] - a[i];
    }
    double x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2],
           z = u[0] * v[1] - u[1] * v[0];
    return 0.5 * sqrt(x * x + y * y + z * z);
}

static void print_materials(const struct irb_scene *scene)
{
    printf("materials:\n");
    for (int i = 0; i < scene->material_count; i++) {
        const struct irb_material *m = &scene->materials[i];
        printf("  %-24s diffuse %.3f %.3f %.3f  specular %.3f %.3f %.3f  exponent %.3g%s%s\n",
               m->name, m->diffuse[0], m->diffuse[1], m->diffuse[2], m->specular[0], m->specular[1],
               m->specular[2], m->exponent, m->diffuse_texture >= 0 ? "  texture " : "",
               m->diffuse_texture >= 0 ? scene->textures[m->diffuse_texture].name : "");
    }
}

/* What the scene's own animation does; nothing where it has none. */
static void print_animation(const struct irb_scene *scene)
{
    double first, last;
    if (irb_scene_duration(scene, &first, &last))
        printf("animation  %.4g .. %.4g s\n", first, last);
    for (int i = 0; scene->deform && i < scene->deform->object_count; i++) {
        const struct irb_deform_object *object = &scene->deform->objects[i];
        printf("deforms    %s: %u vertices, %d morph targets, %d joints\n",
               scene->objects[object->object].name, object->vertex_count, object->target_count,
               object->joint_count);
    }
}

bool irb_command_inspect(struct irb_cli *cli, struct irb_error *err)
{
    struct irb_scene *scene = irb_scene_load(cli->arguments[0], &cli->log, err);
    if (!scene)
        return false;
    double area = 0;
    for (uint32_t i = 0; i < scene->triangle_count; i++)
        area += triangle_area(scene, i);
    printf("%s\n", scene->name);
    printf("triangles  %u\nvertices   %u\nobjects    %d\nmaterials  %d\ntextures   %d\n",
           scene->triangle_count, scene->vertex_count, scene->object_count, scene->material_count,
           scene->texture_count);
    printf("bounds     (%.4g %.4g %.4g) .. (%.4g %.4g %.4g) m, diagonal %.4g m\n",
           scene->bounds_min[0], scene->bounds_min[1], scene->bounds_min[2], scene->bounds_max[0],
           scene->bounds_max[1], scene->bounds_max[2], irb_scene_diagonal(scene));
    printf("area       %.6g m2\nkey        %s\n", area, irb_scene_key(scene).hex);
    print_animation(scene);
    print_materials(scene);
    for (int i = 0; i < scene->texture_count; i++)
        printf("texture    %s %dx%d\n", scene->textures[i].name, scene->textures[i].width,
               scene->textures[i].height);
    irb_scene_destroy(scene);
    return true;
}
