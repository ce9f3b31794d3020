/* SPDX-License-Identifier: MIT
 *
 * Irradiance from virtual lights with visibility, over the split G-buffer (thesis 5.3.3):
 *
 *     E(x) = sum Phi F V,  F = cos_x cos_y / (pi r^2 + A)   (eq. 5.5)
 *
 * or, of lights that are polygons, the exact form factor over A (Prutkin et al. 2012, section 5;
 * shaders/lights/polygon_form_factor.glsl). A polygon's shadow is that of a disc of its area.
 *
 * V is 1, or comes from the light's shadow map: of its centre (Ritschel et al. 2008), or of its
 * disc by percentage-closer soft shadows in paraboloid space (Fernando 2005; thesis 3.1.1), whose
 * geometry is in shaders/lights/pcss.glsl.
 *
 * A surface that a map holds, d away from the light, shadows a receiver at distance r where
 *
 *     d + offset < (1 - bias) r
 *
 * and where, at the centre of the texel that holds it, it also lies before the receiver's tangent
 * plane, by the same margins and by what that plane's distance changes over `slope` texels of the
 * map in both its directions (shaders/lights/shadow_test.glsl). So a plane does not shadow itself
 * at any angle, nor does a wide filter ask for a wider bias.
 *
 * `slope` is how far from a texel's centre the surface may have been sampled: half the side of a
 * splat for imperfect maps, and what pull-push adds to it; 0 for maps that are exact at the
 * centres. `bias` and `offset` are for what else is imprecise. In the coloured box (128 lights,
 * maps of 128 x 128 texels, 0.2 and 1 M points, bias 0.01) a slope of 2.5 comes within 2 to 6 % rms
 * of exact maps, a slope of 0 within 11 to 43 %.
 *
 * Does not: make shadow maps, or apply albedo.
 */
#ifndef IRB_LIGHTS_SHADE_H
#define IRB_LIGHTS_SHADE_H

#include "core/frame/interleave.h"
#include "core/gl/timer.h"
#include "core/lights/ism.h"
#include "core/lights/raster_maps.h"
#include "core/lights/shadow_kernel.h"
#include "core/lights/virtual_light.h"

enum irb_shade_visibility {
    IRB_SHADE_NONE,   /* V = 1 */
    IRB_SHADE_BINARY, /* of the light's centre: one texel */
    IRB_SHADE_PCSS,   /* of its disc; of its centre where A = 0 */
    IRB_SHADE_RASTER, /* of its centre, in rasterised maps: by irb_shade_run_raster() or in batches
                       */
};

struct irb_shade_settings {
    int visibility;     /* enum irb_shade_visibility */
    float bias;         /* share of the distance, [0,1) */
    float slope;        /* texels */
    float offset;       /* m */
    int taps;           /* PCSS: of the filter, 1..IRB_SHADOW_TAPS_MOST; thesis: 16 */
    int blocker_taps;   /* PCSS: of the blocker search, likewise */
    float search_scale; /* PCSS: radius of the blocker search, in radii R = sqrt(A/pi) of the light
                           at the receiver's distance; s finds all blockers from 1/(1 + s) of the
                           way on. Penumbrae are cut at it */
    float penumbra_scale;   /* PCSS: factor of eq. 3.2; 1 = a uniform disc of area A */
    bool point_form_factor; /* F with A = 0, where the light is an area light too */
    float bound;            /* largest pi F (1/m2); 0: none. As a point light's cos_x cos_y / r^2 */
};

struct irb_shade;

struct irb_shade *irb_shade_create(struct irb_gl *gl, struct irb_error *err);
void irb_shade_destroy(struct irb_shade *shade);

/* Fills interleave->split from all lights. Tile t takes the lights l with l mod (n m) = t; light l
 * has map l of `ism` (NULL for NONE). Without lights all is 0. Never NaN or Inf for finite inputs.
 * Same input, same bits. Many lights with many taps take several dispatches, as if they were
 * batches (core/gl/context.h, IRB_LOOP_ROUNDS_MOST; from 56 taps of 1024 lights of a tile on). */
bool irb_shade_run(struct irb_shade *shade, struct irb_interleave *interleave,
                   const struct irb_virtual_lights *lights, const struct irb_ism *ism,
                   const struct irb_shade_settings *settings, struct irb_error *err);

/* The same for the lights first..first+count-1 only, in the tiles that they have among all; added
 * to what is there if `accumulate`. For RASTER, light l has map l - first of `raster`, and `ism`
 * isn't looked at. Fewer maps than lights are IRB_E_INTERNAL. */
struct irb_shade_batch {
    int first, count;
    bool accumulate;
    const struct irb_raster_maps *raster; /* borrowed; RASTER only */
};
bool irb_shade_run_batch(struct irb_shade *shade, struct irb_interleave *interleave,
                         const struct irb_virtual_lights *lights, const struct irb_ism *ism,
                         const struct irb_shade_settings *settings,
                         const struct irb_shade_batch *batch, struct irb_error *err);

/* RASTER from all lights, like irb_shade_run(): in batches of the maps' capacity, each batch's maps
 * are rendered, then shaded. A bias of 0.01 and no slope came closest to rays among those tried in
 * the Cornell box with objects (maps of 128 x 128 texels). */
struct irb_shade_raster {
    struct irb_raster_maps *maps;     /* borrowed, as all of this */
    const struct irb_scene_gl *scene; /* what they show */
    float near;                       /* as irb_raster_maps_render() has it */
    struct irb_timer *timer;          /* NULL: nothing is timed */
    int maps_stage, light_stage;
};
bool irb_shade_run_raster(struct irb_shade *shade, struct irb_interleave *interleave,
                          const struct irb_virtual_lights *lights,
                          const struct irb_shade_raster *raster,
                          const struct irb_shade_settings *settings, struct irb_error *err);

/* Share of the irradiance that the last runs' bound took, [0,1]; 0 where there was no bound, or no
 * light. Waits for the GPU. */
bool irb_shade_lost(struct irb_shade *shade, const struct irb_interleave *interleave, double *share,
                    struct irb_error *err);

#endif
