/* SPDX-License-Identifier: MIT
 *
 * Real shadow maps of many virtual lights, the scene's triangles rasterised into all of them in one
 * layered pass: what imperfect shadow maps approximate (Ritschel et al. 2008), and the maps of
 * clustered visibility (Dong et al. 2009; thesis 3.2.5).
 *
 * A map holds the hemisphere above its light, in the frame of shaders/lights/paraboloid.glsl. The
 * hemicube (Cohen and Greenberg 1985) is three squares: one has the top, two have the four sides,
 * each of which needs its upper half only (shaders/lights/raster_charts.glsl). The paraboloid
 * (Brabec et al. 2002) is one. Both are exact at the texels' centres: a projected edge of the
 * paraboloid bends, so there every texel's ray is tested against the triangle itself, where
 * subdivision would leave chords.
 *
 * What is nearer than `near` and what lies below the light's plane is left out. Surfaces are seen
 * from both sides, and alpha masks cut holes.
 */
#ifndef IRB_LIGHTS_RASTER_MAPS_H
#define IRB_LIGHTS_RASTER_MAPS_H

#include "core/frame/scene_gl.h"
#include "core/lights/virtual_light.h"

enum irb_raster_projection { IRB_RASTER_HEMICUBE, IRB_RASTER_PARABOLOID };
extern const char *const irb_raster_projection_names[]; /* "hemicube", "paraboloid", NULL */

/* Distances take at most this much: 64 KiB a face at 128 texels a side. Source: ours. */
enum { IRB_RASTER_MOST_MIB = 256 };

struct irb_raster_maps {
    struct irb_gl *gl; /* borrowed */
    enum irb_raster_projection projection;
    int size;                     /* texels a side of a face; even */
    int capacity;                 /* lights a render */
    int faces;                    /* layers a light: 3 or 1 */
    int count;                    /* lights of the last render */
    struct irb_texture *distance; /* R32F array: Euclidean distance light - surface (m), +Inf where
                                     nothing is; layer = map * faces + face */
    struct irb_framebuffer *framebuffer; /* private */
    struct irb_surface_program program;  /* private */
};

/* How many lights one render can take: by the driver's limit on layers (GL guarantees 2048) and
 * IRB_RASTER_MOST_MIB; at least 1. */
int irb_raster_maps_most(struct irb_gl *gl, enum irb_raster_projection projection, int size);

/* IRB_E_INPUT: an odd size or one below 2, a capacity outside 1..irb_raster_maps_most(). */
struct irb_raster_maps *irb_raster_maps_create(struct irb_gl *gl,
                                               enum irb_raster_projection projection, int size,
                                               int capacity, struct irb_error *err);
void irb_raster_maps_destroy(struct irb_raster_maps *maps);

/* Lights first..first+count-1 into maps 0..count-1, dark ones too; maps beyond are emptied. `near`
 * in metres, taken for at least 1e-6 of the scene's diagonal. A light with a zero normal sees
 * nothing. Uses what irb_scene_gl_draw() does and uniform block binding 0. IRB_E_INTERNAL for
 * lights that are not there. Same input, same bits, in whatever order surfaces are drawn. */
bool irb_raster_maps_render(struct irb_raster_maps *maps, const struct irb_scene_gl *scene,
                            const struct irb_virtual_lights *lights, int first, int count,
                            float near, struct irb_error *err);

/* Sets the uniforms of shaders/lights/raster_maps_fetch.glsl; the next free texture unit. The
 * program was made with the define that irb_raster_define() gives. */
int irb_raster_maps_bind(const struct irb_raster_maps *maps, const struct irb_program *program,
                         int first_unit);
const char *irb_raster_define(enum irb_raster_projection projection); /* "RASTER_PROJECTION 0" */

#endif
