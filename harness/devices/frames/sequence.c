#include "harness/devices/frames/sequence.h"

#include <limits.h>

#include "core/base/log.h"
#include "core/image/clip/clip.h"
#include "core/image/files/io.h"
#include "harness/console/interrupt.h"
#include "harness/console/progress.h"
#include "harness/devices/frames/frame.h"
#include "harness/devices/workers/worker.h"
#include "harness/record/numbered.h"

struct run {
    const struct rg_sequence *sequence;
    struct rg_clip *clip; // NULL: numbered pictures
    struct rg_session *session;
    struct rg_progress progress;
    int kept; // frames written
};

// --- output of frames ---

static bool open_place(struct run *run)
{
    const struct rg_sequence *s = run->sequence;
    char path[PATH_MAX];
    const int64_t frames = (int64_t)s->last - s->first + 1;
    const int64_t pixels = frames * s->subject.width * s->subject.height;
    if (!rg_clip_is_named(s->path))
        return rg_numbered_path(s->path, s->first, path, sizeof(path)) &&
               rg_picture_can_be_written(path, pixels);
    run->clip = rg_clip_open(s->path, &(struct rg_clip_options){.width = s->subject.width,
                                                                .height = s->subject.height,
                                                                .fps = s->fps,
                                                                .frames = frames,
                                                                .exposure = (float)s->exposure,
                                                                .patience_s = rg_workers.timeout_s,
                                                                .stop = rg_interrupted});
    return run->clip != NULL;
}

static bool keep_in_clip(struct run *run)
{
    struct rg_picture picture = {0};
    const bool ok =
        rg_session_read_picture(run->session, &picture) && rg_clip_add(run->clip, &picture);
    rg_picture_destroy(&picture);
    return ok;
}

static bool keep(struct run *run, int frame)
{
    const struct rg_sequence *s = run->sequence;
    char path[PATH_MAX];
    const bool ok = run->clip ? keep_in_clip(run)
                              : rg_numbered_path(s->path, frame, path, sizeof(path)) &&
                                    rg_frame_write(run->session, path, s->exposure);
    run->kept += ok;
    return ok;
}

// --- running ---

// False on failure or interruption.
static bool run_frame(struct run *run, int frame)
{
    const bool is_kept = frame >= run->sequence->first;
    const bool ok = !rg_interrupted() && (frame == 0 || rg_session_step(run->session)) &&
                    (!is_kept || (rg_session_draw(run->session) && keep(run, frame)));
    rg_progress_add(&run->progress, 1);
    return ok;
}

static bool run_frames(struct run *run, struct rg_device *device)
{
    const struct rg_sequence *s = run->sequence;
    run->session = rg_session_open(device, &s->subject);
    bool ok = run->session != NULL;
    rg_progress_start(&run->progress, (int64_t)s->last + 1);
    rg_progress_label(&run->progress, "%s, frames %d-%d", s->subject.technique->name, s->first,
                      s->last);
    for (int frame = 0; ok && frame <= s->last; frame++)
        ok = run_frame(run, frame);
    ok = ok && (!run->clip || rg_clip_finish(run->clip));
    rg_progress_end(&run->progress);
    return ok;
}

static void tell_interrupted(const struct run *run)
{
    const struct rg_sequence *s = run->sequence;
    if (run->clip || !run->kept)
        rg_info("%s: interrupted; nothing was written", s->path);
    else
        rg_info("%s: interrupted; frames %d-%d are written", s->path, s->first,
                s->first + run->kept - 1);
}

struct rg_session *rg_sequence_run(const struct rg_sequence *sequence, struct rg_device *device)
{
    struct run run = {.sequence = sequence};
    rg_interrupt_watch();
    const bool ok = open_place(&run) && run_frames(&run, device);
    if (!ok && rg_interrupted())
        tell_interrupted(&run);
    rg_clip_close(run.clip);
    if (ok)
        return run.session;
    rg_session_close(run.session);
    return NULL;
}
