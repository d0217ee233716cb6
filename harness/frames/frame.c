#include "harness/frames/frame.h"

#include <stdlib.h>

bool rg_frame_draw(struct rg_device *device, const struct rg_subject *subject, int frames,
                   struct rg_picture *picture)
{
    struct rg_session *session = rg_session_run(device, subject, frames);
    const bool ok = session && rg_session_read_picture(session, picture);
    rg_session_close(session);
    return ok;
}

bool rg_frame_draw_dry(struct rg_device *device, const struct rg_subject *subject, int frames,
                       struct rg_picture *picture)
{
    const struct rg_technique *technique = subject->technique;
    struct rg_subject dry = *subject;
    void *settings = rg_settings_copy(technique, subject->settings, technique->proof->dry);
    dry.settings = settings;
    const bool ok = settings && rg_frame_draw(device, &dry, frames, picture);
    free(settings);
    return ok;
}
