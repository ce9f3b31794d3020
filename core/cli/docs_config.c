/* SPDX-License-Identifier: MIT
 *
 * The reference of the config file.
 */
#include "core/cli/docs.h"
#include "core/cli/markdown.h"
#include "core/config/config.h"
#include "core/config/keys.h"

#include <stdlib.h>

#define KEY(name, value, doc) {name, value, doc},
#define SECTION(title, KEYS) {title, (const struct irb_documented_key[]){KEYS(KEY){NULL}}},

const struct irb_documented_section irb_documented_sections[] = {
    IRB_CONFIG_SECTIONS(SECTION){NULL},
};

static const char introduction[] =
    "# Config reference\n"
    "\n"
    "Made by `irbench docs config` from the tables that the program reads configs with.\n"
    "\n"
    "A config is one YAML file. Every error names file, line and column. Single values can be set\n"
    "from the command line: `--set frames=4 --set resolution=64x48 --set reference.noise=0.05\n"
    "--set seeds=1,2,3`. `irbench show CONFIG` prints a config as it is understood, all trials "
    "and\n"
    "seeds included.\n"
    "\n"
    "    name: example\n"
    "    seeds: [1, 2, 3]\n"
    "    resolution: [256, 192]\n"
    "    frames: 8\n"
    "    reference: {min_samples: 16, max_samples: 64, noise: 0.02}\n"
    "    scenes:\n"
    "      - scene: cornell\n"
    "        light:\n"
    "          keys:\n"
    "            - {frame: 0, position: [0.25, 0.5, 0.12], target: [0.45, 0, 0.1], intensity: 1}\n"
    "            - {frame: 7, target: [0.55, 0.25, 0.35]}\n"
    "    trials:\n"
    "      - rsm:mode=all\n"
    "      - rsm:samples=100@0+400@4\n"
    "      - rsm: {mode: uniform, samples: [100, 400, 1600]}\n"
    "      - rsm:\n"
    "          clamp: 10\n"
    "          matrix:\n"
    "            - {mode: uniform, samples: 100}\n"
    "            - {mode: importance, samples: 400}\n"
    "\n";

static const char of_trials[] =
    "## `trials`\n"
    "\n"
    "A list of methods with their parameters (`irbench docs methods`), as a name\n"
    "(`rsm:mode=uniform:samples=100`) or as a map. In a map a list where one value may stand gives "
    "a\n"
    "trial for each value; several lists give every combination, in the order of the method's\n"
    "parameter table with the last one changing fastest. `matrix:` lists combinations instead: "
    "each\n"
    "of its maps is merged over what stands beside it. A trial that comes out twice is refused, "
    "and\n"
    "so are more than 1000 trials, each seed counted. `rsm_resolution`\n"
    "may stand in any trial, and be swept too (`rsm: {rsm_resolution: [128, 256]}`): the method is "
    "given an\n"
    "RSM of that size, and direct light keeps the config's.\n"
    "\n"
    "A parameter may change over the sequence: `samples: {keys: [[0, 32], [4, 64]]}` is 32 in "
    "frames 0\n"
    "to 3 and 64 from frame 4 on, and `interpolation: linear` goes there in a straight line. The "
    "same\n"
    "in a name is `rsm:samples=32@0+64@4`, linear `rsm:samples=32@0..64@4`. Settle frames have "
    "the\n"
    "values of frame 0.\n"
    "\n"
    "## `seed`, `seeds` and `repeats`\n"
    "\n"
    "Without either there are five seeds; `seed: 1` is one. With several every trial is run with "
    "each of\n"
    "them; tables show means and the standard\n"
    "deviation from seed to seed (`--per-seed` gives every seed a row), and files of a trial lie "
    "in\n"
    "`RUN/SCENE/TRIAL/seed-N/`. A method without random choices gives the same image for every\n"
    "seed, with a deviation of 0; its times are then repeated measurements. The reference has a\n"
    "seed of its own, `reference.seed`.\n"
    "\n"
    "Each seed and repeat is a pass over the whole sequence: first every seed once, then every "
    "seed\n"
    "again. Within a pass the trials take turns frame by frame, in an order that changes. Repeats "
    "are\n"
    "not part of the config's key: a run with `repeats: 1` goes on to 3 with `--set repeats=3`. "
    "The\n"
    "last frame of a repeat must be that of the first time, bit for bit, or the run ends.\n"
    "\n";

static void print_section(FILE *out, const struct irb_documented_section *section)
{
    fprintf(out, "## %s\n\n", section->title);
    irb_markdown_header(out, (const char *const[]){"key", "value", "meaning", NULL});
    for (const struct irb_documented_key *key = section->keys; key->name; key++) {
        char *name = irb_asprintf("`%s`", key->name);
        irb_markdown_row(out, (const char *const[]){name, key->value, key->doc, NULL});
        free(name);
    }
    fprintf(out, "\n");
}

void irb_docs_config(FILE *out, const struct irb_cli *cli)
{
    (void)cli;
    fputs(introduction, out);
    print_section(out, &irb_documented_sections[0]);
    fputs("Single values beside them:\n\n", out);
    irb_markdown_options(out, irb_render_options, "key");
    fputs("\nWhat is kept beside the numbers; it is no part of the config's key. `gl_bytes` counts "
          "the\ntextures that a method makes for it:\n\n",
          out);
    irb_markdown_options(out, irb_output_options, "key");
    fputs("\n## `reference`\n\n", out);
    irb_markdown_options(out, irb_reference_options, "key");
    fputs("\n", out);
    fputs(of_trials, out);
    for (const struct irb_documented_section *s = irb_documented_sections + 1; s->title; s++)
        print_section(out, s);
}
