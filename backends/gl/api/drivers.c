// Tells whether a machine without a GL device lacks a driver, or has one that fails.
#define _GNU_SOURCE // dlinfo, strcasestr
#include "backends/gl/gl.h"

#include <dlfcn.h>
#include <limits.h>
#include <link.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Variables that ask Mesa for a driver; the first applies to software devices only.
static const struct {
    const char *name;
    bool of_software;
} variables[] = {{"GALLIUM_DRIVER", true}, {"MESA_LOADER_DRIVER_OVERRIDE", false}};

// The driver that such a variable asks for; NULL: none.
static const char *asked_by(int variable)
{
    const char *value = getenv(variables[variable].name);
    return value && *value ? value : NULL;
}

// Mesa names its driver in the renderer's text, or through EGL.
static bool is_driver(const struct gl_egl *egl, const char *driver, const char *renderer)
{
    const char *name = epoxy_has_egl_extension(egl->display, "EGL_MESA_query_driver")
                           ? eglGetDisplayDriverName(egl->display)
                           : NULL;
    return strcasestr(renderer, driver) || (name && !strcmp(name, driver)) ||
           (!strcmp(driver, "virpipe") && strcasestr(renderer, "virgl"));
}

bool gl_is_driver_asked(const struct gl_egl *egl, char *why, size_t why_size)
{
    const char *renderer = (const char *)glGetString(GL_RENDERER);
    const char *version = (const char *)glGetString(GL_VERSION);
    if (!renderer || !version || !strstr(version, "Mesa"))
        return true;
    const bool is_software = egl->software || strstr(renderer, "llvmpipe");
    for (int i = 0; i < 2; i++) {
        const char *driver = asked_by(i);
        if (!driver || (variables[i].of_software && !is_software) ||
            is_driver(egl, driver, renderer))
            continue;
        snprintf(why, why_size,
                 "%s asks for the driver '%.40s', and Mesa opens '%.80s' instead: unset it, or "
                 "name a driver that is installed",
                 variables[i].name, driver, renderer);
        return false;
    }
    return true;
}

// The folder of the drivers that Mesa's EGL loads: LIBGL_DRIVERS_PATH, or the one in the library's
// folder.
static bool find_drivers(char folder[PATH_MAX])
{
    const char *named = getenv("LIBGL_DRIVERS_PATH");
    if (named && *named) {
        snprintf(folder, PATH_MAX, "%.*s", (int)strcspn(named, ":"), named);
        return true;
    }
    struct link_map *map = NULL;
    void *mesa = dlopen("libEGL_mesa.so.0", RTLD_LAZY | RTLD_NOLOAD);
    if (!mesa || dlinfo(mesa, RTLD_DI_LINKMAP, &map) || !strrchr(map->l_name, '/'))
        return false;
    snprintf(folder, PATH_MAX, "%.*s/dri", (int)(strrchr(map->l_name, '/') - map->l_name),
             map->l_name);
    dlclose(mesa);
    return true;
}

// Mesa does not report why it cannot load a driver, so the linker is asked. Returns whether it gave
// a reason.
static bool add_linker_error(char *why, size_t why_size)
{
    char folder[PATH_MAX], path[PATH_MAX + 16], error[320];
    bool is_absent;
    if (!find_drivers(folder))
        return false;
    snprintf(path, sizeof(path), "%s/swrast_dri.so", folder);
    const size_t used = strlen(why);
    if (rg_manifests_load(path, &is_absent, error, sizeof(error)))
        return false;
    snprintf(why + used, why_size - used, ": %s", error);
    return true;
}

static void add_asked(char *why, size_t why_size)
{
    for (int i = 0; i < 2; i++) {
        const size_t used = strlen(why);
        if (asked_by(i))
            snprintf(why + used, why_size - used, "; %s=%.40s asks for a driver that fails here",
                     variables[i].name, asked_by(i));
    }
}

const struct rg_manifest_rules gl_manifests = {
    .instead = {"__EGL_VENDOR_LIBRARY_FILENAMES", "__EGL_VENDOR_LIBRARY_DIRS"},
    .places = {{NULL, "/etc/glvnd/egl_vendor.d:/usr/share/glvnd/egl_vendor.d"}},
    .below = "",
    .ending = ".json",
    .names_any = true,
    .functions = {"__egl_Main"},
    .package = GL_PACKAGE,
};

int gl_judge(const struct gl_search *search, int count, char *why, size_t why_size)
{
    enum rg_manifest_state state = search->state;
    snprintf(why, why_size, "%s", search->why);
    if (search->grave)
        return state == RG_MANIFEST_BROKEN ? RG_LIST_BROKEN : RG_LIST_FAILED;
    if (!count && search->lacks)
        return 0;
    if (!count && (asked_by(0) || asked_by(1))) {
        add_asked(why, why_size);
        state = RG_MANIFEST_BROKEN;
    } else if (!count && state == RG_MANIFEST_FAILED && add_linker_error(why, why_size)) {
        state = RG_MANIFEST_BROKEN;
    }
    return rg_manifests_judge(&gl_manifests, count, state, why, why_size);
}
