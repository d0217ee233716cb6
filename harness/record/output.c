#include "harness/record/output.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/log.h"

static bool write_all(int fd, const char *text)
{
    size_t left = strlen(text);
    while (left > 0) {
        ssize_t written = write(fd, text, left);
        if (written < 0 && errno == EINTR)
            continue;
        if (written <= 0)
            return false;
        text += written;
        left -= (size_t)written;
    }
    return fsync(fd) == 0 || errno == EINVAL;
}

// mkstemp makes files that only the owner reads: gives the file the permissions of any other.
static bool open_up(int fd)
{
    const mode_t mask = umask(0);
    umask(mask);
    return fchmod(fd, 0666 & ~mask) == 0;
}

// Makes a folder unless it is there; `made` says whether it was made.
static bool make_folder(const char *folder, bool *made)
{
    *made = mkdir(folder, 0777) == 0;
    return *made || errno == EEXIST ||
           rg_error("%s: cannot be made: %s; name a folder that can be written", folder,
                    strerror(errno));
}

bool rg_output_folder(const char *folder)
{
    bool made;
    return make_folder(folder, &made);
}

bool rg_output_write(const char *folder, const char *name, const char *text)
{
    char path[2048], temporary[2112];
    bool made;
    if (!make_folder(folder, &made))
        return false;
    if (snprintf(path, sizeof(path), "%s/%s", folder, name) >= (int)sizeof(path))
        return rg_error("%.80s...: its name is too long; name a folder of at most %zu bytes",
                        folder, sizeof(path) - strlen(name) - 2);
    snprintf(temporary, sizeof(temporary), "%s.XXXXXX", path);
    int fd = mkstemp(temporary);
    if (fd < 0)
        return rg_error("%s: cannot be written: %s; name a folder that can be written", path,
                        strerror(errno));
    bool ok = write_all(fd, text) && open_up(fd);
    ok = close(fd) == 0 && ok;
    ok = ok && rename(temporary, path) == 0;
    if (ok)
        return true;
    rg_error("%s: cannot be written: %s; nothing was changed", path, strerror(errno));
    unlink(temporary);
    if (made)
        rmdir(folder);
    return false;
}
