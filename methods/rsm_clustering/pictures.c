/* SPDX-License-Identifier: MIT */
#include "methods/rsm_clustering/pictures.h"

#include <stdio.h>
#include <stdlib.h>

/* Of shaders/methods/rsm_clustering/show_*. */
enum { SHOW_CLUSTERS, SHOW_FLUX, SHOW_CLUSTERED };
enum { CLUSTERS_BINDING = 0, LIGHTS_BINDING = 6, TEXEL_GROUP = 8, DISC_CORNERS = 6 };

struct rsc_picture_passes {
    struct irb_program *map[2];       /* by the RSM's layout */
    struct irb_program *surfaces[2];  /* by the G-buffer's */
    struct irb_program *lights[2][3]; /* by that and the corners */
    struct irb_program *centres;
    struct irb_texture *depth;
    struct irb_framebuffer *on_centres, *on_lights;
};

static bool create_picture(struct irb_gl *gl, struct irb_texture **out, unsigned format, int width,
                           int height, struct irb_error *err)
{
    *out = irb_texture_create(
        gl,
        &(struct irb_texture_desc){
            .name = "rsm-clustering: picture", .format = format, .width = width, .height = height},
        err);
    return *out != NULL;
}

static bool create_targets(struct rsc_pictures *p, int resolution, int width, int height,
                           struct irb_error *err)
{
    struct irb_gl *gl = p->gl;
    struct rsc_picture_passes *own = p->passes;
    return create_picture(gl, &p->map, GL_RGBA32F, resolution, resolution, err) &&
           create_picture(gl, &p->flux, GL_RGBA32F, resolution, resolution, err) &&
           create_picture(gl, &p->clustered, GL_RGBA32F, resolution, resolution, err) &&
           create_picture(gl, &p->centres, GL_RGBA32F, resolution, resolution, err) &&
           create_picture(gl, &p->lights, GL_RGBA32F, width, height, err) &&
           create_picture(gl, &own->depth, GL_DEPTH_COMPONENT32F, width, height, err) &&
           (own->on_centres =
                irb_framebuffer_create(gl, "rsm-clustering: centres", &p->centres, 1, NULL, err)) &&
           (own->on_lights = irb_framebuffer_create(gl, "rsm-clustering: lights", &p->lights, 1,
                                                    own->depth, err));
}

struct rsc_pictures *rsc_pictures_create(struct irb_gl *gl, int resolution, int width, int height,
                                         struct irb_error *err)
{
    struct rsc_pictures *p = calloc(1, sizeof *p);
    struct rsc_picture_passes *own = calloc(1, sizeof *own);
    if (!p || !own) {
        free(p);
        free(own);
        irb_fail(err, IRB_E_MEMORY, "rsm-clustering: out of memory");
        return NULL;
    }
    p->gl = gl;
    p->passes = own;
    if (create_targets(p, resolution, width, height, err))
        return p;
    rsc_pictures_destroy(p);
    return NULL;
}

void rsc_pictures_destroy(struct rsc_pictures *p)
{
    if (!p)
        return;
    struct rsc_picture_passes *own = p->passes;
    irb_framebuffer_destroy(own->on_centres);
    irb_framebuffer_destroy(own->on_lights);
    for (int layout = 0; layout < 2; layout++) {
        irb_program_destroy(own->map[layout]);
        irb_program_destroy(own->surfaces[layout]);
        for (int i = 0; i < 3; i++)
            irb_program_destroy(own->lights[layout][i]);
    }
    irb_program_destroy(own->centres);
    irb_texture_destroy(own->depth);
    free(own);
    irb_texture_destroy(p->map);
    irb_texture_destroy(p->flux);
    irb_texture_destroy(p->clustered);
    irb_texture_destroy(p->centres);
    irb_texture_destroy(p->lights);
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

static void show_map(const struct rsc_pictures *p, const struct irb_program *program, int show,
                     const struct irb_texture *picture)
{
    const struct irb_gl_api *api = &p->gl->api;
    const unsigned groups = (unsigned)(picture->width + TEXEL_GROUP - 1) / TEXEL_GROUP;
    irb_program_int(program, "show", show);
    api->BindImageTexture(0, picture->id, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
    api->DispatchCompute(groups, groups, 1);
    api->MemoryBarrier(GL_FRAMEBUFFER_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT |
                       GL_TEXTURE_FETCH_BARRIER_BIT);
}

static bool draw_maps(struct rsc_pictures *p, const struct rsc_clusters *clusters,
                      const struct irb_rsm *rsm, struct irb_error *err)
{
    const char *const defines[] = {irb_rsm_define(rsm->layout), NULL};
    const struct irb_program_desc desc = {.name = "rsm-clustering: show map",
                                          .compute = "methods/rsm_clustering/show_map.comp",
                                          .defines = defines};
    const struct irb_program *program = use(p->gl, &p->passes->map[rsm->layout], &desc, err);
    if (!program)
        return false;
    const int unit = irb_rsm_bind(rsm, program, 0);
    p->gl->api.BindTextureUnit((GLuint)unit, clusters->map->id);
    irb_program_int(program, "cluster_map", unit);
    irb_program_float(program, "flux_unit", irb_rsm_flux_unit(rsm));
    show_map(p, program, SHOW_CLUSTERS, p->map);
    show_map(p, program, SHOW_FLUX, p->flux);
    show_map(p, program, SHOW_CLUSTERED, p->clustered);
    show_map(p, program, SHOW_CLUSTERED, p->centres);
    return true;
}

static bool draw_centres(struct rsc_pictures *p, const struct rsc_clusters *clusters,
                         const struct irb_rsm *rsm, struct irb_error *err)
{
    const struct irb_gl_api *api = &p->gl->api;
    const struct irb_program_desc desc = {.name = "rsm-clustering: show centres",
                                          .vertex = "methods/rsm_clustering/show_centres.vert",
                                          .fragment = "methods/rsm_clustering/show_centres.frag"};
    const struct irb_program *program = use(p->gl, &p->passes->centres, &desc, err);
    if (!program)
        return false;
    irb_program_mat4(program, "view_projection", rsm->view_projection);
    irb_framebuffer_bind(p->passes->on_centres);
    api->Disable(GL_DEPTH_TEST);
    api->PointSize(rsm->resolution >= 256 ? 3 : 1);
    api->BindVertexArray(p->gl->empty_vertex_array);
    api->DrawArrays(GL_POINTS, 0, clusters->count);
    api->PointSize(1);
    return true;
}

static void set_camera(const struct irb_program *program, const struct irb_gbuffer *gbuffer)
{
    irb_gbuffer_bind(gbuffer, program, 0);
    irb_program_vec3(program, "camera", gbuffer->camera_position);
    irb_program_vec3(program, "right", gbuffer->right);
    irb_program_vec3(program, "up", gbuffer->up);
    irb_program_vec3(program, "back", gbuffer->back);
    irb_program_vec2(program, "tangent", gbuffer->tangent);
    irb_program_vec2(program, "near_far", (const float[]){gbuffer->z_near, gbuffer->z_far});
}

static bool draw_lights(struct rsc_pictures *p, const struct rsc_area_lights *lights,
                        const struct irb_gbuffer *gbuffer, struct irb_error *err)
{
    const struct irb_gl_api *api = &p->gl->api;
    const struct irb_buffer *buffer = lights->corners ? lights->polygons : lights->discs;
    char corners[32];
    snprintf(corners, sizeof corners, "CORNERS %d", lights->corners);
    const char *const defines[] = {irb_gbuffer_define(gbuffer->layout), corners, NULL};
    const struct irb_program_desc desc = {.name = "rsm-clustering: show lights",
                                          .vertex = "methods/rsm_clustering/show_lights.vert",
                                          .fragment = "methods/rsm_clustering/show_lights.frag",
                                          .defines = defines};
    struct irb_program **slot = &p->passes->lights[gbuffer->layout][lights->corners / 8];
    const struct irb_program *program = use(p->gl, slot, &desc, err);
    if (!program)
        return false;
    set_camera(program, gbuffer);
    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, LIGHTS_BINDING, buffer->id);
    api->ClearDepth(1);
    api->DepthMask(GL_TRUE);
    api->Clear(GL_DEPTH_BUFFER_BIT);
    api->Enable(GL_DEPTH_TEST);
    api->DepthFunc(GL_LESS);
    api->Disable(GL_CULL_FACE);
    api->BindVertexArray(p->gl->empty_vertex_array);
    api->DrawArraysInstanced(GL_TRIANGLE_FAN, 0, lights->corners ? lights->corners : DISC_CORNERS,
                             lights->count);
    api->Disable(GL_DEPTH_TEST);
    return true;
}

static bool draw_scene(struct rsc_pictures *p, const struct rsc_area_lights *lights,
                       const struct irb_gbuffer *gbuffer, struct irb_error *err)
{
    const char *const defines[] = {irb_gbuffer_define(gbuffer->layout), NULL};
    const struct irb_program_desc desc = {.name = "rsm-clustering: show surfaces",
                                          .vertex = "gl/fullscreen.vert",
                                          .fragment = "methods/rsm_clustering/show_surfaces.frag",
                                          .defines = defines};
    const struct irb_program *program =
        use(p->gl, &p->passes->surfaces[gbuffer->layout], &desc, err);
    if (!program)
        return false;
    set_camera(program, gbuffer);
    irb_framebuffer_bind(p->passes->on_lights);
    irb_gl_draw_fullscreen(p->gl);
    return draw_lights(p, lights, gbuffer, err);
}

bool rsc_pictures_draw(struct rsc_pictures *p, const struct rsc_clusters *clusters,
                       const struct rsc_area_lights *lights, const struct irb_rsm *rsm,
                       const struct irb_gbuffer *gbuffer, struct irb_error *err)
{
    p->gl->api.BindBufferBase(GL_SHADER_STORAGE_BUFFER, CLUSTERS_BINDING, clusters->clusters->id);
    return draw_maps(p, clusters, rsm, err) && draw_centres(p, clusters, rsm, err) &&
           draw_scene(p, lights, gbuffer, err) &&
           irb_gl_check(p->gl, "rsm-clustering: pictures", err);
}
