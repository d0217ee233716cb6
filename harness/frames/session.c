#include "harness/frames/session.h"

#include <stdlib.h>

#include "core/base/alloc.h"
#include "harness/frames/ways.h"
#include "harness/devices/workers/device.h"

static const struct rg_session_ways *ways_of(const struct rg_device *device)
{
    return rg_remote_worker(device) ? &rg_remote_session : &rg_local_session;
}

struct rg_session *rg_session_open(struct rg_device *device, const struct rg_subject *subject)
{
    struct rg_session *session = rg_alloc(1, sizeof(*session), subject->technique->name);
    if (!session)
        return NULL;
    *session = (struct rg_session){.ways = ways_of(device),
                                   .device = device,
                                   .technique = subject->technique,
                                   .width = subject->width,
                                   .height = subject->height};
    if (session->ways->open(session, subject))
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
    if (session)
        session->ways->close(session);
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
    return session->ways->step(session);
}

bool rg_session_draw(struct rg_session *session)
{
    return session->ways->draw(session);
}

bool rg_session_sync(struct rg_session *session)
{
    return session->ways->sync(session);
}

bool rg_session_frames(struct rg_session *session, int frames, double *wall_ms)
{
    return session->ways->frames(session, frames, wall_ms);
}

bool rg_session_count(struct rg_session *session, struct rg_tally *tally)
{
    return session->ways->count(session, tally);
}

bool rg_session_stages(struct rg_session *session,
                       void (*tell)(const char *kernel, double ms, void *user), void *user)
{
    return session->ways->stages(session, tell, user);
}

bool rg_session_time(struct rg_session *session, int64_t *time_ns)
{
    return session->ways->time(session, time_ns);
}

bool rg_session_code(struct rg_session *session, struct rg_session_code *code)
{
    return session->ways->code(session, code);
}

// --- its picture ---

void *rg_session_read(struct rg_session *session, size_t *size)
{
    return session->ways->read(session, size);
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

// --- its state, and what it tells of itself ---

bool rg_session_tell(const struct rg_session *session, struct rg_account *account)
{
    return session->ways->tell(session, account);
}

int rg_session_state_count(const struct rg_session *session)
{
    return session->state_count;
}

void *rg_session_read_state(struct rg_session *session, int index, struct rg_state *layout,
                            size_t *size)
{
    return session->ways->read_state(session, index, layout, size);
}

const struct rg_law *rg_session_law(const struct rg_session *session, int number)
{
    const struct rg_law *law = session->technique->proof->laws;
    for (int i = 0; law->name && i < number; i++)
        law++;
    return law->name ? law : NULL;
}

bool rg_session_obeys(const struct rg_session *session, const struct rg_law *law, char *detail,
                      size_t size)
{
    return session->ways->obeys(session, law, detail, size);
}

bool rg_session_texture(const struct rg_session *session, const char *name,
                        struct rg_image_desc *desc, int *first_level)
{
    return session->ways->texture(session, name, desc, first_level);
}

// --- digests ---

bool rg_digests_take(const struct rg_digest_run *run, struct rg_device *device,
                     struct rg_digests *digests)
{
    return ways_of(device)->take_digests(run, device, digests);
}

bool rg_digests_contents(const struct rg_digest_run *run, struct rg_device *device, int row,
                         struct rg_contents *contents, struct rg_state *state)
{
    *contents = (struct rg_contents){0};
    *state = (struct rg_state){0};
    return ways_of(device)->take_contents(run, device, row, contents, state);
}

bool rg_digests_dispatches(const struct rg_digest_run *run, struct rg_device *device,
                           int stages_run, struct rg_dispatches *dispatches)
{
    *dispatches = (struct rg_dispatches){0};
    return ways_of(device)->take_dispatches(run, device, stages_run, dispatches);
}

bool rg_digests_dispatch(struct rg_dispatched *dispatched, struct rg_device *device)
{
    for (int i = 0; i < RG_MAX_SLOTS; i++) // of another kernel before it, perhaps
        rg_contents_free(&dispatched->after[i]);
    return ways_of(device)->run_dispatched(dispatched, device);
}

void *rg_digests_code(struct rg_device *device, const struct rg_kernel *kernel,
                      enum rg_code_kind kind, size_t *size)
{
    return ways_of(device)->take_code(device, kernel, kind, size);
}
