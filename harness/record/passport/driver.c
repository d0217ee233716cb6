#include "harness/record/passport/driver.h"

#include <limits.h>
#include <string.h>
#include <unistd.h>

#include "core/base/text/plain.h"
#include "harness/record/named.h"

// A path relative to the current folder, if it is in it.
static const char *from_here(const char *path)
{
    char here[PATH_MAX];
    const size_t length = getcwd(here, sizeof(here)) ? strlen(here) : 0;
    const bool is_below = length > 1 && !strncmp(path, here, length) && path[length] == '/';
    return is_below ? path + length + 1 : path;
}

void rg_driver_line(const struct rg_device_info *info, char line[RG_DRIVER_LINE])
{
    size_t used = (size_t)snprintf(line, RG_DRIVER_LINE, "%s", info->name);
    if (*info->full && strcmp(info->name, info->full) != 0)
        used += (size_t)snprintf(line + used, RG_DRIVER_LINE - used, " (%s)", info->full);
    used += (size_t)snprintf(line + used, RG_DRIVER_LINE - used, ": %s", info->driver);
    for (int i = 0; i < RG_DRIVER_LIBRARIES && *info->libraries[i].path; i++)
        if (used < RG_DRIVER_LINE)
            used += (size_t)snprintf(line + used, RG_DRIVER_LINE - used, "%s %s, build id %s",
                                     i ? ", with" : ",", from_here(info->libraries[i].path),
                                     info->libraries[i].build);
    rg_plain(line);
    for (char *c = strstr(line, "##["); c; c = strstr(c, "##["))
        c[2] = '('; // "##[" anywhere in a line is a command to GitHub's logs
}

void rg_drivers_print(const struct rg_device_info *const infos[], int count, FILE *out)
{
    char line[RG_DRIVER_LINE];
    for (int i = 0; i < count; i++) {
        rg_driver_line(infos[i], line);
        fprintf(out, "%s\n", line);
    }
}

// The path to store and send: for the program its file name only, because its folder names a user.
static const char *kept_path(const struct rg_device_info *info, const char *path)
{
    const char *slash = strrchr(path, '/');
    return !strncmp(info->full, "cpu", 3) && slash ? slash + 1 : path;
}

void rg_driver_put(json_t *device, const struct rg_device_info *info)
{
    json_t *libraries = json_array();
    for (int i = 0; i < RG_DRIVER_LIBRARIES && *info->libraries[i].path; i++) {
        const struct rg_library *library = &info->libraries[i];
        json_array_append_new(libraries, json_pack("{so so}", "path",
                                                   rg_json_text(kept_path(info, library->path)),
                                                   "build", rg_json_text(library->build)));
    }
    if (*info->full && strcmp(info->name, info->full) != 0)
        json_object_set_new(device, "full", rg_json_text(info->full));
    json_object_set_new(device, "libraries", libraries);
}
