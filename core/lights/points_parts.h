/* SPDX-License-Identifier: MIT
 *
 * The two ways to make points. Private to core/lights.
 */
#ifndef IRB_LIGHTS_POINTS_PARTS_H
#define IRB_LIGHTS_POINTS_PARTS_H

#include "core/lights/points.h"

/* Where points go: nowhere (points is NULL: they are counted, before alpha masks), or to the end of
 * an array with room for `most`, but for those that an alpha mask cuts away. */
struct irb_points_sink {
    struct irb_point *points;
    uint64_t count, most;
};

static inline bool irb_points_sink_is_over(const struct irb_points_sink *sink)
{
    return sink->count > sink->most;
}

/* Algorithm 5.2 over all triangles of all objects; stops once the sink is over. density: NULL, or a
 * float a triangle that gets its points before alpha masks. IRB_E_MEMORY. */
bool irb_points_tessellate(const struct irb_scene *scene, const struct irb_points_desc *desc,
                           struct irb_points_sink *sink, float *density, struct irb_error *err);
/* About how many points that would be, from the mean step along a row. */
double irb_points_tessellate_estimate(const struct irb_scene *scene,
                                      const struct irb_points_desc *desc);

/* What AREA draws a triangle in proportion to; 0 without area. */
double irb_points_weight(const struct irb_scene *scene, const struct irb_points_desc *desc,
                         uint32_t triangle);
/* sink->most random points, and their density. IRB_E_MEMORY. */
bool irb_points_draw(const struct irb_scene *scene, const struct irb_points_desc *desc,
                     struct irb_points_sink *sink, float *density, struct irb_error *err);

#endif
