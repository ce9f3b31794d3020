/* SPDX-License-Identifier: MIT
 *
 * Imperfect shadow maps of many virtual lights in one atlas (Ritschel et al. 2008; thesis 3.2.4,
 * 5.1.3, 5.3.2): points of the scene are splatted in paraboloid projection along each light's
 * normal, and holes are filled by pull-push. Light l has map l; point i goes to maps (i + j) mod N,
 * j < s_f.
 *
 * A texel holds the Euclidean distance from the light to the nearest splat over it. Splats are
 * squares of whole texels, as large as the surface that a point stands for looks from the light
 * (enum irb_ism_size; shaders/lights/ism_splat.glsl has the formula), cut at the map's border.
 * Points below the light's plane, within 0.06 degrees of it, or nearer than `near` are left out. A
 * light without flux keeps an empty map. Objects' transforms and the scene's vertex buffer are read
 * anew at every splat.
 *
 * Same input, same bits; ATOMIC and RASTER give the same atlas.
 */
#ifndef IRB_LIGHTS_ISM_H
#define IRB_LIGHTS_ISM_H

#include "core/lights/points.h"
#include "core/lights/virtual_light.h"

enum irb_ism_splatter {
    IRB_ISM_ATOMIC,       /* compute shader, atomic minima */
    IRB_ISM_RASTER,       /* thesis, static points: vertex, geometry and fragment shader, GL_POINTS
                             with depth test */
    IRB_ISM_TESSELLATION, /* thesis, dynamic points: tessellation of every triangle as it is now,
                             then as RASTER. Alpha masks are not seen. */
};

enum irb_ism_pull {
    IRB_ISM_MEDIAN, /* thesis: a coarser texel takes the median of its four, of an even number of
                       valid ones the nearer of the middle two; a hole takes its parent's distance
                     */
    IRB_ISM_MEAN,   /* Ritschel et al. 2008: the mean of the valid ones that are at most 10 % (ours)
                       farther than the nearest; a hole interpolates bilinearly between its parent
                       and those of the parent's neighbours within 10 % of it */
};
extern const char *const irb_ism_pull_names[]; /* "median", "mean", NULL */

/* What a splat's size goes by, besides the distance. */
enum irb_ism_size {
    IRB_ISM_SIZE_EVEN,    /* nothing (thesis 5.3.2): every point stands for the same part of the
                             scene's surface and faces the light. Where points are sparse, as
                             algorithm 5.2 leaves them on large triangles, holes stay */
    IRB_ISM_SIZE_SURFACE, /* the part of its own triangle that the point stands for, as it looks
                             from the light: no holes but by chance, and large splats on large
                             triangles, whose one distance is far off at their rims */
};
extern const char *const irb_ism_size_names[]; /* "even", "surface", NULL */

struct irb_ism_settings {
    int splatter;       /* enum irb_ism_splatter */
    float splat_factor; /* s_f in (0, 64]; of a fraction, that share of the points (chosen by a hash
                           of their number) goes into one map more */
    float splat_scale;  /* > 0; 1: a splat is as large as the share of the surface that one splat of
                           a map stands for */
    int splat_size;     /* enum irb_ism_size */
    int splat_most;     /* texels, >= 1: largest side of a splat */
    float near;         /* share of the scene's diagonal at rest, >= 0 */
    float near_radii;   /* >= 0; 1 leaves out what is nearer than the radius sqrt(A/pi) of an area
                           light: the surface that it stands for, which lies before its centre
                           where it bends */
    int pull_push;      /* levels j, 0 = off: holes up to about 2^j texels wide are filled */
    int pull;           /* enum irb_ism_pull */
    float f_min, f_max; /* TESSELLATION: f[min,max] of eqs 5.3 and 5.4, at most 64 */
    int smoothstep;     /* TESSELLATION: 3 or 5 */
};

struct irb_ism {
    struct irb_gl *gl; /* borrowed */
    int map_size;      /* texels a side; the thesis has 128 */
    int maps_a_row;
    int capacity;              /* maps_a_row^2, at most 1024 */
    struct irb_texture *atlas; /* R32UI: bits of the distance (m, float32), of +Inf (0x7f800000)
                                  where there is none; map l at column l mod maps_a_row, row l /
                                  maps_a_row. GLSL: lights/ism_fetch.glsl */
    int count; /* maps in use after the last splat: one a light. The others are empty */
    struct irb_ism_passes *passes; /* private */
};

/* Room for at least `capacity` maps, 1..1024, of map_size 8..1024; all empty. IRB_E_INPUT beyond
 * the driver's limits. One ISM serves one scene: it keeps what it measured there. */
struct irb_ism *irb_ism_create(struct irb_gl *gl, int map_size, int capacity,
                               struct irb_error *err);
/* The same into *ism, unless there are as many maps of that size already; what was there is
 * destroyed. */
bool irb_ism_prepare(struct irb_ism **ism, struct irb_gl *gl, int map_size, int capacity,
                     struct irb_error *err);
void irb_ism_destroy(struct irb_ism *ism); /* NULL is fine */

/* irb_ism_splat(), then irb_ism_pull_push(). points is NULL for TESSELLATION, which makes its own.
 * No light at all is fine. IRB_E_INPUT names a setting out of range. */
bool irb_ism_build(struct irb_ism *ism, const struct irb_scene_gl *scene,
                   const struct irb_points *points, const struct irb_virtual_lights *lights,
                   const struct irb_ism_settings *settings, struct irb_error *err);
bool irb_ism_splat(struct irb_ism *ism, const struct irb_scene_gl *scene,
                   const struct irb_points *points, const struct irb_virtual_lights *lights,
                   const struct irb_ism_settings *settings, struct irb_error *err);
/* Levels beyond those by which 2^j divides map_size are refused (IRB_E_INPUT): a texel of a coarser
 * level must not lie in two maps. */
bool irb_ism_pull_push(struct irb_ism *ism, const struct irb_ism_settings *settings,
                       struct irb_error *err);

/* Share of the texels that hold a distance, of those with centres inside the unit discs of the maps
 * of all lights with flux at the last splat; 0 where there is none. Reads back. */
bool irb_ism_coverage(struct irb_ism *ism, double *share, struct irb_error *err);

/* Sets the atlas (texture unit first_unit) and the uniforms of lights/ism_fetch.glsl. Returns the
 * next free unit. */
int irb_ism_bind(const struct irb_ism *ism, const struct irb_program *program, int first_unit);

#endif
