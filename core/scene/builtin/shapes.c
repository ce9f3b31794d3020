/* SPDX-License-Identifier: MIT */
#include "core/scene/builtin/geometry.h"

#include "core/scene/vec.h"

/* ---- Sphere ---- */

struct sphere {
    const double *centre;
    double radius;
    int slices, stacks;
    bool inwards;
    uint32_t first_vertex; /* the +y pole; then stacks - 1 rings; then the -y pole */
};

static void sphere_vertex(struct irb_builder *builder, const struct sphere *sphere, double theta,
                          double phi)
{
    const double outward[3] = {sin(theta) * cos(phi), cos(theta), sin(theta) * sin(phi)};
    double position[3], normal[3];

    for (int i = 0; i < 3; i++) {
        position[i] = sphere->centre[i] + sphere->radius * outward[i];
        normal[i] = sphere->inwards ? -outward[i] : outward[i];
    }
    irb_builder_vertex(builder, position, normal, NULL);
}

/* a, b, c run counter-clockwise seen from outside. */
static void sphere_triangle(struct irb_builder *builder, const struct sphere *sphere, uint32_t a,
                            uint32_t b, uint32_t c)
{
    a += sphere->first_vertex;
    b += sphere->first_vertex;
    c += sphere->first_vertex;
    irb_builder_triangle(builder, a, sphere->inwards ? c : b, sphere->inwards ? b : c);
}

static void sphere_triangles(struct irb_builder *builder, const struct sphere *sphere)
{
    uint32_t slices = (uint32_t)sphere->slices, rings = (uint32_t)sphere->stacks - 1;
    uint32_t south = 1 + rings * slices;

    for (uint32_t s = 0; s < slices; s++) {
        uint32_t next = (s + 1) % slices;

        sphere_triangle(builder, sphere, 0, 1 + next, 1 + s);
        for (uint32_t r = 0; r + 1 < rings; r++) {
            uint32_t upper = 1 + r * slices, lower = upper + slices;

            sphere_triangle(builder, sphere, upper + s, upper + next, lower + next);
            sphere_triangle(builder, sphere, upper + s, lower + next, lower + s);
        }
        sphere_triangle(builder, sphere, south, south - slices + s, south - slices + next);
    }
}

void irb_builder_sphere(struct irb_builder *builder, const double centre[3], double radius,
                        int slices, int stacks, bool inwards)
{
    struct sphere sphere = {centre, radius, slices, stacks, inwards, 0};

    if (builder->failure)
        return;
    sphere.first_vertex = builder->scene->vertex_count;
    sphere_vertex(builder, &sphere, 0, 0);
    for (int r = 1; r < stacks; r++)
        for (int s = 0; s < slices; s++)
            sphere_vertex(builder, &sphere, M_PI * r / stacks, 2 * M_PI * s / slices);
    sphere_vertex(builder, &sphere, M_PI, 0);
    sphere_triangles(builder, &sphere);
}

/* ---- Torus knot ---- */

/* On the torus with ring radius 2 and tube radius 1 the (2,3) knot's strands keep about 2 apart, so
 * a tube of up to 0.66 never meets itself. */
#define KNOT_RING 2.0
#define KNOT_TUBE 0.55
#define KNOT_RELIEF 0.2 /* share of the tube radius by which the strands stand out */
#define KNOT_STRANDS 4  /* around the tube */
#define KNOT_TWISTS 28  /* turns of the strands along the knot; whole, so that the ends meet */

/* The knot with the ring's axis along z: parameter t along, phi around, both in [0, 2 pi). */
static void knot_point(double t, double phi, double out[3])
{
    /* torus angles 2t around the ring and 3t around its tube; `side` is normal to the torus and so
     * to the curve, and periodic, which a Frenet frame would not be at inflections */
    const double radius = KNOT_RING + cos(3 * t);
    const double point[3] = {radius * cos(2 * t), radius * sin(2 * t), sin(3 * t)};
    const double side[3] = {cos(3 * t) * cos(2 * t), cos(3 * t) * sin(2 * t), sin(3 * t)};
    double tangent[3] = {-3 * sin(3 * t) * cos(2 * t) - 2 * radius * sin(2 * t),
                         -3 * sin(3 * t) * sin(2 * t) + 2 * radius * cos(2 * t), 3 * cos(3 * t)};
    double other[3];
    double tube = KNOT_TUBE * (1 + KNOT_RELIEF * cos(KNOT_STRANDS * phi + KNOT_TWISTS * t));

    vec_normalize(tangent);
    vec_cross(tangent, side, other);
    for (int i = 0; i < 3; i++)
        out[i] = point[i] + tube * (cos(phi) * side[i] + sin(phi) * other[i]);
}

static void knot_triangles(struct irb_builder *builder, uint32_t first, uint32_t along,
                           uint32_t around)
{
    for (uint32_t i = 0; i < along; i++) {
        uint32_t here = first + i * around, next = first + (i + 1) % along * around;

        for (uint32_t j = 0; j < around; j++) {
            uint32_t k = (j + 1) % around;

            irb_builder_triangle(builder, here + j, here + k, next + k);
            irb_builder_triangle(builder, here + j, next + k, next + j);
        }
    }
}

void irb_builder_knot(struct irb_builder *builder, const double foot[3], double height, int along,
                      int around)
{
    static const double none[3] = {0, 0, 0};
    double low = INFINITY, high = -INFINITY;
    uint32_t first_vertex, first_triangle;

    if (builder->failure)
        return;
    first_vertex = builder->scene->vertex_count;
    first_triangle = builder->scene->triangle_count;
    for (int pass = 0; pass < 2; pass++) { /* the extent first, then the vertices */
        double scale = height / (high - low);

        for (int i = 0; i < along; i++) {
            for (int j = 0; j < around; j++) {
                double p[3], placed[3];

                knot_point(2 * M_PI * i / along, 2 * M_PI * j / around, p);
                if (pass == 0) {
                    low = fmin(low, p[1]);
                    high = fmax(high, p[1]);
                    continue;
                }
                placed[0] = foot[0] + scale * p[0];
                placed[1] = foot[1] + scale * (p[1] - low);
                placed[2] = foot[2] + scale * p[2];
                irb_builder_vertex(builder, placed, none, NULL);
            }
        }
    }
    knot_triangles(builder, first_vertex, (uint32_t)along, (uint32_t)around);
    irb_builder_smooth_normals(builder, first_vertex, first_triangle, false);
}
