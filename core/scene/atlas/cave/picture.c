#include "core/scene/atlas/cave/picture.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/image/files/format.h"
#include "core/scene/atlas/levels.h"

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

bool rg_cave_read_picture(const char *path, int width, int height, bool is_mirrored, float *texels,
                          struct rg_cave_why *why)
{
    struct stat st;
    struct rg_why reason;
    struct rg_picture picture = {0};
    if (stat(path, &st))
        return rg_cave_refuse(why, "%s: %s; name the folder that holds the whole database", path,
                              strerror(errno));
    if (!rg_png_read_codes(path, st.st_size, &picture, &reason))
        return rg_cave_refuse(why, "%s: %s", path, reason.text);
    const bool good = check_size(path, &picture, width, height, why);
    // the first channel alone: the pictures are grey, or nearly
    const size_t pixels = (size_t)picture.width * (size_t)picture.height;
    for (size_t i = 0; good && i < pixels; i++)
        picture.texels[i] = picture.texels[i * (size_t)picture.channels];
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
