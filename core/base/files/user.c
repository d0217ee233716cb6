#include "core/base/files/user.h"

#include <errno.h>
#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

__attribute__((format(printf, 2, 3))) static bool because(char why[256], const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(why, 256, format, args);
    va_end(args);
    return false;
}

bool rg_user_path(enum rg_user_folder folder, const char *name, char *path, size_t size,
                  char why[256])
{
    static const struct {
        const char *variable, *in_home;
    } folders[] = {[RG_USER_CACHE] = {"XDG_CACHE_HOME", ".cache"},
                   [RG_USER_STATE] = {"XDG_STATE_HOME", ".local/state"}};
    const char *variable = folders[folder].variable;
    const char *named = getenv(variable), *home = getenv("HOME");
    int length;
    if (named && named[0] == '/')
        length = snprintf(path, size, "%s/raingauge/%s", named, name);
    else if (home && home[0] == '/')
        length = snprintf(path, size, "%s/%s/raingauge/%s", home, folders[folder].in_home, name);
    else
        return because(why, "neither %s nor HOME names a folder; set one", variable);
    return (size_t)length < size ||
           because(why, "its path is too long; set %s to a shorter one", variable);
}

bool rg_user_make_folders(const char *path, char why[256])
{
    char part[PATH_MAX];
    for (const char *slash = strchr(path + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
        snprintf(part, sizeof(part), "%.*s", (int)(slash - path), path);
        if (mkdir(part, 0700) && errno != EEXIST && errno != EROFS && errno != EACCES)
            return because(why, "%s: %s", part, strerror(errno));
    }
    return true;
}
