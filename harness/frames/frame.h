// One frame of a subject as a picture.
#ifndef RG_HARNESS_FRAMES_FRAME_H
#define RG_HARNESS_FRAMES_FRAME_H

#include "harness/frames/session.h"

// Opens a subject on a device, simulates so many frames and brings the picture of the last, which
// the caller destroys. False, and one logged line, on failure.
bool rg_frame_draw(struct rg_device *device, const struct rg_subject *subject, int frames,
                   struct rg_picture *picture);

// The same without rain, as the technique's proof takes it away: the background of the rain mask.
bool rg_frame_draw_dry(struct rg_device *device, const struct rg_subject *subject, int frames,
                       struct rg_picture *picture);

enum { RG_FRAME_DRY = 160 };
// Says in one line that a subject has no rain behind so many frames, and which frame has some, if
// one is found; `option` is how the user gives a frame, as "--frame".
void rg_frame_tell_dry(struct rg_device *device, const struct rg_subject *subject, int frames,
                       float exposure, const char *option, char text[RG_FRAME_DRY]);

// Opens a subject on a device, simulates so many frames and draws the last, with a bar of progress;
// of a picture so large that it alone may last long, how long is found out first, from one of an
// eighth of its sides. NULL, and one logged line, on failure.
struct rg_session *rg_frame_run(struct rg_device *device, const struct rg_subject *subject,
                                int frames);

// Writes the frame that a session has drawn last as a picture file, without an alpha that is 1
// everywhere. False, and one logged line, on failure.
bool rg_frame_write(struct rg_session *session, const char *path, double exposure);

#endif
