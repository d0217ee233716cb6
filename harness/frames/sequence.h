// Frames in a row: one session simulates each of them once, draws those that are asked for, and
// keeps them as a clip or as numbered pictures.
#ifndef RG_HARNESS_FRAMES_SEQUENCE_H
#define RG_HARNESS_FRAMES_SEQUENCE_H

#include "harness/frames/session.h"

struct rg_sequence {
    struct rg_subject subject;
    int first, last;  // frames that are simulated before the first and the last drawing
    const char *path; // a clip (core/image/clip/clip.h), or a picture whose name has a place for
                      // the frame's number (harness/frames/numbered.h)
    int fps;          // of a clip: frames a second
    double exposure;
};

// Runs it with a bar of progress, and returns the session after the last frame. Whether the path
// can be written, and a clip be made, it finds out before it simulates.
//
// NULL, and one logged line, on failure, or when the user interrupts
// (harness/console/interrupt.h), which it watches for. A clip is then not written; pictures that
// are written stay, each of them whole.
struct rg_session *rg_sequence_run(const struct rg_sequence *sequence, struct rg_device *device);

#endif
