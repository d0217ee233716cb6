// Clips: pictures in a row as a WebM file of VP9, which the program vpxenc makes (Debian package
// vpx-tools).
//
// Frames go to vpxenc one by one. Its file stays in memory until it is whole, for vpxenc does not
// say when a disk is full; it is then written as pictures are. The same pictures give the same
// bytes with the same vpxenc, on any number of cores.
#ifndef RG_CORE_IMAGE_CLIP_CLIP_H
#define RG_CORE_IMAGE_CLIP_CLIP_H

#include "core/image/picture.h"

struct rg_clip_options {
    int width, height; // of every picture, in pixels
    int fps;           // frames a second
    int64_t frames;    // of the clip, as far as is known: the disk must have room for them
    float exposure;    // linear colours are multiplied by this, clamped and sRGB-encoded
    // vpxenc is ended where it has neither taken nor coded anything for so long, and for as long
    // again as its slowest coding of such a frame may take; 0: never.
    int patience_s;
    bool (*stop)(void); // asked while vpxenc is waited for: true gives up, and nothing is logged
};

struct rg_clip;

// Whether a path names a clip: it ends in ".webm".
bool rg_clip_is_named(const char *path);

// Starts vpxenc. `path` stays the caller's, and outlives the clip. NULL, and one logged line, where
// vpxenc is missing, which is unsupported, or where the clip could not be written, or the disk has
// no room.
struct rg_clip *rg_clip_open(const char *path, const struct rg_clip_options *options);
// Hands the next frame on. False, and one logged line, where vpxenc has failed.
bool rg_clip_add(struct rg_clip *clip, const struct rg_picture *picture);
// Waits until vpxenc has coded all frames, then writes beside `path` and renames. False, and one
// logged line, on failure.
bool rg_clip_finish(struct rg_clip *clip);
// Ends vpxenc where it still runs. A clip that has not been finished leaves nothing behind. NULL is
// accepted.
void rg_clip_close(struct rg_clip *clip);

#endif
