#include "core/base/files/file.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char *judge(int fd)
{
    struct stat st;
    if (fd < 0 || fstat(fd, &st)) // a socket cannot even be opened
        return errno == ENXIO ? "is not a regular file" : strerror(errno);
    return S_ISREG(st.st_mode)   ? NULL
           : S_ISDIR(st.st_mode) ? "is a folder"
                                 : "is not a regular file";
}

FILE *rg_file_open(const char *path, const char **why)
{
    const int fd = open(path, O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    *why = judge(fd);
    FILE *file = *why ? NULL : fdopen(fd, "rb");
    if (!file && fd >= 0)
        close(fd);
    if (!file && !*why)
        *why = strerror(errno);
    return file;
}
