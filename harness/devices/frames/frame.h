// One frame of a subject as a picture.
#ifndef RG_HARNESS_DEVICES_FRAMES_FRAME_H
#define RG_HARNESS_DEVICES_FRAMES_FRAME_H

#include "core/image/compare/compare.h"
#include "harness/devices/frames/session.h"

// Opens a subject on a device, simulates this many frames and reads the picture of the last, which
// the caller destroys. False, and one logged line, on failure.
bool rg_frame_draw(struct rg_device *device, const struct rg_subject *subject, int frames,
                   struct rg_picture *picture);

// The same without rain, by the technique's own `dry` settings: the background for the rain mask.
bool rg_frame_draw_dry(struct rg_device *device, const struct rg_subject *subject, int frames,
                       struct rg_picture *picture);

// The session that drew it, which the caller closes: while it is open, other sessions on the device
// share its large data. NULL, and one logged line, on failure.
struct rg_session *rg_frame_run_dry(struct rg_device *device, const struct rg_subject *subject,
                                    int frames);

// Whether one of two devices draws scenes in another way: it is native, and the other is not.
bool rg_frame_scenes_differ(const struct rg_device_info *a, const struct rg_device_info *b);

// Compares a picture that a device drew after this many frames with one that `other` drew, whose
// scene is `dry` (NULL: none). If their scenes differ, the whole pictures must hold T2 first. Then
// the rain is compared before `dry`: what the scenes differ by is taken from the picture. False,
// and one logged line, on failure.
bool rg_frame_compare(struct rg_device *device, const struct rg_subject *subject, int frames,
                      const struct rg_device_info *other, const struct rg_picture *expected,
                      const struct rg_picture *dry, const struct rg_picture *picture,
                      struct rg_comparison *comparison);

// The second half of this: compares the rain alone, by drawing the device's own scene without rain.
bool rg_frame_compare_rain(struct rg_device *device, const struct rg_subject *subject, int frames,
                           const struct rg_device_info *other, const struct rg_picture *expected,
                           const struct rg_picture *dry, const struct rg_picture *picture,
                           float exposure, struct rg_comparison *comparison);

enum { RG_FRAME_DRY = 160 };
// Writes a line saying that a subject shows no rain after this many frames, and which frame does,
// if one is found. `option` is the option that sets the frame, such as "--frame".
void rg_frame_tell_dry(struct rg_device *device, const struct rg_subject *subject, int frames,
                       float exposure, const char *option, char text[RG_FRAME_DRY]);

// Opens a subject on a device, simulates this many frames and draws the last, with a progress bar.
// For a very large picture, first logs an estimate of the time, from a picture of an eighth of the
// width and height. NULL, and one logged line, on failure.
struct rg_session *rg_frame_run(struct rg_device *device, const struct rg_subject *subject,
                                int frames);

// Writes the frame last drawn by a session to a picture file, and drops an alpha that is 1
// everywhere. False, and one logged line, on failure.
bool rg_frame_write(struct rg_session *session, const char *path, double exposure);

#endif
