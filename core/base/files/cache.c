#include "core/base/files/cache.h"

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

bool rg_cache_path(const char *name, char *path, size_t size, char why[256])
{
    const char *cache = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    int length;
    if (cache && cache[0] == '/')
        length = snprintf(path, size, "%s/raingauge/%s", cache, name);
    else if (home && home[0] == '/')
        length = snprintf(path, size, "%s/.cache/raingauge/%s", home, name);
    else
        return because(why, "neither XDG_CACHE_HOME nor HOME names a folder; set one");
    return (size_t)length < size ||
           because(why, "the path of the cache is too long; set XDG_CACHE_HOME to a shorter one");
}

bool rg_cache_make_folders(const char *path, char why[256])
{
    char part[PATH_MAX];
    for (const char *slash = strchr(path + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
        snprintf(part, sizeof(part), "%.*s", (int)(slash - path), path);
        if (mkdir(part, 0700) && errno != EEXIST && errno != EROFS && errno != EACCES)
            return because(why, "%s: %s", part, strerror(errno));
    }
    return true;
}
