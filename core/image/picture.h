// A picture in memory: read from a file, written to one, or compared.
#ifndef RG_CORE_IMAGE_PICTURE_H
#define RG_CORE_IMAGE_PICTURE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Limits; a larger picture is refused before memory is taken.
#define RG_PICTURE_MAX_SIDE_PX 65536
#define RG_PICTURE_MAX_BYTES   ((int64_t)16 << 30)

// Texels are linear light, row 0 on top, tightly packed: texels[(y * width + x) * channels + c].
// Channels: 1 grey; 2 grey, alpha; 3 red, green, blue; 4 red, green, blue, alpha. Reading and
// writing do not multiply colours by alpha. The owner calls rg_picture_destroy.
struct rg_picture {
    int width, height, channels;
    float *texels;
    bool decoded;       // read from integer codes, which were made linear
    bool is_associated; // read from a file whose colours are already multiplied by alpha
    double gamma;       // light is code^gamma of the codes read; 0: sRGB's curve
    char *extras;       // other contents of the file (core/image/extras.h); NULL: none; owned
};

// Makes a picture of undefined texels. False for a size outside the limits or when memory runs out,
// with one logged line that has the size and `name` (a file or a role); `picture` is then zeroed.
bool rg_picture_create(struct rg_picture *picture, int width, int height, int channels,
                       const char *name);

// The bytes that this many pictures of 4 channels take together, including the copy of one
// picture's texels in the memory shared with the device's process.
int64_t rg_pictures_bytes(int width, int height, int count);
// Whether memory for this many pictures may be taken (core/base/memory.h); asked before any is
// drawn. False, and one logged line.
bool rg_pictures_fit(int width, int height, int count);

// Frees the texels and zeroes the struct. NULL and a zeroed struct are accepted.
void rg_picture_destroy(struct rg_picture *picture);

// As rg_picture_create, but puts the reason of a failure into `why` instead of logging it, so that
// several files can be read at once and log one line.
bool rg_picture_allocate(struct rg_picture *picture, int64_t width, int64_t height,
                         int64_t channels, char *why, size_t why_size);

// Whether the picture has alpha that is not 1 everywhere.
bool rg_picture_is_see_through(const struct rg_picture *picture);

// Gives a picture as many channels as the other has, in place, without changing its look: grey
// becomes red, green and blue, and an alpha of 1 is added. False, and one logged line, when memory
// runs out.
bool rg_picture_widen(struct rg_picture *picture, const struct rg_picture *other, const char *name);

// Drops an alpha that is 1 everywhere, in place: files get smaller, and HDR cannot hold alpha.
void rg_picture_drop_opaque_alpha(struct rg_picture *picture);

static inline int64_t rg_picture_values(const struct rg_picture *picture)
{
    return (int64_t)picture->width * picture->height * picture->channels;
}

// The number of colour channels; the rest is alpha.
static inline int rg_picture_colours(const struct rg_picture *picture)
{
    return picture->channels > 2 ? 3 : 1;
}

#endif
