#include "harness/devices/drivers/apart.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/base/text/add.h"
#include "harness/devices/drivers/choice.h"
#include "harness/devices/workers/environment.h"

static const char *const choosing[] = {"DRIVER",
                                       "VK_DRIVER_FILES",
                                       "VK_ICD_FILENAMES",
                                       "VK_ADD_DRIVER_FILES",
                                       "__EGL_VENDOR_LIBRARY_FILENAMES",
                                       "__EGL_VENDOR_LIBRARY_DIRS",
                                       "LIBGL_DRIVERS_PATH",
                                       "OCL_ICD_VENDORS",
                                       "OCL_ICD_FILENAMES",
                                       "LD_LIBRARY_PATH",
                                       NULL};

static const char *value_of(const char *environment, const char *variable)
{
    const char *own = rg_environment_find(environment, variable);
    const char *value = own || !strcmp(variable, "DRIVER") ? own : getenv(variable);
    return value ? value : "";
}

// The variable by which two names choose different drivers; NULL: none.
static const char *find_difference(const char *a, const char *b)
{
    for (int i = 0; choosing[i]; i++)
        if (strcmp(value_of(a, choosing[i]), value_of(b, choosing[i])) != 0)
            return choosing[i];
    return NULL;
}

static bool are_of_one_api(const char *a, const char *b)
{
    const size_t length = strcspn(a, ":@");
    return length == strcspn(b, ":@") && !strncmp(a, b, length) && strncmp(a, "cpu", length) != 0;
}

bool rg_drivers_are_chosen_apart(const char *a, const char *settings_a, const char *b,
                                 const char *settings_b)
{
    return are_of_one_api(a, b) && find_difference(settings_a, settings_b);
}

static bool chooses(const char *variable, size_t length)
{
    bool any = false;
    for (int i = 0; choosing[i]; i++)
        any = any || (strlen(choosing[i]) == length && !strncmp(choosing[i], variable, length));
    return any;
}

// Adds what differs of the variables in `named`, without those in `told`.
static void add_settings(const char *named, const char *told, const char *now, const char *then,
                         char *text, size_t size)
{
    for (const char *v = named; *v; v += strlen(v) + 1) {
        char key[128];
        const size_t length = strcspn(v, "=");
        snprintf(key, sizeof(key), "%.*s", (int)length, v);
        const char *is = value_of(now, key), *was = value_of(then, key);
        if (!chooses(v, length) && !rg_environment_find(told, key) && strcmp(is, was) != 0)
            rg_text_add(text, size, "; ", "%s %s and not %s", key, *is ? is : "unset",
                        *was ? was : "unset");
    }
}

void rg_drivers_settings(const char *now, const char *then, char *text, size_t size)
{
    *text = 0;
    add_settings(now, "", now, then, text, size);
    add_settings(then, now, now, then, text, size);
}

static bool is_all(const struct rg_device_info *a, const struct rg_device_info *b, bool by_build)
{
    bool all = *a->libraries[0].path && *b->libraries[0].path;
    for (int i = 0; all && i < RG_DRIVER_LIBRARIES; i++) {
        const struct rg_library *of_a = &a->libraries[i], *of_b = &b->libraries[i];
        all = !*of_a->path && !*of_b->path ? true
              : by_build                   ? !strcmp(of_a->build, of_b->build)
                                           : rg_library_is_same(of_a, of_b);
    }
    return all;
}

// Guesses the prefix of a folder of libraries; "PREFIX" if unclear.
static void guess_prefix(const char *libraries, char prefix[PATH_MAX])
{
    const char *end = strstr(libraries, "/usr/lib");
    end = end ? end : strstr(libraries, "/lib");
    snprintf(prefix, PATH_MAX, "%.*s", end && end > libraries ? (int)(end - libraries) : 6,
             end && end > libraries ? libraries : "PREFIX");
}

// Explains why a variable did not choose another driver, and what would.
static bool tell_same(const struct rg_device_info *a, const struct rg_device_info *b,
                      const char *variable, const char *api, const char *value)
{
    char prefix[PATH_MAX];
    guess_prefix(value, prefix);
    if (!strcmp(variable, "LD_LIBRARY_PATH"))
        return rg_error("devices '%s' and '%s' run one driver, %s: LD_LIBRARY_PATH alone chooses "
                        "none, for the system's own files name it; write '%s@DRIVER=%s'",
                        a->name, b->name, a->libraries[0].path, api, prefix);
    return rg_error("devices '%s' and '%s' run one driver, %s, though they name it differently by "
                    "%s; name the other one, or " RG_MEND_PREFIX,
                    a->name, b->name, a->libraries[0].path, variable, api);
}

bool rg_drivers_are_apart(const struct rg_device_info *a, const char *settings_a,
                          const struct rg_device_info *b, const char *settings_b)
{
    if (!are_of_one_api(a->full, b->full))
        return true;
    const char *variable = find_difference(settings_a, settings_b);
    char api[32];
    snprintf(api, sizeof(api), "%.*s", (int)strcspn(a->full, ":@"), a->full);
    if (variable && is_all(a, b, false))
        return tell_same(
            a, b, variable, api,
            value_of(*value_of(settings_b, variable) ? settings_b : settings_a, variable));
    if (variable && is_all(a, b, true))
        rg_warning("devices '%s' and '%s' run one build of a driver from two files, %s and %s",
                   a->name, b->name, a->libraries[0].path, b->libraries[0].path);
    return true;
}
