#include <errno.h>
#include <png.h>
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/image/files/format.h"
#include "core/image/files/png_beside.h"
#include "core/image/srgb.h"

// State of one read or write. libpng reports errors by longjmp, so the state lives outside the
// functions that a jump leaves.
struct png_job {
    png_structp png;
    png_infop info;
    FILE *file;
    png_byte *bytes;
    png_bytep *rows;
    struct rg_png_beside beside;
    struct rg_why *why;
};

static void on_error(png_structp png, png_const_charp message)
{
    struct png_job *job = png_get_error_ptr(png);
    const bool is_disks = ferror(job->file) != 0;
    const int error = is_disks ? errno : 0;
    rg_why_system(job->why, error, "PNG: %s%s%s", message, is_disks ? ": " : "; write it again",
                  is_disks ? strerror(error) : "");
    longjmp(png_jmpbuf(png), 1);
}

static void on_warning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

static void release(struct png_job *job)
{
    if (job->file)
        fclose(job->file);
    free(job->bytes);
    free(job->rows);
    rg_png_beside_release(&job->beside);
}

// One deflated byte expands to at most 1032, so that a header that promises more is damaged and
// gets no memory.
static bool plausible(int64_t file_bytes, int64_t raw_bytes, struct rg_why *why)
{
    if (raw_bytes / 1040 <= file_bytes)
        return true;
    return rg_why_set(why,
                      "promises %lld MiB of pixels, more than its %lld bytes can hold; write "
                      "it again",
                      (long long)(raw_bytes >> 20), (long long)file_bytes);
}

// Makes room for 8- or 16-bit rows; false with `why` set.
static bool allocate_rows(struct png_job *job, size_t row_bytes, size_t height)
{
    job->bytes = malloc(row_bytes * height);
    job->rows = malloc(height * sizeof(*job->rows));
    if (!job->bytes || !job->rows)
        return rg_why_system(job->why, ENOMEM, "no memory for its rows; make it smaller");
    for (size_t y = 0; y < height; y++)
        job->rows[y] = job->bytes + y * row_bytes;
    return true;
}

static bool read_rows(struct png_job *job, int64_t file_bytes, struct rg_picture *picture)
{
    if (setjmp(png_jmpbuf(job->png)))
        return false;
    png_set_user_limits(job->png, RG_PICTURE_MAX_SIDE_PX, RG_PICTURE_MAX_SIDE_PX);
    png_set_chunk_malloc_max(job->png, (png_alloc_size_t)file_bytes); // frames may be large
    rg_png_beside_collect(&job->beside, job->png);
    png_init_io(job->png, job->file);
    png_read_info(job->png, job->info);
    int64_t height = png_get_image_height(job->png, job->info);
    if (!plausible(file_bytes, (int64_t)png_get_rowbytes(job->png, job->info) * height, job->why))
        return false;
    png_set_expand(job->png);
    if (png_get_bit_depth(job->png, job->info) == 16)
        png_set_swap(job->png);
    png_set_interlace_handling(job->png);
    png_read_update_info(job->png, job->info);
    size_t row_bytes = png_get_rowbytes(job->png, job->info);
    return rg_why_allocate(picture, png_get_image_width(job->png, job->info), height,
                           png_get_channels(job->png, job->info), job->why) &&
           allocate_rows(job, row_bytes, (size_t)height) &&
           (png_read_image(job->png, job->rows), png_read_end(job->png, job->info), true);
}

static void decode8(const png_byte *codes, const float *light, struct rg_picture *picture)
{
    int channels = picture->channels, colours = rg_picture_colours(picture);
    int64_t texels = (int64_t)picture->width * picture->height;
    float *to = picture->texels;
    if (channels == 3 || channels == 1) {
        for (int64_t i = 0; i < texels * channels; i++)
            to[i] = light[codes[i]];
        return;
    }
    for (int64_t i = 0; i < texels; i++, codes += channels, to += channels) {
        for (int c = 0; c < colours; c++)
            to[c] = light[codes[c]];
        to[colours] = codes[colours] / 255.0f;
    }
}

static void decode16(const png_byte *bytes, const float *light, struct rg_picture *picture)
{
    const uint16_t *codes = (const uint16_t *)(const void *)bytes;
    int colours = rg_picture_colours(picture);
    int64_t values = rg_picture_values(picture);
    for (int64_t i = 0; i < values; i++)
        picture->texels[i] =
            i % picture->channels < colours ? light[codes[i]] : codes[i] / 65535.0f;
}

static bool decode(const struct png_job *job, bool wide, struct rg_picture *picture)
{
    if (!rg_png_beside_tell(&job->beside, picture))
        return rg_why_system(job->why, ENOMEM, "no memory for what it holds besides");
    float *light = rg_light_of_codes(wide ? 65536 : 256, picture->gamma);
    if (!light)
        return rg_why_system(job->why, ENOMEM, "no memory for its curve");
    if (wide)
        decode16(job->bytes, light, picture);
    else
        decode8(job->bytes, light, picture);
    free(light);
    return true;
}

// Keeps codes over the largest code, without a curve.
static void keep_codes(const png_byte *bytes, bool wide, struct rg_picture *picture)
{
    const uint16_t *codes = (const uint16_t *)(const void *)bytes;
    const int64_t values = rg_picture_values(picture);
    for (int64_t i = 0; i < values; i++)
        picture->texels[i] = wide ? codes[i] / 65535.0f : bytes[i] / 255.0f;
}

static bool read_png(const char *path, int64_t file_bytes, bool curve, struct rg_picture *picture,
                     struct rg_why *why)
{
    struct png_job job = {.file = fopen(path, "rb"), .why = why};
    if (!job.file)
        return rg_why_system(why, errno, "%s; check the path", strerror(errno));
    job.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &job, on_error, on_warning);
    job.info = job.png ? png_create_info_struct(job.png) : NULL;
    bool good = job.info ? read_rows(&job, file_bytes, picture)
                         : rg_why_system(why, ENOMEM, "no memory for the PNG reader");
    const bool wide = good && png_get_bit_depth(job.png, job.info) == 16;
    if (good && !curve)
        keep_codes(job.bytes, wide, picture);
    else if (good)
        good = decode(&job, wide, picture);
    picture->decoded = good && curve;
    png_destroy_read_struct(&job.png, &job.info, NULL);
    release(&job);
    if (!good)
        rg_picture_destroy(picture);
    return good;
}

bool rg_png_read(const char *path, int64_t file_bytes, struct rg_picture *picture,
                 struct rg_why *why)
{
    return read_png(path, file_bytes, true, picture, why);
}

bool rg_png_read_codes(const char *path, int64_t file_bytes, struct rg_picture *picture,
                       struct rg_why *why)
{
    return read_png(path, file_bytes, false, picture, why);
}

static void encode_row(const struct rg_picture *picture, int y, float exposure, png_byte *codes)
{
    const struct rg_srgb *srgb = rg_srgb();
    int channels = picture->channels, colours = rg_picture_colours(picture);
    const float *from = picture->texels + (int64_t)y * picture->width * channels;
    for (int x = 0; x < picture->width; x++, from += channels, codes += channels) {
        for (int c = 0; c < colours; c++)
            codes[c] = rg_srgb_code(srgb, from[c] * exposure);
        if (channels > colours)
            codes[colours] = rg_alpha_code(from[colours]);
    }
}

static bool write_rows(struct png_job *job, const struct rg_picture *picture, float exposure)
{
    static const int types[] = {0, PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA,
                                PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGB_ALPHA};
    job->bytes = malloc((size_t)picture->width * (size_t)picture->channels);
    if (!job->bytes)
        return rg_why_system(job->why, ENOMEM, "no memory for its rows");
    if (setjmp(png_jmpbuf(job->png)))
        return false;
    png_init_io(job->png, job->file);
    // Level 3 writes four times as fast as the default and makes a tenth more bytes.
    png_set_compression_level(job->png, 3);
    png_set_IHDR(job->png, job->info, (png_uint_32)picture->width, (png_uint_32)picture->height, 8,
                 types[picture->channels], PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB_gAMA_and_cHRM(job->png, job->info, PNG_sRGB_INTENT_RELATIVE);
    png_write_info(job->png, job->info);
    for (int y = 0; y < picture->height; y++) {
        encode_row(picture, y, exposure, job->bytes);
        png_write_row(job->png, job->bytes);
    }
    png_write_end(job->png, NULL);
    return true;
}

bool rg_png_write(const char *path, const struct rg_picture *picture,
                  const struct rg_write_options *options, struct rg_why *why)
{
    struct png_job job = {.file = fopen(path, "wb"), .why = why};
    if (!job.file)
        return rg_why_system(why, errno, "cannot be written: %s", strerror(errno));
    job.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &job, on_error, on_warning);
    job.info = job.png ? png_create_info_struct(job.png) : NULL;
    bool good = job.info ? write_rows(&job, picture, options->exposure)
                         : rg_why_system(why, ENOMEM, "no memory for the PNG writer");
    png_destroy_write_struct(&job.png, &job.info);
    if (fclose(job.file) && good)
        good = rg_why_unwritten(why, strerror(errno));
    job.file = NULL;
    release(&job);
    return good;
}
