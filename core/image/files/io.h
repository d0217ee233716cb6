// Picture files: EXR, PNG, Radiance HDR and TIFF, chosen by the file's extension.
//
// EXR and PNG go through their own C libraries, because pictures are compared all the time and
// OpenImageIO takes a quarter of a second to load (it pulls 260 shared libraries in); the other
// formats, and OpenImageIO's comparison, go through OpenImageIO, loaded when first asked for.
#ifndef RG_CORE_IMAGE_FILES_IO_H
#define RG_CORE_IMAGE_FILES_IO_H

#include "core/image/files/options.h"
#include "core/image/picture.h"

// Reads a file of codes (PNG, TIFF of integers) to linear light: from sRGB, or by the power that a
// PNG's gAMA says; one of floats as it is. Of an EXR this is the display window, 0 where the file
// has no texels; HDR and TIFF are turned upright. What the file holds besides is in the picture's
// extras. A file that cannot be read leaves `picture` zeroed and logs one line: file, what is
// wrong, how to mend it. NaN and infinite texels are kept, with a warning that counts them; what is
// held besides is a warning, too.
bool rg_picture_read(const char *path, struct rg_picture *picture);

// Reads several files at once, on as many threads. All are read or none: then one line is logged.
// Of what they hold besides nothing is said: that is for who compares them.
bool rg_pictures_read(const char *const *paths, struct rg_picture *pictures, int count);

// The least bytes that drawn pictures of so many pixels take in a file of this name; 0 where its
// format is not known. Some take up to twenty times as much.
int64_t rg_picture_file_bytes(const char *path, int64_t pixels);

// Whether pictures of so many pixels together can be written there, as is found out before any
// work: the format is known, the folder is there and takes files, the disk has room. False and one
// logged line.
bool rg_picture_can_be_written(const char *path, int64_t pixels);

// Writes beside `path` and renames, so that a failure leaves nothing behind and what was there
// untouched; it logs one line. The folder has to be there.
bool rg_picture_write(const char *path, const struct rg_picture *picture,
                      const struct rg_write_options *options);

#endif
