#include "core/image/files/io.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/log.h"
#include "core/base/text/plain.h"
#include "core/image/extras.h"
#include "core/image/files/disk.h"
#include "core/image/files/format.h"
#include "core/image/files/temporary.h"

static const struct {
    const char *extension;
    double least_pixel_bytes; // lower bound for drawn pictures; docs/reliability.md has sizes
    bool (*read)(const char *, int64_t, struct rg_picture *, struct rg_why *);
    bool (*write)(const char *, const struct rg_picture *, const struct rg_write_options *,
                  struct rg_why *);
} formats[] = {
    {"exr", 0.3, rg_exr_read, rg_exr_write},
    {"png", 0.1, rg_png_read, rg_png_write},
    {"hdr", 0.3, rg_oiio_read, rg_oiio_write_hdr},
    {"tif", 0.25, rg_oiio_read, rg_oiio_write_tiff},
    {"tiff", 0.25, rg_oiio_read, rg_oiio_write_tiff},
};

// The index into formats, or -1 with `why` set.
static int find_format(const char *path, struct rg_why *why)
{
    const char *name = strrchr(path, '/');
    name = name ? name + 1 : path;
    const char *dot = strrchr(name, '.');
    for (size_t i = 0; dot && i < sizeof(formats) / sizeof(formats[0]); i++)
        if (!strcasecmp(dot + 1, formats[i].extension))
            return (int)i;
    rg_why_set(why, "the extension %s%s%s; use .exr, .png, .hdr or .tif", dot ? "\"" : "is missing",
               dot ? dot : "", dot ? "\" is not a known picture's" : "");
    return -1;
}

static bool examine(const char *path, int64_t *bytes, struct rg_why *why)
{
    struct stat st;
    if (stat(path, &st))
        return rg_why_system(why, errno, "%s; %s", strerror(errno),
                             errno == ENOENT ? "check the name" : "check the path");
    if (S_ISDIR(st.st_mode))
        return rg_why_set(why, "is a folder; name a picture file in it");
    if (!S_ISREG(st.st_mode))
        return rg_why_set(why, "is not a regular file; copy the picture to one");
    if (access(path, R_OK))
        return rg_why_system(why, errno, "%s; change the file's permissions", strerror(errno));
    if (st.st_size == 0)
        return rg_why_set(why, "is empty; write it again");
    *bytes = st.st_size;
    return true;
}

static bool read_file(const char *path, struct rg_picture *picture, struct rg_why *why)
{
    memset(picture, 0, sizeof(*picture));
    int64_t bytes = 0;
    int format = find_format(path, why);
    return format >= 0 && examine(path, &bytes, why) &&
           formats[format].read(path, bytes, picture, why);
}

// Whether a path occurs earlier in the list, so that a file that is read twice is warned of once.
static bool was_named_before(const char *const *paths, int index)
{
    for (int i = 0; i < index; i++)
        if (!strcmp(paths[i], paths[index]))
            return true;
    return false;
}

static void warn_of_nonfinite(const char *path, const struct rg_picture *picture)
{
    int64_t count = 0, first = -1, values = rg_picture_values(picture);
    const float *texels = picture->texels;
    for (int64_t start = 0; start < values; start += 4096) {
        int64_t end = start + 4096 < values ? start + 4096 : values;
        int bad = 0;
        for (int64_t i = start; i < end; i++)
            bad += texels[i] - texels[i] != 0.0f;
        for (int64_t i = start; bad && first < 0 && i < end; i++)
            if (texels[i] - texels[i] != 0.0f)
                first = i;
        count += bad;
    }
    if (count)
        rg_warning("%s: %lld values are NaN or infinite, the first at x %lld, y %lld", path,
                   (long long)count, (long long)(first / picture->channels % picture->width),
                   (long long)(first / picture->channels / picture->width));
}

bool rg_pictures_read(const char *const *paths, struct rg_picture *pictures, int count)
{
    struct rg_why *why = calloc((size_t)count, sizeof(*why));
    if (!why)
        return rg_harness_error("%s: no memory to read it", paths[0]);
    int failed = 0;
#pragma omp parallel for schedule(dynamic) reduction(+ : failed) if (count > 1)
    for (int i = 0; i < count; i++)
        failed += !read_file(paths[i], &pictures[i], &why[i]);
    bool told = false;
    for (int i = 0; i < count; i++) {
        if (failed && pictures[i].texels == NULL && !told)
            told = !rg_why_tell(&why[i], paths[i]);
        if (failed)
            rg_picture_destroy(&pictures[i]);
        else if (!was_named_before(paths, i))
            warn_of_nonfinite(paths[i], &pictures[i]);
    }
    free(why);
    return !failed;
}

static void warn_of_extras(const char *path, const struct rg_picture *picture)
{
    char names[200] = "";
    struct rg_extra extra;
    for (const char *at = picture->extras; rg_extras_next(&at, &extra);) {
        const size_t length = strlen(names);
        snprintf(names + length, sizeof(names) - length, "%s%.*s", length ? ", " : "",
                 extra.name_length, extra.name);
    }
    rg_plain(names);
    if (*names)
        rg_warning("%s: what it holds besides is not used: %s", path, names);
}

bool rg_picture_read(const char *path, struct rg_picture *picture)
{
    const bool good = rg_pictures_read(&path, picture, 1);
    if (good)
        warn_of_extras(path, picture);
    return good;
}

int64_t rg_picture_file_bytes(const char *path, int64_t pixels)
{
    struct rg_why why;
    const int format = find_format(path, &why);
    return format < 0 ? 0 : (int64_t)((double)pixels * formats[format].least_pixel_bytes);
}

bool rg_picture_can_be_written(const char *path, int64_t pixels)
{
    struct rg_why why;
    return (find_format(path, &why) >= 0 && rg_temporary_try(path, &why) &&
            rg_disk_has_room(path, rg_picture_file_bytes(path, pixels), &why)) ||
           rg_why_tell(&why, path);
}

bool rg_picture_write(const char *path, const struct rg_picture *picture,
                      const struct rg_write_options *options)
{
    struct rg_why why;
    struct rg_write_options with = *options;
    if (with.exposure == 0.0f)
        with.exposure = 1.0f;
    struct rg_temporary temporary;
    int format = find_format(path, &why);
    if (format < 0 || !rg_temporary_make(path, &temporary, &why))
        return rg_why_tell(&why, path);
    const bool written = formats[format].write(temporary.path, picture, &with, &why);
    return rg_temporary_end(&temporary, written, &why) || rg_why_tell(&why, path);
}
