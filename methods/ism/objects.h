/* SPDX-License-Identifier: MIT
 *
 * What imperfect shadow maps keep between frames: nothing but objects of the sizes that the
 * parameters ask for, which may change from frame to frame.
 */
#ifndef IRB_METHODS_ISM_OBJECTS_H
#define IRB_METHODS_ISM_OBJECTS_H

#include "core/lights/importance.h"
#include "core/lights/ism_lighting.h"
#include "core/lights/vpl.h"
#include "methods/ism/params.h"

struct ism_objects {
    struct irb_gl *gl;              /* borrowed */
    int width, height;              /* of the image */
    struct irb_texture *irradiance; /* RGBA32F: W/m2; share of light in shadow */
    struct irb_vpl_set *lights;
    struct irb_importance *importance; /* with its pyramid: bidirectional only */
    struct irb_pyramid *pyramid;
    int rsm_resolution;               /* that the three above are made for */
    struct irb_ism_lighting lighting; /* without points for dynamic ones */
    float *weights;                   /* of adaptive points, a float a triangle; or NULL */
    struct irb_raster_maps *raster;   /* NULL until there are to be some */
};

/* NULL on failure. */
struct ism_objects *ism_objects_create(struct irb_gl *gl, int width, int height,
                                       struct irb_error *err);
void ism_objects_destroy(struct ism_objects *objects);
bool ism_objects_resize(struct ism_objects *objects, int width, int height, struct irb_error *err);

/* Makes what the parameters and the RSM's resolution ask for and is not there, but for the points.
 */
bool ism_objects_prepare(struct ism_objects *objects, const struct ism_params *params,
                         const struct irb_scene_gl *scene, int rsm_resolution,
                         struct irb_error *err);
/* Likewise the points. `seed`: of area points. Adaptive ones are made anew for the lights as they
 * are. */
bool ism_objects_prepare_points(struct ism_objects *objects, const struct ism_params *params,
                                const struct irb_scene_gl *scene, uint64_t seed,
                                struct irb_error *err);

#endif
