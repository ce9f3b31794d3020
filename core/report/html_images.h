/* SPDX-License-Identifier: MIT
 *
 * Which images a report holds. Everything that the run keeps is found first, then chosen from so
 * that the file stays within its budget:
 *   1. all trials, where they fit;
 *   2. else the best trial of each method (least indirect FLIP) and those asked for by name;
 *   3. of these no temporal residuals;
 *   4. every second frame, every fourth, ... and the worst frames;
 *   5. fewer trials, those with the largest FLIP first to go.
 * For core/report only.
 */
#ifndef IRB_REPORT_HTML_IMAGES_H
#define IRB_REPORT_HTML_IMAGES_H

#include "core/base/str.h"
#include "core/report/analysis.h"
#include "core/report/html.h"

/* Files that become one block of the page, an array of base64 texts. */
struct irb_html_strip {
    char **paths;  /* NULL where there is no file; owned, and so is each */
    size_t *bytes; /* of each file; owned */
    int count;
    int id; /* of the block; -1 = not in the page */
};

struct irb_html_trial_images {
    struct irb_html_strip indirect, flip, residual; /* a frame each */
    struct irb_html_strip profile, flicker;         /* one file each */
    struct irb_html_strip sheets;                   /* a frame each; where the scene has no film */
    bool has_film, wanted;                          /* wanted: the film is in the page */
    bool asked;                                     /* by name */
    int worst;                                      /* frame of the largest indirect FLIP */
    double worst_flip;                              /* NaN without */
};

struct irb_html_scene_images {
    int frame_count;
    bool *frames; /* which of them the page holds; owned */
    struct irb_html_strip reference, direct, direct_reference;
    struct irb_html_trial_images *trials; /* as the analysis has them; owned */
    int trial_count;
    int best;     /* trial with the least indirect FLIP that has a film, -1 without */
    bool *method; /* whether a trial is the best of its method; owned */
};

struct irb_html_images {
    struct irb_html_scene_images *scenes; /* as the analysis has them; owned */
    int scene_count;
    int block_count;
    struct irb_str notes; /* what is left out, as HTML paragraphs; "" where nothing is */
};

/* Looks for the files of the run. IRB_E_INPUT where a trial is asked for that no scene has. */
bool irb_html_images_find(struct irb_html_images *images, const char *run_dir,
                          const struct irb_analysis *analysis,
                          const struct irb_html_options *options, struct irb_error *err);
/* Chooses within `budget` bytes of base64 text, numbers the blocks, and says what is left out. */
void irb_html_images_choose(struct irb_html_images *images, const struct irb_analysis *analysis,
                            double budget, struct irb_log *log);
/* Writes all blocks as script elements. What cannot be read any more becomes null. IRB_E_IO where
 * `out` does not take it. */
bool irb_html_images_write(FILE *out, const struct irb_html_images *images, struct irb_error *err);
void irb_html_images_destroy(struct irb_html_images *images);

#endif
