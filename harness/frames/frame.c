#include "harness/frames/frame.h"

#include <stdlib.h>

#include "core/techniques/proof.h"

struct rg_instance *rg_frame_run(const struct rg_technique *technique, const void *settings,
                                 struct rg_device *device, int width, int height, int frames)
{
    struct rg_instance *instance = rg_instance_open(technique, device, settings, width, height);
    bool ok = instance != NULL;
    for (int i = 0; ok && i < frames; i++)
        ok = technique->step(instance);
    if (ok && technique->draw(instance) && rg_device_sync(device))
        return instance;
    if (instance)
        rg_instance_close(instance);
    return NULL;
}

bool rg_frame_draw(const struct rg_technique *technique, const void *settings,
                   struct rg_device *device, int width, int height, int frames,
                   struct rg_picture *picture)
{
    struct rg_session *session =
        rg_session_run(device, &(struct rg_subject){technique, settings, width, height}, frames);
    const bool ok = session && rg_session_read_picture(session, picture);
    rg_session_close(session);
    return ok;
}

bool rg_frame_draw_dry(const struct rg_technique *technique, const void *settings,
                       struct rg_device *device, int width, int height, int frames,
                       struct rg_picture *picture)
{
    void *dry = rg_settings_copy(technique, settings, technique->proof->dry);
    const bool ok = dry && rg_frame_draw(technique, dry, device, width, height, frames, picture);
    free(dry);
    return ok;
}
