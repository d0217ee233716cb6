#include "core/image/files/disk.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <sys/statvfs.h>

#include "core/base/memory.h"

bool rg_disk_has_room(const char *path, int64_t bytes, struct rg_why *why)
{
    char folder[PATH_MAX], wanted[RG_MEMORY_TEXT], left[RG_MEMORY_TEXT];
    const char *slash = strrchr(path, '/');
    struct statvfs disk;
    snprintf(folder, sizeof(folder), "%.*s", slash ? (int)(slash - path) + 1 : 1,
             slash ? path : ".");
    if (statvfs(folder, &disk))
        return true;
    const double free_bytes = (double)disk.f_bavail * (double)disk.f_frsize;
    return (double)bytes <= free_bytes ||
           rg_why_system(why, ENOSPC,
                         "the disk has %s left, and at least %s are to be written; make room, or "
                         "choose another folder",
                         rg_memory_text((int64_t)free_bytes, left), rg_memory_text(bytes, wanted));
}
