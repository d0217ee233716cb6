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
#include "core/base/text/mark.h"

#define SMALL_BYTES (1 << 18)

static const char *judge(const struct stat *st)
{
    return S_ISREG(st->st_mode)   ? NULL
           : S_ISDIR(st->st_mode) ? "is a folder"
                                  : "is not a regular file";
}

// Opens regular files only: some devices act as soon as they are opened. A file that was replaced
// by something else meanwhile is closed again.
static FILE *stream(const char *path, int flags, const char *mode, const char **why)
{
    struct stat st;
    int error = EINVAL;
    *why = stat(path, &st) ? NULL : judge(&st);
    const int fd = *why ? -1 : open(path, flags | O_NONBLOCK | O_NOCTTY | O_CLOEXEC, 0666);
    if (!*why && (fd < 0 || fstat(fd, &st)))
        *why = strerror(error = errno);
    else if (!*why)
        *why = judge(&st);
    FILE *file = *why ? NULL : fdopen(fd, mode);
    if (!file && !*why)
        *why = strerror(error = errno);
    if (!file && fd >= 0)
        close(fd);
    if (!file)
        errno = error;
    return file;
}

FILE *rg_file_open(const char *path, const char **why)
{
    return stream(path, O_RDONLY, "rb", why);
}

FILE *rg_file_open_text(const char *path, const char **why)
{
    char start[4];
    FILE *file = rg_file_open(path, why);
    const size_t got = file ? fread(start, 1, 3, file) : 0;
    if (file && fseek(file, (long)rg_mark_bytes(start, got), SEEK_SET)) {
        *why = strerror(errno);
        fclose(file);
        return NULL;
    }
    return file;
}

FILE *rg_file_open_small(const char *path, const char **why)
{
    struct stat st;
    FILE *file = rg_file_open_text(path, why);
    if (file && !fstat(fileno(file), &st) && st.st_size <= SMALL_BYTES)
        return file;
    if (file) {
        *why = "has more than 256 KiB";
        fclose(file);
        errno = EINVAL;
    }
    return NULL;
}

// --- shared folders ---

// Splits a path: fills `folder` and returns the name in it. NULL if the path is too long.
static const char *split(const char *path, char folder[PATH_MAX])
{
    const char *slash = strrchr(path, '/');
    const int length = slash ? (int)(slash - path) + 1 : 0;
    return snprintf(folder, PATH_MAX, "%.*s.", length, path) < PATH_MAX ? path + length : NULL;
}

// Whether nobody else can have put this file in the user's way. Either the user or the folder's
// owner owns it, or the folder is not shared (sticky and writable by all). The kernel has the same
// rule (fs.protected_symlinks and others), if it is switched on.
static bool is_trusted(const char *path, const struct stat *st)
{
    char folder[PATH_MAX];
    struct stat in;
    const mode_t shared = S_ISVTX | S_IWOTH;
    return st->st_uid == geteuid() || !split(path, folder) || stat(folder, &in) ||
           (in.st_mode & shared) != shared || st->st_uid == in.st_uid;
}

// Resolves the links at the end of a path.
static bool follow(const char *path, char target[PATH_MAX], const char **why)
{
    enum { MOST_LINKS = 40 }; // the kernel's limit
    struct stat st;
    char to[PATH_MAX], folder[PATH_MAX];
    snprintf(target, PATH_MAX, "%s", path);
    for (int links = 0; !lstat(target, &st) && S_ISLNK(st.st_mode); links++) {
        const ssize_t length = readlink(target, to, sizeof(to) - 1);
        *why = links == MOST_LINKS ? strerror(ELOOP)
               : length < 0        ? strerror(errno)
               : is_trusted(target, &st)
                   ? NULL
                   : "is or goes through a link that another user has put into a folder for all";
        if (*why)
            return false;
        to[length] = 0;
        const size_t used = *to == '/' || !split(target, folder) ? 0 : strlen(folder) - 1;
        if (snprintf(target, PATH_MAX, "%.*s%s", (int)used, folder, to) >= PATH_MAX)
            return *why = strerror(ENAMETOOLONG), false;
    }
    return true;
}

bool rg_file_follow(const char *path, char target[PATH_MAX], const char **why)
{
    char folder[PATH_MAX];
    if (strlen(path) >= PATH_MAX || !split(path, folder))
        return *why = strerror(ENAMETOOLONG), false;
    const size_t length = strlen(folder);
    if (length > 2)
        folder[length - 2] = 0; // drops "/.", which would hide a link
    return (length <= 2 || follow(folder, target, why)) && follow(path, target, why);
}

FILE *rg_file_append(const char *path, const char **why)
{
    const int flags = O_WRONLY | O_APPEND | O_CREAT | O_NOFOLLOW;
    char target[PATH_MAX];
    struct stat st;
    FILE *file = rg_file_follow(path, target, why) ? stream(target, flags, "a", why) : NULL;
    if (!file || fstat(fileno(file), &st) || is_trusted(target, &st))
        return file;
    *why = "is a file of another user in a folder for all";
    fclose(file);
    errno = EINVAL;
    return NULL;
}

bool rg_file_copy(int from, int to)
{
    char bytes[1 << 16];
    ssize_t got;
    for (off_t at = 0; (got = pread(from, bytes, sizeof(bytes), at)) > 0;) {
        const ssize_t put = write(to, bytes, (size_t)got);
        if (put < 0)
            return false;
        at += put;
    }
    return !got;
}

static bool lead_to_one(const char *a, const char *b)
{
    struct stat of_a, of_b;
    return !stat(a, &of_a) && !stat(b, &of_b) && of_a.st_dev == of_b.st_dev &&
           of_a.st_ino == of_b.st_ino;
}

bool rg_file_is_same(const char *a, const char *b)
{
    char folder_a[PATH_MAX], folder_b[PATH_MAX];
    if (!strcmp(a, b) || lead_to_one(a, b))
        return true;
    // A missing file has no inode, so its folder and name are compared.
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
