// What raingauge_picture_reader replies in its cage (core/base/cage/cage.h), and what it is asked.
//
// Command line: raingauge_picture_reader NAME, of which only the extension counts: the file is the
// descriptor that it is given. The reply is this header, then the texels as floats, as in
// picture.h. `why` is "" or a sentence that says what is wrong, and then nothing follows; nothing
// follows either where the header alone shows a picture that cannot be. The receiver trusts none
// of it.
#ifndef RG_CORE_IMAGE_READER_REPLY_H
#define RG_CORE_IMAGE_READER_REPLY_H

#include <stdbool.h>
#include <stdint.h>

#include "core/image/picture.h"

#define RG_PICTURE_REPLY_MAGIC 0x50524731u // "1GRP"

struct rg_picture_reply {
    uint32_t magic, integer; // integer: of 8 or 16 bits, values are code / largest code
    int32_t width, height, channels, reserved;
    char why[488];
};

// Whether it is a picture within the limits.
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

// Whether a file of so many bytes can hold the picture: no format codes more than 1040 values in a
// byte.
static inline bool rg_picture_reply_fits(const struct rg_picture_reply *reply, int64_t file_bytes)
{
    return (double)reply->width * reply->height * reply->channels / 1040 <= (double)file_bytes;
}

#endif
