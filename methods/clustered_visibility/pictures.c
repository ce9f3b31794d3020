/* SPDX-License-Identifier: MIT */
#include "methods/clustered_visibility/pictures.h"

#include <stdlib.h>

enum { GROUP = 8, ORDERED_BINDING = 4 };

static bool create_texture(struct cv_pictures *p, struct irb_texture **out, unsigned format,
                           int width, int height, int layers, struct irb_error *err)
{
    *out = irb_texture_create(p->gl,
                              &(struct irb_texture_desc){.name = "clustered-visibility: picture",
                                                         .format = format,
                                                         .width = width,
                                                         .height = height,
                                                         .layers = layers},
                              err);
    return *out != NULL;
}

struct cv_pictures *cv_pictures_create(struct irb_gl *gl, int resolution, int width, int height,
                                       struct irb_error *err)
{
    struct cv_pictures *p = calloc(1, sizeof *p);
    if (!p) {
        irb_fail(err, IRB_E_MEMORY, "clustered-visibility: out of memory");
        return NULL;
    }
    p->gl = gl;
    if (create_texture(p, &p->vals, GL_RGBA32F, resolution, resolution, 0, err) &&
        (p->shadow = irb_shadow_term_create(gl, width, height, err)) &&
        (p->on_vals =
             irb_framebuffer_create(gl, "clustered-visibility: VALs", &p->vals, 1, NULL, err)))
        return p;
    cv_pictures_destroy(p);
    return NULL;
}

void cv_pictures_destroy(struct cv_pictures *p)
{
    if (!p)
        return;
    irb_framebuffer_destroy(p->on_vals);
    for (int layout = 0; layout < 2; layout++)
        irb_program_destroy(p->surfaces[layout]);
    irb_program_destroy(p->points);
    irb_program_destroy(p->images);
    irb_texture_destroy(p->vals);
    irb_shadow_term_destroy(p->shadow);
    irb_texture_destroy(p->basis);
    free(p);
}

/* Made when first asked for, in use; NULL on failure. */
static const struct irb_program *use(struct irb_gl *gl, struct irb_program **program,
                                     const struct irb_program_desc *desc, struct irb_error *err)
{
    if (!*program)
        *program = irb_program_create(gl, desc, err);
    if (*program)
        irb_program_use(*program);
    return *program;
}

static void dispatch(const struct cv_pictures *p, const struct irb_texture *target)
{
    const struct irb_gl_api *api = &p->gl->api;
    api->BindImageTexture(0, target->id, 0, target->layers > 0, 0, GL_WRITE_ONLY, target->format);
    api->DispatchCompute((unsigned)(target->width + GROUP - 1) / GROUP,
                         (unsigned)(target->height + GROUP - 1) / GROUP,
                         (unsigned)(target->layers > 0 ? target->layers : 1));
    api->MemoryBarrier(GL_FRAMEBUFFER_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT |
                       GL_TEXTURE_FETCH_BARRIER_BIT);
}

/* What the light lights, dark, and the VPLs on it. */
static bool draw_vals(struct cv_pictures *p, const struct irb_rsm *rsm, const struct irb_vals *vals,
                      struct irb_error *err)
{
    const struct irb_gl_api *api = &p->gl->api;
    const char *const defines[] = {irb_rsm_define(rsm->layout), NULL};
    const struct irb_program_desc surfaces = {.name = "clustered-visibility: show surfaces",
                                              .compute =
                                                  "methods/clustered_visibility/show_surfaces.comp",
                                              .defines = defines};
    const struct irb_program_desc points = {.name = "clustered-visibility: show VPLs",
                                            .vertex = "methods/clustered_visibility/show_vpls.vert",
                                            .fragment =
                                                "methods/clustered_visibility/show_vpls.frag"};
    const struct irb_program *program = use(p->gl, &p->surfaces[rsm->layout], &surfaces, err);
    if (!program)
        return false;
    irb_rsm_bind(rsm, program, 0);
    irb_program_float(program, "flux_unit", irb_rsm_flux_unit(rsm));
    dispatch(p, p->vals);
    if (!(program = use(p->gl, &p->points, &points, err)))
        return false;
    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, ORDERED_BINDING, vals->ordered->id);
    irb_program_mat4(program, "view_projection", rsm->view_projection);
    irb_framebuffer_bind(p->on_vals);
    api->Disable(GL_DEPTH_TEST);
    api->PointSize(rsm->resolution >= 512 ? 5 : rsm->resolution >= 128 ? 3 : 1);
    api->BindVertexArray(p->gl->empty_vertex_array);
    api->DrawArrays(GL_POINTS, 0, vals->vpls);
    api->PointSize(1);
    return true;
}

/* The plain basis images of the first map, all of its faces. */
static bool draw_basis(struct cv_pictures *p, const struct irb_csm *csm, struct irb_error *err)
{
    const int layers = csm->faces * ((csm->order + 1) / 2);
    const struct irb_program_desc desc = {.name = "clustered-visibility: show basis",
                                          .compute =
                                              "methods/clustered_visibility/show_basis.comp"};
    const struct irb_program *program = use(p->gl, &p->images, &desc, err);
    if (!program)
        return false;
    if (!p->basis || p->basis->width != csm->size || p->basis->layers != layers) {
        irb_texture_destroy(p->basis);
        if (!create_texture(p, &p->basis, GL_RGBA32F, csm->size, csm->size, layers, err))
            return false;
    }
    p->gl->api.BindTextureUnit(0, csm->images->id);
    irb_program_int(program, "images", 0);
    irb_program_int(program, "pairs", (csm->order + 1) / 2);
    irb_program_int(program, "tables", csm->prefilter == IRB_CSM_SAT);
    dispatch(p, p->basis);
    return true;
}

bool cv_pictures_draw(struct cv_pictures *p, const struct irb_rsm *rsm, const struct irb_vals *vals,
                      const struct irb_texture *irradiance, const struct irb_csm *csm,
                      struct irb_error *err)
{
    return draw_vals(p, rsm, vals, err) && irb_shadow_term_draw(p->shadow, irradiance, err) &&
           (!csm || draw_basis(p, csm, err)) &&
           irb_gl_check(p->gl, "clustered-visibility: pictures", err);
}
