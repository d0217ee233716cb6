// The readers and writers of each file format, which io.c calls. They put errors into `why` and log
// nothing.
#ifndef RG_CORE_IMAGE_FILES_FORMAT_H
#define RG_CORE_IMAGE_FILES_FORMAT_H

#include "core/image/files/options.h"
#include "core/image/files/why.h"
#include "core/image/picture.h"

bool rg_exr_read(const char *path, int64_t file_bytes, struct rg_picture *picture,
                 struct rg_why *why);
bool rg_exr_write(const char *path, const struct rg_picture *picture,
                  const struct rg_write_options *options, struct rg_why *why);

bool rg_png_read(const char *path, int64_t file_bytes, struct rg_picture *picture,
                 struct rg_why *why);
// The same for a file without colours: values are codes over the largest code, without a curve.
bool rg_png_read_codes(const char *path, int64_t file_bytes, struct rg_picture *picture,
                       struct rg_why *why);
bool rg_png_write(const char *path, const struct rg_picture *picture,
                  const struct rg_write_options *options, struct rg_why *why);

// Reads HDR and TIFF, and EXR files that exr.c cannot read. The writer takes the format from
// `extension`, since `path` is a temporary name.
bool rg_oiio_read(const char *path, int64_t file_bytes, struct rg_picture *picture,
                  struct rg_why *why);
// Takes the reply of the reader's process (core/image/reader/reply.h) for a file of `file_bytes`.
// The process was told to return at most `most_bytes` of texels. The picture may hold texels even
// if the reply turns out to be cut; the caller destroys it in either case.
bool rg_oiio_take_reply(const void *reply, size_t bytes, int64_t file_bytes, int64_t most_bytes,
                        struct rg_picture *picture, struct rg_why *why);
bool rg_oiio_write_hdr(const char *path, const struct rg_picture *picture,
                       const struct rg_write_options *options, struct rg_why *why);
bool rg_oiio_write_tiff(const char *path, const struct rg_picture *picture,
                        const struct rg_write_options *options, struct rg_why *why);

#endif
