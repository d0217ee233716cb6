// Finds the file of the driver's code that serves a context.
//
// Programs call EGL and OpenGL through libglvnd, and Mesa's functions through a table of its own,
// so that no address from them lies in the driver. So the driver is found among the loaded objects:
// first the vendor's EGL library, by its exports; then the library below it that draws, by Mesa's
// and NVIDIA's file names.
#include "backends/gl/gl.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

static const char *base_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

static bool ends_with(const char *text, const char *end)
{
    const size_t length = strlen(text), of = strlen(end);
    return length >= of && !strcmp(text + length - of, end);
}

static bool is_implementation(const char *path, const void *code)
{
    const char *base = base_of(path);
    (void)code;
    return !strncmp(base, "libgallium-", 11) || ends_with(base, "_dri.so") ||
           !strncmp(base, "libnvidia-eglcore", 17);
}

static bool is_vendor(const char *path, const void *code)
{
    (void)path;
    return rg_library_exports(code, "__egl_Main");
}

// Whether a libEGL is a driver itself, without libglvnd.
static bool is_egl(const char *path, const void *code)
{
    return !strncmp(base_of(path), "libEGL", 6) && rg_library_exports(code, "eglInitialize");
}

static bool is_vulkan_driver(const char *path, const void *code)
{
    (void)path;
    return rg_library_exports(code, "vk_icdGetInstanceProcAddr");
}

static bool is_lavapipe(const char *path, const void *code)
{
    return strstr(base_of(path), "lvp") && is_vulkan_driver(path, code);
}

static bool is_of(const char *word, const void *code)
{
    struct rg_library library;
    char lower[RG_LIBRARY_PATH];
    size_t i = 0;
    rg_library_at(code, &library);
    for (const char *c = base_of(library.path); *c; c++)
        lower[i++] = (char)(*c | 0x20);
    lower[i] = 0;
    return strstr(lower, word) != NULL;
}

// libglvnd loads all installed vendors' libraries; this keeps those of the vendor that EGL names.
static int keep_of_vendor(EGLDisplay display, const void **codes, int count)
{
    const char *vendor = eglQueryString(display, EGL_VENDOR);
    const char *word = vendor && !strncasecmp(vendor, "nvidia", 6) ? "nvidia" : "mesa";
    int kept = 0;
    for (int i = 0; i < count; i++)
        if (count == 1 || is_of("nvidia", codes[i]) == !strcmp(word, "nvidia"))
            codes[kept++] = codes[i];
    return kept;
}

// zink draws through a Vulkan driver, whose device name it reports.
static int add_below(const void **functions, int count, int max)
{
    const char *renderer = (const char *)glGetString(GL_RENDERER);
    if (!renderer || strncmp(renderer, "zink", 4) != 0)
        return count;
    return count + rg_libraries_find(strstr(renderer, "llvmpipe") ? is_lavapipe : is_vulkan_driver,
                                     functions + count, max - count);
}

int gl_functions(struct rg_device *device, const void **functions, int max)
{
    struct gl_device *gl = (struct gl_device *)device;
    bool (*const kinds[])(const char *, const void *) = {is_implementation, is_vendor, is_egl};
    int count = 0;
    if (!gl_use(gl))
        return 0;
    for (int i = 0; !count && i < 3; i++)
        count =
            keep_of_vendor(gl->egl.display, functions, rg_libraries_find(kinds[i], functions, max));
    return add_below(functions, count, max);
}
