/* SPDX-License-Identifier: MIT */
#include "core/gl/backend.h"

static void print_limits(FILE *out, struct irb_gl *gl)
{
    /* what the methods rely on, and how much of it: UBO blocks of lights, point sets in chunks,
     * images of 4K, compute groups of 16 x 16 */
    static const struct {
        GLenum name;
        const char *title;
        int64_t needed;
    } limits[] = {
        {GL_MAX_UNIFORM_BLOCK_SIZE, "uniform block bytes", 48 << 10},
        {GL_MAX_SHADER_STORAGE_BLOCK_SIZE, "storage block bytes", 64 << 20},
        {GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, "storage blocks, compute", 8},
        {GL_MAX_TEXTURE_SIZE, "texture size", 4096},
        {GL_MAX_ARRAY_TEXTURE_LAYERS, "texture layers", 256},
        {GL_MAX_COLOR_ATTACHMENTS, "colour attachments", 8},
        {GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS, "compute group size", 256},
        {GL_MAX_COMPUTE_SHARED_MEMORY_SIZE, "compute shared bytes", 16 << 10},
        {GL_MAX_COMBINED_IMAGE_UNIFORMS, "image units, all stages", 8},
        {GL_MAX_TESS_GEN_LEVEL, "tessellation level", 64},
    };
    for (size_t i = 0; i < sizeof limits / sizeof *limits; i++) {
        GLint64 value = 0;
        gl->api.GetInteger64v(limits[i].name, &value);
        fprintf(out, "  %-26s %12lld  ", limits[i].title, (long long)value);
        if (value >= limits[i].needed)
            fprintf(out, "OK\n");
        else
            fprintf(out, "missing: %lld needed; some methods will not run here\n",
                    (long long)limits[i].needed);
    }
}

static void print_context(FILE *out, struct irb_gl *gl)
{
    fprintf(out, "  vendor    %s\n", gl->vendor);
    fprintf(out, "  renderer  %s%s\n", gl->renderer, gl->software ? " (software)" : "");
    fprintf(out, "  version   %s\n", gl->version);
    fprintf(out, "  GPU       %s\n",
            gl->software
                ? "missing: rendering on the CPU; for a GPU install its vendor's EGL driver "
                  "(in a container, pass the device through)"
                : "OK");
    fprintf(out, "  timing    %s\n",
            gl->software ? "glFinish and monotonic clock" : "GL timer queries");
}

static bool try_backend(FILE *out, enum irb_backend backend, const struct irb_gl_desc *desc)
{
    struct irb_error err = {0};
    struct irb_gl_desc one = *desc;
    one.backend = backend;
    struct irb_gl *gl = irb_gl_create(&one, &err);
    if (gl)
        fprintf(out, "%-7s OK       %s, %s\n", irb_backend_names[backend], gl->platform,
                gl->renderer);
    else
        fprintf(out, "%-7s missing  %s\n", irb_backend_names[backend], err.message);
    irb_gl_destroy(gl);
    return gl != NULL;
}

bool irb_gl_doctor(FILE *out, const struct irb_gl_desc *desc)
{
    fprintf(out, "OpenGL 4.5 core backends:\n");
    bool osmesa = try_backend(out, IRB_BACKEND_OSMESA, desc);
    bool egl = try_backend(out, IRB_BACKEND_EGL, desc);
    fprintf(out, "EGL devices:\n");
    if (!irb_egl_list_devices(out))
        fprintf(out, "  none\n");
    struct irb_error err = {0};
    struct irb_gl *gl = irb_gl_create(desc, &err);
    fprintf(out, "chosen by --backend %s:\n", irb_backend_names[desc->backend]);
    if (!gl) {
        fprintf(out, "  none: %s\n", err.message);
        if (!osmesa && !egl)
            fprintf(out, "  what to do: apt install libegl1 libegl-mesa0 libgl1-mesa-dri "
                         "libosmesa6, or the GPU's own driver\n");
        return false;
    }
    fprintf(out, "  backend   %s (%s)\n", irb_backend_names[gl->backend], gl->platform);
    print_context(out, gl);
    print_limits(out, gl);
    irb_gl_destroy(gl);
    return true;
}
