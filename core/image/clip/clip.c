#include "core/image/clip/clip.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "core/base/alloc.h"
#include "core/base/files/file.h"
#include "core/base/log.h"
#include "core/image/clip/encoder.h"
#include "core/image/clip/yuv.h"
#include "core/image/files/disk.h"
#include "core/image/files/temporary.h"

struct rg_clip {
    const char *path;
    struct rg_clip_options options;
    struct rg_encoder encoder;
    uint8_t *yuv; // one frame
};

bool rg_clip_is_named(const char *path)
{
    const size_t length = strlen(path), ending = strlen(".webm");
    return length > ending && !strcasecmp(path + length - ending, ".webm");
}

// --- frames ---

// Y4M header. "420jpeg" says that chroma samples lie in the middle of their four pixels, as vpxenc
// codes them.
static bool feed_header(struct rg_clip *clip)
{
    char header[128];
    const struct rg_clip_options *o = &clip->options;
    const int length = snprintf(header, sizeof(header),
                                "YUV4MPEG2 W%d H%d F%d:1 Ip A1:1 C420jpeg XCOLORRANGE=LIMITED\n",
                                o->width, o->height, o->fps);
    return rg_encoder_feed(&clip->encoder, header, (size_t)length);
}

bool rg_clip_add(struct rg_clip *clip, const struct rg_picture *picture)
{
    static const char header[] = "FRAME\n";
    const struct rg_clip_options *o = &clip->options;
    rg_yuv_encode(picture, o->exposure, clip->yuv);
    return rg_encoder_feed(&clip->encoder, header, strlen(header)) &&
           rg_encoder_feed(&clip->encoder, clip->yuv, rg_yuv_bytes(o->width, o->height));
}

// --- the file ---

static bool copy(int from, const char *path, struct rg_why *why)
{
    const int to = open(path, O_WRONLY | O_CLOEXEC);
    bool ok = to >= 0 && rg_file_copy(from, to);
    if (!ok)
        rg_why_unwritten(why, strerror(errno));
    if (to >= 0 && close(to) && ok)
        ok = rg_why_unwritten(why, strerror(errno));
    return ok;
}

bool rg_clip_finish(struct rg_clip *clip)
{
    struct rg_why why;
    struct rg_temporary temporary;
    if (!rg_encoder_finish(&clip->encoder))
        return false;
    if (rg_temporary_make(clip->path, &temporary, &why)) {
        const bool written = copy(clip->encoder.coded, temporary.path, &why);
        if (rg_temporary_end(&temporary, written, &why))
            return true;
    }
    return rg_why_tell(&why, clip->path);
}

// --- opening and closing ---

// A lower bound of a clip's file size: clips that we drew took three times as much.
static int64_t least_bytes(const struct rg_clip_options *options)
{
    return (int64_t)options->width * options->height * options->frames / 100;
}

// How long vpxenc may do nothing. A frame of 1280x720 adds half a minute, one of 3840x2160 four
// minutes.
static double patience_of(const struct rg_clip_options *options)
{
    const double slowest_s_a_byte = 2e-5;
    const double frame_bytes = (double)rg_yuv_bytes(options->width, options->height);
    return options->patience_s ? options->patience_s + frame_bytes * slowest_s_a_byte : 0;
}

struct rg_clip *rg_clip_open(const char *path, const struct rg_clip_options *options)
{
    struct rg_why why;
    if (!rg_temporary_try(path, &why) || !rg_disk_has_room(path, least_bytes(options), &why)) {
        rg_why_tell(&why, path);
        return NULL;
    }
    struct rg_clip *clip = rg_alloc(1, sizeof(*clip), path);
    if (!clip)
        return NULL;
    *clip = (struct rg_clip){.path = path, .options = *options};
    clip->yuv = rg_alloc(rg_yuv_bytes(options->width, options->height), 1, path);
    if (rg_encoder_start(&clip->encoder, path, patience_of(options), options->stop) && clip->yuv &&
        feed_header(clip))
        return clip;
    rg_clip_close(clip);
    return NULL;
}

void rg_clip_close(struct rg_clip *clip)
{
    if (!clip)
        return;
    rg_encoder_end(&clip->encoder);
    free(clip->yuv);
    free(clip);
}
