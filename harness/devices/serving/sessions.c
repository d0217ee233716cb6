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
    rg_put_int(reply, sessions.count);
    rg_put_int(reply, rg_session_state_count(session));
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
    RG_PUT(reply, wall_ms);
    return true;
}

bool rg_serve_count(struct rg_message *request, struct rg_message *reply)
{
    struct rg_session *session = take_session(request);
    struct rg_tally tally;
    if (!session || !rg_session_count(session, &tally))
        return false;
    rg_put_tally(reply, &tally);
    return true;
}

struct told_stages {
    int64_t count;
    struct rg_message rows;
};

static void put_stage(const char *kernel, double ms, void *user)
{
    struct told_stages *told = user;
    rg_put_text(&told->rows, kernel);
    RG_PUT(&told->rows, ms);
    told->count++;
}

bool rg_serve_stages(struct rg_message *request, struct rg_message *reply)
{
    struct rg_session *session = take_session(request);
    struct told_stages told = {0};
    const bool ok = session && rg_session_stages(session, put_stage, &told);
    rg_put_int(reply, told.count);
    rg_put(reply, told.rows.bytes, told.rows.size);
    rg_message_free(&told.rows);
    return ok;
}

bool rg_serve_time(struct rg_message *request, struct rg_message *reply)
{
    struct rg_session *session = take_session(request);
    int64_t time_ns;
    if (!session || !rg_session_time(session, &time_ns))
        return false;
    RG_PUT(reply, time_ns);
    return true;
}

bool rg_serve_code(struct rg_message *request, struct rg_message *reply)
{
    struct rg_session *session = take_session(request);
    struct rg_session_code code;
    if (!session || !rg_session_code(session, &code))
        return false;
    rg_put_text(reply, code.program);
    RG_PUT(reply, code.libraries);
    RG_PUT(reply, code.passes.hash);
    rg_put_int(reply, code.passes.bytes);
    return true;
}

// --- its picture, its state, and what it tells of itself ---

bool rg_serve_read(struct rg_message *request, struct rg_message *reply)
{
    struct rg_session *session = take_session(request);
    size_t size = 0;
    void *texels = session ? rg_session_read(session, &size) : NULL;
    if (texels)
        rg_put_block(reply, texels, (int64_t)size);
    free(texels);
    return texels;
}

bool rg_serve_tell(struct rg_message *request, struct rg_message *reply)
{
    struct rg_session *session = take_session(request);
    struct rg_account account;
    if (!session || !rg_session_tell(session, &account))
        return false;
    rg_put_account(reply, &account);
    return true;
}

bool rg_serve_read_state(struct rg_message *request, struct rg_message *reply)
{
    struct rg_session *session = take_session(request);
    const int index = session ? rg_take_index(request, rg_session_state_count(session)) : 0;
    struct rg_state layout;
    size_t size = 0;
    void *words =
        session && !request->failed ? rg_session_read_state(session, index, &layout, &size) : NULL;
    if (words) {
        rg_put_layout(reply, &layout);
        rg_put_block(reply, words, (int64_t)size);
    }
    free(words);
    return words;
}

bool rg_serve_obeys(struct rg_message *request, struct rg_message *reply)
{
    struct rg_session *session = take_session(request);
    char detail[512] = "";
    if (!session)
        return false;
    const struct rg_law *law = rg_session_law(session, rg_take_index(request, INT32_MAX));
    if (!law)
        return rg_error("a session's technique has no such law");
    rg_put_int(reply, rg_session_obeys(session, law, detail, sizeof(detail)));
    rg_put_text(reply, detail);
    return true;
}

bool rg_serve_texture(struct rg_message *request, struct rg_message *reply)
{
    struct rg_session *session = take_session(request);
    struct rg_image_desc desc;
    int first_level;
    if (!session)
        return false;
    const bool found = rg_session_texture(session, rg_take_text(request), &desc, &first_level);
    rg_put_int(reply, found);
    if (found) {
        RG_PUT(reply, desc);
        rg_put_int(reply, first_level);
    }
    return true;
}
