#include "harness/record/output.h"

#include <ctype.h>
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/image/files/disk.h"
#include "core/image/files/temporary.h"

static bool write_all(int fd, const char *text, size_t left)
{
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

// Makes a folder if it is missing; `made` says whether it was.
static bool make_folder(const char *folder, bool *made)
{
    *made = mkdir(folder, 0777) == 0;
    return *made || errno == EEXIST ||
           rg_system_error(errno, "%s: cannot be made: %s; name a folder that can be written",
                           folder, strerror(errno));
}

bool rg_output_folder(const char *folder)
{
    bool made;
    return make_folder(folder, &made);
}

// Tries a file in the folder, or, if the folder does not exist yet, a file in its place.
bool rg_output_can_be_written(const char *folder, int64_t bytes)
{
    char path[2048];
    struct rg_why why;
    struct stat st;
    const bool is_there = !stat(folder, &st);
    size_t length = strlen(folder);
    while (!is_there && length > 1 && folder[length - 1] == '/')
        length--;
    if (snprintf(path, sizeof(path), "%.*s%s", (int)length, folder, is_there ? "/result" : "") >=
        (int)sizeof(path))
        return rg_error("%.80s...: its name is too long", folder);
    return (rg_temporary_try(path, &why) && rg_disk_has_room(path, bytes, &why)) ||
           rg_why_tell(&why, folder);
}

bool rg_output_file_can_be_written(const char *path, int64_t bytes)
{
    struct rg_why why;
    return (rg_temporary_try(path, &why) && rg_disk_has_room(path, bytes, &why)) ||
           rg_why_tell(&why, path);
}

bool rg_output_can_be_replaced(const char *folder, const char *name)
{
    char path[2048];
    struct rg_why why;
    struct stat st;
    if (snprintf(path, sizeof(path), "%s/%s", folder, name) >= (int)sizeof(path))
        return rg_error("%.80s...: its name is too long", folder);
    return lstat(path, &st) || rg_temporary_try(path, &why) || rg_why_tell(&why, path);
}

// A file that is written but not yet renamed into place.
struct pending {
    char path[2048];
    bool is_open;
    struct rg_temporary temporary;
};

static bool begin(const char *folder, const struct rg_output_file *file, struct pending *pending)
{
    struct rg_why why;
    pending->is_open = false;
    if (snprintf(pending->path, sizeof(pending->path), "%s/%s", folder, file->name) >=
        (int)sizeof(pending->path))
        return rg_error("%.80s...: its name is too long; name a folder of at most %zu bytes",
                        folder, sizeof(pending->path) - strlen(file->name) - 2);
    if (!rg_temporary_make(pending->path, &pending->temporary, &why))
        return rg_why_tell(&why, pending->path);
    pending->is_open = true;
    const size_t size = file->size ? file->size : strlen(file->text);
    return write_all(pending->temporary.fd, file->text, size) ||
           rg_system_error(errno, "%s: cannot be written: %s; nothing was changed", pending->path,
                           strerror(errno));
}

static bool end(struct pending *pending, bool written)
{
    struct rg_why why;
    pending->is_open = false;
    return rg_temporary_end(&pending->temporary, written, &why) ||
           (written && rg_why_tell(&why, pending->path));
}

bool rg_output_write_set(const char *folder, const struct rg_output_file *files, int count)
{
    struct pending *pending = rg_alloc(RG_MAX_OUTPUT_FILES, sizeof(*pending), "files");
    bool made = false, ok = pending && make_folder(folder, &made);
    int begun = 0;
    for (; ok && begun < count && begun < RG_MAX_OUTPUT_FILES; begun++)
        ok = begin(folder, &files[begun], &pending[begun]);
    for (int i = 0; ok && i < begun; i++)
        ok = end(&pending[i], true);
    for (int i = 0; !ok && i < begun; i++)
        if (pending[i].is_open)
            end(&pending[i], false);
    if (!ok && made)
        rmdir(folder);
    free(pending);
    return ok;
}

bool rg_output_write(const char *folder, const char *name, const char *text)
{
    return rg_output_write_set(folder, &(struct rg_output_file){name, text, 0}, 1);
}

bool rg_output_write_file(const char *path, const char *text)
{
    char folder[2048];
    const char *slash = strrchr(path, '/');
    const int length = slash ? (int)(slash - path) + 1 : 1;
    if (length >= (int)sizeof(folder))
        return rg_error("%.80s...: its name is too long", path);
    snprintf(folder, sizeof(folder), "%.*s", length, slash ? path : ".");
    return rg_output_write(folder, slash ? slash + 1 : path, text);
}

void rg_output_part(const char *name, char part[RG_OUTPUT_PART])
{
    enum { KEPT = 100 };
    snprintf(part, RG_OUTPUT_PART, "%.*s", KEPT, name);
    bool is_plain = strlen(name) <= KEPT;
    for (char *c = part; *c; c++)
        if (!isalnum((unsigned char)*c) && !strchr("-.", *c)) {
            is_plain = is_plain && *c == ':'; // "cpu:reference"
            *c = '_';
        }
    if (!is_plain)
        sprintf(part + strlen(part), "_%016" PRIx64, (uint64_t)XXH3_64bits(name, strlen(name)));
}
