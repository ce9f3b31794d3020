/* SPDX-License-Identifier: MIT
 *
 * The table of commands.
 */
#include "core/cli/cli.h"

const struct irb_command irb_commands[] = {
    {"run", "CONFIG", 1, 1, "prepare, render and score an experiment, print its table",
     "\nWhat was done before (cached references, finished frames of the same run folder) is not\n"
     "done again; Ctrl-C keeps everything.\n\n"
     "  irbench run experiments/quick.yaml\n"
     "  irbench run experiments/quick.yaml --set frames=2 --set reference.noise=0.05 --out /tmp/q\n"
     "  irbench run experiments/quick.yaml --only rsm:mode=uniform:samples=100\n"
     "  irbench run experiments/quick.yaml --set seeds=20 --minutes 30\n"
     "  irbench run experiments/quick.yaml --debug-layers --keep all\n",
     irb_command_run},
    {"table", "RUN", 1, 1, "print the results of a run folder",
     "\nReads the run's database, also while a run writes it: then the first line says how far it "
     "is, "
     "and\n"
     "rows are of the frames that are there. Instead of the scores, --stages "
     "prints "
     "the\n"
     "median time of every stage and --statistics the mean of what methods report of their frames, "
     "in\n"
     "a table for each method of a scene; --ratio holds all trials against one. --frames has a row "
     "for\n"
     "every frame, and --figure the numbers of a figure, for plots.\n\n"
     "  irbench table results/runs/quick-1a2b3c4d\n"
     "  irbench table results/runs/quick-1a2b3c4d --format json\n"
     "  irbench table results/runs/seeds-1a2b3c4d --format latex --per-seed\n"
     "  irbench table results/runs/quick-1a2b3c4d --stages --format md\n"
     "  irbench table results/runs/quick-1a2b3c4d --ratio ism:vpls=512\n"
     "  irbench table results/runs/quick-1a2b3c4d --frames > frames.csv\n"
     "  irbench table results/runs/quick-1a2b3c4d --figure pareto > pareto.csv\n",
     irb_command_table},
    {"plot", "RUN", 1, 1, "draw a figure of a run: --kind KIND, as SVG, PNG or PDF",
     "\nWith gnuplot. Methods have the same colours and symbols in all figures; a panel a scene.\n"
     "  pareto       error against frame time or memory, with intervals and fronts\n"
     "  stages       where the time of a frame goes\n"
     "  timeline     a metric over the frames: of each method its best trial, or those of --only\n"
     "  convergence  error over the number that a family of trials differs in\n"
     "  flicker      flicker and pops of each trial, with the reference's own\n"
     "Without --out the file lies in the run folder. The scripts are in plots/, and draw what\n"
     "they are given by hand as well.\n\n"
     "  irbench plot results/runs/quick-1a2b3c4d --kind pareto\n"
     "  irbench plot results/runs/quick-1a2b3c4d --kind pareto --metric indirect_rmse --cost "
     "bytes\n"
     "  irbench plot results/runs/quick-1a2b3c4d --kind stages --scene cornell --out stages.pdf\n"
     "  irbench plot results/runs/quick-1a2b3c4d --kind timeline --only rsm --only ism:vpls=256\n",
     irb_command_plot},
    {"tradeoff", "CONFIG|RUN", 1, 1, "run an experiment as run does, then say what its error costs",
     "\nOr take a run that is there. Prints the trials that nothing measured beats in error and "
     "cost,\n"
     "the least error within a time and the least time for an error, and every method at equal "
     "time\n"
     "and at equal error. RUN/tradeoff gets the same as answers.md, answers.csv, equal-time.csv,\n"
     "equal-error.csv and pareto.csv, and images of the methods side by side.\n\n"
     "  irbench tradeoff experiments/tradeoff.yaml --minutes 30\n"
     "  irbench tradeoff results/runs/tradeoff-1a2b3c4d --time 100 --metric rmse\n"
     "  irbench tradeoff results/runs/tradeoff-1a2b3c4d --error 0.2\n",
     irb_command_tradeoff},
    {"report", "RUN", 1, 1, "write a run as one HTML file: answers, tables, figures, image viewer",
     "\nThe file needs nothing else, neither a network nor other files; without --out it is\n"
     "RUN/report.html. Figures need gnuplot; without it the page has their data alone. Images are\n"
     "those of the run's film; where all of them would be larger than --max-mb (25), those of "
     "each\n"
     "method's best trial and of every --trial are taken, then fewer frames, and the page says "
     "so.\n\n"
     "  irbench report results/runs/quick-1a2b3c4d\n"
     "  irbench report results/runs/quick-1a2b3c4d --out quick.html --trial rsm --max-mb 10\n",
     irb_command_report},
    {"reference", "CONFIG", 1, 1, "trace the references of an experiment into the cache",
     "\nThe cache is $IRBENCH_CACHE, else ~/.cache/irbench. Resumable.\n\n"
     "  irbench reference experiments/quick.yaml\n"
     "  irbench reference experiments/quick.yaml --key\n",
     irb_command_reference},
    {"list", "WHAT", 0, 1, "list methods, scenes, metrics or backends",
     "\n  irbench list methods\n  irbench list metrics\n", irb_command_list},
    {"show", "NAME", 1, 1, "show a method's parameters, a scene's source or a config as resolved",
     "\n  irbench show rsm\n  irbench show cornell\n  irbench show experiments/quick.yaml\n",
     irb_command_show},
    {"docs", "SUBJECT", 1, 1,
     "print a reference as Markdown: config, cli, metrics, methods or scenes",
     "\nMade from the tables that the program itself works with; docs/ holds what it prints.\n\n"
     "  irbench docs config\n",
     irb_command_docs},
    {"inspect", "SCENE", 1, 1, "say what a scene file or built-in holds",
     "\n  irbench inspect cornell\n  irbench inspect sibenik.glb\n", irb_command_inspect},
    {"compare", "IMAGE REFERENCE", 2, 2, "every image metric between two image files",
     "\nOpenEXR files, or any image that OpenImageIO reads. Two files of a display-referred "
     "format\n"
     "(PNG, JPEG, ...) are compared as they are shown; all others hold radiance, which SSIM and\n"
     "LDR-FLIP see tone-mapped at an exposure from the reference. --max and --min bound the\n"
     "metrics by the values printed: the exit status is 1 where one does not hold, or is not\n"
     "defined. --out DIR writes the maps: maps.exr, a PNG of each in false colour, and\n"
     "difference_x8.png: the difference of the images as they are shown, times 8.\n\n"
     "  irbench compare image.exr reference.exr\n"
     "  irbench compare image.exr reference.exr --layer indirect --format json\n"
     "  irbench compare image.exr reference.exr --max flip=0.05 --min ssim=0.98 --out maps\n",
     irb_command_compare},
    {"export-scene", "SCENE FILE.glb", 2, 2, "write a scene with its view for other renderers",
     "\nGeometry, materials, textures, camera and light of frame 0; units one to one (W/sr).\n\n"
     "  irbench export-scene hall hall.glb\n",
     irb_command_export_scene},
    {"doctor", "", 0, 0, "say what this machine can do, and what to do about what is missing",
     "\n  irbench doctor\n  irbench doctor --backend egl\n", irb_command_doctor},
    {NULL, NULL, 0, 0, NULL, NULL, NULL},
};
