// A picture in memory: what is read from a file, written to one, and compared.
#ifndef RG_CORE_IMAGE_PICTURE_H
#define RG_CORE_IMAGE_PICTURE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Refused above these before memory is taken.
#define RG_PICTURE_MAX_SIDE_PX 65536
#define RG_PICTURE_MAX_BYTES   ((int64_t)16 << 30)

// Texels are linear light, row 0 on top, tightly packed: texels[(y * width + x) * channels + c].
// Channels: 1 grey; 2 grey, alpha; 3 red, green, blue; 4 red, green, blue, alpha. Alpha is not
// multiplied into the colours by reading or writing. The owner calls rg_picture_destroy.
struct rg_picture {
    int width, height, channels;
    float *texels;
    bool decoded;       // read from integer codes, which were made linear
    bool is_associated; // read from a file whose colours are multiplied by alpha already
    double gamma;       // of codes whose curve is a power: light is code^gamma; 0: sRGB's curve
    char *extras;       // what else the file holds (core/image/extras.h); NULL: nothing; owned
};

// Makes a picture of undefined texels. A size outside the limits, or memory that is not there, is
// logged with the size and `name` (a file or a role, for the message); `picture` is zeroed then.
bool rg_picture_create(struct rg_picture *picture, int width, int height, int channels,
                       const char *name);

// What so many pictures of 4 channels take that are held at once, in bytes, with the texels of the
// one that is being read from a device, which lie in memory that its process shares as well.
int64_t rg_pictures_bytes(int width, int height, int count);
// Whether they may be taken (core/base/memory.h), as is found out before any is drawn. False, and
// one logged line.
bool rg_pictures_fit(int width, int height, int count);

// Frees the texels and zeroes the struct. NULL and a zeroed struct are accepted.
void rg_picture_destroy(struct rg_picture *picture);

// As rg_picture_create, but says into `why` what is wrong instead of logging it, so that several
// files can be read at once and one line be logged.
bool rg_picture_allocate(struct rg_picture *picture, int64_t width, int64_t height,
                         int64_t channels, char *why, size_t why_size);

// Whether an alpha is there that is not 1 everywhere.
bool rg_picture_is_see_through(const struct rg_picture *picture);

// Makes room for as many channels as the other has, and shows the same: grey becomes red, green and
// blue, and an alpha of 1 is added. In place. False, and one logged line, without memory.
bool rg_picture_widen(struct rg_picture *picture, const struct rg_picture *other, const char *name);

// Leaves out an alpha that is 1 everywhere: files are smaller, and HDR holds none. In place.
void rg_picture_drop_opaque_alpha(struct rg_picture *picture);

static inline int64_t rg_picture_values(const struct rg_picture *picture)
{
    return (int64_t)picture->width * picture->height * picture->channels;
}

// How many of the channels are colour: the others are alpha.
static inline int rg_picture_colours(const struct rg_picture *picture)
{
    return picture->channels > 2 ? 3 : 1;
}

#endif
