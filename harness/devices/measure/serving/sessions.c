// Calls about sessions and runs (harness/devices/frames/remote.c makes them).
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/base/array.h"
#include "core/base/log.h"
#include "core/base/memory.h"
#include "harness/devices/frames/calling.h"
#include "harness/devices/frames/messages.h"
#include "harness/devices/measure/serving/services.h"

// By number; NULL: closed. Numbers are never reused, so that each means one session.
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

// --- calls about a session, and about runs of the device ---

static bool serve(const struct rg_frame_call *row, struct rg_message *request, void *asked,
                  void *told)
{
    struct rg_session *session = NULL;
    struct rg_device *device = NULL;
    if (row->of_session)
        session = take_session(request);
    else
        device = rg_served_device(rg_take_text(request));
    return (session || device) && !request->failed &&
           (!row->request || rg_take_fields(request, row->request, asked)) &&
           (session ? row->of_session(session, asked, told) : row->of_run(device, asked, told));
}

static bool serve_call(enum rg_call call, struct rg_message *request, struct rg_message *reply)
{
    const struct rg_frame_call *row = &rg_frame_calls[call];
    void *asked = rg_alloc(1, row->request_size + 1, "a request");
    void *told = rg_alloc(1, row->reply_size + 1, "a reply");
    const bool ok = asked && told && serve(row, request, asked, told);
    if (ok && row->reply)
        rg_put_fields(reply, row->reply, told);
    if (told && row->reply)
        rg_free_fields(row->reply, told);
    if (asked && row->request)
        rg_free_fields(row->request, asked);
    free(told);
    free(asked);
    return ok;
}

#define SERVICE(name, service, doing)                                                              \
    bool rg_serve_##service(struct rg_message *request, struct rg_message *reply)                  \
    {                                                                                              \
        return serve_call(RG_CALL_##name, request, reply);                                         \
    }
RG_SESSION_CALLS(SERVICE)
RG_RUN_CALLS(SERVICE)
