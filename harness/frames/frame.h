// Running a technique to a frame and bringing its image to the host.
#ifndef RG_HARNESS_FRAMES_FRAME_H
#define RG_HARNESS_FRAMES_FRAME_H

#include "core/techniques/frame.h"
#include "harness/frames/session.h"

// Opens a technique on a device, simulates `frames` frames and draws the last. The caller destroys
// it with rg_technique->destroy. NULL, and one logged line, on failure.
struct rg_instance *rg_frame_run(const struct rg_technique *technique, const void *settings,
                                 struct rg_device *device, int width, int height, int frames);

// Runs to a frame as rg_frame_run does and brings its picture, which the caller destroys. False,
// and one logged line, on failure.
bool rg_frame_draw(const struct rg_technique *technique, const void *settings,
                   struct rg_device *device, int width, int height, int frames,
                   struct rg_picture *picture);

// The same of the settings without rain, as the technique's proof takes it away: the background of
// the rain mask.
bool rg_frame_draw_dry(const struct rg_technique *technique, const void *settings,
                       struct rg_device *device, int width, int height, int frames,
                       struct rg_picture *picture);

#endif
