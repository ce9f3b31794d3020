/* SPDX-License-Identifier: MIT
 *
 * The command docs: references as Markdown, from the tables that the program works with.
 */
#include "core/cli/docs.h"
#include "core/cli/markdown.h"
#include "core/cli/method_text.h"
#include "core/config/config.h"
#include "core/scene/builtin.h"
#include "core/score/metric_list.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

static void print_title(FILE *out, const char *title, const char *subject)
{
    fprintf(out, "# %s\n\nMade by `irbench docs %s`.\n\n", title, subject);
}

static void docs_options(FILE *out)
{
    irb_markdown_header(out, (const char *const[]){"option", "meaning", NULL});
    for (const struct irb_cli_option *o = irb_cli_options; o->name; o++) {
        char *name = irb_asprintf("`%s%s%s%s%s`", o->letter ? o->letter : "", o->letter ? ", " : "",
                                  o->name, o->value ? " " : "", o->value ? o->value : "");
        irb_markdown_row(out, (const char *const[]){name, o->doc, NULL});
        free(name);
    }
    irb_markdown_row(out,
                     (const char *const[]){"`-h, --help`", "this, or a command's own help", NULL});
    irb_markdown_row(out, (const char *const[]){"`--version`", "version and build", NULL});
}

static void docs_exit_status(FILE *out)
{
    irb_markdown_header(out, (const char *const[]){"status", "name", "meaning", NULL});
    static const struct {
        int status;
        const char *name, *doc;
    } codes[] = {
#define X(name, status, doc) {status, #name, doc},
        IRB_ERROR_CODES(X)
#undef X
    };
    for (size_t i = 0; i < sizeof codes / sizeof *codes; i++) {
        char number[16];
        snprintf(number, sizeof number, "%d", codes[i].status);
        irb_markdown_row(out, (const char *const[]){number, codes[i].name, codes[i].doc, NULL});
    }
}

static void docs_environment(FILE *out)
{
    static const char *const variables[][3] = {
        {"`IRBENCH_CACHE`",
         "folder of references and G-buffers; $XDG_CACHE_HOME/irbench or "
         "~/.cache/irbench without it",
         NULL},
        {"`IRBENCH_SCENES`", "folder of the scenes that configs name as ${IRBENCH_SCENES}/...",
         NULL},
        {"`LP_NUM_THREADS`", "threads of the software rasteriser (Mesa's llvmpipe)", NULL},
        {"`NO_COLOR`", "no colour on the terminal", NULL},
    };
    irb_markdown_header(out, (const char *const[]){"variable", "meaning", NULL});
    for (size_t i = 0; i < sizeof variables / sizeof *variables; i++)
        irb_markdown_row(out, variables[i]);
}

/* A table's line as a sentence of its own. */
static void print_sentence(FILE *out, const char *line)
{
    fprintf(out, "%c%s.\n", toupper((unsigned char)*line), *line ? line + 1 : "");
}

static void docs_cli(FILE *out, const struct irb_cli *cli)
{
    (void)cli;
    print_title(out, "Command-line reference", "cli");
    fputs("    irbench COMMAND [ARGUMENTS] [OPTIONS]\n\n## Commands\n", out);
    for (const struct irb_command *c = irb_commands; c->name; c++) {
        fprintf(out, "\n### %s%s%s\n\n", c->name, *c->arguments ? " " : "", c->arguments);
        print_sentence(out, c->doc);
        fprintf(out, "\n```\n%s```\n", c->help + (*c->help == '\n'));
    }
    fputs("\n## Options\n\n", out);
    docs_options(out);
    fputs("\n## Progress for programs\n\n"
          "With `--json` everything on stderr is one JSON object a line:\n\n"
          "    {\"event\": \"progress\", \"what\": \"render\", \"fraction\": 0.3700, \"left_s\": "
          "12}\n"
          "    {\"event\": \"info\", \"message\": \"...\"}             also \"warning\" and "
          "\"debug\"\n"
          "    {\"event\": \"error\", \"code\": \"INPUT\", \"message\": \"...\"}\n"
          "    {\"event\": \"done\", \"run\": \"results/runs/...\"}    the last line of what went "
          "well\n"
          "\n`left_s` is null while nobody knows; `code` is a name of the next table.\n"
          "\n## Exit status\n\n",
          out);
    docs_exit_status(out);
    fputs("\n## Environment\n\n", out);
    docs_environment(out);
}

static void docs_metrics(FILE *out, const struct irb_cli *cli)
{
    (void)cli;
    print_title(out, "Metrics", "metrics");
    fputs(
        "v is the method's image, r the reference: linear radiance over pixels with geometry and\n"
        "over channels. eps is (0.01 times the mean of r over the sequence) squared. *indirect* "
        "is\n"
        "the indirect radiance and *full* the whole image, both against bounce 1 with exact\n"
        "visibility. Stage times are metrics of their own, `stage_NAME_ms`.\n\n",
        out);
    irb_markdown_header(out, (const char *const[]){"metric", "unit", "better", "meaning", NULL});
    for (int i = 0; i < IRB_METRIC_COUNT; i++) {
        char *name = irb_asprintf("`%s`", irb_metrics[i].name);
        irb_markdown_row(out, (const char *const[]){name, irb_metrics[i].unit,
                                                    irb_better_name(irb_metrics[i].better),
                                                    irb_metrics[i].doc, NULL});
        free(name);
    }
    fputs("\nIn a scene's named regions, as `METRIC@REGION`:", out);
    for (int i = 0; i < IRB_REGION_METRIC_COUNT; i++)
        fprintf(out, "%s`%s`", i ? ", " : " ", irb_metrics[irb_region_metrics[i]].name);
    fputs(".\n", out);
}

static void docs_method(FILE *out, const struct irb_method *method)
{
    struct irb_str nature = {0};
    irb_method_visibility_text(method, "`", &nature);
    irb_str_printf(&nature, ".");
    irb_method_needs_text(method, IRB_NEEDS_HISTORY, "Keeps a history", "`", &nature);
    irb_method_needs_text(method, IRB_NEEDS_STATIC_GEOMETRY, "Needs static geometry", "`", &nature);
    fprintf(out, "## %s: %s\n\n%s\n\nLight paths: %s; %s\n\n", method->name, method->title,
            method->citation, method->path_classes, irb_str_text(&nature));
    irb_str_free(&nature);
    if (method->params->name)
        irb_markdown_options(out, method->params, "parameter");
    fputs("\nStages that are timed:", out);
    for (int i = 0; method->stages[i]; i++)
        fprintf(out, "%s`%s`", i ? ", " : " ", method->stages[i]);
    fputs(".\n\n", out);
}

static void docs_methods(FILE *out, const struct irb_cli *cli)
{
    print_title(out, "Methods", "methods");
    fputs("## Of every trial\n\nBeside the method's own parameters, in names, maps and sweeps "
          "alike.\n\n",
          out);
    irb_markdown_options(out, irb_trial_options, "parameter");
    fputs("\n", out);
    for (int i = 0; i < cli->registry.count; i++)
        docs_method(out, cli->registry.methods[i]);
}

static void docs_scenes(FILE *out, const struct irb_cli *cli)
{
    (void)cli;
    print_title(out, "Built-in scenes", "scenes");
    irb_markdown_header(out, (const char *const[]){"scene", "what it is", "source", NULL});
    for (const struct irb_builtin *b = irb_builtins; b->name; b++) {
        char *name = irb_asprintf("`%s`", b->name);
        irb_markdown_row(out, (const char *const[]){name, b->doc, b->source, NULL});
        free(name);
    }
    fputs(
        "\n## glTF files\n\n"
        "A scene may also be a glTF 2.0 file, `.gltf` or `.glb`. Its triangles, base colours with "
        "their\ntextures and alpha masks, spot and directional lights, perspective cameras and "
        "first animation are\nread; `irbench inspect FILE` says what there is, and warns about "
        "what "
        "is left out. `animation:` in a\nconfig plays the animation, which moves:\n\n"
        "- nodes, by translation, rotation and scale;\n"
        "- vertices, by the weights of morph targets (positions and normals). At rest the weights "
        "are the node's,\n  else the mesh's, else 0;\n"
        "- vertices of skins, by joints: up to 16 a vertex, whose weights are divided by their "
        "sum. "
        "A vertex\n  that no joint holds stays where its node is at rest.\n\n"
        "Surfaces without normals in the file stay flat when they deform. Sparse accessors and "
        "compressed\nmeshes are refused. `irbench export-scene` writes a scene at rest: no "
        "animation, morph targets or skins.\n",
        out);
}

static const struct {
    const char *name;
    void (*print)(FILE *out, const struct irb_cli *cli);
} subjects[] = {{"config", irb_docs_config},
                {"cli", docs_cli},
                {"metrics", docs_metrics},
                {"methods", docs_methods},
                {"scenes", docs_scenes}};

bool irb_command_docs(struct irb_cli *cli, struct irb_error *err)
{
    for (size_t i = 0; i < sizeof subjects / sizeof *subjects; i++) {
        if (strcmp(cli->arguments[0], subjects[i].name))
            continue;
        subjects[i].print(stdout, cli);
        return true;
    }
    return irb_fail(err, IRB_E_USAGE,
                    "docs: expected config, cli, metrics, methods or scenes, found '%.64s'",
                    cli->arguments[0]);
}
