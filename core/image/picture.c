#define _DEFAULT_SOURCE // madvise
#include "core/image/picture.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

#include "core/base/log.h"
#include "core/base/memory.h"

// Large pictures ask for huge pages, because touching their memory for the first time otherwise
// takes a tenth of a comparison's time.
static float *allocate_texels(size_t bytes)
{
    const size_t huge_page = (size_t)2 << 20;
    if (bytes < 4 * huge_page)
        return malloc(bytes);
    size_t rounded = (bytes + huge_page - 1) / huge_page * huge_page;
    float *texels = aligned_alloc(huge_page, rounded);
#ifdef MADV_HUGEPAGE
    if (texels)
        madvise(texels, rounded, MADV_HUGEPAGE); // only advice; ignoring it does no harm
#endif
    return texels;
}

bool rg_picture_allocate(struct rg_picture *picture, int64_t width, int64_t height,
                         int64_t channels, char *why, size_t why_size)
{
    memset(picture, 0, sizeof(*picture));
    errno = EINVAL;
    if (width < 1 || height < 1 || channels < 1 || channels > 4) {
        snprintf(why, why_size,
                 "%lld x %lld pixels of %lld channels is no picture; it needs a pixel, and 1 to 4 "
                 "channels",
                 (long long)width, (long long)height, (long long)channels);
        return false;
    }
    if (width > RG_PICTURE_MAX_SIDE_PX || height > RG_PICTURE_MAX_SIDE_PX ||
        width * height * channels * 4 > RG_PICTURE_MAX_BYTES) {
        snprintf(why, why_size,
                 "%lld x %lld pixels of %lld channels is above the limit of %d pixels a side and "
                 "16 GiB; crop it",
                 (long long)width, (long long)height, (long long)channels, RG_PICTURE_MAX_SIDE_PX);
        return false;
    }
    int64_t bytes = width * height * channels * 4;
    float *texels = rg_memory_allows(bytes) ? allocate_texels((size_t)bytes) : NULL;
    if (!texels) {
        errno = ENOMEM;
        snprintf(why, why_size,
                 "no memory for %lld x %lld pixels (%lld MiB); make it smaller, or allow more with "
                 "--memory",
                 (long long)width, (long long)height, (long long)(bytes >> 20));
        return false;
    }
    *picture = (struct rg_picture){
        .width = (int)width, .height = (int)height, .channels = (int)channels, .texels = texels};
    return true;
}

bool rg_picture_create(struct rg_picture *picture, int width, int height, int channels,
                       const char *name)
{
    char why[256];
    if (!rg_picture_allocate(picture, width, height, channels, why, sizeof(why)))
        return rg_system_error(errno, "%s: %s", name, why);
    return true;
}

int64_t rg_pictures_bytes(int width, int height, int count)
{
    const int64_t texel_bytes = 4 * sizeof(float), half_texel_bytes = 4 * 2;
    return (int64_t)width * height * (count * texel_bytes + 2 * half_texel_bytes);
}

bool rg_pictures_fit(int width, int height, int count)
{
    const int64_t bytes = rg_pictures_bytes(width, height, count);
    char begin[64];
    snprintf(begin, sizeof(begin), "room for %d picture%s of %dx%d", count, count > 1 ? "s" : "",
             width, height);
    return rg_memory_allows(bytes) || rg_memory_refuse(begin, bytes, "a smaller --size");
}

void rg_picture_destroy(struct rg_picture *picture)
{
    if (!picture)
        return;
    free(picture->texels);
    free(picture->extras);
    memset(picture, 0, sizeof(*picture));
}

bool rg_picture_is_see_through(const struct rg_picture *picture)
{
    const int64_t pixels = (int64_t)picture->width * picture->height;
    const int channels = picture->channels, colours = rg_picture_colours(picture);
    for (int64_t i = 0; colours < channels && i < pixels; i++)
        if (picture->texels[i * channels + colours] != 1.0f)
            return true;
    return false;
}

bool rg_picture_widen(struct rg_picture *picture, const struct rg_picture *other, const char *name)
{
    const int own = rg_picture_colours(picture), others = rg_picture_colours(other);
    const bool has_alpha = picture->channels > own, is_alpha_wanted = other->channels > others;
    const int colours = own > others ? own : others;
    const int channels = colours + (has_alpha || is_alpha_wanted);
    struct rg_picture wide;
    if (channels == picture->channels)
        return true;
    if (!rg_picture_create(&wide, picture->width, picture->height, channels, name))
        return false;
    const int64_t pixels = (int64_t)picture->width * picture->height;
    const float *from = picture->texels;
    float *to = wide.texels;
    for (int64_t i = 0; i < pixels; i++, from += picture->channels, to += channels) {
        for (int c = 0; c < colours; c++)
            to[c] = from[own > 1 ? c : 0]; // NOLINT: without memory there is no picture
        if (channels > colours)
            to[colours] = has_alpha ? from[own] : 1.0f;
    }
    free(picture->texels);
    picture->texels = wide.texels;
    picture->channels = channels;
    return true;
}

void rg_picture_drop_opaque_alpha(struct rg_picture *picture)
{
    const int64_t pixels = (int64_t)picture->width * picture->height;
    const int channels = picture->channels, colours = rg_picture_colours(picture);
    if (colours == channels || rg_picture_is_see_through(picture))
        return;
    for (int64_t i = 0; i < pixels; i++)
        for (int c = 0; c < colours; c++)
            picture->texels[i * colours + c] = picture->texels[i * channels + c];
    picture->channels = colours;
}
