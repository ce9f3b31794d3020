/* SPDX-License-Identifier: MIT
 *
 * Scenes whose indirect light has a closed form.
 */
#include "core/scene/builtin/geometry.h"

/* The same in every channel; 1/2 keeps later bounces well above rounding. */
static const float half_grey[3] = {0.5f, 0.5f, 0.5f};

/* Inscribed in the unit sphere: its area is 3e-5 below 4 pi. */
struct irb_scene *irb_build_sphere(struct irb_error *err)
{
    static const double origin[3] = {0, 0, 0};
    struct irb_builder builder;

    irb_builder_begin(&builder, "sphere");
    irb_builder_object(&builder, "sphere", irb_builder_material(&builder, "grey", half_grey));
    irb_builder_sphere(&builder, origin, 1, 512, 256, true);
    return irb_builder_finish(&builder, err);
}

/* y = 0 and y = 1 over [-1/2, 1/2]^2, facing each other. */
struct irb_scene *irb_build_squares(struct irb_error *err)
{
    static const double lower[4][3] = {
        {-0.5, 0, 0.5}, {0.5, 0, 0.5}, {0.5, 0, -0.5}, {-0.5, 0, -0.5}};
    static const double upper[4][3] = {
        {-0.5, 1, -0.5}, {0.5, 1, -0.5}, {0.5, 1, 0.5}, {-0.5, 1, 0.5}};
    struct irb_builder builder;
    int grey;

    irb_builder_begin(&builder, "squares");
    grey = irb_builder_material(&builder, "grey", half_grey);
    irb_builder_object(&builder, "lower", grey);
    irb_builder_quad(&builder, lower);
    irb_builder_object(&builder, "upper", grey);
    irb_builder_quad(&builder, upper);
    return irb_builder_finish(&builder, err);
}

/* [0,1]^3 seen from inside. */
struct irb_scene *irb_build_furnace(struct irb_error *err)
{
    static const double faces[6][4][3] = {
        {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}, /* y = 0 */
        {{0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}}, /* y = 1 */
        {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}, /* x = 0 */
        {{1, 0, 0}, {1, 0, 1}, {1, 1, 1}, {1, 1, 0}}, /* x = 1 */
        {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, /* z = 0 */
        {{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}, /* z = 1 */
    };
    struct irb_builder builder;

    irb_builder_begin(&builder, "furnace");
    irb_builder_object(&builder, "cube", irb_builder_material(&builder, "grey", half_grey));
    for (int face = 0; face < 6; face++)
        irb_builder_quad(&builder, faces[face]);
    return irb_builder_finish(&builder, err);
}
