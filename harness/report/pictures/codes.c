#define _GNU_SOURCE // memmem
#include "harness/report/pictures/codes.h"

#include <png.h>
#include <stdlib.h>
#include <string.h>
#include <webp/encode.h>
#include <xxhash.h>

// A lower level writes larger files, by a tenth at level 2; a higher one takes longer for nothing.
enum { LEVEL = 4 };

static bool is_held(const png_image *image)
{
    return !(image->format & PNG_FORMAT_FLAG_LINEAR) && image->width <= WEBP_MAX_DIMENSION &&
           image->height <= WEBP_MAX_DIMENSION;
}

bool rg_codes_of_png(const void *png, size_t size, struct rg_codes *codes)
{
    png_image image = {.version = PNG_IMAGE_VERSION};
    *codes = (struct rg_codes){0};
    if (memmem(png, size, "acTL", 4)) // frames of an animation
        return false;
    if (!png_image_begin_read_from_memory(&image, png, size) || !is_held(&image)) {
        png_image_free(&image);
        return false;
    }
    image.format = PNG_FORMAT_RGBA;
    *codes = (struct rg_codes){(int)image.width, (int)image.height,
                               malloc((size_t)PNG_IMAGE_SIZE(image))};
    if (codes->texels && png_image_finish_read(&image, NULL, codes->texels, 0, NULL))
        return true;
    png_image_free(&image);
    rg_codes_free(codes);
    return false;
}

void rg_codes_free(struct rg_codes *codes)
{
    free(codes->texels);
    codes->texels = NULL;
}

uint64_t rg_codes_digest(const struct rg_codes *codes)
{
    const uint64_t seed = (uint64_t)codes->width << 32 | (uint32_t)codes->height;
    return XXH3_64bits_withSeed(codes->texels, (size_t)codes->width * (size_t)codes->height * 4,
                                seed);
}

uint8_t *rg_codes_webp(const struct rg_codes *codes, size_t *size)
{
    WebPConfig config;
    WebPPicture picture;
    WebPMemoryWriter writer;
    WebPMemoryWriterInit(&writer);
    bool ok = WebPConfigInit(&config) && WebPConfigLosslessPreset(&config, LEVEL) &&
              WebPPictureInit(&picture);
    if (!ok)
        return NULL;
    config.exact = 1; // colours stay where alpha is 0
    picture.use_argb = 1;
    picture.width = codes->width;
    picture.height = codes->height;
    picture.writer = WebPMemoryWrite;
    picture.custom_ptr = &writer;
    ok = WebPPictureImportRGBA(&picture, codes->texels, 4 * codes->width) &&
         WebPEncode(&config, &picture);
    WebPPictureFree(&picture);
    if (ok) {
        *size = writer.size;
        return writer.mem;
    }
    WebPMemoryWriterClear(&writer);
    return NULL;
}
