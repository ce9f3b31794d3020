/* SPDX-License-Identifier: MIT
 *
 * An OpenGL 4.5 core context without a window, from OSMesa (loaded at run time) or EGL (device or
 * surfaceless platform), and the entry points. A context belongs to the thread that created it and
 * is current there until it is destroyed; use one at a time. Both libraries are loaded at run time.
 * PACK and UNPACK alignment are 1; debug output is synchronous.
 *
 * Does not: choose what to draw, nor keep state between draws: every pass sets what it needs.
 */
#ifndef IRB_GL_CONTEXT_H
#define IRB_GL_CONTEXT_H

#include "core/base/error.h"
#include "core/base/log.h"
#include "core/gl/api.h"

#include <stdint.h>

enum irb_backend { IRB_BACKEND_AUTO, IRB_BACKEND_OSMESA, IRB_BACKEND_EGL, IRB_BACKEND_NULL };

/* "auto", "osmesa", "egl", "null", NULL: the choices of --backend. */
extern const char *const irb_backend_names[];

struct irb_gl_desc {
    enum irb_backend backend;
    const char *shader_dir; /* NULL: the shaders embedded in the binary; else a folder that is laid
                               over them: a file in it wins, what it lacks stays embedded */
    struct irb_log *log;    /* borrowed, may be NULL */
};

struct irb_gl {
    struct irb_gl_api api;                   /* gl->api.BindTexture(...) */
    enum irb_backend backend;                /* what was chosen: OSMESA or EGL */
    bool software;                           /* llvmpipe or another CPU rasteriser */
    const char *vendor, *renderer, *version; /* the driver's strings */
    const char *platform;                    /* "osmesa", "egl-device", "egl-surfaceless" */
    int64_t bytes;                           /* live bytes of textures, buffers and renderbuffers */
    int64_t peak_bytes;                      /* highest value of `bytes` so far */
    char pending[512];      /* first KHR_debug error since the last check, "" when none */
    const char *shader_dir; /* owned copy, or NULL */
    struct irb_log *log;
    void *native;                /* the backend's own state */
    unsigned empty_vertex_array; /* for draws that take no attributes */
};

/* Rounds that all loops of one shader invocation may make together. llvmpipe ends them after 65535
 * (LP_MAX_TGSI_LOOP_ITERATIONS in Mesa's gallivm/lp_bld_limits.h), without an error; a loop of n
 * rounds counts n + 1 times, and lanes of one vector share the count. Shaders that may need more
 * stop here and go on in another dispatch, on any driver, so that all give the same sums. The rest
 * is for short loops that nobody counts. */
enum { IRB_LOOP_ROUNDS_MOST = 60000 };

/* auto: EGL on hardware, else OSMesa, else EGL in software. NULL with IRB_E_BACKEND when there is
 * none; the message says for each backend what was missing. IRB_BACKEND_NULL is for commands that
 * need no context and do not call this: here it fails with a message that says so. IRB_E_INPUT
 * where shader_dir is no folder. */
struct irb_gl *irb_gl_create(const struct irb_gl_desc *desc, struct irb_error *err);
void irb_gl_destroy(struct irb_gl *gl);

/* Fails with "site: message" if KHR_debug reported an error since the last check (or glGetError
 * has one). `site` names the call or pass, e.g. "gbuffer: draw". IRB_E_MEMORY for
 * GL_OUT_OF_MEMORY, else IRB_E_BACKEND. */
bool irb_gl_check(struct irb_gl *gl, const char *site, struct irb_error *err);

/* Full-screen triangle with the program in use into the framebuffer that is bound; no depth, blend,
 * culling or scissor, all colour channels. Its vertex shader is "gl/fullscreen.vert", which gives
 * the fragment shader `in vec2 uv`. */
void irb_gl_draw_fullscreen(struct irb_gl *gl);

/* Writes what `irbench doctor` prints about this machine's backends, devices, limits and missing
 * features, with what to do about each. Returns false where desc->backend does not work. */
bool irb_gl_doctor(FILE *out, const struct irb_gl_desc *desc);

#endif
