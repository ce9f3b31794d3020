/* SPDX-License-Identifier: MIT
 *
 * Rows are converted to opponent colours and filtered horizontally, then filtered vertically and
 * taken to CIELab and to lengths of gradients.
 */
#include "core/score/flip_analysis.h"

#include "core/base/parallel.h"
#include "core/score/flip_colour.h"
#include "core/score/flip_exposure.h"
#include "core/score/flip_math.h"

#include <math.h>
#include <stdlib.h>

/* What is filtered horizontally, and what comes out vertically. */
enum { H_Y, H_CX, H_CZ0, H_CZ1, H_GAUSS, H_EDGE, H_POINT, H_PLANES };
enum { V_Y, V_CX, V_CZ, V_CZ1, V_EDGE_X, V_EDGE_Y, V_POINT_X, V_POINT_Y, V_ROWS };

enum { BAND = 8 }; /* rows that a thread takes at a time */

struct pass {
    const struct irb_flip_analysis *analysis;
    const struct irb_image *image;
    struct irb_flip_display display;
    float *layers;
};

static float *plane_row(const struct irb_flip_analysis *a, int plane, int y)
{
    return a->planes + ((size_t)plane * (size_t)a->height + (size_t)y) * (size_t)a->width;
}

/* IEC 61966-2-1. */
static float srgb_decode(float v)
{
    return v <= 0.04045f ? v / 12.92f : powf((v + 0.055f) / 1.055f, 2.4f);
}

/* Displayed values in [0,1], linear; NaN is 0. */
IRB_FLIP_WIDE
static void display_row(struct irb_flip_display display, const float *restrict in, int count,
                        float *restrict out)
{
    const float bound = 1e18f; /* its square is finite */
    if (display.encoding == IRB_FLIP_ACES) {
        for (int i = 0; i < count; i++) {
            float v = in[i] * display.gain;
            v = v > 0 ? v : 0;
            out[i] = irb_aces(v < bound ? v : bound);
        }
        return;
    }
    for (int i = 0; i < count; i++) {
        float v = in[i] > 0 ? in[i] : 0;
        out[i] = v < 1 ? v : 1;
    }
    for (int i = 0; display.encoding == IRB_FLIP_SRGB && i < count; i++)
        out[i] = srgb_decode(out[i]);
}

IRB_FLIP_WIDE
static void opponent_row(const float *restrict rgb, int width, float *restrict row_y,
                         float *restrict row_cx, float *restrict row_cz)
{
    for (int x = 0; x < width; x++) {
        struct irb_opponent colour = irb_rgb_to_opponent(rgb + 3 * x);
        row_y[x] = colour.y;
        row_cx[x] = colour.cx;
        row_cz[x] = colour.cz;
    }
}

/* Repeats the first and last value outside the row: the filters clamp to the edge. */
static void pad_row(float *row, int width, int radius)
{
    for (int k = 1; k <= radius; k++) {
        row[-k] = row[0];
        row[width - 1 + k] = row[width - 1];
    }
}

static void filter_horizontally(const struct irb_flip_analysis *a,
                                const struct irb_flip_kernel *kernel, const float *row, float *out)
{
    const float *taps[2 * IRB_FLIP_MAX_RADIUS + 1];
    for (int k = -kernel->radius; k <= kernel->radius; k++)
        taps[kernel->radius + k] = row + k;
    irb_flip_apply(kernel, taps + kernel->radius, a->width, out);
}

static bool horizontal_band(void *user, int band, int thread)
{
    const struct pass *pass = user;
    const struct irb_flip_analysis *a = pass->analysis;
    const struct irb_flip_filters *filters = a->filters;
    size_t stride = (size_t)a->width + 2 * (size_t)filters->radius;
    float *rows[3], *shown = a->scratch + (size_t)thread * a->per_thread + 3 * stride;
    for (size_t i = 0; i < 3; i++)
        rows[i] = shown - (i + 1) * stride + filters->radius;
    const struct {
        const struct irb_flip_kernel *kernel;
        const float *row;
    } jobs[H_PLANES] = {
        [H_Y] = {&filters->achromatic, rows[0]},
        [H_CX] = {&filters->red_green, rows[1]},
        [H_CZ0] = {&filters->blue_yellow[0], rows[2]},
        [H_CZ1] = {&filters->blue_yellow[1], rows[2]},
        [H_GAUSS] = {&filters->gauss, rows[0]},
        [H_EDGE] = {&filters->edge, rows[0]},
        [H_POINT] = {&filters->point, rows[0]},
    };
    for (int y = band * BAND; y < (band + 1) * BAND && y < a->height; y++) {
        display_row(pass->display, irb_image_at(pass->image, 0, y), 3 * a->width, shown);
        opponent_row(shown, a->width, rows[0], rows[1], rows[2]);
        for (int i = 0; i < 3; i++)
            pad_row(rows[i], a->width, filters->radius);
        for (int i = 0; i < H_PLANES; i++)
            filter_horizontally(a, jobs[i].kernel, jobs[i].row, plane_row(a, i, y));
    }
    return true;
}

static void filter_vertically(const struct irb_flip_analysis *a,
                              const struct irb_flip_kernel *kernel, int plane, int y, float *out)
{
    const float *taps[2 * IRB_FLIP_MAX_RADIUS + 1];
    for (int k = -kernel->radius; k <= kernel->radius; k++) {
        int row = y + k < 0 ? 0 : y + k >= a->height ? a->height - 1 : y + k;
        taps[kernel->radius + k] = plane_row(a, plane, row);
    }
    irb_flip_apply(kernel, taps + kernel->radius, a->width, out);
}

static void filter_row(const struct irb_flip_analysis *a, int y, float *const out[V_ROWS])
{
    const struct irb_flip_filters *k = a->filters;
    filter_vertically(a, &k->achromatic, H_Y, y, out[V_Y]);
    filter_vertically(a, &k->red_green, H_CX, y, out[V_CX]);
    filter_vertically(a, &k->blue_yellow[0], H_CZ0, y, out[V_CZ]);
    filter_vertically(a, &k->blue_yellow[1], H_CZ1, y, out[V_CZ1]);
    for (int x = 0; x < a->width; x++)
        out[V_CZ][x] =
            k->blue_yellow_share[0] * out[V_CZ][x] + k->blue_yellow_share[1] * out[V_CZ1][x];
    filter_vertically(a, &k->gauss, H_EDGE, y, out[V_EDGE_X]);
    filter_vertically(a, &k->edge, H_GAUSS, y, out[V_EDGE_Y]);
    filter_vertically(a, &k->gauss, H_POINT, y, out[V_POINT_X]);
    filter_vertically(a, &k->point, H_GAUSS, y, out[V_POINT_Y]);
}

IRB_FLIP_WIDE
static void lab_row(const float *restrict row_y, const float *restrict row_cx,
                    const float *restrict row_cz, int width, float *restrict l, float *restrict a,
                    float *restrict b)
{
    for (int x = 0; x < width; x++) {
        struct irb_opponent colour = {row_y[x], row_cx[x], row_cz[x]};
        struct irb_lab lab = irb_opponent_to_hunt_lab(colour);
        l[x] = lab.l;
        a[x] = lab.a;
        b[x] = lab.b;
    }
}

IRB_FLIP_WIDE
static void length_row(const float *restrict row_x, const float *restrict row_y, int width,
                       float *restrict out)
{
    for (int x = 0; x < width; x++)
        out[x] = sqrtf(row_x[x] * row_x[x] + row_y[x] * row_y[x]);
}

static bool vertical_band(void *user, int band, int thread)
{
    const struct pass *pass = user;
    const struct irb_flip_analysis *a = pass->analysis;
    size_t width = (size_t)a->width, pixels = width * (size_t)a->height;
    float *v[V_ROWS], *out[IRB_FLIP_LAYERS];
    for (size_t i = 0; i < V_ROWS; i++)
        v[i] = a->scratch + (size_t)thread * a->per_thread + i * width;
    for (int y = band * BAND; y < (band + 1) * BAND && y < a->height; y++) {
        for (size_t i = 0; i < IRB_FLIP_LAYERS; i++)
            out[i] = pass->layers + i * pixels + (size_t)y * width;
        filter_row(a, y, v);
        lab_row(v[V_Y], v[V_CX], v[V_CZ], a->width, out[IRB_FLIP_L], out[IRB_FLIP_A],
                out[IRB_FLIP_B]);
        length_row(v[V_EDGE_X], v[V_EDGE_Y], a->width, out[IRB_FLIP_EDGE]);
        length_row(v[V_POINT_X], v[V_POINT_Y], a->width, out[IRB_FLIP_POINT]);
    }
    return true;
}

bool irb_flip_analysis_create(struct irb_flip_analysis *analysis,
                              const struct irb_flip_filters *filters, int width, int height,
                              int threads, struct irb_error *err)
{
    size_t w = (size_t)width, horizontal = 3 * (w + 2 * (size_t)filters->radius) + 3 * w;
    size_t vertical = V_ROWS * w;
    *analysis = (struct irb_flip_analysis){
        .filters = filters,
        .width = width,
        .height = height,
        .threads = threads > 0 ? threads : irb_core_count(),
        .per_thread = horizontal > vertical ? horizontal : vertical,
    };
    analysis->planes = malloc(H_PLANES * w * (size_t)height * sizeof(float));
    analysis->scratch = malloc((size_t)analysis->threads * analysis->per_thread * sizeof(float));
    return (analysis->planes && analysis->scratch) ||
           irb_fail(err, IRB_E_MEMORY, "FLIP of %d x %d pixels: out of memory", width, height);
}

void irb_flip_analysis_destroy(struct irb_flip_analysis *analysis)
{
    free(analysis->planes);
    free(analysis->scratch);
    *analysis = (struct irb_flip_analysis){0};
}

void irb_flip_analyse(const struct irb_flip_analysis *analysis, const struct irb_image *image,
                      struct irb_flip_display display, float *layers)
{
    struct pass pass = {analysis, image, display, layers};
    int bands = (analysis->height + BAND - 1) / BAND;
    irb_parallel_for(bands, analysis->threads, horizontal_band, &pass);
    irb_parallel_for(bands, analysis->threads, vertical_band, &pass);
}
