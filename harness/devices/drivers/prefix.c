#include "harness/devices/drivers/prefix.h"

#include <glob.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/devices/drivers/manifest.h"

// --- places below a prefix, as patterns ---

static const char *const folders[] = {
    "/usr/lib/*-linux-*", "/usr/lib64", "/usr/lib", "/usr/local/lib/*-linux-*", "/usr/local/lib64",
    "/usr/local/lib", "/lib/*-linux-*", "/lib64", "/lib",
    // in a build folder of Mesa
    "/src/egl", "/src/gbm", "/src/glx", "/src/mapi/shared-glapi", "/src/gallium/targets/*", NULL};

static const struct place {
    const char *api, *pattern;
} places[] = {
    {"vulkan", "/usr/share/vulkan/icd.d/*.json"},
    {"vulkan", "/usr/local/share/vulkan/icd.d/*.json"},
    {"vulkan", "/share/vulkan/icd.d/*.json"},
    {"vulkan", "/etc/vulkan/icd.d/*.json"},
    {"vulkan", "/src/*/vulkan/*_devenv_icd.*.json"},
    {"vulkan", "/src/gallium/targets/*/*_devenv_icd.*.json"},
    {"gl", "/usr/share/glvnd/egl_vendor.d/*.json"},
    {"gl", "/usr/local/share/glvnd/egl_vendor.d/*.json"},
    {"gl", "/share/glvnd/egl_vendor.d/*.json"},
    {"gl", "/etc/glvnd/egl_vendor.d/*.json"},
    {"gl", "/src/egl/*.json"},
    {"opencl", "/etc/OpenCL/vendors/*.icd"},
    {"opencl", "/usr/etc/OpenCL/vendors/*.icd"},
    {"opencl", "/src/gallium/targets/*/*.icd"},
};

// Calls `take` for each path of a pattern below the prefix.
static void for_each(struct rg_prefix *prefix, const char *pattern,
                     void (*take)(struct rg_prefix *prefix, const char *path, const void *user),
                     const void *user)
{
    char whole[PATH_MAX + 64];
    glob_t found;
    snprintf(whole, sizeof(whole), "%s%s", prefix->path, pattern);
    if (!glob(whole, 0, NULL, &found))
        for (size_t i = 0; i < found.gl_pathc; i++)
            if (strlen(found.gl_pathv[i]) < PATH_MAX)
                take(prefix, found.gl_pathv[i], user);
    globfree(&found);
}

// --- libraries ---

static void add_folder(struct rg_prefix *prefix, const char *path, const void *user)
{
    struct stat what;
    (void)user;
    if (!stat(path, &what) && S_ISDIR(what.st_mode) && prefix->folder_count < RG_PREFIX_FOLDERS)
        snprintf(prefix->folders[prefix->folder_count++], PATH_MAX, "%s", path);
}

// Unsuitable files found while looking for a library.
struct seen {
    char foreign[PATH_MAX];  // for another processor
    char manifest[PATH_MAX]; // whose library is outside the prefix
};

// Takes a file that exists and fits this processor.
static bool take_library(const char *path, char library[PATH_MAX], struct seen *seen)
{
    if (access(path, F_OK))
        return false;
    if (rg_library_is_foreign(path)) {
        snprintf(seen->foreign, PATH_MAX, "%.*s", PATH_MAX - 1, path);
        return false;
    }
    snprintf(library, PATH_MAX, "%.*s", PATH_MAX - 1, path);
    return true;
}

static bool find_in_folders(const struct rg_prefix *prefix, const char *name,
                            char library[PATH_MAX], struct seen *seen)
{
    bool is_found = false;
    for (int i = 0; !is_found && i < prefix->folder_count; i++) {
        char path[2 * PATH_MAX];
        is_found = snprintf(path, sizeof(path), "%s/%s", prefix->folders[i], name) < PATH_MAX &&
                   take_library(path, library, seen);
    }
    return is_found;
}

// A manifest names its library by a bare name, by the place where it will be installed, or by its
// current place.
static bool find_library(const struct rg_prefix *prefix, const struct rg_manifest *m,
                         char library[PATH_MAX], struct seen *seen)
{
    char path[2 * PATH_MAX];
    const char *slash = strrchr(m->named, '/');
    snprintf(path, sizeof(path), "%s%s", prefix->path, m->named);
    if (*m->named == '/' && strlen(path) < PATH_MAX && take_library(path, library, seen))
        return true;
    char *real = m->is_bare ? NULL : realpath(m->library, NULL);
    const bool is_inside = real && rg_path_is_below(real, prefix->path);
    const bool is_found = is_inside && take_library(real, library, seen);
    free(real);
    return is_found || find_in_folders(prefix, slash ? slash + 1 : m->named, library, seen);
}

// --- drivers ---

struct place_seen {
    const struct place *place;
    struct seen *seen;
};

static struct rg_prefix_driver *add_driver(struct rg_prefix *prefix, const char *api)
{
    if (prefix->driver_count == RG_PREFIX_DRIVERS)
        return NULL;
    prefix->drivers[prefix->driver_count].api = api;
    return &prefix->drivers[prefix->driver_count++];
}

static void add_manifest(struct rg_prefix *prefix, const char *path, const void *user)
{
    const struct place_seen *at = user;
    struct rg_manifest m;
    char library[PATH_MAX];
    rg_manifest_read(path, &m);
    if (m.fault == RG_MANIFEST_NO_FORM || !find_library(prefix, &m, library, at->seen)) {
        snprintf(at->seen->manifest, PATH_MAX, "%s", path);
        return;
    }
    struct rg_prefix_driver *driver = add_driver(prefix, at->place->api);
    if (driver) {
        memcpy(driver->manifest, m.path, PATH_MAX);
        memcpy(driver->library, library, PATH_MAX);
    }
}

static const struct rg_prefix_driver *driver_of(const struct rg_prefix *prefix, const char *api)
{
    for (int i = 0; i < prefix->driver_count; i++)
        if (!strcmp(prefix->drivers[i].api, api))
            return &prefix->drivers[i];
    return NULL;
}

// Adds EGL without a vendor's manifest: Mesa's library is enough, and so is a libEGL that is the
// driver.
static void add_egl(struct rg_prefix *prefix, struct seen *seen)
{
    static const char *const names[] = {"libEGL_mesa.so.0", "libEGL.so.1"};
    char library[PATH_MAX];
    for (int i = 0; i < 2 && !driver_of(prefix, "gl"); i++) {
        struct rg_prefix_driver *driver =
            find_in_folders(prefix, names[i], library, seen) ? add_driver(prefix, "gl") : NULL;
        if (driver)
            memcpy(driver->library, library, PATH_MAX);
    }
}

// --- messages ---

static bool tell_none(const char *device, const char *api, const char *path,
                      const struct seen *seen)
{
    if (*seen->foreign)
        return rg_error("device '%s': %s is for another processor than this raingauge; unpack the "
                        "packages for this one into %s",
                        device, seen->foreign, path);
    if (*seen->manifest)
        return rg_unsupported("device '%s': %s names a library that is not in %s; unpack the "
                              "package that has it there too",
                              device, seen->manifest, path);
    return rg_unsupported("device '%s': %s has no driver of %s, which has %s below usr/ or the "
                          "folder itself; unpack the package that has one there",
                          device, path, api,
                          !strcmp(api, "vulkan") ? "a file share/vulkan/icd.d/*.json"
                          : !strcmp(api, "gl")   ? "libEGL_mesa.so.0 among its libraries"
                                                 : "a file etc/OpenCL/vendors/*.icd");
}

bool rg_prefix_read(const char *device, const char *api, const char *path, struct rg_prefix *prefix)
{
    struct seen seen = {.foreign = ""}, other = {.foreign = ""};
    struct stat what;
    *prefix = (struct rg_prefix){.folder_count = 0};
    if (!realpath(path, prefix->path) || stat(prefix->path, &what) || !S_ISDIR(what.st_mode))
        return rg_error("device '%s': DRIVER=%s is no folder; name the one that a driver's "
                        "packages were unpacked into",
                        device, path);
    for (int i = 0; folders[i]; i++)
        for_each(prefix, folders[i], add_folder, NULL);
    for (size_t i = 0; i < sizeof(places) / sizeof(*places); i++) {
        const struct place_seen at = {&places[i], strcmp(places[i].api, api) ? &other : &seen};
        for_each(prefix, places[i].pattern, add_manifest, &at);
    }
    add_egl(prefix, strcmp(api, "gl") ? &other : &seen);
    return driver_of(prefix, api) || tell_none(device, api, path, &seen);
}

// --- variables ---

static void append(char list[], size_t size, const char *path)
{
    const size_t used = strlen(list);
    if (*path)
        snprintf(list + used, size - used, "%s%s", used ? ":" : "", path);
}

// Copies a driver's manifest with its library's path.
static bool copy_manifest(const struct rg_prefix_driver *driver, const char *folder, int number,
                          char copy[PATH_MAX])
{
    struct rg_manifest m = {.path = "raingauge.json"};
    char named[PATH_MAX + 128];
    if (*driver->manifest)
        rg_manifest_read(driver->manifest, &m);
    const char *slash = strrchr(m.path, '/');
    snprintf(named, sizeof(named), "%s/%s-%02d-%.80s", folder, driver->api, number,
             slash ? slash + 1 : m.path);
    if (strlen(named) >= PATH_MAX)
        return rg_error("%s: is too long a path; set XDG_CACHE_HOME to a shorter one", folder);
    memcpy(copy, named, strlen(named) + 1);
    return rg_manifest_write(&m, driver->library, copy);
}

static bool is_vendor(const char *library)
{
    const char *slash = strrchr(library, '/');
    return strcmp(slash ? slash + 1 : library, "libEGL.so.1") != 0;
}

// Copies an API's manifests and lists them.
static bool list_manifests(const struct rg_prefix *prefix, const char *api, const char *folder,
                           char list[], size_t size)
{
    *list = 0;
    for (int i = 0; i < prefix->driver_count; i++) {
        const struct rg_prefix_driver *driver = &prefix->drivers[i];
        char copy[PATH_MAX];
        if (strcmp(driver->api, api) != 0 || !is_vendor(driver->library))
            continue;
        if (!copy_manifest(driver, folder, i, copy))
            return false;
        append(list, size, copy);
    }
    return true;
}

// A folder in one of the prefix's library folders, such as "dri"; "": there is none.
static void find_below(const struct rg_prefix *prefix, const char *name, char found[PATH_MAX])
{
    *found = 0;
    for (int i = 0; !*found && i < prefix->folder_count; i++) {
        char path[PATH_MAX + 16];
        snprintf(path, sizeof(path), "%s/%s", prefix->folders[i], name);
        if (!access(path, F_OK) && strlen(path) < PATH_MAX)
            memcpy(found, path, strlen(path) + 1);
    }
}

static bool set_folder(const struct rg_prefix *prefix, const char *name, const char *variable,
                       struct rg_worker_variables *variables)
{
    char path[PATH_MAX];
    find_below(prefix, name, path);
    return !*path || rg_variables_set(variables, variable, path);
}

// The prefix's folders come before those that the worker has already.
static bool set_libraries(const struct rg_prefix *prefix, char list[], size_t size,
                          struct rg_worker_variables *variables)
{
    const char *before = rg_variables_find(variables, "LD_LIBRARY_PATH");
    *list = 0;
    for (int i = 0; i < prefix->folder_count; i++)
        append(list, size, prefix->folders[i]);
    append(list, size, before ? before : "");
    return !*list || rg_variables_set(variables, "LD_LIBRARY_PATH", list);
}

bool rg_prefix_set(const struct rg_prefix *prefix, const char *folder,
                   struct rg_worker_variables *variables)
{
    enum { SIZE = RG_PREFIX_DRIVERS * PATH_MAX };
    char *list = malloc(SIZE);
    bool ok = list && list_manifests(prefix, "vulkan", folder, list, SIZE) &&
              (!*list || (rg_variables_set(variables, "VK_DRIVER_FILES", list) &&
                          rg_variables_set(variables, "VK_ICD_FILENAMES", list)));
    ok = ok && list_manifests(prefix, "gl", folder, list, SIZE) &&
         (!*list || rg_variables_set(variables, "__EGL_VENDOR_LIBRARY_FILENAMES", list));
    ok = ok && list_manifests(prefix, "opencl", folder, list, SIZE) &&
         (!*list || (rg_variables_set(variables, "OCL_ICD_VENDORS", folder) &&
                     rg_variables_set(variables, "OCL_ICD_FILENAMES", "")));
    ok = ok && set_libraries(prefix, list, SIZE, variables) &&
         set_folder(prefix, "dri", "LIBGL_DRIVERS_PATH", variables) &&
         set_folder(prefix, "gbm", "GBM_BACKENDS_PATH", variables);
    free(list);
    return ok;
}
