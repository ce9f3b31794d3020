/* SPDX-License-Identifier: MIT
 *
 * The reflective shadow map: the light's G-buffer (Dachsbacher and Stamminger 2005; thesis 3.2.2,
 * 5.1.1), with the exact solid angle of every texel; in full precision or in the thesis's slim
 * layout. The direct light uses the full one only; methods are given either, and read both through
 * irb_rsm_bind().
 *
 * Spot: a square perspective image that encloses the cone. Directional: an orthographic image of
 * the beam. Texels outside the cone or without geometry have zero flux.
 */
#ifndef IRB_FRAME_RSM_H
#define IRB_FRAME_RSM_H

#include "core/frame/layout.h"
#include "core/frame/scene_gl.h"
#include "core/scene/light.h"

struct irb_rsm {
    int resolution; /* texels a side */
    enum irb_layout layout;
    /* full | slim, where the layers differ */
    struct irb_texture
        *position;              /* RGBA32F: world position (m); 1 where there is geometry | NULL */
    struct irb_texture *normal; /* RGBA32F: unit shading normal on the lit side; Euclidean
                                   distance to the light (spot) or along the beam (m) | RG16:
                                   spheremap of the normal in the light's frame */
    struct irb_texture *flux;   /* RGBA32F: reflected flux Phi_p = k_d I dw_p (W); flux in,
                                   averaged over the channels (W) | RGBA8: reflected flux in
                                   units of flux_scale; 0 */
    struct irb_texture *specular; /* RGBA32F: k_s; exponent: for importance (thesis 4.5) | RGBA8:
                                     k_s; log of the exponent */
    struct irb_texture *depth;    /* DEPTH_COMPONENT32F, reversed (1 near, 0 far): the rasteriser's
                                     own, for comparisons take the distance in normal.w */
    struct irb_framebuffer *framebuffer;
    struct irb_surface_program program;
    /* of the last render */
    float view_projection[16]; /* world -> clip, depth 1..0 */
    float half_extent;         /* of the image: tan(omega_s) at distance 1, or the beam's half side
                                  (m) */
    bool directional;
    float light_position[3], right[3], up[3], direction[3]; /* the light's frame, world */
    float depth_range;   /* m: spot: distance at depth 1; directional: at depth 0 */
    float flux_scale[3]; /* W: the most that a texel of albedo 1 reflects */
    struct irb_gl *gl;   /* borrowed */
};

/* In full precision. */
struct irb_rsm *irb_rsm_create(struct irb_gl *gl, int resolution, struct irb_error *err);
struct irb_rsm *irb_rsm_create_layout(struct irb_gl *gl, enum irb_layout layout, int resolution,
                                      struct irb_error *err);
void irb_rsm_destroy(struct irb_rsm *rsm);

/* Memory of a texel, bytes, its depth included: 68 full, 16 slim. */
int irb_rsm_texel_bytes(const struct irb_rsm *rsm);

/* The largest of flux_scale, W. */
float irb_rsm_largest_flux(const struct irb_rsm *rsm);
/* Its inverse, 1/W, which brings fluxes to order 1 whatever the light's power; 1 for a dark light.
 */
float irb_rsm_flux_unit(const struct irb_rsm *rsm);

/* The define that a shader which includes frame/rsm_fetch.glsl is compiled with. */
const char *irb_rsm_define(enum irb_layout layout);

/* Binds the layers to texture units first_unit.. and sets the uniforms of frame/rsm_fetch.glsl;
 * returns the first unit after them (4 are used). */
int irb_rsm_bind(const struct irb_rsm *rsm, const struct irb_program *program, int first_unit);

/* Spot: nothing nearer than 1e-5 of the current bounds' diagonal (along the axis) is seen, and
 * there is no far end. Directional: from the light's plane to the end of the bounds. */
bool irb_rsm_render(struct irb_rsm *rsm, const struct irb_scene_gl *scene,
                    const struct irb_light *light, struct irb_error *err);

#endif
