// Calls about sessions (harness/frames/remote.c makes them).
#include <stdlib.h>

#include "core/base/array.h"
#include "core/base/log.h"
#include "core/base/memory.h"
#include "harness/frames/messages.h"
#include "harness/frames/session.h"
#include "harness/devices/serving/services.h"

// By number; NULL: closed. Numbers are not used again, so that none means two sessions.
static struct {
    int count;
    int64_t room;
    struct rg_session **all;
} sessions;

static struct rg_session *take_session(struct rg_message *request)
{
    const int number = rg_take_index(request, sessions.count);
    struct rg_session *session = request->failed ? NULL : sessions.all[number];
    return session || request->failed ? session : rg_error_null("session %d: is closed", number);
}

// --- opening and closing ---

bool rg_serve_session_open(struct rg_message *request, struct rg_message *reply)
{
    struct rg_subject subject;
    struct rg_device *device = rg_served_device(rg_take_text(request));
    rg_memory_allow(rg_take_int(request));
    if (!device || !rg_take_subject(request, &subject) ||
        !rg_array_fit(&sessions.all, &sessions.room, sessions.count + 1, sizeof(*sessions.all),
                      "sessions"))
        return false;
    struct rg_session *session = rg_session_open(device, &subject);
    free((void *)subject.settings);
    if (!session)
        return false;
    const struct rg_told_session told = {sessions.count, rg_session_state_count(session)};
    rg_put_fields(reply, rg_told_session_fields, &told);
    sessions.all[sessions.count++] = session;
    return true;
}

bool rg_serve_session_close(struct rg_message *request, struct rg_message *reply)
{
    (void)reply;
    struct rg_session *session = take_session(request);
    for (int i = 0; i < sessions.count; i++)
        if (sessions.all[i] == session)
            sessions.all[i] = NULL;
    rg_session_close(session);
    return session;
}

void rg_served_sessions_close(void)
{
    for (int i = 0; i < sessions.count; i++)
        rg_session_close(sessions.all[i]);
    free(sessions.all);
    sessions.all = NULL;
    sessions.count = 0;
    sessions.room = 0;
}

// --- simulating and drawing ---

bool rg_serve_step(struct rg_message *request, struct rg_message *reply)
{
    (void)reply;
    struct rg_session *session = take_session(request);
    return session && rg_session_step(session);
}

bool rg_serve_draw(struct rg_message *request, struct rg_message *reply)
{
    (void)reply;
    struct rg_session *session = take_session(request);
    return session && rg_session_draw(session);
}

bool rg_serve_sync(struct rg_message *request, struct rg_message *reply)
{
    (void)reply;
    struct rg_session *session = take_session(request);
    return session && rg_session_sync(session);
}

bool rg_serve_frames(struct rg_message *request, struct rg_message *reply)
{
    struct rg_session *session = take_session(request);
    const int frames = rg_take_index(request, INT32_MAX);
    double wall_ms;
    if (!session || !rg_session_frames(session, frames, &wall_ms))
        return false;
    rg_put_fields(reply, rg_ms_fields, &wall_ms);
    return true;
}

bool rg_serve_count(struct rg_message *request, struct rg_message *reply)
{
    struct rg_session *session = take_session(request);
    struct rg_tally tally;
    if (!session || !rg_session_count(session, &tally))
        return false;
    rg_put_fields(reply, rg_told_tally_fields, &tally);
    return true;
}

static void keep_stage(const char *kernel, double ms, void *user)
{
    struct rg_told_stages *told = user;
    if (rg_array_fit(&told->rows, &told->room, told->count + 1, sizeof(*told->rows), "stages"))
        told->rows[told->count++] = (struct rg_told_stage){kernel, ms};
}

bool rg_serve_stages(struct rg_message *request, struct rg_message *reply)
{
    struct rg_session *session = take_session(request);
    struct rg_told_stages told = {0};
    const bool ok = session && rg_session_stages(session, keep_stage, &told);
    rg_put_fields(reply, rg_told_stages_fields, &told);
    free(told.rows);
    return ok;
}

bool rg_serve_time(struct rg_message *request, struct rg_message *reply)
{
    struct rg_session *session = take_session(request);
    int64_t time_ns;
    if (!session || !rg_session_time(session, &time_ns))
        return false;
    rg_put_fields(reply, rg_time_fields, &time_ns);
    return true;
}

bool rg_serve_code(struct rg_message *request, struct rg_message *reply)
{
    struct rg_session *session = take_session(request);
    struct rg_session_code code;
    if (!session || !rg_session_code(session, &code))
        return false;
    rg_put_fields(reply, rg_told_code_fields, &code);
    return true;
}

// --- its picture, its state, and what it tells of itself ---

bool rg_serve_read(struct rg_message *request, struct rg_message *reply)
{
    struct rg_session *session = take_session(request);
    struct rg_told_bytes told = {0};
    told.bytes = session ? rg_session_read(session, &told.size) : NULL;
    return rg_serve_bytes(reply, &told);
}

bool rg_serve_tell(struct rg_message *request, struct rg_message *reply)
{
    struct rg_session *session = take_session(request);
    struct rg_account account;
    if (!session || !rg_session_tell(session, &account))
        return false;
    rg_put_fields(reply, rg_told_account_fields, &account);
    return true;
}

bool rg_serve_read_state(struct rg_message *request, struct rg_message *reply)
{
    struct rg_session *session = take_session(request);
    const int index = session ? rg_take_index(request, rg_session_state_count(session)) : 0;
    struct rg_told_bytes told = {0};
    if (session && !request->failed)
        told.bytes = rg_session_read_state(session, index, &told.layout, &told.size);
    return rg_serve_bytes(reply, &told);
}

bool rg_serve_obeys(struct rg_message *request, struct rg_message *reply)
{
    struct rg_session *session = take_session(request);
    struct rg_told_law told = {0};
    if (!session)
        return false;
    const struct rg_law *law = rg_session_law(session, rg_take_index(request, INT32_MAX));
    if (!law)
        return rg_error("a session's technique has no such law");
    told.holds = rg_session_obeys(session, law, told.detail, sizeof(told.detail));
    rg_put_fields(reply, rg_told_law_fields, &told);
    return true;
}

bool rg_serve_texture(struct rg_message *request, struct rg_message *reply)
{
    struct rg_session *session = take_session(request);
    struct rg_told_texture told = {0};
    if (!session)
        return false;
    told.is_found =
        rg_session_texture(session, rg_take_text(request), &told.desc, &told.first_level);
    rg_put_fields(reply, rg_told_texture_fields, &told);
    return true;
}
