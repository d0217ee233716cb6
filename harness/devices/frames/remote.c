// Calls about sessions and runs, here or in a worker (harness/devices/measure/serving/sessions.c
// serves them).
#include "harness/devices/workers/device.h"
#include "harness/devices/frames/calling.h"
#include "harness/devices/frames/messages.h"

static bool fetch(struct rg_worker *worker, enum rg_call call, struct rg_message *message,
                  const void *request, void *reply)
{
    const struct rg_frame_call *row = &rg_frame_calls[call];
    if (row->request)
        rg_put_fields(message, row->request, request);
    const bool ok = rg_worker_fetch(worker, call, message, row->reply, reply);
    rg_message_free(message);
    return ok;
}

bool rg_session_ask(const struct rg_session *session, enum rg_call call, const void *request,
                    void *reply)
{
    struct rg_worker *worker = rg_remote_worker(session->device);
    struct rg_message message = {0};
    if (!worker)
        return rg_frame_calls[call].of_session((struct rg_session *)(uintptr_t)session, request,
                                               reply);
    if (!rg_worker_still_has(worker, session->life))
        return false;
    rg_put_int(&message, session->number);
    return fetch(worker, call, &message, request, reply);
}

bool rg_run_ask(struct rg_device *device, enum rg_call call, const void *request, void *reply)
{
    struct rg_message message = {0};
    if (!rg_remote_worker(device))
        return rg_frame_calls[call].of_run(device, request, reply);
    rg_put_text(&message, device->info.full);
    return fetch(rg_remote_worker(device), call, &message, request, reply);
}

bool rg_remote_session_open(struct rg_session *session, const struct rg_subject *subject)
{
    struct rg_message request = {0};
    struct rg_told_session told = {0};
    struct rg_worker *worker = rg_remote_worker(session->device);
    rg_put_text(&request, session->device->info.full);
    rg_put_int(&request, rg_worker_grant(worker));
    rg_put_subject(&request, subject);
    const bool ok =
        rg_worker_fetch(worker, RG_CALL_SESSION_OPEN, &request, rg_told_session_fields, &told);
    rg_message_free(&request);
    session->number = told.number;
    session->state_count = told.state_count;
    session->life = rg_worker_life(worker);
    return ok;
}

// A session that ended with its worker needs no closing, and no line.
void rg_remote_session_close(struct rg_session *session)
{
    struct rg_worker *worker = rg_remote_worker(session->device);
    struct rg_message request = {0};
    if (!rg_worker_has(worker, session->life))
        return;
    rg_put_int(&request, session->number);
    if (!rg_worker_ask(worker, RG_CALL_SESSION_CLOSE, &request))
        rg_worker_closes_badly(worker);
    rg_message_free(&request);
}
