#include "backends/gl/gl.h"

#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "core/base/log.h"

// The serial of this thread's current context, 0 for none.
static _Thread_local unsigned current;

// EGL returns the same display to every caller for one device, and eglTerminate ends it for all. So
// users are counted, and the last one ends it.
static pthread_mutex_t displays_lock = PTHREAD_MUTEX_INITIALIZER;
static struct {
    EGLDisplay display;
    int users;
} displays[GL_MAX_TARGETS];
static unsigned last_serial;

static const char *error_name(EGLint code)
{
    static const char *const names[] = {
        "EGL_SUCCESS",       "EGL_NOT_INITIALIZED",     "EGL_BAD_ACCESS",
        "EGL_BAD_ALLOC",     "EGL_BAD_ATTRIBUTE",       "EGL_BAD_CONFIG",
        "EGL_BAD_CONTEXT",   "EGL_BAD_CURRENT_SURFACE", "EGL_BAD_DISPLAY",
        "EGL_BAD_MATCH",     "EGL_BAD_NATIVE_PIXMAP",   "EGL_BAD_NATIVE_WINDOW",
        "EGL_BAD_PARAMETER", "EGL_BAD_SURFACE",         "EGL_CONTEXT_LOST"};
    int index = code - EGL_SUCCESS;
    return index >= 0 && index < (int)(sizeof(names) / sizeof(names[0])) ? names[index]
                                                                         : "an unknown error";
}

// Notes why a target was refused, if it is the first reason, which is the best target's. A driver
// that is installed, and fails or is broken, outweighs missing ones.
__attribute__((format(printf, 3, 4))) static bool
note(struct gl_search *search, enum rg_manifest_state state, const char *format, ...)
{
    if (search->state != RG_MANIFEST_NONE || (state == RG_MANIFEST_NONE && search->why[0]))
        return false;
    va_list args;
    va_start(args, format);
    vsnprintf(search->why, sizeof(search->why), format, args);
    va_end(args);
    search->state = state;
    return false;
}

// The same for failures that count even if devices open.
static void fail_gravely(struct gl_search *search, const char *call)
{
    note(search, RG_MANIFEST_FAILED, "%s failed with %s", call, error_name(eglGetError()));
    search->grave = true;
}

// --- targets ---

// Keeps Mesa from warning on stderr of devices that it cannot open, since the search goes on.
static void silence_mesa(void)
{
    setenv("EGL_LOG_LEVEL", "fatal", 0);
}

// libepoxy ends the process when it cannot load a library that it needs.
static bool can_load(struct gl_search *search, const char *noun, const char *library,
                     const char *package)
{
    char why[320];
    bool is_absent = false;
    if (rg_manifests_load(library, &is_absent, why, sizeof(why)))
        return true;
    search->lacks = is_absent;
    return is_absent ? note(search, RG_MANIFEST_NONE,
                            "no %s: %s is not there; install the Debian package %s", noun, library,
                            package)
                     : note(search, RG_MANIFEST_BROKEN, "no %s: %s", noun, why);
}

// Either of two libraries provides OpenGL's functions.
static bool can_load_opengl(struct gl_search *search)
{
    struct gl_search other = {0};
    return can_load(&other, "OpenGL", "libGL.so.1", "") ||
           can_load(search, "OpenGL", "libOpenGL.so.0", "libopengl0");
}

static bool has_client_extension(const char *name)
{
    return epoxy_has_egl_extension(EGL_NO_DISPLAY, name);
}

// Mesa cannot run a hardware device in software, so forcing software excludes hardware devices.
static bool software_is_forced(void)
{
    const char *value = getenv("LIBGL_ALWAYS_SOFTWARE");
    return value && (!strcmp(value, "1") || !strcasecmp(value, "true") ||
                     !strcasecmp(value, "yes") || !strcasecmp(value, "y"));
}

static void add_devices(struct gl_search *search, EGLDeviceEXT *devices, int count, bool software)
{
    for (int i = 0; i < count && search->count < GL_MAX_TARGETS; i++) {
        const char *extensions = eglQueryDeviceStringEXT(devices[i], EGL_EXTENSIONS);
        if (!extensions)
            fail_gravely(search, "no EGL devices: eglQueryDeviceString");
        bool is_software = extensions && strstr(extensions, "EGL_MESA_device_software");
        if (is_software == software)
            search->targets[search->count++] =
                (struct gl_target){EGL_PLATFORM_DEVICE_EXT, devices[i], software};
    }
}

static void add_targets(struct gl_search *search)
{
    EGLDeviceEXT devices[GL_MAX_TARGETS - 1];
    EGLint count = 0;
    bool base = has_client_extension("EGL_EXT_device_base");
    if ((base || (has_client_extension("EGL_EXT_device_enumeration") &&
                  has_client_extension("EGL_EXT_device_query"))) &&
        has_client_extension("EGL_EXT_platform_device") &&
        !eglQueryDevicesEXT(GL_MAX_TARGETS - 1, devices, &count)) {
        fail_gravely(search, "no EGL devices: eglQueryDevices");
        count = 0;
    }
    if (!software_is_forced())
        add_devices(search, devices, count, false);
    add_devices(search, devices, count, true);
    if (has_client_extension("EGL_MESA_platform_surfaceless"))
        search->targets[search->count++] =
            (struct gl_target){EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, false};
}

void gl_search_begin(struct gl_search *search)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, silence_mesa);
    *search = (struct gl_search){0};
    if (!can_load(search, "EGL", "libEGL.so.1", "libegl1") || !can_load_opengl(search))
        return;
    rg_manifests_begin(&gl_manifests);
    // Without client extensions, EGL reports a bad display here.
    const char *listed = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    const EGLint code = listed ? EGL_SUCCESS : eglGetError();
    if (code != EGL_SUCCESS && code != EGL_BAD_DISPLAY)
        note(search, RG_MANIFEST_FAILED, "no EGL driver: eglQueryString failed with %s",
             error_name(code));
    else if (!has_client_extension("EGL_EXT_platform_base"))
        note(search, RG_MANIFEST_NONE, "no EGL driver: EGL lists no platforms");
    else
        add_targets(search);
    if (!search->count)
        note(search, RG_MANIFEST_NONE, "no EGL device and no surfaceless platform");
}

// --- displays and contexts ---

// The entry of an open display, or a free one; -1: none is free.
static int place_of(EGLDisplay display)
{
    int free_place = -1;
    for (int i = 0; i < GL_MAX_TARGETS; i++) {
        if (displays[i].users && displays[i].display == display)
            return i;
        if (!displays[i].users)
            free_place = i;
    }
    return free_place;
}

static bool open_display(struct gl_search *search, const struct gl_target *target,
                         EGLDisplay *display)
{
    *display = eglGetPlatformDisplayEXT(target->platform, target->native, NULL);
    if (*display == EGL_NO_DISPLAY)
        return note(search, RG_MANIFEST_FAILED,
                    "no EGL display: eglGetPlatformDisplay failed with %s",
                    error_name(eglGetError()));
    int at = place_of(*display);
    if (at < 0)
        return note(search, RG_MANIFEST_NONE, "no EGL display: %d are open", GL_MAX_TARGETS);
    if (!displays[at].users && !eglInitialize(*display, NULL, NULL))
        return note(search, RG_MANIFEST_FAILED, "no EGL display: eglInitialize failed with %s",
                    error_name(eglGetError()));
    displays[at].display = *display;
    displays[at].users++;
    return true;
}

static void close_display(EGLDisplay display)
{
    if (--displays[place_of(display)].users == 0)
        eglTerminate(display);
}

static bool open_context(struct gl_search *search, struct gl_egl *egl)
{
    static const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                        4,
                                        EGL_CONTEXT_MINOR_VERSION,
                                        5,
                                        EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                        EGL_NONE};
    if (!epoxy_has_egl_extension(egl->display, "EGL_KHR_no_config_context") ||
        !epoxy_has_egl_extension(egl->display, "EGL_KHR_surfaceless_context"))
        return note(search, RG_MANIFEST_NONE, "EGL by %s cannot open a context without a surface",
                    eglQueryString(egl->display, EGL_VENDOR));
    if (!eglBindAPI(EGL_OPENGL_API))
        return note(search, RG_MANIFEST_FAILED, "no OpenGL: eglBindAPI failed with %s",
                    error_name(eglGetError()));
    egl->context = eglCreateContext(egl->display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    if (egl->context == EGL_NO_CONTEXT) {
        const EGLint code = eglGetError();
        // EGL's error codes for a version that the driver lacks.
        const bool is_lack = code == EGL_BAD_MATCH || code == EGL_BAD_ATTRIBUTE;
        return note(search, is_lack ? RG_MANIFEST_NONE : RG_MANIFEST_FAILED,
                    "no OpenGL 4.5 core: eglCreateContext failed with %s", error_name(code));
    }
    if (!eglMakeCurrent(egl->display, EGL_NO_SURFACE, EGL_NO_SURFACE, egl->context)) {
        note(search, RG_MANIFEST_FAILED, "no OpenGL 4.5 core: eglMakeCurrent failed with %s",
             error_name(eglGetError()));
        eglDestroyContext(egl->display, egl->context);
        return false;
    }
    egl->serial = current = ++last_serial;
    return true;
}

static bool open_target(struct gl_search *search, const struct gl_target *target,
                        struct gl_egl *egl)
{
    *egl = (struct gl_egl){.software = target->software};
    pthread_mutex_lock(&displays_lock);
    bool ok = open_display(search, target, &egl->display);
    if (ok && !open_context(search, egl)) {
        close_display(egl->display);
        ok = false;
    }
    pthread_mutex_unlock(&displays_lock);
    char why[256];
    if (!ok || gl_is_driver_asked(egl, why, sizeof(why)))
        return ok;
    search->grave = true;
    gl_egl_close(egl);
    return note(search, RG_MANIFEST_BROKEN, "%s", why);
}

bool gl_search_next(struct gl_search *search, struct gl_egl *egl)
{
    while (search->next < search->count) {
        const struct gl_target *target = &search->targets[search->next++];
        // The surfaceless platform duplicates one of the devices, so it is used only if none
        // opened.
        if (target->platform == EGL_PLATFORM_SURFACELESS_MESA && search->found)
            continue;
        if (open_target(search, target, egl))
            return search->found = true;
    }
    return false;
}

void gl_search_check(struct gl_search *search)
{
    const GLenum code = glGetError();
    if (code == GL_NO_ERROR)
        return;
    search->grave = true;
    note(search, RG_MANIFEST_FAILED, "no GL device: its limits cannot be read, with GL error 0x%x",
         code);
}

bool gl_egl_beside(const struct gl_device *device, struct gl_egl *beside)
{
    struct gl_search search = {0};
    *beside = device->egl;
    pthread_mutex_lock(&displays_lock);
    const bool ok = open_context(&search, beside);
    if (ok)
        displays[place_of(beside->display)].users++;
    pthread_mutex_unlock(&displays_lock);
    return ok || rg_driver_error("device '%s': %s", device->pub.info.name, search.why);
}

void gl_egl_close(struct gl_egl *egl)
{
    pthread_mutex_lock(&displays_lock);
    if (current == egl->serial) {
        eglMakeCurrent(egl->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        current = 0;
    }
    eglDestroyContext(egl->display, egl->context);
    close_display(egl->display);
    pthread_mutex_unlock(&displays_lock);
}

bool gl_use(struct gl_device *device)
{
    const struct gl_egl *egl = &device->egl;
    if (current == egl->serial)
        return true;
    if (!eglMakeCurrent(egl->display, EGL_NO_SURFACE, EGL_NO_SURFACE, egl->context))
        return rg_driver_error(
            "device '%s': eglMakeCurrent failed with %s; use it on one thread only",
            device->pub.info.name, error_name(eglGetError()));
    current = egl->serial;
    return true;
}
