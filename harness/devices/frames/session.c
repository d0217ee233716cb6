#include "harness/devices/frames/session.h"

#include <stdio.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "harness/devices/workers/device.h"
#include "harness/devices/frames/calling.h"
#include "harness/devices/frames/messages.h"

static bool open_here(struct rg_session *session, const struct rg_subject *subject)
{
    session->instance = rg_instance_open(subject->technique, session->device, subject->settings,
                                         subject->width, subject->height);
    if (session->instance)
        session->state_count = session->instance->state_count;
    return session->instance;
}

struct rg_session *rg_session_open(struct rg_device *device, const struct rg_subject *subject)
{
    struct rg_session *session = rg_alloc(1, sizeof(*session), subject->technique->name);
    if (!session)
        return NULL;
    *session = (struct rg_session){.device = device,
                                   .technique = subject->technique,
                                   .width = subject->width,
                                   .height = subject->height};
    if (rg_remote_worker(device) ? rg_remote_session_open(session, subject)
                                 : open_here(session, subject))
        return session;
    free(session);
    return NULL;
}

struct rg_session *rg_session_run(struct rg_device *device, const struct rg_subject *subject,
                                  int frames)
{
    struct rg_session *session = rg_session_open(device, subject);
    bool ok = session != NULL;
    for (int i = 0; ok && i < frames; i++)
        ok = rg_session_step(session);
    if (ok && rg_session_draw(session) && rg_session_sync(session))
        return session;
    rg_session_close(session);
    return NULL;
}

void rg_session_close(struct rg_session *session)
{
    if (session && rg_remote_worker(session->device))
        rg_remote_session_close(session);
    else if (session)
        rg_instance_close(session->instance);
    free(session);
}

bool rg_session_lives(const struct rg_session *session)
{
    const struct rg_worker *worker = rg_remote_worker(session->device);
    return !worker || rg_worker_has(worker, session->life);
}

struct rg_device *rg_session_device(const struct rg_session *session)
{
    return session->device;
}

// --- simulating and drawing ---

bool rg_session_step(struct rg_session *session)
{
    return rg_session_ask(session, RG_CALL_STEP, NULL, NULL);
}

bool rg_session_draw(struct rg_session *session)
{
    return rg_session_ask(session, RG_CALL_DRAW, NULL, NULL);
}

bool rg_session_sync(struct rg_session *session)
{
    return rg_session_ask(session, RG_CALL_SYNC, NULL, NULL);
}

bool rg_session_frames(struct rg_session *session, int frames, double *wall_ms)
{
    double ms = 0;
    const bool ok = rg_session_ask(session, RG_CALL_FRAMES, &(struct rg_asked){NULL, frames}, &ms);
    if (wall_ms)
        *wall_ms = ms;
    return ok;
}

bool rg_session_count(struct rg_session *session, struct rg_tally *tally)
{
    return rg_session_ask(session, RG_CALL_COUNT, NULL, tally);
}

bool rg_session_stages(struct rg_session *session,
                       void (*tell)(const char *kernel, double ms, void *user), void *user)
{
    struct rg_told_stages told = {0};
    const bool ok = rg_session_ask(session, RG_CALL_STAGES, NULL, &told);
    for (int i = 0; ok && i < told.count; i++)
        tell(told.rows[i].kernel, told.rows[i].ms, user);
    free(told.rows);
    return ok;
}

bool rg_session_time(struct rg_session *session, int64_t *time_ns)
{
    return rg_session_ask(session, RG_CALL_TIME, NULL, time_ns);
}

bool rg_session_code(struct rg_session *session, struct rg_session_code *code)
{
    *code = (struct rg_session_code){.libraries = 0};
    return rg_session_ask(session, RG_CALL_CODE, NULL, code);
}

// --- its picture ---

// The bytes of a reply; frees them and returns NULL if the call failed.
static void *bytes_of(struct rg_told_bytes *told, bool ok, size_t *size)
{
    *size = told->size;
    if (ok)
        return told->bytes;
    free(told->bytes);
    return NULL;
}

void *rg_session_read(struct rg_session *session, size_t *size)
{
    struct rg_told_bytes told = {0};
    bool ok = rg_session_ask(session, RG_CALL_READ, NULL, &told);
    const size_t due =
        (size_t)session->width * (size_t)session->height * (size_t)rg_format_size(RG_RGBA16F);
    if (ok && told.size != due)
        ok = rg_driver_error("device '%s': a picture from its process has %zu bytes, not %zu",
                             session->device->info.name, told.size, due);
    return bytes_of(&told, ok, size);
}

bool rg_session_picture(const struct rg_session *session, const void *texels,
                        struct rg_picture *picture)
{
    return rg_frame_picture(texels, session->width, session->height, picture);
}

bool rg_session_read_picture(struct rg_session *session, struct rg_picture *picture)
{
    size_t size;
    void *texels = rg_session_read(session, &size);
    const bool ok = texels && rg_session_picture(session, texels, picture);
    free(texels);
    return ok;
}

// --- state and account ---

bool rg_session_tell(const struct rg_session *session, struct rg_account *account)
{
    *account = (struct rg_account){0};
    const bool told = rg_session_ask(session, RG_CALL_TELL, NULL, account);
    if (!told)
        *account = (struct rg_account){0};
    return told;
}

int rg_session_state_count(const struct rg_session *session)
{
    return session->state_count;
}

void *rg_session_read_state(struct rg_session *session, int index, struct rg_state *layout,
                            size_t *size)
{
    struct rg_told_bytes told = {0};
    const bool ok =
        rg_session_ask(session, RG_CALL_READ_STATE, &(struct rg_asked){NULL, index}, &told);
    *layout = told.layout;
    return bytes_of(&told, ok, size);
}

bool rg_session_obeys(const struct rg_session *session, const struct rg_law *law, char *detail,
                      size_t size)
{
    const struct rg_asked asked = {NULL, (int)(law - session->technique->proof->laws)};
    struct rg_told_law told = {0};
    const bool ok = rg_session_ask(session, RG_CALL_OBEYS, &asked, &told);
    snprintf(detail, size, "%s", ok ? told.detail : "");
    return ok && told.holds;
}

bool rg_session_texture(const struct rg_session *session, const char *name,
                        struct rg_image_desc *desc, int *first_level)
{
    struct rg_told_texture told = {0};
    if (!rg_session_ask(session, RG_CALL_TEXTURE, &(struct rg_asked){name, 0}, &told) ||
        !told.is_found)
        return false;
    *desc = told.desc;
    *first_level = told.first_level;
    return true;
}

// --- runs whose stages are examined, and kernels alone ---

bool rg_digests_take(const struct rg_digest_run *run, struct rg_device *device,
                     struct rg_digests *digests)
{
    const bool ok = rg_run_ask(device, RG_CALL_DIGESTS, &(struct rg_asked_run){*run, 0}, digests);
    if (!ok)
        rg_digests_free(digests);
    return ok;
}

bool rg_digests_contents(const struct rg_digest_run *run, struct rg_device *device, int row,
                         struct rg_contents *contents, struct rg_state *state)
{
    struct rg_told_contents told = {.contents = {.size = 0}};
    const bool ok = rg_run_ask(device, RG_CALL_CONTENTS, &(struct rg_asked_run){*run, row}, &told);
    *contents = told.contents;
    *state = told.state;
    return ok;
}

bool rg_digests_dispatches(const struct rg_digest_run *run, struct rg_device *device,
                           int stages_run, struct rg_dispatches *dispatches)
{
    *dispatches = (struct rg_dispatches){0};
    return rg_run_ask(device, RG_CALL_DISPATCHES, &(struct rg_asked_run){*run, stages_run},
                      dispatches);
}

bool rg_digests_dispatch(struct rg_dispatched *dispatched, struct rg_device *device)
{
    for (int i = 0; i < RG_MAX_SLOTS; i++) // earlier kernels may have left some
        rg_contents_free(&dispatched->after[i]);
    return rg_run_ask(device, RG_CALL_DISPATCH, dispatched, dispatched);
}

void *rg_digests_code(struct rg_device *device, const struct rg_kernel *kernel,
                      enum rg_code_kind kind, size_t *size)
{
    const struct rg_asked asked = {kernel->name, (int)kind};
    struct rg_told_bytes told = {0};
    return bytes_of(&told, rg_run_ask(device, RG_CALL_KERNEL_CODE, &asked, &told), size);
}

bool rg_digests_compile(struct rg_device *device, const struct rg_kernel *kernel)
{
    return rg_run_ask(device, RG_CALL_COMPILE, &(struct rg_asked){kernel->name, 0}, NULL);
}
