/* SPDX-License-Identifier: MIT
 *
 * The real scenes, where they are: in ${IRBENCH_SCENES}, else in ../shared/scenes beside the
 * sources. Counts and boxes as published with the files.
 */
#include "core/scene/scene.h"

#include "core/base/fs.h"
#include "core/base/str.h"
#include "tests/support/compare.h"

#include <stdlib.h>
#include <string.h>

static const char *scene_folder(void)
{
    const char *folder = getenv("IRBENCH_SCENES");

    return folder ? folder : TEST_SCENES_FOLDER;
}

struct expectation {
    const char *file;
    uint32_t triangles; /* with degenerate ones */
    double min[3], max[3];
};

static long degenerate_count(const char *warnings)
{
    const char *found = strstr(warnings, " degenerate triangles");

    if (!found)
        return 0;
    while (found > warnings && found[-1] >= '0' && found[-1] <= '9')
        found--;
    return strtol(found, NULL, 10);
}

static void require_unit_normals(const struct irb_scene *scene)
{
    for (uint32_t v = 0; v < scene->vertex_count; v++) {
        const float *n = scene->normals + 3 * (size_t)v;

        REQUIRE_NEAR(sqrt((double)n[0] * n[0] + (double)n[1] * n[1] + (double)n[2] * n[2]), 1,
                     1e-6);
    }
}

static void require_scene(const struct expectation *expected)
{
    char *path = irb_asprintf("%s/%s", scene_folder(), expected->file), *warnings = NULL;
    struct irb_log log = {.level = IRB_LOG_WARNING};
    struct irb_error err = {0};
    struct irb_scene *scene;
    size_t size;

    if (!irb_fs_exists(path)) {
        print_message("skipped: no %s (set IRBENCH_SCENES)\n", path);
        free(path);
        skip();
    }
    log.out = open_memstream(&warnings, &size);
    scene = irb_scene_load(path, &log, &err);
    fclose(log.out);
    if (!scene)
        fail_msg("%s", err.message);
    REQUIRE_CMP(scene->triangle_count + degenerate_count(warnings), ==, expected->triangles);
    for (int i = 0; i < 3; i++) {
        REQUIRE_NEAR(scene->bounds_min[i], expected->min[i], 0.051);
        REQUIRE_NEAR(scene->bounds_max[i], expected->max[i], 0.051);
    }
    require_unit_normals(scene);
    irb_scene_destroy(scene);
    free(warnings);
    free(path);
}

static void sibenik(void **state)
{
    (void)state;
    require_scene(
        &(struct expectation){"sibenik.glb", 75274, {-20.1, -15.3, -8.5}, {20.1, 15.3, 8.5}});
}

static void sponza(void **state)
{
    (void)state;
    require_scene(&(struct expectation){
        "sponza-dabrovic.glb", 66453, {-17.4, -0.9, -7.8}, {17.4, 15.7, 7.8}});
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(sibenik), cmocka_unit_test(sponza)};

    if (!irb_fs_exists(scene_folder())) {
        print_message("skipped: no folder %s (set IRBENCH_SCENES)\n", scene_folder());
        return TEST_SKIPPED;
    }
    return cmocka_run_group_tests(tests, NULL, NULL);
}
