#include "harness/devices/frames/frame.h"

#include <stdio.h>
#include <stdlib.h>

#include "core/base/log.h"
#include "core/image/files/io.h"
#include "harness/console/clock.h"
#include "harness/console/duration.h"
#include "harness/console/progress.h"

// Reads the picture of a session, NULL after a failure, and closes it.
static bool read_last(struct rg_session *session, struct rg_picture *picture)
{
    const bool ok = session && rg_session_read_picture(session, picture);
    rg_session_close(session);
    return ok;
}

bool rg_frame_draw(struct rg_device *device, const struct rg_subject *subject, int frames,
                   struct rg_picture *picture)
{
    return read_last(rg_session_run(device, subject, frames), picture);
}

struct rg_session *rg_frame_run_dry(struct rg_device *device, const struct rg_subject *subject,
                                    int frames)
{
    const struct rg_technique *technique = subject->technique;
    struct rg_subject dry = *subject;
    void *settings = rg_settings_copy(technique, subject->settings, technique->proof->dry);
    dry.settings = settings;
    struct rg_session *session = settings ? rg_session_run(device, &dry, frames) : NULL;
    free(settings);
    return session;
}

bool rg_frame_draw_dry(struct rg_device *device, const struct rg_subject *subject, int frames,
                       struct rg_picture *picture)
{
    return read_last(rg_frame_run_dry(device, subject, frames), picture);
}

bool rg_frame_compare_rain(struct rg_device *device, const struct rg_subject *subject, int frames,
                           const struct rg_device_info *other, const struct rg_picture *expected,
                           const struct rg_picture *dry, const struct rg_picture *picture,
                           float exposure, struct rg_comparison *comparison)
{
    struct rg_picture changed = {0};
    bool ok = rg_frame_draw_dry(device, subject, frames, &changed);
    const int64_t values = ok ? rg_picture_values(&changed) : 0;
    for (int64_t i = 0; i < values; i++) {
        const float light = picture->texels[i] + (dry->texels[i] - changed.texels[i]);
        changed.texels[i] = light > 0 ? light : 0;
    }
    ok = ok && rg_compare(expected, other->name, &changed, device->info.name, dry,
                          &(struct rg_compare_options){.exposure = exposure}, comparison);
    rg_picture_destroy(&changed);
    return ok;
}

bool rg_frame_scenes_differ(const struct rg_device_info *a, const struct rg_device_info *b)
{
    return a->native != b->native;
}

bool rg_frame_compare(struct rg_device *device, const struct rg_subject *subject, int frames,
                      const struct rg_device_info *other, const struct rg_picture *expected,
                      const struct rg_picture *dry, const struct rg_picture *picture,
                      struct rg_comparison *comparison)
{
    const bool differ = rg_frame_scenes_differ(&device->info, other);
    if (!rg_compare(expected, other->name, picture, device->info.name, differ ? NULL : dry,
                    &(struct rg_compare_options){0}, comparison))
        return false;
    if (!differ || !dry || !comparison->tiers.of[RG_T2].holds)
        return true;
    rg_comparison_destroy(comparison);
    return rg_frame_compare_rain(device, subject, frames, other, expected, dry, picture, 1,
                                 comparison);
}

static bool shows_rain(struct rg_device *device, const struct rg_subject *subject, int frames,
                       float exposure)
{
    struct rg_picture picture = {0}, dry = {0};
    bool shows = false;
    const bool ok = rg_frame_draw(device, subject, frames, &picture) &&
                    rg_frame_draw_dry(device, subject, frames, &dry) &&
                    rg_picture_shows_rain(&picture, &dry, exposure, &shows);
    rg_picture_destroy(&picture);
    rg_picture_destroy(&dry);
    return ok && shows;
}

void rg_frame_tell_dry(struct rg_device *device, const struct rg_subject *subject, int frames,
                       float exposure, const char *option, char text[RG_FRAME_DRY])
{
    static const int others[] = {60, 240};
    int found = -1;
    rg_log_hold(true); // the caller reports that none was found
    for (int i = 0; found < 0 && i < 2; i++)
        if (others[i] != frames && shows_rain(device, subject, others[i], exposure))
            found = others[i];
    rg_log_hold(false);
    if (found >= 0)
        snprintf(text, RG_FRAME_DRY, "no rain at frame %d, so that nothing is compared; take %s %d",
                 frames, option, found);
    else
        snprintf(
            text, RG_FRAME_DRY,
            "no rain at frame %d, nor at %s, so that nothing is compared; give another size or "
            "setting",
            frames,
            frames == 60    ? "240"
            : frames == 240 ? "60"
                            : "60 and 240");
}

// Pictures of at least this size are first drawn in small, to time them.
#define LARGE_PX ((int64_t)4096 * 4096)

// Estimates how long a large picture takes, and tells if that is long.
static bool foretell(struct rg_device *device, const struct rg_subject *subject)
{
    enum { SIDES = 8 };
    struct rg_subject small = *subject;
    small.width /= SIDES;
    small.height /= SIDES;
    if ((int64_t)subject->width * subject->height < LARGE_PX || small.width < 1 || small.height < 1)
        return true;
    struct rg_session *session = rg_session_run(device, &small, 0);
    if (!session)
        return false;
    char text[RG_DURATION_TEXT];
    const double start_ms = rg_now_ms();
    const bool ok = rg_session_draw(session) && rg_session_sync(session);
    const double s = (rg_now_ms() - start_ms) * SIDES * SIDES / 1e3;
    rg_session_close(session);
    if (ok && s > rg_long_s())
        rg_info("%s of %dx%d: drawing it once takes about %s", subject->technique->name,
                subject->width, subject->height, rg_duration_text(s, text));
    return ok;
}

struct rg_session *rg_frame_run(struct rg_device *device, const struct rg_subject *subject,
                                int frames)
{
    struct rg_session *session =
        foretell(device, subject) ? rg_session_open(device, subject) : NULL;
    struct rg_progress progress;
    bool ok = session != NULL;
    rg_progress_start(&progress, frames);
    rg_progress_label(&progress, "%s, %d frames", subject->technique->name, frames);
    for (int i = 0; ok && i < frames; i++) {
        ok = rg_session_step(session);
        rg_progress_add(&progress, 1);
    }
    ok = ok && rg_session_draw(session) && rg_session_sync(session);
    rg_progress_end(&progress);
    if (ok)
        return session;
    rg_session_close(session);
    return NULL;
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
