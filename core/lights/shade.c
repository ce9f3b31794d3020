/* SPDX-License-Identifier: MIT */
#include "core/lights/shade.h"
#include "core/lights/lost_light.h"

#include <stdio.h>
#include <stdlib.h>

/* Work group side of shaders/lights/shade.glsl, and bindings there. */
enum { GROUP = 8 };
enum { LIGHTS_BINDING = 0, TAPS_BINDING = 1, SPLIT_IMAGE = 0, LOST_IMAGE = 1 };
/* Programs: one a visibility, RASTER one a projection of its maps. */
enum { VISIBILITIES = IRB_SHADE_RASTER + 1, KINDS = VISIBILITIES + 1 };

/* Side of the square of pixels that an invocation shades on software rasterisers: the more, the
 * less a light's loading costs; PCSS has work enough. */
static const int software_tile[VISIBILITIES] = {4, 4, 1, 2};
enum { POLYGON_TILE = 2 }; /* at most: polygons have more to keep for each pixel */

struct irb_shade {
    struct irb_gl *gl;
    struct irb_program *programs[KINDS][2][2][3]; /* kind, clamped, point, corners; when first
                                                     asked for */
    struct irb_buffer *taps;                      /* blocker search, filter: vec4 each */
    int taps_made[2];                             /* how many of each it holds */
    struct irb_lost_light lost;
};

struct irb_shade *irb_shade_create(struct irb_gl *gl, struct irb_error *err)
{
    struct irb_shade *shade = calloc(1, sizeof *shade);
    if (!shade) {
        irb_fail(err, IRB_E_MEMORY, "out of memory");
        return NULL;
    }
    shade->gl = shade->lost.gl = gl;
    shade->taps =
        irb_buffer_create(gl, "shade: taps", (int64_t)2 * IRB_SHADOW_TAPS_MOST * 16, NULL, err);
    if (shade->taps)
        return shade;
    irb_shade_destroy(shade);
    return NULL;
}

void irb_shade_destroy(struct irb_shade *shade)
{
    if (!shade)
        return;
    for (int i = 0; i < KINDS * 12; i++)
        irb_program_destroy(shade->programs[i / 12][i / 6 % 2][i / 3 % 2][i % 3]);
    irb_buffer_destroy(shade->taps);
    irb_lost_light_destroy(&shade->lost);
    free(shade);
}

static int tile_of(const struct irb_shade *shade, int visibility, int corners)
{
    const int tile = software_tile[visibility];
    if (!shade->gl->software)
        return 1;
    return corners && tile > POLYGON_TILE ? POLYGON_TILE : tile;
}

/* Lights in one uniform block, below GL's 64 KiB; their bytes are whole multiples of 256, which is
 * the most that a driver may ask of an offset. */
static int block_lights(int corners)
{
    return corners == 0 ? IRB_VPL_BLOCK : corners == 8 ? IRB_VPL_BLOCK / 2 : IRB_VPL_BLOCK / 4;
}

static const struct irb_program *program_of(struct irb_shade *shade,
                                            const struct irb_shade_settings *s,
                                            const struct irb_raster_maps *raster, int corners,
                                            struct irb_error *err)
{
    const int kind = s->visibility + (raster ? (int)raster->projection : 0);
    struct irb_program **program =
        &shade->programs[kind][s->bound > 0][s->point_form_factor][corners / 8];
    char tile[32], visibility[32], block[32], taps[32], polygon[32];
    if (*program)
        return *program;
    snprintf(tile, sizeof tile, "TILE %d", tile_of(shade, s->visibility, corners));
    snprintf(visibility, sizeof visibility, "VISIBILITY %d", s->visibility);
    snprintf(block, sizeof block, "VPL_BLOCK %d", block_lights(corners));
    snprintf(polygon, sizeof polygon, "CORNERS %d", corners);
    snprintf(taps, sizeof taps, "TAPS_MOST %d", IRB_SHADOW_TAPS_MOST);
    const char *defines[9] = {tile, visibility, block, taps, polygon};
    int count = 5;
    if (raster)
        defines[count++] = irb_raster_define(raster->projection);
    if (s->bound > 0)
        defines[count++] = "CLAMPED 1";
    if (s->point_form_factor)
        defines[count++] = "POINT 1";
    const struct irb_program_desc desc = {.name = "shade",
                                          .compute = raster ? "lights/shade_raster.comp"
                                                            : "lights/shade.comp",
                                          .defines = defines};
    *program = irb_program_create(shade->gl, &desc, err);
    return *program;
}

/* The kernels, where others are asked for than there are. */
static bool prepare_taps(struct irb_shade *shade, const struct irb_shade_settings *s,
                         struct irb_error *err)
{
    const int counts[2] = {s->blocker_taps, s->taps};
    for (int kernel = 0; kernel < 2; kernel++) {
        float points[IRB_SHADOW_TAPS_MOST][2], padded[IRB_SHADOW_TAPS_MOST][4] = {0};
        if (counts[kernel] < 1 || counts[kernel] > IRB_SHADOW_TAPS_MOST)
            return irb_fail(err, IRB_E_INTERNAL, "shade: %d taps, expected 1 to %d", counts[kernel],
                            IRB_SHADOW_TAPS_MOST);
        if (counts[kernel] == shade->taps_made[kernel])
            continue;
        irb_shadow_kernel(counts[kernel], points);
        for (int i = 0; i < counts[kernel]; i++) {
            padded[i][0] = points[i][0];
            padded[i][1] = points[i][1];
        }
        if (!irb_buffer_write(shade->taps, kernel * (int64_t)sizeof padded, sizeof padded, padded,
                              err))
            return false;
        shade->taps_made[kernel] = counts[kernel];
    }
    return true;
}

/* A bound from the first batch on, or from none. */
static bool prepare_lost(struct irb_shade *shade, const struct irb_interleave *il,
                         const struct irb_shade_settings *s, bool accumulate, struct irb_error *err)
{
    if (s->bound > 0 && accumulate && !irb_lost_light_fits(&shade->lost, il))
        return irb_fail(err, IRB_E_INTERNAL, "shade: a bound only since the second batch");
    return irb_lost_light_prepare(&shade->lost, il, s->bound, err);
}

static bool check(const struct irb_virtual_lights *lights, const struct irb_ism *ism,
                  const struct irb_shade_settings *s, const struct irb_shade_batch *batch,
                  struct irb_error *err)
{
    if (lights->corners != 0 && lights->corners != 8 && lights->corners != 16)
        return irb_fail(err, IRB_E_INTERNAL, "shade: polygons of %d corners", lights->corners);
    if (s->visibility < 0 || s->visibility >= VISIBILITIES)
        return irb_fail(err, IRB_E_INTERNAL, "shade: no visibility %d", s->visibility);
    if (batch->first < 0 || batch->count < 0 || batch->first + batch->count > lights->count)
        return irb_fail(err, IRB_E_INTERNAL, "shade: lights %d to %d of %d", batch->first,
                        batch->first + batch->count - 1, lights->count);
    const bool raster = s->visibility == IRB_SHADE_RASTER;
    const int maps = raster ? (batch->raster ? batch->raster->count : 0) : ism ? ism->capacity : 0;
    const int asked = raster ? batch->count : batch->first + batch->count;
    if (s->visibility != IRB_SHADE_NONE && (asked > maps || (raster && !batch->raster)))
        return irb_fail(err, IRB_E_INTERNAL, "shade: %d shadow maps for %d lights", maps, asked);
    return true;
}

/* Texture units from 3; the side of a texel is in [-1,1]^2. */
static void bind_maps(const struct irb_program *program, const struct irb_ism *ism,
                      const struct irb_raster_maps *raster, int first)
{
    const int size = raster ? raster->size : ism ? ism->map_size : 1;

    if (raster)
        irb_raster_maps_bind(raster, program, 3);
    else if (ism)
        irb_ism_bind(ism, program, 3);
    irb_program_float(program, "map_texel", 2.0f / (float)size);
    irb_program_int(program, "map_base", raster ? first : 0);
}

static void bind(const struct irb_shade *shade, const struct irb_program *program,
                 const struct irb_interleave *il, bool bounded)
{
    const struct irb_gl_api *api = &shade->gl->api;

    api->BindTextureUnit(0, il->position->id);
    irb_program_int(program, "split_position", 0);
    api->BindTextureUnit(1, il->normal->id);
    irb_program_int(program, "split_normal", 1);
    api->BindTextureUnit(2, il->geometric->id);
    irb_program_int(program, "split_geometric", 2);
    api->BindImageTexture(SPLIT_IMAGE, il->split->id, 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
    if (bounded)
        api->BindImageTexture(LOST_IMAGE, shade->lost.image->id, 0, GL_FALSE, 0, GL_READ_WRITE,
                              GL_R32F);
    api->BindBufferBase(GL_UNIFORM_BUFFER, TAPS_BINDING, shade->taps->id);
    irb_program_ivec2(program, "tile_size", (const int[]){il->tile_width, il->tile_height});
    irb_program_int(program, "tiles_across", il->n);
    irb_program_int(program, "tile_count", il->n * il->m);
}

static void set_settings(const struct irb_program *program, const struct irb_shade_settings *s)
{
    irb_program_int(program, "search_taps", s->blocker_taps);
    irb_program_int(program, "filter_taps", s->taps);
    irb_program_float(program, "search_scale", s->search_scale);
    irb_program_float(program, "penumbra_scale", s->penumbra_scale);
    irb_program_float(program, "bound", s->bound);
    irb_program_float(program, "bias", s->bias);
    irb_program_float(program, "slope", s->slope);
    irb_program_float(program, "offset", s->offset);
}

/* Lights that one dispatch may take: of each tile as many as IRB_LOOP_ROUNDS_MOST lets a pixel go
 * through with all taps and both loops over a polygon's corners. */
static int lights_at_once(const struct irb_shade_settings *s, const struct irb_interleave *il,
                          int corners)
{
    const int taps = s->visibility == IRB_SHADE_PCSS ? s->blocker_taps + s->taps + 2 : 0;
    return IRB_LOOP_ROUNDS_MOST / (1 + taps + (corners ? corners + 2 : 0)) * il->n * il->m;
}

static int least(int a, int b)
{
    return a < b ? a : b;
}

/* The lights of one uniform block that lie in the batch, up to `at_once` of them in a dispatch. */
static void dispatch(const struct irb_shade *shade, const struct irb_program *program,
                     const struct irb_interleave *il, const struct irb_virtual_lights *lights,
                     int block, const struct irb_shade_batch *batch, int side, int at_once)
{
    const struct irb_gl_api *api = &shade->gl->api;
    const int lights_a_block = block_lights(lights->corners);
    const int64_t bytes = (int64_t)lights_a_block * (IRB_VPL_BYTES + 8 * lights->corners);
    const int base = block * lights_a_block;
    const int first = batch->first > base ? batch->first - base : 0;
    const int end = least(batch->first + batch->count - base, lights_a_block);

    irb_program_int(program, "light_base", base);
    api->BindBufferRange(GL_UNIFORM_BUFFER, LIGHTS_BINDING, lights->buffer->id, block * bytes,
                         bytes);
    /* no lights at all still take one dispatch, which writes zeros */
    for (int begin = first; begin == first || begin < end; begin += at_once) {
        irb_program_int(program, "light_begin", begin);
        irb_program_int(program, "light_end", least(begin + at_once, end));
        irb_program_int(program, "accumulate", batch->accumulate || begin + base > batch->first);
        api->DispatchCompute((unsigned)((il->tile_width + side - 1) / side),
                             (unsigned)((il->tile_height + side - 1) / side),
                             (unsigned)(il->n * il->m));
        api->MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    }
}

bool irb_shade_run_batch(struct irb_shade *shade, struct irb_interleave *il,
                         const struct irb_virtual_lights *lights, const struct irb_ism *ism,
                         const struct irb_shade_settings *settings,
                         const struct irb_shade_batch *batch, struct irb_error *err)
{
    if (!check(lights, ism, settings, batch, err) ||
        (settings->visibility == IRB_SHADE_PCSS && !prepare_taps(shade, settings, err)) ||
        !prepare_lost(shade, il, settings, batch->accumulate, err))
        return false;
    const struct irb_raster_maps *raster =
        settings->visibility == IRB_SHADE_RASTER ? batch->raster : NULL;
    const struct irb_program *program = program_of(shade, settings, raster, lights->corners, err);
    if (!program)
        return false;
    irb_program_use(program);
    bind(shade, program, il, settings->bound > 0);
    bind_maps(program, ism, raster, batch->first);
    set_settings(program, settings);
    const int side = GROUP * tile_of(shade, settings->visibility, lights->corners);
    const int at_once = lights_at_once(settings, il, lights->corners);
    const int first = batch->count > 0 ? batch->first / block_lights(lights->corners) : 0;
    const int last = (batch->first + batch->count - 1) / block_lights(lights->corners);
    for (int block = first; block == first || block <= last; block++)
        dispatch(shade, program, il, lights, block, batch, side, at_once);
    shade->gl->api.MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT |
                                 GL_FRAMEBUFFER_BARRIER_BIT);
    return irb_gl_check(shade->gl, "shade", err);
}

bool irb_shade_run(struct irb_shade *shade, struct irb_interleave *interleave,
                   const struct irb_virtual_lights *lights, const struct irb_ism *ism,
                   const struct irb_shade_settings *settings, struct irb_error *err)
{
    const struct irb_shade_batch all = {.count = lights->count};
    return irb_shade_run_batch(shade, interleave, lights, ism, settings, &all, err);
}

bool irb_shade_run_raster(struct irb_shade *shade, struct irb_interleave *interleave,
                          const struct irb_virtual_lights *lights,
                          const struct irb_shade_raster *raster,
                          const struct irb_shade_settings *settings, struct irb_error *err)
{
    struct irb_raster_maps *maps = raster->maps;
    struct irb_shade_batch batch = {.raster = maps};
    bool ok = true;
    do { /* no lights at all still take one batch, which writes zeros */
        batch.count = least(lights->count - batch.first, maps->capacity);
        batch.accumulate = batch.first > 0;
        IRB_TIMED(ok, raster->timer, raster->maps_stage,
                  irb_raster_maps_render(maps, raster->scene, lights, batch.first, batch.count,
                                         raster->near, err));
        IRB_TIMED(ok, raster->timer, raster->light_stage,
                  irb_shade_run_batch(shade, interleave, lights, NULL, settings, &batch, err));
        batch.first += batch.count;
    } while (ok && batch.first < lights->count);
    return ok;
}

bool irb_shade_lost(struct irb_shade *shade, const struct irb_interleave *il, double *share,
                    struct irb_error *err)
{
    return irb_lost_light_share(&shade->lost, il, share, err);
}
