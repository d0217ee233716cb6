#include "harness/frames/session.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/techniques/stages/frame.h"
#include "harness/console/clock.h"
#include "harness/console/interrupt.h"
#include "harness/frames/inside.h"

struct rg_session {
    struct rg_instance *instance;
};

struct rg_session *rg_session_open(struct rg_device *device, const struct rg_subject *subject)
{
    struct rg_session *session = rg_alloc(1, sizeof(*session), subject->technique->name);
    if (!session)
        return NULL;
    session->instance = rg_instance_open(subject->technique, device, subject->settings,
                                         subject->width, subject->height);
    if (session->instance)
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
        rg_instance_close(session->instance);
    free(session);
}

struct rg_device *rg_session_device(const struct rg_session *session)
{
    return session->instance->device;
}

struct rg_instance *rg_session_instance(struct rg_session *session)
{
    return session->instance;
}

// --- simulating and drawing ---

bool rg_session_step(struct rg_session *session)
{
    return session->instance->technique->step(session->instance);
}

bool rg_session_draw(struct rg_session *session)
{
    return session->instance->technique->draw(session->instance);
}

bool rg_session_sync(struct rg_session *session)
{
    return rg_device_sync(session->instance->device);
}

bool rg_session_frames(struct rg_session *session, int frames)
{
    bool ok = true;
    for (int i = 0; ok && i < frames && !rg_interrupted(); i++)
        ok = rg_session_step(session) && rg_session_draw(session);
    return ok && rg_session_sync(session);
}

bool rg_session_count(struct rg_session *session, struct rg_tally *tally)
{
    struct rg_device *device = session->instance->device;
    rg_tally_begin(device, tally);
    const bool ok = rg_session_frames(session, 1);
    rg_tally_end(device);
    return ok;
}

struct stage_clock {
    struct rg_session *session;
    void (*tell)(const char *kernel, double ms, void *user);
    void *user;
    double last_ms;
    bool ok;
};

static void after_stage(const struct rg_opened_stage *stage, void *user)
{
    struct stage_clock *clock = user;
    clock->ok = rg_session_sync(clock->session) && clock->ok;
    const double now_ms = rg_now_ms();
    clock->tell(stage->row.kernel, now_ms - clock->last_ms, clock->user);
    clock->last_ms = now_ms;
}

bool rg_session_stages(struct rg_session *session,
                       void (*tell)(const char *kernel, double ms, void *user), void *user)
{
    struct stage_clock clock = {session, tell, user, rg_now_ms(), true};
    session->instance->after_stage = after_stage;
    session->instance->user = &clock;
    const bool ok = rg_session_frames(session, 1);
    session->instance->after_stage = NULL;
    return ok && clock.ok;
}

bool rg_session_time(struct rg_session *session, int64_t *time_ns)
{
    return rg_device_time(session->instance->device, time_ns);
}

// --- its picture ---

void *rg_session_read(struct rg_session *session, size_t *size)
{
    return rg_frame_read(session->instance, size);
}

bool rg_session_picture(const struct rg_session *session, const void *texels,
                        struct rg_picture *picture)
{
    return rg_frame_picture(session->instance, texels, picture);
}

bool rg_session_read_picture(struct rg_session *session, struct rg_picture *picture)
{
    return rg_frame_read_picture(session->instance, picture);
}

// --- its state, and what it tells of itself ---

void rg_session_tell(const struct rg_session *session, struct rg_account *account)
{
    const struct rg_instance *instance = session->instance;
    *account = (struct rg_account){.frame = instance->frame,
                                   .counter_count = instance->counter_count,
                                   .fact_count = instance->fact_count};
    memcpy(account->counters, instance->counters, sizeof(account->counters));
    memcpy(account->facts, instance->facts, sizeof(account->facts));
}

int rg_session_state_count(const struct rg_session *session)
{
    return session->instance->state_count;
}

void *rg_session_read_state(struct rg_session *session, int index, struct rg_state *layout,
                            size_t *size)
{
    const struct rg_state *state = &session->instance->state[index];
    struct rg_buf *buf = state->asset->buf;
    void *words = malloc(buf->size);
    if (!words)
        return rg_error_null("buffer '%s': no memory for %zu bytes", state->name, buf->size);
    if (rg_buf_read(buf, 0, words, (int64_t)buf->size)) {
        *layout = *state;
        layout->asset = NULL;
        *size = buf->size;
        return words;
    }
    free(words);
    return NULL;
}

bool rg_session_obeys(const struct rg_session *session, const struct rg_law *law, char *detail,
                      size_t size)
{
    return law->holds(session->instance, detail, size);
}

bool rg_session_texture(const struct rg_session *session, const char *name,
                        struct rg_image_desc *desc, int *first_level)
{
    const struct rg_instance *instance = session->instance;
    for (int i = 0; i < instance->texture_count; i++) {
        const struct rg_texture *texture = &instance->textures[i];
        if (strcmp(texture->name, name))
            continue;
        *desc = texture->image->desc;
        *first_level = texture->first_level;
        return true;
    }
    return false;
}
