#include "harness/frames/frame.h"

#include <stdlib.h>

#include "core/image/files/io.h"

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

bool rg_frame_write(struct rg_session *session, const char *path, double exposure)
{
    struct rg_picture picture = {0};
    bool ok = rg_session_read_picture(session, &picture);
    if (ok) {
        rg_picture_drop_opaque_alpha(&picture);
        ok = rg_picture_write(path, &picture,
                              &(struct rg_write_options){.exposure = (float)exposure});
    }
    rg_picture_destroy(&picture);
    return ok;
}
