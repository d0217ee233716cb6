#define _GNU_SOURCE // memfd_create, mkostemp
#include "core/base/files/nameless.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

// Creates a named file and unlinks it, which works on every file system.
static int open_in(const char *folder)
{
    char path[PATH_MAX];
    if (snprintf(path, sizeof(path), "%s/raingauge-XXXXXX", folder) >= (int)sizeof(path))
        return -1;
    const int fd = mkostemp(path, O_CLOEXEC);
    if (fd >= 0)
        unlink(path);
    return fd;
}

int rg_file_nameless(char why[RG_NAMELESS_WHY])
{
    const char *const folders[] = {getenv("TMPDIR"), "/tmp", "/dev/shm", "."};
    int fd = memfd_create("raingauge", MFD_CLOEXEC);
    const int refused = errno;
    const bool has_room = refused != EMFILE && refused != ENFILE;
    for (size_t i = 0; fd < 0 && has_room && i < sizeof(folders) / sizeof(folders[0]); i++)
        if (folders[i] && *folders[i])
            fd = open_in(folders[i]);
    if (fd < 0 && !has_room)
        snprintf(why, RG_NAMELESS_WHY, "%s; allow more open files (ulimit -n)", strerror(refused));
    else if (fd < 0)
        snprintf(why, RG_NAMELESS_WHY,
                 "no file in memory (memfd_create: %s), nor in TMPDIR, /tmp, /dev/shm or this "
                 "folder (%s); set TMPDIR to a folder that takes files",
                 strerror(refused), strerror(errno));
    return fd;
}
