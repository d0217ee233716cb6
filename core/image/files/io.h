// Picture files: EXR, PNG, Radiance HDR and TIFF, chosen by the file's extension.
//
// EXR and PNG go through their own C libraries, because OpenImageIO takes a quarter of a second to
// load its 260 shared libraries. The other formats, and OpenImageIO's comparison, load it when they
// first need it.
#ifndef RG_CORE_IMAGE_FILES_IO_H
#define RG_CORE_IMAGE_FILES_IO_H

#include "core/image/files/options.h"
#include "core/image/picture.h"

// Reads a picture. Codes (PNG, TIFF of integers) become linear light: by sRGB's curve, or the power
// in a PNG's gAMA. Floats stay as they are. An EXR's picture is its display window, 0 where the
// file has no texels; HDR and TIFF are turned upright. The file's other contents become the
// picture's extras. On failure `picture` is zeroed and one line logged: file, what is wrong, how to
// mend it. NaN and infinite texels are kept, with a warning that counts them; extras are warned of,
// too.
bool rg_picture_read(const char *path, struct rg_picture *picture);

// Reads several files at once, each on a thread. Either all are read, or none and one line is
// logged. Extras are not logged, because the caller compares them.
bool rg_pictures_read(const char *const *paths, struct rg_picture *pictures, int count);

// A lower bound in bytes for drawn pictures of this many pixels in a file of this name; 0 where its
// format is unknown. Some take up to twenty times as much.
int64_t rg_picture_file_bytes(const char *path, int64_t pixels);

// Whether pictures of this many pixels together can be written there, to be asked before any work:
// the format is known, the folder exists and is writable, the disk has room. False and one logged
// line.
bool rg_picture_can_be_written(const char *path, int64_t pixels);

// Writes a temporary file beside `path` and renames it, so that a failure leaves nothing behind and
// an existing file untouched; a failure logs one line. The folder must exist.
bool rg_picture_write(const char *path, const struct rg_picture *picture,
                      const struct rg_write_options *options);

#endif
