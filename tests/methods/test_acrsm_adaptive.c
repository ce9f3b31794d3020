/* SPDX-License-Identifier: MIT
 *
 * What the adaptive clustering is for (thesis 4.1, figures 4.2 and 6.7): a spot turns from the back
 * wall of the Cornell box to the right one, over the edge that k-means does not cross. With
 * evaluation more of the clusters follow it, and they are more even.
 */
#include "tests/support/compare.h"
#include "tests/methods/acrsm_fixture.h"

static struct irb_gl *gl;

enum { SETTLE = 12, FRAMES = 60, SEEDS = 4, CLUSTERS = 128 };

/* After 65 degrees three quarters of the light fall on the right wall. */
static struct irb_light light_at(double t)
{
    const double angle = fmax(t, 0) * 65 * M_PI / 180;
    const float position[3] = {0.3f, 0.42f, 0.3f};
    const float target[3] = {0.3f + (float)sin(angle), 0.42f, 0.3f + (float)cos(angle)};
    struct irb_light light = fixture_spot(position, target, 32);
    light.falloff = IRB_FALLOFF_COSINE;
    return light;
}

struct balance {
    double on_wall; /* share of the clusters that are on the right wall at the end */
    double spread, count_spread;
};

static struct balance turn(struct acrsm_fixture *a, bool adaptive, uint64_t seed)
{
    struct irb_error err = {0};
    struct acrsm_cluster clusters[ACRSM_CLUSTERS_MOST];
    a->settings.adaptive = adaptive;
    REQUIRE_OK(acrsm_clusters_begin(a->clusters, seed, &err));
    for (int frame = -SETTLE; frame < FRAMES; frame++) {
        struct irb_light light = light_at(frame / (FRAMES - 1.0));
        acrsm_fixture_rsm(a, &light);
        acrsm_fixture_frame(a);
    }
    struct acrsm_report report = acrsm_fixture_report(a);
    struct balance balance = {0, report.spread, report.count_spread};
    acrsm_fixture_state(a, clusters);
    for (int i = 0; i < CLUSTERS; i++)
        balance.on_wall += clusters[i].count > 0 && clusters[i].normal[0] < -0.7;
    balance.on_wall /= CLUSTERS;
    return balance;
}

static void test_turn(void **state)
{
    (void)state;
    struct acrsm_fixture a;
    struct balance mean[2] = {{0}};
    acrsm_fixture_create(&a, gl, fixture_scene("cornell-objects"), 128, CLUSTERS);
    for (uint64_t seed = 1; seed <= SEEDS; seed++)
        for (int adaptive = 0; adaptive < 2; adaptive++) {
            struct balance balance = turn(&a, adaptive, seed);
            mean[adaptive].on_wall += balance.on_wall / SEEDS;
            mean[adaptive].spread += balance.spread / SEEDS;
            mean[adaptive].count_spread += balance.count_spread / SEEDS;
        }
    for (int adaptive = 0; adaptive < 2; adaptive++)
        print_message("%s: %.3f of the clusters on the new wall, spread of delta %.3f, of texels "
                      "%.3f\n",
                      adaptive ? "adaptive" : "without", mean[adaptive].on_wall,
                      mean[adaptive].spread, mean[adaptive].count_spread);
    REQUIRE_CMP(mean[1].on_wall, >, 1.1 * mean[0].on_wall);
    REQUIRE_CMP(mean[1].spread, <, 0.95 * mean[0].spread);
    REQUIRE_CMP(mean[1].count_spread, <, 0.95 * mean[0].count_spread);
    acrsm_fixture_destroy(&a);
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), NULL);
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_turn)};
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failed;
}
