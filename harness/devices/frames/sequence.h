// Writes a sequence of frames: one session simulates each frame once, draws the wanted ones, and
// writes them as a clip or as numbered pictures.
#ifndef RG_HARNESS_DEVICES_FRAMES_SEQUENCE_H
#define RG_HARNESS_DEVICES_FRAMES_SEQUENCE_H

#include "harness/devices/frames/session.h"

struct rg_sequence {
    struct rg_subject subject;
    int first, last;  // frames simulated before the first and the last drawing
    const char *path; // a clip (core/image/clip/clip.h), or a picture with a place for the frame's
                      // number (harness/record/numbered.h)
    int fps;          // of a clip: frames in a second
    double exposure;
};

// Runs a sequence with a progress bar, and returns the session after the last frame. Checks before
// simulating that the path is writable and that clips can be made.
//
// NULL, and one logged line, on failure or interruption (harness/console/interrupt.h). A clip is
// then not written; complete pictures stay.
struct rg_session *rg_sequence_run(const struct rg_sequence *sequence, struct rg_device *device);

#endif
