/* SPDX-License-Identifier: MIT
 *
 * The polygon's form factor against closed forms for rectangles (Howell, A Catalog of Radiation
 * Heat Transfer Configuration Factors, B-3 and B-4) and against quadrature over random hulls, part
 * of them below the receiver's horizon.
 *
 *     test_polygon BACKEND SHADERS     SHADERS: tests/lights/shaders
 */
#include "tests/support/compare.h"
#include "core/gl/objects.h"
#include "core/gl/program.h"
#include "tests/gl/fixture.h"

static struct irb_gl *gl;

enum { CORNERS = 8, MOST_CASES = 512 };

struct vec {
    float x, y, z, w;
};

struct polygon_case {
    struct vec at, normal, corner[CORNERS];
};

static void evaluate(const struct polygon_case *cases, int count, float *out)
{
    struct irb_error err = {0};
    const int64_t bytes = count * (int64_t)sizeof *cases;
    struct irb_program *program = irb_program_create(
        gl, &(struct irb_program_desc){.name = "polygon", .compute = "test_polygon.comp"}, &err);
    struct irb_buffer *in = irb_buffer_create(gl, "cases", bytes, cases, &err);
    struct irb_buffer *factors = irb_buffer_create(gl, "factors", count * (int64_t)4, NULL, &err);
    REQUIRE_OK(program && in && factors);
    irb_program_use(program);
    irb_program_uint(program, "count", (unsigned)count);
    gl->api.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, in->id);
    gl->api.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, factors->id);
    gl->api.DispatchCompute((unsigned)(count + 63) / 64, 1, 1);
    REQUIRE_OK(irb_buffer_read(factors, 0, count * (int64_t)4, out, &err));
    irb_program_destroy(program);
    irb_buffer_destroy(in);
    irb_buffer_destroy(factors);
}

/* A rectangle's 4 corners, and 4 more that repeat the last: edges without length add nothing. */
static void set_rectangle(struct polygon_case *c, const struct vec corner[4])
{
    for (int i = 0; i < CORNERS; i++)
        c->corner[i] = corner[i < 3 ? i : 3];
}

/* B-3: element below a corner of an a x b rectangle that faces it at distance c. */
static double parallel_corner(double a, double b, double c)
{
    const double x = a / c, y = b / c, p = sqrt(1 + x * x), q = sqrt(1 + y * y);
    return (x / p * atan(y / p) + y / q * atan(x / q)) / (2 * M_PI);
}

static void test_parallel_square(void **state)
{
    (void)state;
    const double halves[] = {1e-4, 0.01, 0.3, 1, 5, 100, 1e4}, distance = 0.7;
    struct polygon_case cases[7];
    float found[7];
    for (int i = 0; i < 7; i++) {
        const float h = (float)halves[i], z = (float)distance;
        cases[i].at = (struct vec){0};
        cases[i].normal = (struct vec){.z = 1};
        /* faces down: counter-clockwise from below */
        set_rectangle(&cases[i], (const struct vec[]){
                                     {-h, -h, z, 0}, {-h, h, z, 0}, {h, h, z, 0}, {h, -h, z, 0}});
    }
    evaluate(cases, 7, found);
    for (int i = 0; i < 7; i++)
        REQUIRE_REL(found[i], 4 * parallel_corner(halves[i], halves[i], distance), 1e-5);
}

/* B-4: element on the floor, a rectangle upright at distance c, b wide from the foot of the
 * perpendicular, a high. What lies below the floor (`sunk`) makes no difference. */
static void test_perpendicular_rectangle(void **state)
{
    (void)state;
    enum { SIZES = 6 };
    const double sizes[SIZES][3] = {{1, 1, 1},     {0.2, 0.2, 1},   {3, 0.5, 0.25},
                                    {0.1, 4, 0.5}, {1e3, 1e3, 0.1}, {0.01, 0.01, 2}};
    const float sunk[] = {0, 0.3f, 50};
    struct polygon_case cases[3 * SIZES];
    float found[3 * SIZES];
    for (int i = 0; i < 3 * SIZES; i++) {
        const float a = (float)sizes[i / 3][0], b = (float)sizes[i / 3][1];
        const float c = (float)sizes[i / 3][2], s = -sunk[i % 3];
        cases[i].at = (struct vec){0};
        cases[i].normal = (struct vec){.z = 1};
        set_rectangle(&cases[i],
                      (const struct vec[]){{c, 0, s, 0}, {c, 0, a, 0}, {c, b, a, 0}, {c, b, s, 0}});
    }
    evaluate(cases, 3 * SIZES, found);
    for (int i = 0; i < 3 * SIZES; i++) {
        const double a = sizes[i / 3][0], b = sizes[i / 3][1], c = sizes[i / 3][2];
        const double q = hypot(a, c);
        REQUIRE_NEAR(found[i], (atan(b / c) - c / q * atan(b / q)) / (2 * M_PI),
                     1e-4 * found[i] + 3e-7);
    }
}

static double random_in(uint32_t *x, double low, double high)
{
    *x ^= *x << 13;
    *x ^= *x >> 17;
    *x ^= *x << 5;
    return low + (high - low) * (*x / 4294967296.0);
}

static void random_unit(uint32_t *seed, double out[3])
{
    double length;
    do {
        length = 0;
        for (int i = 0; i < 3; i++) {
            out[i] = random_in(seed, -1, 1);
            length += out[i] * out[i];
        }
    } while (length > 1 || length < 0.01);
    for (int i = 0; i < 3; i++)
        out[i] /= sqrt(length);
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* Corners on an ellipse round the origin at growing angles, in the plane across n. */
static void random_hull(uint32_t *seed, struct polygon_case *c, double n[3])
{
    double t[3], b[3], helper[3] = {0}, angle[CORNERS], all = 0;
    random_unit(seed, n);
    helper[fabs(n[0]) < 0.7 ? 0 : 1] = 1;
    cross(n, helper, t);
    const double length = sqrt(dot(t, t)), stretch = random_in(seed, 0.1, 1);
    for (int i = 0; i < 3; i++)
        t[i] /= length;
    cross(n, t, b);
    for (int i = 0; i < CORNERS; i++)
        angle[i] = all += random_in(seed, 0.02, 1);
    for (int i = 0; i < CORNERS; i++) {
        const double a = 2 * M_PI * angle[i] / all, u = cos(a), v = stretch * sin(a);
        c->corner[i] = (struct vec){(float)(u * t[0] + v * b[0]), (float)(u * t[1] + v * b[1]),
                                    (float)(u * t[2] + v * b[2]), 0};
    }
}

static void corner_at(const struct polygon_case *c, int i, double out[3])
{
    const struct vec *v = &c->corner[i];
    out[0] = v->x;
    out[1] = v->y;
    out[2] = v->z;
}

/* cos cos/(pi r^2) at a point of the polygon. */
static double kernel(const struct polygon_case *c, const double y[3], const double n_y[3])
{
    const double d[3] = {y[0] - c->at.x, y[1] - c->at.y, y[2] - c->at.z};
    const double n_x[3] = {c->normal.x, c->normal.y, c->normal.z}, r2 = dot(d, d);
    return fmax(0, dot(n_x, d)) * fmax(0, -dot(n_y, d)) / (M_PI * r2 * r2);
}

/* Midpoint rule over `steps`^2 parts of each triangle of the fan. */
static double quadrature(const struct polygon_case *c, const double n_y[3], int steps)
{
    double sum = 0, o[3], p[3], q[3], pq[3];
    corner_at(c, 0, o);
    for (int k = 1; k + 1 < CORNERS; k++) {
        corner_at(c, k, p);
        corner_at(c, k + 1, q);
        for (int i = 0; i < 3; i++) {
            p[i] -= o[i];
            q[i] -= o[i];
        }
        cross(p, q, pq);
        const double part = 0.5 * sqrt(dot(pq, pq)) / ((double)steps * steps);
        for (int i = 0; i < steps; i++)
            for (int j = 0; j < 2 * (steps - i) - 1; j++) {
                /* upright parts at even j, those between at odd j */
                double u = (i + (j % 2 ? 2 / 3.0 : 1 / 3.0)) / steps;
                double v = (j / 2 + (j % 2 ? 2 / 3.0 : 1 / 3.0)) / steps, y[3];
                for (int m = 0; m < 3; m++)
                    y[m] = o[m] + u * p[m] + v * q[m];
                sum += part * kernel(c, y, n_y);
            }
    }
    return sum;
}

/* Receivers 0.3 to 30 away in all directions; those behind get 0. The quadrature of half the step
 * tells its own error. */
static void test_random_hulls(void **state)
{
    (void)state;
    static struct polygon_case cases[MOST_CASES];
    static double front[MOST_CASES][3];
    float found[MOST_CASES];
    uint32_t seed = 12345;
    int clipped = 0;
    double worst = 0;
    for (int i = 0; i < MOST_CASES; i++) {
        double n[3], to[3], away = 0.3 * pow(100, random_in(&seed, 0, 1));
        random_hull(&seed, &cases[i], front[i]);
        random_unit(&seed, to);
        random_unit(&seed, n);
        /* 0.3 along the front's normal too: no receiver is in the polygon; one in four may be
         * behind it */
        const double side = copysign(1, dot(to, front[i])), turn = i % 4 ? side : 1;
        for (int m = 0; m < 3; m++)
            to[m] = turn * (away * to[m] + 0.3 * side * front[i][m]);
        cases[i].at = (struct vec){(float)to[0], (float)to[1], (float)to[2], 0};
        cases[i].normal = (struct vec){(float)n[0], (float)n[1], (float)n[2], 0};
    }
    evaluate(cases, MOST_CASES, found);
    for (int i = 0; i < MOST_CASES; i++) {
        const double coarse = quadrature(&cases[i], front[i], 48);
        const double fine = quadrature(&cases[i], front[i], 96);
        const double own = fabs(fine - coarse);
        int below = 0;
        for (int k = 0; k < CORNERS; k++) {
            double v[3], n[3] = {cases[i].normal.x, cases[i].normal.y, cases[i].normal.z};
            corner_at(&cases[i], k, v);
            v[0] -= cases[i].at.x, v[1] -= cases[i].at.y, v[2] -= cases[i].at.z;
            below += dot(n, v) <= 0;
        }
        clipped += below > 0 && below < CORNERS && fine > 0;
        REQUIRE_CMP(own, <, 1e-4);
        REQUIRE_NEAR(found[i], fine, 1e-4 * fine + 2 * own + 1e-7);
        worst = fmax(worst, fabs(found[i] - fine));
    }
    print_message("largest difference %.2g; %d hulls cut by the horizon\n", worst, clipped);
    REQUIRE_CMP(clipped, >, 50);
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), argc > 2 ? argv[2] : NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_parallel_square),
        cmocka_unit_test(test_perpendicular_rectangle),
        cmocka_unit_test(test_random_hulls),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failed;
}
