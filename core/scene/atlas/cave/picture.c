#include "core/scene/atlas/cave/picture.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/base/files/file.h"
#include "core/image/files/format.h"
#include "core/scene/atlas/levels.h"

enum { WIDTHS = 4 }; // the database's: levels 0 to 3

static bool check_size(const char *path, const struct rg_picture *picture, int width, int height,
                       struct rg_cave_why *why)
{
    if (picture->width == width && abs(picture->height - height) <= 2 + height / 50)
        return true;
    return rg_cave_refuse(why, "%s: %d x %d pixels, where the database has %d x %d; copy it again",
                          path, picture->width, picture->height, width, height);
}

static void mirror(float *texels, int width, int height)
{
    for (int r = 0; r < height; r++)
        for (int c = 0; c < width / 2; c++) {
            float *left = &texels[r * width + c], *right = &texels[r * width + width - 1 - c];
            const float kept = *left;
            *left = *right;
            *right = kept;
        }
}

// Reads the first channel of a picture as codes over the largest code; the pictures are grey, or
// nearly.
static bool read_grey(const char *path, struct rg_picture *picture, struct rg_cave_why *why)
{
    struct stat st;
    struct rg_why reason;
    *picture = (struct rg_picture){0};
    if (stat(path, &st))
        return rg_cave_refuse(why, "%s: %s; name the folder that holds the whole database", path,
                              strerror(errno));
    if (!rg_png_read_codes(path, st.st_size, picture, &reason))
        return rg_cave_refuse(why, "%s: %s", path, reason.text);
    const size_t pixels = (size_t)picture->width * (size_t)picture->height;
    for (size_t i = 0; i < pixels; i++)
        picture->texels[i] = picture->texels[i * (size_t)picture->channels];
    return true;
}

bool rg_cave_read_picture(const char *path, int width, int height, bool is_mirrored, float *texels,
                          struct rg_cave_why *why)
{
    struct rg_picture picture;
    if (!read_grey(path, &picture, why))
        return false;
    const bool good = check_size(path, &picture, width, height, why);
    if (good)
        rg_shrink(picture.texels, width, picture.height, texels, width, height);
    if (good && is_mirrored)
        mirror(texels, width, height);
    rg_picture_destroy(&picture);
    return good;
}

float rg_cave_leaning(const float *texels, int width, int height)
{
    double left = 0, right = 0;
    for (int i = 0; i < width * height; i++)
        *(i % width < width / 2 ? &left : &right) += (double)texels[i];
    return left + right > 0 ? (float)((left - right) / (left + right)) : 0;
}

int rg_cave_picture_width(const char *path)
{
    unsigned char head[24]; // the signature, and the first chunk's length, name and width
    const char *why;
    FILE *file = rg_file_open(path, &why);
    const bool is_whole = file && fread(head, 1, sizeof(head), file) == sizeof(head);
    if (file)
        fclose(file);
    return is_whole && !memcmp(head + 1, "PNG", 3) ? head[18] * 256 + head[19] : 0;
}

bool rg_cave_read_any(const char *path, int view, int *level, float *texels,
                      struct rg_cave_why *why)
{
    struct rg_picture picture;
    if (!read_grey(path, &picture, why))
        return false;
    int own = 0;
    while (own < WIDTHS - 1 && RG_ATLAS_CELL_PX >> own > picture.width)
        own++;
    const bool good =
        check_size(path, &picture, RG_ATLAS_CELL_PX >> own, rg_atlas_row_height(view, own), why);
    *level = own > *level ? own : *level;
    if (good)
        rg_shrink(picture.texels, picture.width, picture.height, texels, RG_ATLAS_CELL_PX >> *level,
                  rg_atlas_row_height(view, *level));
    rg_picture_destroy(&picture);
    return good;
}
