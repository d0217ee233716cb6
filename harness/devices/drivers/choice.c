#include "harness/devices/drivers/choice.h"

#include <glob.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "harness/devices/workers/environment.h"

// --- the names' choice ---

// Variables that name manifests, by API; the first one set counts.
static const struct {
    const char *api, *variable;
    const char *pattern; // for files in a folder
} manifests[] = {
    {"vulkan", "VK_DRIVER_FILES", "*.json"},
    {"vulkan", "VK_ICD_FILENAMES", "*.json"},
    {"vulkan", "VK_ADD_DRIVER_FILES", "*.json"},
    {"gl", "__EGL_VENDOR_LIBRARY_FILENAMES", "*.json"},
    {"gl", "__EGL_VENDOR_LIBRARY_DIRS", "*.json"},
    {"opencl", "OCL_ICD_VENDORS", "*.icd"},
};

static void add_manifest(struct rg_choice *c, const char *path)
{
    if (c->count < RG_CHOICE_MANIFESTS)
        rg_manifest_read(path, &c->manifests[c->count++]);
}

// Adds a file, or all files in a folder.
static void add_named(struct rg_choice *c, const char *path, const char *pattern)
{
    struct stat what;
    char whole[PATH_MAX + 16];
    glob_t found;
    if (stat(path, &what) || !S_ISDIR(what.st_mode)) {
        add_manifest(c, path);
        return;
    }
    snprintf(whole, sizeof(whole), "%s/%s", path, pattern);
    if (!glob(whole, 0, NULL, &found))
        for (size_t i = 0; i < found.gl_pathc; i++)
            add_manifest(c, found.gl_pathv[i]);
    globfree(&found);
}

static void read_named(struct rg_choice *c)
{
    const char *list = NULL, *pattern = NULL;
    for (size_t i = 0; !list && i < sizeof(manifests) / sizeof(*manifests); i++) {
        if (strcmp(manifests[i].api, c->api) != 0)
            continue;
        c->variable = manifests[i].variable;
        pattern = manifests[i].pattern;
        list = rg_environment_find(c->environment, c->variable);
    }
    if (!list)
        c->variable = NULL;
    while (list && *list) {
        char path[PATH_MAX];
        const size_t length = strcspn(list, ":");
        snprintf(path, sizeof(path), "%.*s", (int)length, list);
        if (length)
            add_named(c, path, pattern);
        list += length + (list[length] == ':');
    }
}

// --- messages ---

static bool refuse_manifest(const struct rg_choice *c, const struct rg_manifest *m)
{
    const char *device = c->name;
    if (m->fault == RG_MANIFEST_ABSENT)
        return rg_unsupported("device '%s': %s names %s, which is not there; name a driver's file, "
                              "or " RG_MEND_PREFIX,
                              device, c->variable, m->path, c->api);
    if (m->fault == RG_MANIFEST_NO_LIBRARY)
        return rg_setup_error("device '%s': %s names the library %s, which is not there; mend its "
                              "library_path, or " RG_MEND_PREFIX,
                              device, m->path, m->library, c->api);
    return rg_setup_error("device '%s': %s is no driver's file, which has a library_path; name "
                          "another one, or " RG_MEND_PREFIX,
                          device, m->path, c->api);
}

// As for the loaders, one good manifest is enough.
static bool are_manifests_well(const struct rg_choice *c)
{
    bool any = !c->count;
    for (int i = 0; !any && i < c->count; i++)
        any = c->manifests[i].fault == RG_MANIFEST_WELL;
    return any || refuse_manifest(c, &c->manifests[0]);
}

static bool read_driver(struct rg_choice *c)
{
    const char *device = c->name;
    c->driver = rg_environment_find(c->environment, "DRIVER");
    if (!c->driver)
        return true;
    if (c->variable)
        return rg_error("device '%s': both DRIVER and %s name a driver; leave one of them out",
                        device, c->variable);
    if (!strcmp(c->api, "cpu"))
        return rg_error("device '%s': cpu has no driver; RG_PROGRAM names another build of "
                        "raingauge",
                        device);
    return rg_prefix_read(device, c->api, c->driver, &c->prefix);
}

struct rg_choice *rg_choice_read(const struct rg_asked *asked)
{
    struct rg_choice *c = rg_alloc(1, sizeof(*c), asked->name);
    if (!c)
        return NULL;
    c->name = asked->name;
    c->environment = asked->environment;
    snprintf(c->api, sizeof(c->api), "%.*s", (int)strcspn(asked->full, ":@"), asked->full);
    read_named(c);
    if (read_driver(c) && are_manifests_well(c))
        return c;
    rg_choice_free(c);
    return NULL;
}

void rg_choice_free(struct rg_choice *c)
{
    free(c);
}

bool rg_choice_set(const struct rg_choice *c, const char *folder, struct rg_worker_variables *v)
{
    bool ok = true;
    for (const char *own = c->environment; ok && *own; own += strlen(own) + 1) {
        const size_t length = strcspn(own, "=");
        char key[RG_DEVICE_NAME_SIZE];
        snprintf(key, sizeof(key), "%.*s", (int)length, own);
        ok = (c->driver && !strcmp(key, "DRIVER")) || rg_variables_set(v, key, own + length + 1);
    }
    if (!ok)
        return rg_harness_error("device '%s': no memory for its variables", c->name);
    return !c->driver || rg_prefix_set(&c->prefix, folder, v);
}

// --- the loaded files ---

int rg_choice_libraries(const struct rg_choice *c, const char **libraries, int max)
{
    int count = 0;
    for (int i = 0; i < c->count && count < max; i++)
        if (c->manifests[i].fault == RG_MANIFEST_WELL)
            libraries[count++] = c->manifests[i].library;
    for (int i = 0; i < c->prefix.driver_count && count < max; i++)
        if (!strcmp(c->prefix.drivers[i].api, c->api))
            libraries[count++] = c->prefix.drivers[i].library;
    return count;
}

bool rg_choice_refuse(const struct rg_choice *c, const char *why)
{
    const char *library = "its library";
    rg_choice_libraries(c, &library, 1);
    if (c->driver)
        return rg_setup_error("device '%s': %s cannot be loaded: %s; install the package that has "
                              "what is missing, or unpack it into %s",
                              c->name, library, why, c->driver);
    return rg_setup_error("device '%s': the library that %s names cannot be loaded: %s; add the "
                          "folder of what is missing by LD_LIBRARY_PATH, or " RG_MEND_PREFIX,
                          c->name, c->manifests[0].path, why, c->api);
}

// Whether a library of the device is this file, after following links.
static bool runs_file(const struct rg_device_info *info, const char *path)
{
    char *real = realpath(path, NULL);
    bool any = false;
    for (int i = 0; real && i < RG_DRIVER_LIBRARIES; i++)
        any = any || !strcmp(info->libraries[i].path, real);
    free(real);
    return any;
}

static bool is_in_prefix(const struct rg_choice *c, const struct rg_device_info *info)
{
    const struct rg_library *driver = &info->libraries[0];
    bool any = !*driver->path || rg_path_is_below(driver->path, c->prefix.path);
    for (int i = 0; !any && i < c->prefix.driver_count; i++)
        any = runs_file(info, c->prefix.drivers[i].library);
    return any ||
           rg_error("device '%s': its driver is %s, and not one of %s; unpack all packages of the "
                    "driver there",
                    c->name, driver->path, c->driver);
}

// Whether the named driver runs. A manifest in one tree may lead to a library of another: by a bare
// name, which is found in the system's folders, or by a path.
bool rg_choice_is_met(const struct rg_choice *c, const struct rg_device_info *info)
{
    const struct rg_library *driver = &info->libraries[0];
    const struct rg_manifest *strayed = NULL;
    char tree[PATH_MAX], of_strayed[PATH_MAX] = "";
    if (c->driver)
        return is_in_prefix(c, info);
    for (int i = 0; *driver->path && i < c->count; i++) {
        rg_manifest_tree(c->manifests[i].path, tree);
        if (!*tree || rg_path_is_below(driver->path, tree))
            return true;
        if (!strayed)
            memcpy(of_strayed, tree, PATH_MAX);
        strayed = strayed ? strayed : &c->manifests[i];
    }
    return !strayed ||
           rg_error("device '%s': %s is of %s, and the driver that runs is %s: its library_path %s "
                    "%s; write '%s@DRIVER=%s'",
                    c->name, strayed->path, of_strayed, driver->path, strayed->named,
                    strayed->is_bare ? "is a bare name, which is looked for in the system's folders"
                                     : "leads there",
                    c->api, of_strayed);
}
