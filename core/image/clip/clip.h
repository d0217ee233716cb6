// Clips: sequences of pictures as a WebM file of VP9, coded by the program vpxenc (Debian package
// vpx-tools).
//
// Frames go to vpxenc one by one. Its output stays in memory until it is complete, because vpxenc
// does not report a full disk; it is then written as pictures are. The same pictures give the same
// bytes with the same vpxenc, on any number of cores.
#ifndef RG_CORE_IMAGE_CLIP_CLIP_H
#define RG_CORE_IMAGE_CLIP_CLIP_H

#include "core/image/picture.h"

struct rg_clip_options {
    int width, height; // of every picture, in pixels
    int fps;           // frames a second
    int64_t frames;    // of the clip, as far as known: the disk must have room for them
    float exposure;    // linear colours are multiplied by this, clamped and sRGB-encoded
    // vpxenc is killed after it has neither read nor coded anything for so long plus the time that
    // its slowest coding of such a frame may take; 0: never.
    int patience_s;
    bool (*stop)(void); // called while waiting for vpxenc; true gives up, without a message
};

struct rg_clip;

// Whether a path is a clip's: it ends in ".webm".
bool rg_clip_is_named(const char *path);

// Starts vpxenc. `path` stays the caller's, and must outlive the clip. NULL, and one logged line,
// where vpxenc is missing (unsupported), the clip could not be written, or the disk has no room.
struct rg_clip *rg_clip_open(const char *path, const struct rg_clip_options *options);
// Hands vpxenc the next frame. False, and one logged line, where vpxenc has failed.
bool rg_clip_add(struct rg_clip *clip, const struct rg_picture *picture);
// Waits until vpxenc has coded all frames, then writes beside `path` and renames. False, and one
// logged line, on failure.
bool rg_clip_finish(struct rg_clip *clip);
// Ends vpxenc if it still runs. An unfinished clip leaves no file. NULL is accepted.
void rg_clip_close(struct rg_clip *clip);

#endif
