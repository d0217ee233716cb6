// What io.c asks of one file format. Everything here reports into `why`, a sentence without the
// file's name, and logs nothing.
#ifndef RG_CORE_IMAGE_FORMAT_H
#define RG_CORE_IMAGE_FORMAT_H

#include "core/image/files/io.h"

struct rg_why {
    char text[512];
};

// Sets the sentence and returns false.
bool rg_why_set(struct rg_why *why, const char *format, ...) __attribute__((format(printf, 2, 3)));

bool rg_exr_read(const char *path, int64_t file_bytes, struct rg_picture *picture,
                 struct rg_why *why);
bool rg_exr_write(const char *path, const struct rg_picture *picture,
                  const struct rg_write_options *options, struct rg_why *why);

bool rg_png_read(const char *path, int64_t file_bytes, struct rg_picture *picture,
                 struct rg_why *why);
// The same of a file that holds no colours: values are codes over the largest code, without a
// curve.
bool rg_png_read_codes(const char *path, int64_t file_bytes, struct rg_picture *picture,
                       struct rg_why *why);
bool rg_png_write(const char *path, const struct rg_picture *picture,
                  const struct rg_write_options *options, struct rg_why *why);

// HDR and TIFF. The writer takes the format from `extension`, since `path` is a temporary name.
bool rg_oiio_read(const char *path, int64_t file_bytes, struct rg_picture *picture,
                  struct rg_why *why);
bool rg_oiio_write_hdr(const char *path, const struct rg_picture *picture,
                       const struct rg_write_options *options, struct rg_why *why);
bool rg_oiio_write_tiff(const char *path, const struct rg_picture *picture,
                        const struct rg_write_options *options, struct rg_why *why);

#endif
