/* SPDX-License-Identifier: MIT
 *
 * Rasterised shadow maps against closed forms and against rays traced in double precision.
 *
 *     test_raster_maps BACKEND SHADERS     SHADERS: tests/lights/shaders
 */
#include "tests/support/compare.h"
#include "tests/support/raycast.h"
#include "tests/lights/raster_fixture.h"

static struct irb_gl *gl;

static const float grey[3] = {0.5f, 0.5f, 0.5f};
static const char *const projection_names[] = {"hemicube", "paraboloid"};
enum { PROJECTIONS = 2 };

/* A room, off the origin, no two sides alike; metres, before it is scaled. */
static double room_low[3], room_high[3];

static void set_room(double scale)
{
    static const double low[3] = {1, -2, 0.5}, high[3] = {4, 0.2, 6};
    for (int i = 0; i < 3; i++) {
        room_low[i] = scale * low[i];
        room_high[i] = scale * high[i];
    }
}

static struct irb_scene *make_room(void)
{
    struct irb_error err = {0};
    struct irb_builder builder;
    irb_builder_begin(&builder, "room");
    irb_builder_object(&builder, "room", irb_builder_material(&builder, "grey", grey));
    for (int axis = 0; axis < 3; axis++)
        for (int side = 0; side < 2; side++) {
            double corners[4][3];
            for (int i = 0; i < 4; i++) {
                int u = (axis + 1) % 3, v = (axis + 2) % 3;
                corners[i][axis] = side ? room_high[axis] : room_low[axis];
                corners[i][u] = i == 1 || i == 2 ? room_high[u] : room_low[u];
                corners[i][v] = i >= 2 ? room_high[v] : room_low[v];
            }
            irb_builder_quad(&builder, (const double(*)[3])corners);
        }
    struct irb_scene *scene = irb_builder_finish(&builder, &err);
    REQUIRE_OK(scene);
    return scene;
}

/* From inside the room to its walls. */
static double room_distance(const float from[3], const double d[3])
{
    double nearest = INFINITY;
    for (int i = 0; i < 3; i++)
        if (d[i] != 0)
            nearest = fmin(nearest, ((d[i] > 0 ? room_high[i] : room_low[i]) - from[i]) / d[i]);
    return nearest;
}

/* Lights in the air with any normal, and every third on a wall. */
static void make_room_lights(struct fixture_light *lights, int count)
{
    uint64_t random = 1;
    memset(lights, 0, (size_t)count * sizeof *lights);
    for (int l = 0; l < count; l++) {
        fixture_random_normal(&random, lights[l].normal);
        for (int i = 0; i < 3; i++)
            lights[l].position[i] = (float)(room_low[i] + (0.1 + 0.8 * fixture_random(&random)) *
                                                              (room_high[i] - room_low[i]));
        if (l % 3 == 2) {
            int axis = l / 3 % 3, side = l / 9 % 2;
            lights[l].position[axis] = (float)(side ? room_high[axis] : room_low[axis]);
            for (int i = 0; i < 3; i++)
                lights[l].normal[i] = i == axis ? (side ? -1.0f : 1.0f) : 0;
        }
    }
}

static struct irb_raster_maps *render(const struct irb_scene *scene,
                                      enum irb_raster_projection projection, int size,
                                      const struct fixture_light *lights, int count, float near)
{
    struct irb_error err = {0};
    struct irb_scene_gl *scene_gl = irb_scene_gl_create(gl, scene, &err);
    REQUIRE_OK(scene_gl);
    struct irb_raster_maps *maps =
        irb_raster_maps_create(gl, projection, size, count > 0 ? count : 1, &err);
    REQUIRE_OK(maps);
    struct irb_virtual_lights view = fixture_lights(gl, lights, count);
    REQUIRE_OK(irb_raster_maps_render(maps, scene_gl, &view, 0, count, near, &err));
    irb_buffer_destroy((struct irb_buffer *)view.buffer);
    irb_scene_gl_destroy(scene_gl);
    return maps;
}

/* ---- Texels ---- */

struct comparison {
    double worst;       /* relative error of those that agree */
    int texels, apart;  /* apart by more than `agree` */
    double worst_apart; /* largest |1/found - 1/expected| of those that do not, 1/m */
};

typedef double (*distance_fn)(const void *user, const float from[3], const double d[3]);

static void compare(struct comparison *out, double found, double expected, double agree)
{
    assert_false(isnan(found));
    out->texels++;
    if (found == expected) /* infinite ones too */
        return;
    if (fabs(found - expected) <= agree * expected) {
        out->worst = fmax(out->worst, fabs(found / expected - 1));
        return;
    }
    out->apart++;
    out->worst_apart = fmax(out->worst_apart, fabs(1 / found - 1 / expected));
}

/* Every texel of one light against the distance along the texel's own direction. */
static void compare_map(const struct irb_raster_maps *maps, const struct irb_image *image, int map,
                        const struct fixture_light *light, distance_fn distance, const void *user,
                        struct comparison *out)
{
    double frame[3][3], in_light[3], d[3];
    fixture_light_frame(light->normal, frame);
    for (int face = 0; face < maps->faces; face++)
        for (int y = 0; y < maps->size; y++)
            for (int x = 0; x < maps->size; x++) {
                if (!fixture_texel_direction(maps->projection, maps->size, face, x, y, in_light))
                    continue;
                fixture_to_world((const double(*)[3])frame, in_light, d);
                compare(out, fixture_texel(maps, image, map, face, x, y),
                        distance(user, light->position, d), 1e-5);
            }
}

static double distance_in_room(const void *user, const float from[3], const double d[3])
{
    (void)user;
    return room_distance(from, d);
}

/* Least distance of the walls that a light inside, or on one of them, can see. */
static double nearest_wall(const float from[3])
{
    double nearest = INFINITY;
    for (int i = 0; i < 3; i++) {
        double low = from[i] - room_low[i], high = room_high[i] - from[i];
        double on_it = 1e-5 * (room_high[i] - room_low[i]);
        if (low > on_it)
            nearest = fmin(nearest, low);
        if (high > on_it)
            nearest = fmin(nearest, high);
    }
    return nearest;
}

/* By how much directions differ, at most, that GL's grid of sub-pixels takes for one. */
static double snapping(int size)
{
    GLint bits = 0;
    gl->api.GetIntegerv(GL_SUBPIXEL_BITS, &bits);
    return M_SQRT2 * 2 / size / (1 << bits);
}

/* Inside a closed room every texel holds the distance along its own direction, but for those of the
 * hemicube that lie within the grid of sub-pixels from a corner of the room and show the wall
 * behind it. 1/r is the largest of (d . n)/h over the walls, so directions apart by s differ in 1/r
 * by at most s over the least distance of a wall. */
static void check_room(enum irb_raster_projection projection, int size, double scale)
{
    enum { LIGHTS = 24 };
    set_room(scale);
    struct irb_scene *scene = make_room();
    struct fixture_light lights[LIGHTS];
    make_room_lights(lights, LIGHTS);
    struct irb_raster_maps *maps =
        render(scene, projection, size, lights, LIGHTS, 1e-3f * (float)scale);
    struct irb_image image = fixture_read(maps->distance, 1);
    int texels = 0, corners = 0;
    double worst = 0;
    for (int l = 0; l < LIGHTS; l++) {
        struct comparison c = {0};
        compare_map(maps, &image, l, &lights[l], distance_in_room, NULL, &c);
        REQUIRE_CMP(c.worst_apart, <=, snapping(size) / nearest_wall(lights[l].position));
        texels += c.texels;
        corners += c.apart;
        worst = fmax(worst, c.worst);
    }
    print_message("room x %g, %s %d: %d texels, relative error up to %.2g; %d round a corner\n",
                  scale, projection_names[projection], size, texels, worst, corners);
    REQUIRE_CMP(corners, <=, projection == IRB_RASTER_HEMICUBE ? 1e-4 * texels : 0);
    irb_image_destroy(&image);
    irb_raster_maps_destroy(maps);
    irb_scene_destroy(scene);
}

static void test_room(void **state)
{
    (void)state;
    for (int p = 0; p < PROJECTIONS; p++) {
        enum irb_raster_projection projection = (enum irb_raster_projection)p;
        check_room(projection, 2, 1);
        check_room(projection, 6, 1e-3);
        check_room(projection, 6, 1e3);
        check_room(projection, 64, 1);
    }
}

/* ---- Look-ups ---- */

struct query {
    float direction[4], normal[4]; /* direction[3]: map */
};
struct answer {
    float texel_direction[4]; /* [3]: distance */
    float texel[4], tangent[4], bitangent[4];
};

static struct answer *look_up(const struct irb_raster_maps *maps, const struct query *queries,
                              int count)
{
    struct irb_error err = {0};
    struct answer *answers = malloc((size_t)count * sizeof *answers);
    const char *const defines[] = {irb_raster_define(maps->projection), NULL};
    struct irb_program *program = irb_program_create(
        gl,
        &(struct irb_program_desc){
            .name = "look-ups", .compute = "test_raster.comp", .defines = defines},
        &err);
    REQUIRE_OK(program);
    struct irb_buffer *in =
        irb_buffer_create(gl, "queries", count * (int64_t)sizeof *queries, queries, &err);
    struct irb_buffer *out =
        irb_buffer_create(gl, "answers", count * (int64_t)sizeof *answers, NULL, &err);
    REQUIRE_OK(in && out);
    irb_program_use(program);
    irb_raster_maps_bind(maps, program, 0);
    irb_program_uint(program, "count", (unsigned)count);
    gl->api.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, in->id);
    gl->api.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, out->id);
    gl->api.DispatchCompute((unsigned)(count + 63) / 64, 1, 1);
    REQUIRE_OK(irb_buffer_read(out, 0, count * (int64_t)sizeof *answers, answers, &err));
    irb_buffer_destroy(in);
    irb_buffer_destroy(out);
    irb_program_destroy(program);
    return answers;
}

/* Random directions, some of them on and about the horizon and the faces' edges and diagonals. */
static void make_queries(struct query *queries, int count, const struct fixture_light *lights,
                         int light_count)
{
    static const double special[][3] = {
        {0, 0, 1},       {1, 0, 0},  {-1, 0, 0},      {0, 1, 0},      {0, -1, 0},
        {1, 1, 1},       {-1, 1, 1}, {-1, -1, 1},     {1, -1, 0},     {-1, -1, 0},
        {-1, 0.3, 1e-9}, {1, 0, 1},  {-1, 0.5, -0.0}, {0, -1, 1e-12}, {0.3, -1, -1e-7}};
    enum { SPECIAL = sizeof special / sizeof *special };
    uint64_t random = 7;
    for (int i = 0; i < count; i++) {
        double d[3], length;
        int map = i % light_count;
        fixture_random_direction(&random, true, d);
        if (i / light_count < SPECIAL)
            memcpy(d, special[i / light_count], sizeof d);
        length = sqrt(raycast_dot(d, d));
        for (int k = 0; k < 3; k++)
            queries[i].direction[k] = (float)(d[k] / length);
        queries[i].direction[3] = (float)map;
        memcpy(queries[i].normal, lights[map].normal, sizeof queries[i].normal);
    }
}

/* How far a direction may be from that of the texel it is looked up in: half a diagonal of a texel
 * on the hemicube's planes, which are at least 1 away; on the paraboloid twice that at the centre,
 * where (u, v) are half of (x, y), and at the rim half a diagonal and what a texel's direction is
 * moved, 5/4 texels. */
static double footprint(enum irb_raster_projection projection, int size)
{
    double texel = 2.0 / size;
    return projection == IRB_RASTER_HEMICUBE ? texel * M_SQRT1_2
                                             : texel * fmax(2 * M_SQRT1_2, M_SQRT1_2 + 1.25);
}

static double apart(const float a[3], const float b[3])
{
    double sum = 0;
    for (int i = 0; i < 3; i++)
        sum += ((double)a[i] - b[i]) * ((double)a[i] - b[i]);
    return sqrt(sum);
}

static void check_frame(const struct query *query, const struct answer *answer)
{
    double frame[3][3];
    fixture_light_frame(query->normal, frame);
    for (int c = 0; c < 3; c++) {
        REQUIRE_NEAR(answer->tangent[c], frame[0][c], 1e-6);
        REQUIRE_NEAR(answer->bitangent[c], frame[1][c], 1e-6);
    }
    REQUIRE_NEAR(fixture_dot(answer->tangent, answer->bitangent), 0, 1e-6);
    REQUIRE_NEAR(fixture_dot(answer->tangent, query->normal), 0, 1e-6);
    REQUIRE_NEAR(fixture_dot(answer->tangent, answer->tangent), 1, 1e-6);
}

/* The texel that is read, from its place in the texture. */
static void check_texel(const struct irb_raster_maps *maps, const struct answer *answer, int map,
                        const struct irb_image *image)
{
    double direction[3] = {0};
    int x = (int)answer->texel[0], y = (int)answer->texel[1];
    int face = (int)answer->texel[2] - map * maps->faces;
    assert_true(x >= 0 && x < maps->size && y >= 0 && y < maps->size);
    assert_true(face >= 0 && face < maps->faces);
    assert_true(fixture_texel_direction(maps->projection, maps->size, face, x, y, direction));
    for (int c = 0; c < 3; c++)
        REQUIRE_NEAR(answer->texel_direction[c], direction[c], 1e-6);
    REQUIRE_NEAR(answer->texel_direction[3], fixture_texel(maps, image, map, face, x, y), 0);
}

/* The distance in the room along a query's direction. */
static double room_distance_of(const struct query *query, const struct fixture_light *light)
{
    double frame[3][3], d[3];
    const double in_light[3] = {query->direction[0], query->direction[1],
                                fmax(query->direction[2], 0)};
    fixture_light_frame(light->normal, frame);
    fixture_to_world((const double(*)[3])frame, in_light, d);
    return room_distance(light->position, d);
}

/* Any direction finds a texel whose own is within the footprint, so that in the room 1/r is within
 * footprint/h (see test_room). The distances that were found are kept. */
static void check_look_ups(const struct irb_raster_maps *maps, const struct fixture_light *lights,
                           int light_count, const struct query *queries, int count, double *found)
{
    const double reach = footprint(maps->projection, maps->size);
    struct irb_image image = fixture_read(maps->distance, 1);
    struct answer *answers = look_up(maps, queries, count);
    double worst = 0;
    for (int i = 0; i < count; i++) {
        const int map = i % light_count;
        const double wall = nearest_wall(lights[map].position);
        check_frame(&queries[i], &answers[i]);
        check_texel(maps, &answers[i], map, &image);
        worst = fmax(worst, apart(answers[i].texel_direction, queries[i].direction));
        found[i] = answers[i].texel_direction[3];
        REQUIRE_NEAR(1 / found[i], 1 / room_distance_of(&queries[i], &lights[map]),
                     (reach + snapping(maps->size)) / wall + 1e-5 / found[i]);
    }
    print_message("look-ups, %s %d: directions within %.4f of their texels', %.4f allowed\n",
                  projection_names[maps->projection], maps->size, worst, reach);
    REQUIRE_CMP(worst, <=, reach + 1e-6);
    free(answers);
    irb_image_destroy(&image);
}

/* And the two projections agree within both footprints. */
static void test_look_ups(void **state)
{
    (void)state;
    enum { LIGHTS = 12, QUERIES = LIGHTS * 1000 };
    const int sizes[] = {8, 128};
    set_room(1);
    struct irb_scene *scene = make_room();
    struct fixture_light lights[LIGHTS];
    struct query *queries = malloc(QUERIES * sizeof *queries);
    double *found[PROJECTIONS];
    make_room_lights(lights, LIGHTS);
    make_queries(queries, QUERIES, lights, LIGHTS);
    for (int s = 0; s < 2; s++) {
        double reach = snapping(sizes[s]);
        for (int p = 0; p < PROJECTIONS; p++) {
            enum irb_raster_projection projection = (enum irb_raster_projection)p;
            struct irb_raster_maps *maps =
                render(scene, projection, sizes[s], lights, LIGHTS, 1e-3f);
            found[p] = malloc(QUERIES * sizeof *found[p]);
            check_look_ups(maps, lights, LIGHTS, queries, QUERIES, found[p]);
            reach += footprint(projection, sizes[s]);
            irb_raster_maps_destroy(maps);
        }
        for (int i = 0; i < QUERIES; i++)
            REQUIRE_NEAR(1 / found[0][i], 1 / found[1][i],
                         reach / nearest_wall(lights[i % LIGHTS].position) + 1e-5 / found[0][i]);
        free(found[0]);
        free(found[1]);
    }
    free(queries);
    irb_scene_destroy(scene);
}

/* ---- Objects ---- */

/* On triangle `t` of the scene, on its front. */
static void put_on_triangle(const struct raycast *cast, uint32_t t, struct fixture_light *light)
{
    double u[3], v[3], n[3], length;
    for (int i = 0; i < 3; i++) {
        const double(*c)[3] = (const double(*)[3])cast->corners[t];
        light->position[i] = (float)((c[0][i] + c[1][i] + c[2][i]) / 3);
        u[i] = c[1][i] - c[0][i];
        v[i] = c[2][i] - c[0][i];
    }
    raycast_cross(u, v, n);
    length = sqrt(raycast_dot(n, n));
    for (int i = 0; i < 3; i++)
        light->normal[i] = (float)(n[i] / length);
}

struct cast_from {
    const struct raycast *cast;
    double near;
};

static double distance_by_ray(const void *user, const float from[3], const double d[3])
{
    const struct cast_from *c = user;
    const double origin[3] = {from[0], from[1], from[2]};
    return raycast_nearest(c->cast, origin, d, c->near);
}

/* The Cornell box with sphere and knot, from lights in the air, on its walls, on the sphere and on
 * the knot, against rays through all of its triangles. Texels that differ show another surface: the
 * hemicube's at silhouettes within the grid of sub-pixels. */
static void test_objects(void **state)
{
    (void)state;
    enum { LIGHTS = 6, SIZE = 20 };
    struct irb_scene *scene = fixture_scene("cornell-objects");
    struct raycast cast;
    struct fixture_light lights[LIGHTS] = {
        {.position = {0.3f, 0.3f, 0.1f}, .normal = {0.6f, -0.64f, 0.48f}},
        {.position = {0.25f, 0.12f, 0.3f}, .normal = {0, 0.6f, -0.8f}},
    };
    const float near = 1e-3f;
    raycast_create(&cast, scene);
    put_on_triangle(&cast, 0, &lights[2]);
    put_on_triangle(&cast, 7, &lights[3]);
    put_on_triangle(&cast, 4000, &lights[4]);
    put_on_triangle(&cast, 20011, &lights[5]);
    for (int p = 0; p < PROJECTIONS; p++) {
        struct irb_raster_maps *maps =
            render(scene, (enum irb_raster_projection)p, SIZE, lights, LIGHTS, near);
        struct irb_image image = fixture_read(maps->distance, 1);
        struct comparison c = {0};
        for (int l = 0; l < LIGHTS; l++)
            compare_map(maps, &image, l, &lights[l], distance_by_ray,
                        &(struct cast_from){&cast, near}, &c);
        print_message("objects, %s: %d of %d texels show another surface; relative error of the "
                      "others up to %.2g\n",
                      projection_names[p], c.apart, c.texels, c.worst);
        REQUIRE_CMP(c.apart, <=, 2e-3 * c.texels);
        irb_image_destroy(&image);
        irb_raster_maps_destroy(maps);
    }
    raycast_destroy(&cast);
    irb_scene_destroy(scene);
}

/* Every texel of all lights that have a normal by rays; few may differ. */
static void check_by_rays(const struct irb_raster_maps *maps, const struct irb_scene *scene,
                          const struct fixture_light *lights, int count, double near)
{
    struct raycast cast;
    struct comparison c = {0};
    struct irb_image image = fixture_read(maps->distance, 1);
    raycast_create(&cast, scene);
    for (int l = 0; l < count; l++)
        if (fixture_dot(lights[l].normal, lights[l].normal) > 0)
            compare_map(maps, &image, l, &lights[l], distance_by_ray,
                        &(struct cast_from){&cast, near}, &c);
    REQUIRE_CMP(c.apart, <=, maps->projection == IRB_RASTER_HEMICUBE ? 1e-3 * c.texels : 0);
    raycast_destroy(&cast);
    irb_image_destroy(&image);
}

/* An object that is moved, turned and stretched, in maps that are used again. */
static void test_moving_object(void **state)
{
    (void)state;
    enum { LIGHTS = 4, SIZE = 48 };
    struct irb_error err = {0};
    const double corners[4][3] = {{0, 0, 0}, {0.5, 0, 0.1}, {0.5, 0.4, 0.1}, {0, 0.4, 0}};
    const double wall[4][3] = {{-2, -2, 2}, {2, -2, 2}, {2, 2, 2}, {-2, 2, 2}};
    struct irb_builder builder;
    irb_builder_begin(&builder, "moving");
    int material = irb_builder_material(&builder, "grey", grey);
    irb_builder_object(&builder, "wall", material);
    irb_builder_quad(&builder, wall);
    irb_builder_object(&builder, "moved", material);
    irb_builder_quad(&builder, corners);
    struct irb_scene *scene = irb_builder_finish(&builder, &err);
    REQUIRE_OK(scene);
    struct fixture_light lights[LIGHTS];
    uint64_t random = 3;
    memset(lights, 0, sizeof lights);
    for (int l = 0; l < LIGHTS; l++) {
        lights[l].position[2] = -1;
        lights[l].position[0] = 0.3f * (float)l;
        fixture_random_normal(&random, lights[l].normal);
        lights[l].normal[2] = fabsf(lights[l].normal[2]);
    }
    struct irb_virtual_lights view = fixture_lights(gl, lights, LIGHTS);
    struct irb_scene_gl *scene_gl = irb_scene_gl_create(gl, scene, &err);
    REQUIRE_OK(scene_gl);
    const float moved[16] = {0.6f, 0.8f, 0,  0, -1.6f, 1.2f,  0,    0,
                             0,    0,    -1, 0, 0.2f,  -0.3f, 0.5f, 1};
    for (int p = 0; p < PROJECTIONS; p++) {
        struct irb_raster_maps *maps =
            irb_raster_maps_create(gl, (enum irb_raster_projection)p, SIZE, LIGHTS, &err);
        REQUIRE_OK(maps);
        for (int pose = 0; pose < 2; pose++) {
            for (int i = 0; i < 16; i++)
                scene->objects[1].transform[i] = pose ? moved[i] : i % 5 == 0;
            REQUIRE_OK(irb_raster_maps_render(maps, scene_gl, &view, 0, LIGHTS, 1e-3f, &err));
            check_by_rays(maps, scene, lights, LIGHTS, 1e-3);
        }
        irb_raster_maps_destroy(maps);
    }
    irb_buffer_destroy((struct irb_buffer *)view.buffer);
    irb_scene_gl_destroy(scene_gl);
    irb_scene_destroy(scene);
}

/* A cloth whose vertices move. */
static void test_deforming_object(void **state)
{
    (void)state;
    enum { LIGHTS = 2, SIZE = 24 };
    struct irb_error err = {0};
    struct irb_scene *scene = fixture_scene("cornell-cloth");
    const struct fixture_light lights[LIGHTS] = {
        {.position = {0.3f, 0.001f, 0.2f}, .normal = {0, 1, 0}},
        {.position = {0.1f, 0.3f, 0.3f}, .normal = {0.96f, 0.28f, 0}},
    };
    struct irb_virtual_lights view = fixture_lights(gl, lights, LIGHTS);
    struct irb_scene_gl *scene_gl = irb_scene_gl_create(gl, scene, &err);
    REQUIRE_OK(scene_gl);
    REQUIRE_OK(irb_scene_animate(scene, 0.7, &err));
    assert_non_null(scene->deform);
    REQUIRE_OK(irb_scene_gl_update(scene_gl, &err));
    for (int p = 0; p < PROJECTIONS; p++) {
        struct irb_raster_maps *maps =
            irb_raster_maps_create(gl, (enum irb_raster_projection)p, SIZE, LIGHTS, &err);
        REQUIRE_OK(maps);
        REQUIRE_OK(irb_raster_maps_render(maps, scene_gl, &view, 0, LIGHTS, 1e-3f, &err));
        check_by_rays(maps, scene, lights, LIGHTS, 1e-3);
        irb_raster_maps_destroy(maps);
    }
    irb_buffer_destroy((struct irb_buffer *)view.buffer);
    irb_scene_gl_destroy(scene_gl);
    irb_scene_destroy(scene);
}

/* A tilted sheet whose left half is there and whose right half is cut away, before a wall. */
static struct irb_scene *make_masked(void)
{
    static const double corners[4][3] = {
        {-0.8, -0.7, 0.5}, {0.9, -0.6, 1.2}, {0.9, 0.8, 1.2}, {-0.8, 0.7, 0.5}};
    static const double texcoords[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    static const double wall[4][3] = {{-9, -9, 2}, {9, -9, 2}, {9, 9, 2}, {-9, 9, 2}};
    struct irb_error err = {0};
    struct irb_builder builder;
    unsigned char *image = malloc(4 * 4 * 4);
    for (int i = 0; i < 16; i++) {
        memset(image + 4 * i, 255, 4);
        image[4 * i + 3] = i % 4 < 2 ? 255 : 0;
    }
    irb_builder_begin(&builder, "masked");
    int sheet = irb_builder_material(&builder, "sheet", grey);
    int plain = irb_builder_material(&builder, "plain", grey);
    int texture = irb_builder_texture(&builder, "half", 4, 4, image);
    irb_builder_object(&builder, "sheet", sheet);
    for (int i = 0; i < 4; i++)
        irb_builder_vertex(&builder, corners[i], (const double[3]){0, 0, 1}, texcoords[i]);
    irb_builder_triangle(&builder, 0, 1, 2);
    irb_builder_triangle(&builder, 0, 2, 3);
    irb_builder_object(&builder, "wall", plain);
    irb_builder_quad(&builder, wall);
    struct irb_scene *scene = irb_builder_finish(&builder, &err);
    REQUIRE_OK(scene);
    scene->materials[sheet].diffuse_texture = texture;
    scene->materials[sheet].alpha_cutoff = 0.5f;
    return scene;
}

/* Where the sheet of make_masked() is met: alpha is bilinear and wraps, so that it reaches 1/2 for
 * texture coordinates s of 0 to 1/2. s is linear on each triangle; both share it along x. */
static double distance_to_masked(const void *user, const float from[3], const double d[3])
{
    const struct raycast *cast = user;
    const double origin[3] = {from[0], from[1], from[2]};
    double nearest = INFINITY;
    for (uint32_t t = 0; t < cast->count; t++) {
        double r = raycast_triangle((const double(*)[3])cast->corners[t], origin, d);
        double s = (origin[0] + r * d[0] + 0.8) / 1.7;
        if (r > 1e-3 && r < nearest && (t >= 2 || s <= 0.5))
            nearest = r;
    }
    return nearest;
}

static void test_alpha_mask(void **state)
{
    (void)state;
    enum { LIGHTS = 3, SIZE = 64 };
    const struct fixture_light lights[LIGHTS] = {
        {.position = {0, 0, -0.5f}, .normal = {0, 0, 1}},
        {.position = {0.2f, 0.1f, 0}, .normal = {0.6f, 0, 0.8f}},
        {.position = {-0.3f, 0, 1.5f}, .normal = {0, 0, -1}},
    };
    struct irb_scene *scene = make_masked();
    struct raycast cast;
    raycast_create(&cast, scene);
    for (int p = 0; p < PROJECTIONS; p++) {
        struct irb_raster_maps *maps =
            render(scene, (enum irb_raster_projection)p, SIZE, lights, LIGHTS, 1e-3f);
        struct irb_image image = fixture_read(maps->distance, 1);
        struct comparison c = {0};
        for (int l = 0; l < LIGHTS; l++)
            compare_map(maps, &image, l, &lights[l], distance_to_masked, &cast, &c);
        print_message("mask, %s: %d of %d texels differ\n", projection_names[p], c.apart, c.texels);
        REQUIRE_CMP(c.apart, <=, 1e-3 * c.texels);
        irb_image_destroy(&image);
        irb_raster_maps_destroy(maps);
    }
    raycast_destroy(&cast);
    irb_scene_destroy(scene);
}

/* ---- Layers, lights, refusals ---- */

static bool is_empty(const struct irb_raster_maps *maps, const struct irb_image *image, int map)
{
    for (int face = 0; face < maps->faces; face++)
        for (int y = 0; y < maps->size; y++)
            for (int x = 0; x < maps->size; x++)
                if (fixture_texel(maps, image, map, face, x, y) != INFINITY)
                    return false;
    return true;
}

/* Over a floor: lights that look down, up, and have no normal at all in turn. Only the first see
 * anything, and what they see does not reach into their neighbours' layers. Fewer lights than
 * before leave the rest empty; so does none. */
static void test_layers(void **state)
{
    (void)state;
    enum { LIGHTS = 30, SIZE = 16 };
    struct irb_error err = {0};
    struct irb_scene *scene = fixture_floor(50, grey);
    struct irb_scene_gl *scene_gl = irb_scene_gl_create(gl, scene, &err);
    struct fixture_light lights[LIGHTS];
    memset(lights, 0, sizeof lights);
    for (int l = 0; l < LIGHTS; l++) {
        lights[l].position[1] = 1 + 0.1f * (float)l;
        lights[l].normal[1] = l % 3 == 2 ? 0 : l % 3 == 1 ? 1 : -1;
    }
    struct irb_virtual_lights view = fixture_lights(gl, lights, LIGHTS);
    REQUIRE_OK(scene_gl);
    for (int p = 0; p < PROJECTIONS; p++) {
        struct irb_raster_maps *maps =
            irb_raster_maps_create(gl, (enum irb_raster_projection)p, SIZE, LIGHTS, &err);
        REQUIRE_OK(maps);
        static const int counts[] = {LIGHTS, 7, 0};
        for (int k = 0; k < 3; k++) {
            REQUIRE_OK(irb_raster_maps_render(maps, scene_gl, &view, 0, counts[k], 1e-3f, &err));
            struct irb_image image = fixture_read(maps->distance, 1);
            assert_int_equal(maps->count, counts[k]);
            for (int l = 0; l < LIGHTS; l++)
                assert_int_equal(is_empty(maps, &image, l), l >= counts[k] || l % 3 != 0);
            irb_image_destroy(&image);
            if (k == 0)
                check_by_rays(maps, scene, lights, LIGHTS, 1e-3);
        }
        irb_raster_maps_destroy(maps);
    }
    irb_buffer_destroy((struct irb_buffer *)view.buffer);
    irb_scene_gl_destroy(scene_gl);
    irb_scene_destroy(scene);
}

/* Lights in parts, from the middle and over the end of a block of lights, give the same bits as all
 * at once. */
static void test_batches(void **state)
{
    (void)state;
    enum { LIGHTS = IRB_VPL_BLOCK + 10, FIRST = IRB_VPL_BLOCK - 14, TOGETHER = 24, PART = 9 };
    enum { SIZE = 16 };
    struct irb_error err = {0};
    set_room(1);
    struct irb_scene *scene = make_room();
    struct irb_scene_gl *scene_gl = irb_scene_gl_create(gl, scene, &err);
    struct fixture_light *lights = malloc(LIGHTS * sizeof *lights);
    make_room_lights(lights, LIGHTS);
    struct irb_virtual_lights all = fixture_lights(gl, lights, LIGHTS);
    struct irb_virtual_lights some = fixture_lights(gl, lights + FIRST, TOGETHER);
    REQUIRE_OK(scene_gl);
    for (int p = 0; p < PROJECTIONS; p++) {
        enum irb_raster_projection projection = (enum irb_raster_projection)p;
        struct irb_raster_maps *whole =
            irb_raster_maps_create(gl, projection, SIZE, TOGETHER, &err);
        struct irb_raster_maps *part = irb_raster_maps_create(gl, projection, SIZE, PART, &err);
        REQUIRE_OK(whole && part);
        REQUIRE_OK(irb_raster_maps_render(whole, scene_gl, &some, 0, TOGETHER, 1e-3f, &err));
        struct irb_image expected = fixture_read(whole->distance, 1);
        const size_t map = (size_t)(whole->faces * SIZE * SIZE);
        for (int first = 0; first < TOGETHER; first += PART) {
            int count = TOGETHER - first < PART ? TOGETHER - first : PART;
            REQUIRE_OK(
                irb_raster_maps_render(part, scene_gl, &all, FIRST + first, count, 1e-3f, &err));
            struct irb_image found = fixture_read(part->distance, 1);
            assert_memory_equal(found.data, expected.data + (size_t)first * map,
                                (size_t)count * map * sizeof(float));
            irb_image_destroy(&found);
        }
        irb_image_destroy(&expected);
        irb_raster_maps_destroy(whole);
        irb_raster_maps_destroy(part);
    }
    irb_buffer_destroy((struct irb_buffer *)all.buffer);
    irb_buffer_destroy((struct irb_buffer *)some.buffer);
    free(lights);
    irb_scene_gl_destroy(scene_gl);
    irb_scene_destroy(scene);
}

static const double near_cut = 0.7; /* m */

static double distance_beyond_cut(const void *user, const float from[3], const double d[3])
{
    (void)user;
    double r = room_distance(from, d);
    return r >= near_cut ? r : INFINITY;
}

/* Nearer surfaces than `near` are left out, and 0 stands for a little. */
static void test_near(void **state)
{
    (void)state;
    enum { LIGHTS = 24, SIZE = 32 };
    set_room(1);
    struct irb_scene *scene = make_room();
    struct fixture_light lights[LIGHTS];
    make_room_lights(lights, LIGHTS);
    for (int p = 0; p < PROJECTIONS; p++)
        for (int cut = 0; cut < 2; cut++) {
            struct irb_raster_maps *maps = render(scene, (enum irb_raster_projection)p, SIZE,
                                                  lights, LIGHTS, cut ? (float)near_cut : 0);
            struct irb_image image = fixture_read(maps->distance, 1);
            struct comparison c = {0};
            for (int l = 0; l < LIGHTS; l++)
                compare_map(maps, &image, l, &lights[l],
                            cut ? distance_beyond_cut : distance_in_room, NULL, &c);
            REQUIRE_CMP(c.apart, <=, 1e-4 * c.texels);
            irb_image_destroy(&image);
            irb_raster_maps_destroy(maps);
        }
    irb_scene_destroy(scene);
}

/* Lights on a corner of a triangle, on an edge, in the plane of one that is seen edge-on; triangles
 * without area. No NaN, nothing nearer than `near`, and what is seen is what rays find. */
static void test_degenerate(void **state)
{
    (void)state;
    struct irb_error err = {0};
    const double wall[4][3] = {{-1, -1, 2}, {1, -1, 2}, {1, 1, 2}, {-1, 1, 2}};
    const double fin[4][3] = {{0, -1, 0}, {0, 1, 0}, {0, 1, 1}, {0, -1, 1}};
    const double line[4][3] = {{0.2, 0, 1}, {0.6, 0, 1}, {0.6, 0, 1}, {0.2, 0, 1}};
    const struct fixture_light lights[] = {
        {.position = {0, -1, 0}, .normal = {0, 0.6f, 0.8f}},
        {.position = {0, 0.5f, 0}, .normal = {0, 0, 1}},
        {.position = {0, 0.25f, -0.5f}, .normal = {0, 0, 1}},
        {.position = {0.5f, 0, 1}, .normal = {0, 0, 1}},
        {.position = {-1, -1, 2}, .normal = {0.6f, 0, -0.8f}},
        {.position = {0.25f, 0.1f, 2}, .normal = {0, 0, 1}},
    };
    enum { LIGHTS = sizeof lights / sizeof *lights };
    struct irb_builder builder;
    irb_builder_begin(&builder, "degenerate");
    irb_builder_object(&builder, "all", irb_builder_material(&builder, "grey", grey));
    irb_builder_quad(&builder, wall);
    irb_builder_quad(&builder, fin);
    irb_builder_quad(&builder, line);
    struct irb_scene *scene = irb_builder_finish(&builder, &err);
    REQUIRE_OK(scene);
    for (int p = 0; p < PROJECTIONS; p++) {
        struct irb_raster_maps *maps =
            render(scene, (enum irb_raster_projection)p, 32, lights, LIGHTS, 1e-3f);
        struct irb_image image = fixture_read(maps->distance, 1);
        for (size_t i = 0; i < irb_image_pixels(&image); i++)
            assert_true(image.data[i] >= 1e-3f);
        check_by_rays(maps, scene, lights, LIGHTS, 1e-3);
        irb_image_destroy(&image);
        irb_raster_maps_destroy(maps);
    }
    irb_scene_destroy(scene);
}

static void test_refusals(void **state)
{
    (void)state;
    struct irb_error err = {0};
    assert_null(irb_raster_maps_create(gl, IRB_RASTER_HEMICUBE, 7, 1, &err));
    assert_int_equal(err.code, IRB_E_INPUT);
    REQUIRE_CONTAINS(err.message, "even size");
    assert_null(irb_raster_maps_create(gl, IRB_RASTER_HEMICUBE, 0, 1, &err));
    assert_null(irb_raster_maps_create(gl, IRB_RASTER_PARABOLOID, 16, 0, &err));
    for (int p = 0; p < PROJECTIONS; p++) {
        enum irb_raster_projection projection = (enum irb_raster_projection)p;
        int most = irb_raster_maps_most(gl, projection, 128);
        int64_t bytes = (int64_t)most * 128 * 128 * 4 * (p ? 1 : 3);
        REQUIRE_CMP(most, >=, 500);
        REQUIRE_CMP(bytes, <=, 256 << 20);
        assert_null(irb_raster_maps_create(gl, projection, 128, most + 1, &err));
        assert_int_equal(err.code, IRB_E_INPUT);
        REQUIRE_CMP(irb_raster_maps_most(gl, projection, 16384), ==, 1);
    }
    struct irb_scene *scene = fixture_floor(1, grey);
    struct irb_scene_gl *scene_gl = irb_scene_gl_create(gl, scene, &err);
    struct irb_raster_maps *maps = irb_raster_maps_create(gl, IRB_RASTER_HEMICUBE, 2, 4, &err);
    struct irb_virtual_lights view = fixture_lights(gl, NULL, 0);
    REQUIRE_OK(scene_gl && maps);
    view.count = 5;
    static const int ranges[][2] = {{-1, 1}, {0, 5}, {3, 3}, {0, -1}, {6, 0}};
    for (int i = 0; i < 5; i++) {
        err.code = IRB_E_OK;
        assert_false(
            irb_raster_maps_render(maps, scene_gl, &view, ranges[i][0], ranges[i][1], 1e-3f, &err));
        assert_int_equal(err.code, IRB_E_INTERNAL);
    }
    irb_buffer_destroy((struct irb_buffer *)view.buffer);
    irb_raster_maps_destroy(maps);
    irb_scene_gl_destroy(scene_gl);
    irb_scene_destroy(scene);
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), argc > 2 ? argv[2] : NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_room),
        cmocka_unit_test(test_look_ups),
        cmocka_unit_test(test_objects),
        cmocka_unit_test(test_moving_object),
        cmocka_unit_test(test_deforming_object),
        cmocka_unit_test(test_alpha_mask),
        cmocka_unit_test(test_layers),
        cmocka_unit_test(test_batches),
        cmocka_unit_test(test_near),
        cmocka_unit_test(test_degenerate),
        cmocka_unit_test(test_refusals),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failed;
}
