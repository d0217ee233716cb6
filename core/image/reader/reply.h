// The request to raingauge_picture_reader in its cage (core/base/cage/cage.h), and its reply.
//
// Command line: raingauge_picture_reader NAME BYTES. Only NAME's extension matters, since the
// program reads the file from a descriptor. BYTES is the memory that the receiver has for texels.
// The reply is this header, then the texels as floats, as in picture.h, then the extras
// (core/image/extras.h), which are no longer than RG_PICTURE_EXTRAS_BYTES. `why` is "" or a
// sentence that says what is wrong. Nothing follows the header if `why` is set, or if the header
// alone shows a picture that is impossible, or larger than BYTES. The receiver trusts none of it.
#ifndef RG_CORE_IMAGE_READER_REPLY_H
#define RG_CORE_IMAGE_READER_REPLY_H

#include <stdbool.h>
#include <stdint.h>

#include "core/image/picture.h"

#define RG_PICTURE_REPLY_MAGIC 0x50524732u // "2GRP"

// Enough for a file with a few thousand channels or parts.
enum { RG_PICTURE_EXTRAS_BYTES = 1 << 18 };

// An EXR's display window may exceed the texels in its file, so that a small file may hold a
// picture as large as a file of this size could.
enum { RG_PICTURE_EXR_BYTES = 1 << 18 };

struct rg_picture_reply {
    uint32_t magic, is_decoded; // is_decoded: from integer codes
    int32_t width, height, channels, reserved;
    uint32_t is_associated, extras_bytes;
    char why[480];
};

// Whether the header's picture is within the limits.
static inline bool rg_picture_reply_is_possible(const struct rg_picture_reply *reply)
{
    return reply->width > 0 && reply->width <= RG_PICTURE_MAX_SIDE_PX && reply->height > 0 &&
           reply->height <= RG_PICTURE_MAX_SIDE_PX && reply->channels > 0 && reply->channels <= 4 &&
           (int64_t)reply->width * reply->height * reply->channels * 4 <= RG_PICTURE_MAX_BYTES;
}

static inline int64_t rg_picture_reply_values(const struct rg_picture_reply *reply)
{
    return (int64_t)reply->width * reply->height * reply->channels;
}

static inline int64_t rg_picture_reply_texel_bytes(const struct rg_picture_reply *reply)
{
    return rg_picture_reply_values(reply) * (int64_t)sizeof(float);
}

// Whether a file of so many bytes can hold the picture: no format but EXR codes more than 1040
// values in a byte.
static inline bool rg_picture_reply_fits(const struct rg_picture_reply *reply, int64_t file_bytes)
{
    return (double)reply->width * reply->height * reply->channels / 1040 <= (double)file_bytes;
}

#endif
