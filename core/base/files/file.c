#include "core/base/files/file.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/log.h"

#define SMALL_BYTES (1 << 18)

static const char *judge(const struct stat *st)
{
    return S_ISREG(st->st_mode)   ? NULL
           : S_ISDIR(st->st_mode) ? "is a folder"
                                  : "is not a regular file";
}

// Opens a regular file. All else is not even opened, for some devices act as soon as they are; what
// took its place meanwhile is closed again.
static FILE *stream(const char *path, int flags, const char *mode, const char **why)
{
    struct stat st;
    *why = stat(path, &st) ? NULL : judge(&st);
    const int fd = *why ? -1 : open(path, flags | O_NONBLOCK | O_NOCTTY | O_CLOEXEC, 0666);
    if (!*why)
        *why = fd < 0 || fstat(fd, &st) ? strerror(errno) : judge(&st);
    FILE *file = *why ? NULL : fdopen(fd, mode);
    if (!file && !*why)
        *why = strerror(errno);
    if (!file && fd >= 0)
        close(fd);
    return file;
}

FILE *rg_file_open(const char *path, const char **why)
{
    return stream(path, O_RDONLY, "rb", why);
}

FILE *rg_file_open_small(const char *path, const char **why)
{
    struct stat st;
    FILE *file = rg_file_open(path, why);
    if (file && !fstat(fileno(file), &st) && st.st_size <= SMALL_BYTES)
        return file;
    if (file) {
        *why = "has more than 256 KiB";
        fclose(file);
    }
    return NULL;
}

FILE *rg_file_append(const char *path, const char **why)
{
    return stream(path, O_WRONLY | O_APPEND | O_CREAT, "a", why);
}

static bool lead_to_one(const char *a, const char *b)
{
    struct stat of_a, of_b;
    return !stat(a, &of_a) && !stat(b, &of_b) && of_a.st_dev == of_b.st_dev &&
           of_a.st_ino == of_b.st_ino;
}

// The folder in which a path lies, and returns its name there. NULL where it is too long.
static const char *split(const char *path, char folder[PATH_MAX])
{
    const char *slash = strrchr(path, '/');
    const int length = slash ? (int)(slash - path) + 1 : 0;
    return snprintf(folder, PATH_MAX, "%.*s.", length, path) < PATH_MAX ? path + length : NULL;
}

bool rg_file_is_same(const char *a, const char *b)
{
    char folder_a[PATH_MAX], folder_b[PATH_MAX];
    if (!strcmp(a, b) || lead_to_one(a, b))
        return true;
    // What is not there has no inode, but its folder has.
    const char *name_a = split(a, folder_a), *name_b = split(b, folder_b);
    return name_a && name_b && !strcmp(name_a, name_b) && lead_to_one(folder_a, folder_b);
}

bool rg_file_spares(const char *path, const char *read)
{
    return !read || !rg_file_is_same(path, read) ||
           rg_error("%s: would be overwritten, and is read as '%s'; name another with -o", path,
                    read);
}

bool rg_file_is_in(const char *path, const char *folder)
{
    char found[PATH_MAX];
    struct stat st;
    if (!realpath(path, found) || stat(found, &st))
        return false;
    char *slash = S_ISDIR(st.st_mode) ? NULL : strrchr(found, '/');
    if (slash)
        slash[slash == found] = 0;
    return rg_file_is_same(found, folder);
}
