/* SPDX-License-Identifier: MIT
 *
 * Sequences whose flicker is known, through what a run scores them with: irb_score_frame for every
 * frame, the store, and the figures of the sequence.
 */
#include "core/experiment/score_frame.h"

#include "core/base/hash.h"
#include "core/score/flicker.h"
#include "tests/support/compare.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static struct irb_error err;

enum { W = 48, H = 32, N = W * H, MOST_FRAMES = 26 };

/* A pixel's value in all channels; frames may be negative. */
typedef float (*pixel_fn)(int frame, int x, int y);

struct sequence {
    pixel_fn test, reference;
    int frames;
    const int32_t *source; /* of a view that moves: where each pixel was; NULL = at rest */
    const struct irb_region *regions;
    int region_count;
};

struct scores {
    struct irb_frame_scores frames[MOST_FRAMES];
    double whole[IRB_METRIC_COUNT]; /* the sequence's, as the store has them */
    double regions[IRB_MOST_REGIONS][IRB_REGION_METRIC_COUNT];
    struct irb_image residual[MOST_FRAMES]; /* maps; empty in frame 0 */
    double mean;                            /* reference */
    const struct irb_scene_entry *entry;
};

static struct irb_image draw(pixel_fn fn, int frame)
{
    struct irb_image image;
    REQUIRE_OK(irb_image_create(&image, W, H, 3, &err));
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++)
            for (int c = 0; c < 3; c++)
                irb_image_at(&image, x, y)[c] = fn(frame, x, y);
    return image;
}

static struct irb_target target_of(const struct sequence *sequence, int frame)
{
    struct irb_target target = {0};
    target.indirect = draw(sequence->reference, frame);
    target.full = draw(sequence->reference, frame);
    target.mask = malloc(N);
    assert_non_null(target.mask);
    memset(target.mask, 1, N);
    return target;
}

static void set_constants(struct irb_target_constants *c, const struct sequence *sequence)
{
    struct irb_image images[MOST_FRAMES];
    const struct irb_image *list[MOST_FRAMES];
    *c = (struct irb_target_constants){.exposure = 0.5, .view_rests = true};
    if (!sequence->source)
        c->lag = irb_lag_reference_create(W, H, sequence->frames, &err);
    for (int i = 0; i < sequence->frames; i++) {
        images[i] = draw(sequence->reference, i);
        list[i] = &images[i];
        c->mean_indirect += irb_masked_mean(&images[i], NULL) / sequence->frames;
        if (c->lag)
            irb_lag_reference_set(c->lag, i, &images[i]);
    }
    c->mean_full = c->mean_indirect;
    c->eps_indirect = c->eps_full = irb_relmse_eps(c->mean_indirect);
    c->indirect_lit = irb_flip_exposures_of(list, NULL, sequence->frames, &c->flip_indirect);
    c->full_lit = irb_flip_exposures_of(list, NULL, sequence->frames, &c->flip_full);
    for (int i = 0; i < sequence->frames; i++)
        irb_image_destroy(&images[i]);
}

static void read_whole(void *user, int frame, const char *name, double value)
{
    struct scores *scores = user;
    int metric = irb_metric_find(name), region_metric = irb_region_metric_find(name);
    if (frame != -1)
        return;
    if (metric >= 0)
        scores->whole[metric] = value;
    for (int r = 0; region_metric >= 0 && r < scores->entry->region_count; r++)
        for (int i = 0; i < IRB_REGION_METRIC_COUNT; i++)
            if (irb_region_metrics[i] == region_metric &&
                !strcmp(strchr(name, '@') + 1, scores->entry->regions[r].name))
                scores->regions[r][i] = value;
}

/* The figures of the sequence go through a store of their own. */
static void aggregate(struct scores *scores, int frames, const struct irb_target_constants *c,
                      struct irb_scored_trial *trial)
{
    char dir[] = "/tmp/irb_temporal_XXXXXX", command[64];
    assert_non_null(mkdtemp(dir));
    struct irb_store *store = irb_store_open(dir, true, &err);
    if (!store)
        fail_msg("%s", err.message);
    trial->id = irb_store_trial(store, "scene", "method", "trial", "{}", 1, &err);
    assert_true(trial->id > 0);
    REQUIRE_OK(irb_sequence_scores_store(scores->frames, frames, c, store, trial, &err));
    for (int i = 0; i < IRB_METRIC_COUNT; i++)
        scores->whole[i] = NAN;
    for (int i = 0; i < IRB_MOST_REGIONS * IRB_REGION_METRIC_COUNT; i++)
        scores->regions[i / IRB_REGION_METRIC_COUNT][i % IRB_REGION_METRIC_COUNT] = NAN;
    REQUIRE_OK(irb_store_read_scores(store, trial->id, read_whole, scores, &err));
    irb_store_close(store);
    snprintf(command, sizeof command, "rm -rf '%s'", dir);
    assert_int_equal(system(command), 0);
}

static void score(struct scores *scores, const struct sequence *sequence)
{
    struct irb_config settings = {.reference = {.bounces = 1}};
    struct irb_scene_entry entry = {.regions = (struct irb_region *)sequence->regions,
                                    .region_count = sequence->region_count};
    struct irb_scored_trial trial = {.scene = "scene", .entry = &entry};
    struct irb_target_constants constants;
    struct irb_target previous_target = {0};
    struct irb_scored_frame previous = {.frame = -1};
    struct irb_reprojection motion = {W, H, (int32_t *)sequence->source};
    memset(scores, 0, sizeof *scores);
    set_constants(&constants, sequence);
    scores->mean = constants.mean_indirect;
    scores->entry = &entry;
    for (int i = 0; i < sequence->frames; i++) {
        struct irb_target target = target_of(sequence, i);
        struct irb_scored_frame current = {i, draw(sequence->test, i), draw(sequence->test, i)};
        struct irb_score_maps maps;
        REQUIRE_OK(irb_target_prepare(&target, &entry, &constants, 1, &err));
        struct irb_score_context context = {.constants = &constants,
                                            .target = &target,
                                            .previous_target = i > 0 ? &previous_target : NULL,
                                            .motion = sequence->source ? &motion : NULL,
                                            .settings = &settings};
        REQUIRE_OK(irb_score_frame(&scores->frames[i], &context, &trial, &current,
                                   i > 0 ? &previous : NULL, &maps, &err));
        scores->residual[i] = maps.residual; /* moved */
        irb_image_destroy(&maps.flip);
        irb_target_destroy(&previous_target);
        irb_scored_frame_destroy(&previous);
        previous_target = target;
        previous = current;
    }
    aggregate(scores, sequence->frames, &constants, &trial);
    irb_target_destroy(&previous_target);
    irb_scored_frame_destroy(&previous);
    irb_target_constants_destroy(&constants);
    scores->entry = NULL;
}

static void destroy(struct scores *scores)
{
    for (int i = 0; i < MOST_FRAMES; i++)
        irb_image_destroy(&scores->residual[i]);
}

/* What all frames but the first must have, of both images, and the sequence. */
static void expect_change(const struct scores *scores, int frames, double flicker, double pops,
                          double temporal_flip)
{
    for (int i = 0; i <= frames; i++) {
        const double *v = i < frames ? scores->frames[i].values : scores->whole;
        if (i == 0) {
            assert_true(isnan(v[IRB_METRIC_indirect_flicker]));
            assert_true(isnan(v[IRB_METRIC_indirect_temporal_flip]));
            assert_null(scores->residual[0].data);
            continue;
        }
        REQUIRE_NEAR(v[IRB_METRIC_indirect_flicker], flicker, 1e-14 * flicker);
        REQUIRE_NEAR(v[IRB_METRIC_full_flicker], flicker, 1e-14 * flicker);
        REQUIRE_NEAR(v[IRB_METRIC_indirect_pop_share], pops, 1e-15);
        REQUIRE_NEAR(v[IRB_METRIC_full_pop_share], pops, 1e-15);
        if (isnan(temporal_flip)) {
            REQUIRE_CMP(v[IRB_METRIC_indirect_temporal_flip], >, 0.01);
            continue;
        }
        REQUIRE_NEAR(v[IRB_METRIC_indirect_temporal_flip], temporal_flip, 0);
        REQUIRE_NEAR(v[IRB_METRIC_full_temporal_flip], temporal_flip, 0);
    }
}

/* ---- sequences; values are multiples of 2^-7, so that sums and differences are exact ---- */

static float texture(int seed, int x, int y)
{
    return (float)(1 + irb_hash_mix((uint64_t)seed, (uint64_t)(y * 4096 + x)) % 128) / 128;
}

static float still_reference(int frame, int x, int y)
{
    (void)frame;
    return texture(1, x, y);
}

static float still_test(int frame, int x, int y)
{
    (void)frame;
    return texture(2, x, y);
}

static float one(int frame, int x, int y)
{
    (void)frame, (void)x, (void)y;
    return 1;
}

static float jitter_eighth(int frame, int x, int y)
{
    (void)x, (void)y;
    return frame % 2 ? 1.125f : 0.875f;
}

static float jitter_small(int frame, int x, int y)
{
    (void)x, (void)y;
    return frame % 2 ? 1.03125f : 0.96875f;
}

/* A bright edge that moves two pixels a frame, over a texture. */
static float moving(int frame, int x, int y)
{
    return texture(3, x, y) + (x < 4 + 2 * frame ? 1.5f : 0);
}

static float moving_offset(int frame, int x, int y)
{
    return moving(frame, x, y) + 0.25f;
}

static float checkerboard(int frame, int x, int y)
{
    return (x + y) % 2 == 0 && frame >= 3 ? 1.5f : 1;
}

/* ---- tests ---- */

static void a_still_image_does_not_flicker(void **state)
{
    (void)state;
    struct scores scores;
    score(&scores,
          &(struct sequence){.test = still_test, .reference = still_reference, .frames = 6});
    expect_change(&scores, 6, 0, 0, 0);
    REQUIRE_CMP(scores.whole[IRB_METRIC_indirect_rmse], >, 0.1);
    assert_true(isnan(scores.whole[IRB_METRIC_lag]));
    destroy(&scores);
}

static void jitter_has_a_closed_form(void **state)
{
    (void)state;
    struct scores scores;
    /* +-d about 1: 2d; above the threshold of pops, a tenth, and below it */
    score(&scores, &(struct sequence){.test = jitter_eighth, .reference = one, .frames = 6});
    expect_change(&scores, 6, 0.25, 1, NAN);
    for (int i = 1; i < 6; i++)
        for (int p = 0; p < N; p++)
            REQUIRE_NEAR(scores.residual[i].data[p], 0.25, 0);
    destroy(&scores);
    score(&scores, &(struct sequence){.test = jitter_small, .reference = one, .frames = 6});
    expect_change(&scores, 6, 0.0625, 0, NAN);
    destroy(&scores);
}

static void following_the_reference_is_no_flicker(void **state)
{
    (void)state;
    struct scores scores;
    score(&scores, &(struct sequence){.test = moving, .reference = moving, .frames = 20});
    expect_change(&scores, 20, 0, 0, 0);
    REQUIRE_NEAR(scores.whole[IRB_METRIC_lag], 0, 0);
    REQUIRE_NEAR(scores.whole[IRB_METRIC_indirect_flip], 0, 0);
    destroy(&scores);
    score(&scores, &(struct sequence){.test = moving_offset, .reference = moving, .frames = 20});
    expect_change(&scores, 20, 0, 0, 0);
    REQUIRE_NEAR(scores.whole[IRB_METRIC_indirect_bias], 0.25, 1e-12);
    REQUIRE_CMP(scores.whole[IRB_METRIC_indirect_flip], >, 0);
    destroy(&scores);
}

/* moving(frame - K) */
#define DELAYED(name, k)                                                                           \
    static float name(int frame, int x, int y)                                                     \
    {                                                                                              \
        return moving(frame - (k), x, y);                                                          \
    }
DELAYED(ahead_by_2, -2)
DELAYED(behind_by_1, 1)
DELAYED(behind_by_3, 3)
DELAYED(behind_by_7, 7)

static void a_late_image_has_lag(void **state)
{
    (void)state;
    const struct {
        pixel_fn test;
        int lag;
    } cases[] = {{ahead_by_2, -2}, {behind_by_1, 1}, {behind_by_3, 3}, {behind_by_7, 7}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct scores scores;
        score(&scores, &(struct sequence){
                           .test = cases[i].test, .reference = moving, .frames = MOST_FRAMES});
        REQUIRE_NEAR(scores.whole[IRB_METRIC_lag], cases[i].lag, 0);
        REQUIRE_CMP(scores.whole[IRB_METRIC_indirect_flicker], >, 0.05);
        destroy(&scores);
    }
}

static void pops_are_counted(void **state)
{
    (void)state;
    const struct irb_region regions[] = {
        {.name = "all", .box = {0, 0, 1, 1}, .fractions = true},
        {.name = "popped", .box = {2, 0, 3, 1}},
        {.name = "still", .box = {3, 0, 4, 1}},
        {.name = "three", .box = {0, 0, 3, 1}},
    };
    enum { ALL, POPPED, STILL, THREE, REGIONS };
    struct scores scores;
    score(&scores, &(struct sequence){.test = checkerboard,
                                      .reference = one,
                                      .frames = 6,
                                      .regions = regions,
                                      .region_count = REGIONS});
    const double shares[REGIONS] = {0.5, 1, 0, 2.0 / 3};
    int place[IRB_METRIC_COUNT] = {0};
    for (int i = 0; i < IRB_REGION_METRIC_COUNT; i++)
        place[irb_region_metrics[i]] = i;
    for (int i = 1; i < 6; i++) {
        const struct irb_frame_scores *s = &scores.frames[i];
        bool now = i == 3;
        REQUIRE_NEAR(s->values[IRB_METRIC_indirect_pop_share], now ? 0.5 : 0, 0);
        REQUIRE_NEAR(s->values[IRB_METRIC_indirect_flicker], now ? 0.5 * sqrt(0.5) : 0, 1e-15);
        for (int r = 0; r < REGIONS; r++) {
            const double *v = s->regions[r];
            REQUIRE_NEAR(v[place[IRB_METRIC_full_pop_share]], now ? shares[r] : 0, 1e-15);
            REQUIRE_NEAR(v[place[IRB_METRIC_indirect_flicker]], now ? 0.5 * sqrt(shares[r]) : 0,
                         1e-15);
        }
        REQUIRE_NEAR(s->regions[ALL][place[IRB_METRIC_indirect_temporal_flip]],
                     s->values[IRB_METRIC_indirect_temporal_flip], 1e-15);
    }
    /* the sequence: five pairs of frames, one with the jump */
    REQUIRE_NEAR(scores.whole[IRB_METRIC_indirect_pop_share], 0.1, 1e-15);
    REQUIRE_NEAR(scores.whole[IRB_METRIC_indirect_flicker], 0.5 * sqrt(0.1), 1e-15);
    for (int r = 0; r < REGIONS; r++) {
        REQUIRE_NEAR(scores.regions[r][place[IRB_METRIC_indirect_pop_share]], shares[r] / 5, 1e-15);
        REQUIRE_NEAR(scores.regions[r][place[IRB_METRIC_indirect_flicker]],
                     0.5 * sqrt(shares[r] / 5), 1e-15);
    }
    REQUIRE_NEAR(scores.regions[ALL][place[IRB_METRIC_full_temporal_flip]],
                 scores.whole[IRB_METRIC_full_temporal_flip], 1e-15);
    REQUIRE_CMP(scores.regions[POPPED][place[IRB_METRIC_full_temporal_flip]], >, 0);
    destroy(&scores);
}

/* ---- a camera that moves a pixel a frame ---- */

static float panned_reference(int frame, int x, int y)
{
    return texture(4, x - frame + 1000, y);
}

/* The error stays on the surface. */
static float panned_test(int frame, int x, int y)
{
    return panned_reference(frame, x, y) + texture(5, x - frame + 1000, y) / 2;
}

/* And here it stays in the image. */
static float screen_test(int frame, int x, int y)
{
    return panned_reference(frame, x, y) + texture(5, x, y) / 2;
}

static void a_moving_view_is_followed(void **state)
{
    (void)state;
    int32_t source[N];
    for (int i = 0; i < N; i++)
        source[i] = i % W ? i - 1 : -1; /* the first column comes into view */
    struct sequence sequence = {.reference = panned_reference, .frames = 5, .source = source};
    struct scores scores;
    sequence.test = panned_test;
    score(&scores, &sequence);
    expect_change(&scores, 5, 0, 0, 0);
    destroy(&scores);
    sequence.test = screen_test;
    score(&scores, &sequence);
    for (int i = 1; i < 5; i++) {
        /* the closed form, over the pixels that were in view */
        double square = 0;
        for (int y = 0; y < H; y++)
            for (int x = 0; x < W; x++) {
                double change = x ? (texture(5, x, y) - texture(5, x - 1, y)) / 2 : 0;
                square += change * change / ((W - 1) * H);
                REQUIRE_NEAR(scores.residual[i].data[y * W + x], fabs(change) / scores.mean, 1e-6);
            }
        REQUIRE_REL(scores.frames[i].values[IRB_METRIC_indirect_flicker],
                    sqrt(square) / scores.mean, 1e-12);
    }
    destroy(&scores);
}

static float sparkling(int frame, int x, int y)
{
    return frame == 2 && x == 5 && y == 6 ? NAN : texture(20 + frame, x, y);
}

/* The maps over a sequence are the frames' figures, pixel by pixel. */
static void maps_add_up_to_the_figures(void **state)
{
    (void)state;
    enum { FRAMES = 5 };
    struct scores scores;
    struct irb_flicker_sum sum;
    struct irb_flicker_maps maps;
    score(&scores, &(struct sequence){.test = sparkling, .reference = moving, .frames = FRAMES});
    REQUIRE_OK(irb_flicker_sum_create(&sum, W, H, &err));
    for (int i = 1; i < FRAMES; i++) {
        struct irb_image images[] = {draw(sparkling, i - 1), draw(moving, i - 1),
                                     draw(sparkling, i), draw(moving, i)};
        struct irb_pair previous = {&images[0], &images[1], NULL};
        struct irb_pair current = {&images[2], &images[3], NULL};
        irb_flicker_sum_add(&sum, &previous, &current, scores.mean);
        for (int k = 0; k < 4; k++)
            irb_image_destroy(&images[k]);
    }
    REQUIRE_OK(irb_flicker_maps_of(&maps, &sum, &err));
    double square = 0, pops = 0, expected_square = 0, expected_pops = 0;
    for (int p = 0; p < N; p++) {
        double own = 0;
        int pairs = 0;
        for (int i = 1; i < FRAMES; i++) {
            bool counts = p != 6 * W + 5 || i == 1 || i == 4;
            double residual = scores.residual[i].data[p];
            assert_true(counts || residual == 0);
            own += residual * residual;
            pairs += counts;
        }
        REQUIRE_NEAR(maps.pairs.data[p], pairs, 0);
        REQUIRE_REL(maps.flicker.data[p], sqrt(own / pairs), 1e-6);
        square += own;
        pops += maps.pops.data[p];
    }
    for (int i = 1; i < FRAMES; i++) {
        const double *v = scores.frames[i].values;
        int count = i == 2 || i == 3 ? N - 1 : N;
        expected_square += v[IRB_METRIC_indirect_flicker] * v[IRB_METRIC_indirect_flicker] * count;
        expected_pops += v[IRB_METRIC_indirect_pop_share] * count;
    }
    REQUIRE_REL(square, expected_square, 1e-6);
    REQUIRE_NEAR(pops, expected_pops, 1e-6);
    irb_flicker_maps_destroy(&maps);
    irb_flicker_sum_destroy(&sum);
    destroy(&scores);
}

static float black(int frame, int x, int y)
{
    (void)frame, (void)x, (void)y;
    return 0;
}

static void a_black_reference_gives_no_infinite_map(void **state)
{
    (void)state;
    struct scores scores;
    score(&scores, &(struct sequence){.test = jitter_eighth, .reference = black, .frames = 3});
    for (int p = 0; p < N; p++)
        REQUIRE_NEAR(scores.residual[1].data[p], 0, 0);
    REQUIRE_NEAR(scores.whole[IRB_METRIC_indirect_pop_share], 1, 0);
    destroy(&scores);
    score(&scores, &(struct sequence){.test = black, .reference = black, .frames = 3});
    expect_change(&scores, 3, 0, 0, 0);
    destroy(&scores);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_still_image_does_not_flicker),
        cmocka_unit_test(jitter_has_a_closed_form),
        cmocka_unit_test(following_the_reference_is_no_flicker),
        cmocka_unit_test(a_late_image_has_lag),
        cmocka_unit_test(pops_are_counted),
        cmocka_unit_test(a_moving_view_is_followed),
        cmocka_unit_test(maps_add_up_to_the_figures),
        cmocka_unit_test(a_black_reference_gives_no_infinite_map),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
