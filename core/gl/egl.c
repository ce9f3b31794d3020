/* SPDX-License-Identifier: MIT
 *
 * EGL without a window: the device platform (EGL_EXT_device_enumeration, EGL_EXT_platform_device)
 * for a GPU, Mesa's surfaceless platform (EGL_MESA_platform_surfaceless) for llvmpipe. libEGL is
 * loaded at run time, so that a build with EGL starts where it is not installed.
 */
#include "core/gl/backend.h"

#if IRB_HAVE_EGL

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <stdlib.h>

enum { MAX_DEVICES = 32 };

/* Functions that libEGL exports */
#define EGL_FUNCTIONS(X)                                                                           \
    X(PFNEGLGETPROCADDRESSPROC, GetProcAddress)                                                    \
    X(PFNEGLGETERRORPROC, GetError)                                                                \
    X(PFNEGLQUERYSTRINGPROC, QueryString)                                                          \
    X(PFNEGLINITIALIZEPROC, Initialize)                                                            \
    X(PFNEGLTERMINATEPROC, Terminate)                                                              \
    X(PFNEGLBINDAPIPROC, BindAPI)                                                                  \
    X(PFNEGLCHOOSECONFIGPROC, ChooseConfig)                                                        \
    X(PFNEGLCREATECONTEXTPROC, CreateContext)                                                      \
    X(PFNEGLDESTROYCONTEXTPROC, DestroyContext)                                                    \
    X(PFNEGLMAKECURRENTPROC, MakeCurrent)                                                          \
    X(PFNEGLRELEASETHREADPROC, ReleaseThread)

struct egl {
    struct irb_gl_native native;
    void *library;
    EGLDisplay display;
    EGLContext context;
#define X(type, name) type name;
    EGL_FUNCTIONS(X)
#undef X
    /* extensions of the client; NULL where there is none */
    PFNEGLGETPLATFORMDISPLAYEXTPROC GetPlatformDisplay;
    PFNEGLQUERYDEVICESEXTPROC QueryDevices;
    PFNEGLQUERYDEVICESTRINGEXTPROC QueryDeviceString;
    bool surfaceless;
};

static bool has_extension(const char *list, const char *name)
{
    size_t length = strlen(name);
    for (const char *at = list; at && (at = strstr(at, name)); at += length)
        if ((at == list || at[-1] == ' ') && (at[length] == ' ' || !at[length]))
            return true;
    return false;
}

static const char *error_name(EGLint code)
{
    static const char *const names[] = {
        "EGL_SUCCESS",       "EGL_NOT_INITIALIZED",     "EGL_BAD_ACCESS",
        "EGL_BAD_ALLOC",     "EGL_BAD_ATTRIBUTE",       "EGL_BAD_CONFIG",
        "EGL_BAD_CONTEXT",   "EGL_BAD_CURRENT_SURFACE", "EGL_BAD_DISPLAY",
        "EGL_BAD_MATCH",     "EGL_BAD_NATIVE_PIXMAP",   "EGL_BAD_NATIVE_WINDOW",
        "EGL_BAD_PARAMETER", "EGL_BAD_SURFACE",         "EGL_CONTEXT_LOST"};
    size_t i = (size_t)(code - EGL_SUCCESS);
    return i < sizeof names / sizeof *names ? names[i] : "unknown EGL error";
}

static void close_display(struct egl *e)
{
    if (e->display == EGL_NO_DISPLAY)
        return;
    if (e->context != EGL_NO_CONTEXT) {
        e->MakeCurrent(e->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        e->DestroyContext(e->display, e->context);
    }
    e->Terminate(e->display);
    e->display = EGL_NO_DISPLAY;
    e->context = EGL_NO_CONTEXT;
}

static void destroy(struct irb_gl_native *native)
{
    struct egl *e = (struct egl *)native;
    close_display(e);
    if (e->ReleaseThread)
        e->ReleaseThread();
    if (e->library)
        dlclose(e->library);
    free(e);
}

static bool open_library(struct egl *e, struct irb_error *err)
{
    /* NODELETE: drivers leave threads and destructors behind that must not lose their code */
    e->library = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (!e->library)
        return irb_fail(err, IRB_E_BACKEND, "libEGL.so.1 not found (apt install libegl1)");
#define X(type, name)                                                                              \
    e->name = (type)irb_gl_symbol(e->library, "egl" #name);                                        \
    if (!e->name)                                                                                  \
        return irb_fail(err, IRB_E_BACKEND, "libEGL.so.1 lacks egl" #name);
    EGL_FUNCTIONS(X)
#undef X
    e->native.get_proc = (irb_gl_get_proc)e->GetProcAddress;
    const char *client = e->QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (has_extension(client, "EGL_EXT_platform_base"))
        e->GetPlatformDisplay =
            (PFNEGLGETPLATFORMDISPLAYEXTPROC)e->GetProcAddress("eglGetPlatformDisplayEXT");
    bool enumerates = has_extension(client, "EGL_EXT_device_enumeration") ||
                      has_extension(client, "EGL_EXT_device_base");
    if (enumerates && has_extension(client, "EGL_EXT_platform_device")) {
        e->QueryDevices = (PFNEGLQUERYDEVICESEXTPROC)e->GetProcAddress("eglQueryDevicesEXT");
        e->QueryDeviceString =
            (PFNEGLQUERYDEVICESTRINGEXTPROC)e->GetProcAddress("eglQueryDeviceStringEXT");
    }
    e->surfaceless = has_extension(client, "EGL_MESA_platform_surfaceless");
    if (!e->GetPlatformDisplay)
        return irb_fail(err, IRB_E_BACKEND,
                        "no EGL driver found (apt install libegl-mesa0, or the GPU's driver)");
    return true;
}

static struct egl *create(struct irb_error *err)
{
    struct egl *e = calloc(1, sizeof *e);
    if (!e) {
        irb_fail(err, IRB_E_MEMORY, "out of memory");
        return NULL;
    }
    e->native.destroy = destroy;
    e->display = EGL_NO_DISPLAY;
    e->context = EGL_NO_CONTEXT;
    if (open_library(e, err))
        return e;
    destroy(&e->native);
    return NULL;
}

/* A current context on the display; "step: EGL_..." in err where it fails. */
static bool start(struct egl *e, EGLDisplay display, struct irb_error *err)
{
    static const EGLint config_attributes[] = {EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_RENDERABLE_TYPE,
                                               EGL_OPENGL_BIT, EGL_NONE};
    static const EGLint context_attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                                4,
                                                EGL_CONTEXT_MINOR_VERSION,
                                                5,
                                                EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                                EGL_CONTEXT_OPENGL_DEBUG,
                                                EGL_TRUE,
                                                EGL_NONE};
    if (display == EGL_NO_DISPLAY)
        return irb_fail(err, IRB_E_BACKEND, "no display (%s)", error_name(e->GetError()));
    EGLint major, minor, count = 0;
    if (!e->Initialize(display, &major, &minor))
        return irb_fail(err, IRB_E_BACKEND, "eglInitialize: %s", error_name(e->GetError()));
    e->display = display;
    const char *step = NULL;
    EGLConfig config = NULL;
    if (!has_extension(e->QueryString(display, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context"))
        step = "no EGL_KHR_surfaceless_context";
    else if (!e->BindAPI(EGL_OPENGL_API))
        step = "no desktop OpenGL";
    else if (!e->ChooseConfig(display, config_attributes, &config, 1, &count) || count < 1)
        step = "no configuration for desktop OpenGL";
    else if (!(e->context = e->CreateContext(display, config, EGL_NO_CONTEXT, context_attributes)))
        step = "no OpenGL 4.5 core context";
    else if (!e->MakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, e->context))
        step = "eglMakeCurrent";
    if (!step)
        return true;
    irb_fail(err, IRB_E_BACKEND, "%s (%s)", step, error_name(e->GetError()));
    close_display(e);
    return false;
}

static int query_devices(struct egl *e, EGLDeviceEXT devices[MAX_DEVICES])
{
    EGLint count = 0;
    if (!e->QueryDevices || !e->QueryDeviceString || !e->QueryDevices(MAX_DEVICES, devices, &count))
        return 0;
    return count;
}

static bool is_software(struct egl *e, EGLDeviceEXT device)
{
    return has_extension(e->QueryDeviceString(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
}

/* Devices of one kind in EGL's order; the last one's trouble is left in err. */
static bool start_device(struct egl *e, bool software, struct irb_error *err)
{
    EGLDeviceEXT devices[MAX_DEVICES];
    int count = query_devices(e, devices);
    irb_fail(err, IRB_E_BACKEND, "none among %d device%s", count, count == 1 ? "" : "s");
    for (int i = 0; i < count; i++) {
        if (is_software(e, devices[i]) != software)
            continue;
        if (start(e, e->GetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, devices[i], NULL), err)) {
            e->native.platform = "egl-device";
            return true;
        }
        irb_error_prefix(err, "device %d", i);
    }
    return false;
}

static bool start_surfaceless(struct egl *e, struct irb_error *err)
{
    if (!e->surfaceless)
        return irb_fail(err, IRB_E_BACKEND, "no EGL_MESA_platform_surfaceless");
    e->native.platform = "egl-surfaceless";
    return start(
        e, e->GetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, (void *)EGL_DEFAULT_DISPLAY, NULL),
        err);
}

struct irb_gl_native *irb_egl_create(enum irb_egl_choice choice, struct irb_error *err)
{
    struct egl *e = create(err);
    if (!e)
        return NULL;
    struct irb_error device = {0}, surfaceless = {0}, software = {0};
    if (start_device(e, false, &device))
        return &e->native;
    if (choice == IRB_EGL_ANY &&
        (start_surfaceless(e, &surfaceless) || start_device(e, true, &software)))
        return &e->native;
    if (choice == IRB_EGL_ANY)
        irb_fail(err, IRB_E_BACKEND,
                 "hardware: %.200s; surfaceless: %.200s; software device: %.200s", device.message,
                 surfaceless.message, software.message);
    else
        irb_fail(err, IRB_E_BACKEND, "hardware: %s", device.message);
    destroy(&e->native);
    return NULL;
}

int irb_egl_list_devices(FILE *out)
{
    struct irb_error err;
    struct egl *e = create(&err);
    if (!e)
        return 0;
    EGLDeviceEXT devices[MAX_DEVICES];
    int count = query_devices(e, devices);
    for (int i = 0; i < count; i++) {
        const char *extensions = e->QueryDeviceString(devices[i], EGL_EXTENSIONS);
        const char *node = NULL, *vendor = NULL;
        if (has_extension(extensions, "EGL_EXT_device_drm"))
            node = e->QueryDeviceString(devices[i], EGL_DRM_DEVICE_FILE_EXT);
        if (has_extension(extensions, "EGL_EXT_device_persistent_id"))
            vendor = e->QueryDeviceString(devices[i], EGL_DRIVER_NAME_EXT);
        fprintf(out, "  device %d: %s%s%s%s%s\n", i,
                is_software(e, devices[i]) ? "software" : "GPU", vendor ? ", driver " : "",
                vendor ? vendor : "", node ? ", " : "", node ? node : "");
    }
    destroy(&e->native);
    return count;
}

#else

struct irb_gl_native *irb_egl_create(enum irb_egl_choice choice, struct irb_error *err)
{
    (void)choice;
    irb_fail(err, IRB_E_BACKEND,
             "not built in (apt install libegl-dev, then meson setup "
             "-Degl=enabled)");
    return NULL;
}

int irb_egl_list_devices(FILE *out)
{
    (void)out;
    return 0;
}

#endif
