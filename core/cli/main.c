/* SPDX-License-Identifier: MIT */
#include "core/cli/cli.h"
#include "core/experiment/run.h"

#include <signal.h>
#include <stdio.h>
#include <string.h>

const struct irb_command irb_commands[] = {
    {"run", "CONFIG", 1, 1, "prepare, render and score an experiment, print its table",
     "\nWhat was done before (cached references, finished frames of the same run folder) is not\n"
     "done again; Ctrl-C keeps everything.\n\n"
     "  irbench run experiments/quick.yaml\n"
     "  irbench run experiments/quick.yaml --set frames=2 --set reference.noise=0.05 --out /tmp/q\n"
     "  irbench run experiments/quick.yaml --only rsm:samples=100\n",
     irb_command_run},
    {"table", "RUN", 1, 1, "print the results of a run folder",
     "\nReads the run's database, also while a run writes it.\n\n"
     "  irbench table results/runs/quick-1a2b3c4d\n"
     "  irbench table results/runs/quick-1a2b3c4d --format json\n"
     "  irbench table results/runs/seeds-1a2b3c4d --format latex --per-seed\n",
     irb_command_table},
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
    {"inspect", "SCENE", 1, 1, "say what a scene file or built-in holds",
     "\n  irbench inspect cornell\n  irbench inspect sibenik.glb\n", irb_command_inspect},
    {"compare", "IMAGE REFERENCE", 2, 2, "every image metric between two image files",
     "\nOpenEXR files, or any image that OpenImageIO reads. Two files of a display-referred format\n"
     "(PNG, JPEG, ...) are compared as they are shown; all others hold radiance, which SSIM and\n"
     "LDR-FLIP see tone-mapped at an exposure from the reference. --max and --min bound the\n"
     "metrics by the values printed: the exit status is 1 where one does not hold, or is not\n"
     "defined. --out DIR writes the maps: maps.exr, and a PNG of each in false colour.\n\n"
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

/* The one piece of state that a signal handler can reach. */
static volatile sig_atomic_t stop_requested;

static void request_stop(int signal_number)
{
    stop_requested = 1;
    signal(signal_number, SIG_DFL); /* a second Ctrl-C ends the program at once */
}

int main(int argc, char **argv)
{
    struct irb_cli cli = {
        .log = irb_log_default(), .stages = IRB_STAGE_ALL, .stop = &stop_requested};
    struct irb_error err = {0};
    const struct irb_command *command = NULL;
    signal(SIGINT, request_stop);
    signal(SIGTERM, request_stop);
#ifdef SIGXFSZ
    signal(SIGXFSZ, SIG_IGN); /* a file size limit is a write error like a full disk */
#endif
    irb_registry_init(&cli.registry);
    bool ok = irb_cli_parse(&cli, argc, argv, &command, &err);
    if (ok && command)
        ok = command->run(&cli, &err);
    if (ok && fflush(stdout))
        ok = irb_fail(&err, IRB_E_IO, "standard output: cannot write");
    irb_log_progress_done(&cli.log);
    if (!ok)
        irb_log_error(&cli.log, &err);
    else if (command)
        irb_log_done(&cli.log, cli.run_dir);
    int status = ok ? 0 : irb_error_status(err.code);
    irb_cli_close(&cli);
    return status;
}
