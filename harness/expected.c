#include "harness/expected.h"

#include <stdlib.h>

#include "core/device.h"
#include "harness/frame.h"

static bool draw(struct rg_expected *expected, const struct rg_technique *technique,
                 const void *settings, struct rg_device *device, int width, int height)
{
    struct rg_instance *instance =
        rg_frame_run(technique, settings, device, width, height, RG_CHECK_FRAMES);
    if (!instance)
        return false;
    expected->texels = rg_frame_read(instance, &expected->size);
    const bool ok =
        expected->texels && rg_frame_picture(instance, expected->texels, &expected->picture);
    technique->destroy(instance);
    return ok;
}

bool rg_expected_make(struct rg_expected *expected, const struct rg_technique *technique,
                      const void *settings, int width, int height, bool with_dry)
{
    *expected = (struct rg_expected){0};
    struct rg_device *device = rg_device_open("cpu:reference", NULL);
    bool ok = device && draw(expected, technique, settings, device, width, height) &&
              (!with_dry || rg_frame_draw_dry(technique, settings, device, width, height,
                                              RG_CHECK_FRAMES, &expected->dry));
    return rg_device_close(device) && ok;
}

void rg_expected_free(struct rg_expected *expected)
{
    rg_picture_destroy(&expected->picture);
    rg_picture_destroy(&expected->dry);
    free(expected->texels);
    *expected = (struct rg_expected){0};
}
