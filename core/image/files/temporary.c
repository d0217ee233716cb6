#include "core/image/files/temporary.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool rg_temporary_make(const char *path, char *temporary, size_t size, struct rg_why *why)
{
    struct stat st;
    if (!stat(path, &st) && !S_ISREG(st.st_mode))
        return rg_why_set(why, S_ISDIR(st.st_mode) ? "is a folder; name a file in it"
                                                   : "is not a regular file; name another");
    for (int attempt = 0; attempt < 100; attempt++) {
        if (snprintf(temporary, size, "%s.%ld-%d.tmp", path, (long)getpid(), attempt) >= (int)size)
            return rg_why_set(why, "the path is too long; choose a shorter one");
        int fd = open(temporary, O_WRONLY | O_CREAT | O_EXCL, 0666);
        if (fd >= 0) {
            close(fd);
            return true;
        }
        if (errno == ENOENT || errno == ENOTDIR)
            return rg_why_set(why, "its folder is not there; make it first");
        if (errno != EEXIST)
            return rg_why_set(why, "cannot be written: %s; choose another folder", strerror(errno));
    }
    return rg_why_set(why, "temporary files of this name are in the way; remove them");
}

bool rg_temporary_end(const char *temporary, const char *path, bool written, struct rg_why *why)
{
    if (written && rename(temporary, path))
        written = rg_why_set(why, "cannot be put in place: %s", strerror(errno));
    if (!written)
        unlink(temporary);
    return written;
}

bool rg_temporary_try(const char *path, struct rg_why *why)
{
    char temporary[PATH_MAX];
    if (!rg_temporary_make(path, temporary, sizeof(temporary), why))
        return false;
    rg_temporary_end(temporary, path, false, why);
    return true;
}
