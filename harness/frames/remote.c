// A session whose instance lives in a worker (harness/devices/serving/sessions.c serves its calls).
#include <limits.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/base/array.h"
#include "core/base/log.h"
#include "harness/frames/ways.h"
#include "harness/frames/messages.h"
#include "harness/devices/workers/device.h"

static struct rg_worker *worker_of(const struct rg_session *session)
{
    return rg_remote_worker(session->device);
}

// Asks for a call of a session: its number goes before what `request` holds, which is freed. False,
// with one logged line, on failure; `reply` is to be freed in either case.
static bool call(const struct rg_session *session, enum rg_call which, struct rg_message *request,
                 struct rg_message *reply)
{
    struct rg_message whole = {0};
    *reply = (struct rg_message){0};
    bool ok = rg_worker_still_has(worker_of(session), session->life);
    rg_put_int(&whole, session->number);
    if (request)
        rg_put(&whole, request->bytes, request->size);
    whole.failed = whole.failed || (request && request->failed);
    ok = ok && rg_worker_call(worker_of(session), which, &whole, reply);
    rg_message_free(&whole);
    if (request)
        rg_message_free(request);
    return ok;
}

// The same where nothing but success comes back.
static bool ask(struct rg_session *session, enum rg_call which)
{
    struct rg_message reply;
    const bool ok = call(session, which, NULL, &reply);
    rg_message_free(&reply);
    return ok;
}

// Ends the taking of a reply.
static bool finish(struct rg_message *reply, bool ok)
{
    ok = ok && !reply->failed;
    rg_message_free(reply);
    return ok;
}

static bool open_remote(struct rg_session *session, const struct rg_subject *subject)
{
    struct rg_message request = {0}, reply;
    struct rg_worker *worker = worker_of(session);
    rg_put_text(&request, session->device->info.name);
    rg_put_int(&request, rg_worker_grant(worker));
    rg_put_subject(&request, subject);
    bool ok = rg_worker_call(worker, RG_CALL_SESSION_OPEN, &request, &reply);
    if (ok) {
        session->number = rg_take_index(&reply, INT32_MAX);
        session->state_count = rg_take_index(&reply, RG_MAX_STATE + 1);
        session->life = rg_worker_life(worker);
    }
    rg_message_free(&request);
    return finish(&reply, ok);
}

// What is gone with its worker needs no closing, and no line.
static void close_remote(struct rg_session *session)
{
    if (rg_worker_has(worker_of(session), session->life))
        ask(session, RG_CALL_SESSION_CLOSE);
}

// --- simulating and drawing ---

static bool step(struct rg_session *session)
{
    return ask(session, RG_CALL_STEP);
}

static bool draw(struct rg_session *session)
{
    return ask(session, RG_CALL_DRAW);
}

static bool wait_for_all(struct rg_session *session)
{
    return ask(session, RG_CALL_SYNC);
}

static const double most_ms = 1e18; // far beyond any time, and far from infinity

static bool run_frames(struct rg_session *session, int frames, double *wall_ms)
{
    struct rg_message request = {0}, reply;
    rg_put_int(&request, frames);
    const bool ok = call(session, RG_CALL_FRAMES, &request, &reply);
    const double ms = ok ? rg_take_number(&reply, 0, most_ms) : 0;
    if (wall_ms)
        *wall_ms = ms;
    return finish(&reply, ok);
}

static bool count(struct rg_session *session, struct rg_tally *tally)
{
    struct rg_message reply;
    const bool ok = call(session, RG_CALL_COUNT, NULL, &reply) && rg_take_tally(&reply, tally);
    return finish(&reply, ok);
}

static bool time_stages(struct rg_session *session,
                        void (*tell)(const char *kernel, double ms, void *user), void *user)
{
    struct rg_message reply;
    const bool ok = call(session, RG_CALL_STAGES, NULL, &reply);
    const int64_t stages = ok ? rg_take_int(&reply) : 0;
    for (int64_t i = 0; i < stages && !reply.failed; i++) {
        const char *kernel = rg_take_name(&reply);
        const double ms = rg_take_number(&reply, 0, most_ms);
        if (!reply.failed)
            tell(kernel, ms, user);
    }
    return finish(&reply, ok);
}

static bool tell_time(struct rg_session *session, int64_t *time_ns)
{
    struct rg_message reply;
    const bool ok = call(session, RG_CALL_TIME, NULL, &reply) && RG_TAKE(&reply, *time_ns);
    return finish(&reply, ok);
}

static bool tell_code(struct rg_session *session, struct rg_session_code *code)
{
    struct rg_message reply;
    const bool ok = call(session, RG_CALL_CODE, NULL, &reply);
    *code = (struct rg_session_code){.libraries = 0};
    if (ok) {
        snprintf(code->program, sizeof(code->program), "%s", rg_take_text(&reply));
        RG_TAKE(&reply, code->libraries);
        RG_TAKE(&reply, code->passes.hash);
        code->passes.bytes = rg_take_int(&reply);
    }
    return finish(&reply, ok);
}

// --- its picture, its state, and what it tells of itself ---

// The bytes of a reply's block, of the size that is due where that is not 0; NULL where they fail.
static void *take_bytes(struct rg_message *reply, bool ok, size_t due, size_t *size)
{
    int64_t taken = 0;
    void *bytes = ok ? rg_take_block(reply, &taken) : NULL;
    *size = (size_t)taken;
    if (bytes && due && *size != due)
        reply->failed =
            !rg_driver_error("a picture from another process has %zu bytes, not %zu", *size, due);
    if (finish(reply, bytes != NULL))
        return bytes;
    free(bytes);
    return NULL;
}

static void *read_picture(struct rg_session *session, size_t *size)
{
    struct rg_message reply;
    const bool ok = call(session, RG_CALL_READ, NULL, &reply);
    const size_t due =
        (size_t)session->width * (size_t)session->height * (size_t)rg_format_size(RG_RGBA16F);
    return take_bytes(&reply, ok, due, size);
}

// Of a session that has gone nothing is told.
static bool tell(const struct rg_session *session, struct rg_account *account)
{
    struct rg_message reply;
    const bool ok = call(session, RG_CALL_TELL, NULL, &reply) && rg_take_account(&reply, account);
    const bool told = finish(&reply, ok);
    if (!told)
        *account = (struct rg_account){0};
    return told;
}

static void *read_state(struct rg_session *session, int index, struct rg_state *layout,
                        size_t *size)
{
    struct rg_message request = {0}, reply;
    rg_put_int(&request, index);
    const bool ok =
        call(session, RG_CALL_READ_STATE, &request, &reply) && rg_take_layout(&reply, layout);
    return take_bytes(&reply, ok, 0, size);
}

static bool obeys(const struct rg_session *session, const struct rg_law *law, char *detail,
                  size_t size)
{
    struct rg_message request = {0}, reply;
    rg_put_int(&request, law - session->technique->proof->laws);
    const bool ok = call(session, RG_CALL_OBEYS, &request, &reply);
    const bool holds = ok && rg_take_index(&reply, 2);
    snprintf(detail, size, "%s", ok ? rg_take_text(&reply) : rg_last_error());
    return finish(&reply, ok) && holds;
}

static bool texture(const struct rg_session *session, const char *name, struct rg_image_desc *desc,
                    int *first_level)
{
    struct rg_message request = {0}, reply;
    rg_put_text(&request, name);
    const bool ok = call(session, RG_CALL_TEXTURE, &request, &reply);
    const bool found = ok && rg_take_index(&reply, 2) && rg_take_image_desc(&reply, desc);
    if (found)
        *first_level = rg_take_index(&reply, RG_MAX_LEVELS);
    return finish(&reply, ok) && found;
}

// --- digests ---

static bool call_for_run(const struct rg_digest_run *run, struct rg_device *device,
                         enum rg_call which, int row, struct rg_message *reply)
{
    struct rg_message request = {0};
    rg_put_text(&request, device->info.name);
    rg_put_subject(&request, &run->subject);
    rg_put_int(&request, run->frames);
    rg_put_int(&request, row);
    const bool ok = rg_worker_call(rg_remote_worker(device), which, &request, reply);
    rg_message_free(&request);
    return ok;
}

static bool take_digests(const struct rg_digest_run *run, struct rg_device *device,
                         struct rg_digests *digests)
{
    struct rg_message reply;
    int64_t size = 0;
    bool ok = call_for_run(run, device, RG_CALL_DIGESTS, 0, &reply);
    digests->rows = ok ? rg_take_block(&reply, &size) : NULL;
    if (size % (int64_t)sizeof(*digests->rows) ||
        size / (int64_t)sizeof(*digests->rows) > INT_MAX) {
        rg_message_fail(&reply);
        size = 0;
    }
    digests->room = digests->count = (int)(size / (int64_t)sizeof(*digests->rows));
    for (int i = 0; i < digests->count; i++) {
        struct rg_digest *row = &digests->rows[i];
        row->stage[RG_ASSET_NAME - 1] = row->asset[RG_ASSET_NAME - 1] = 0;
        if (row->frame < 0 || row->stages_run < 0 || row->weight < 0)
            rg_message_fail(&reply);
    }
    return finish(&reply, ok);
}

static bool take_contents(const struct rg_digest_run *run, struct rg_device *device, int row,
                          struct rg_contents *contents, struct rg_state *state)
{
    struct rg_message reply;
    const bool ok = call_for_run(run, device, RG_CALL_CONTENTS, row, &reply) &&
                    rg_take_image_desc(&reply, &contents->desc) && rg_take_layout(&reply, state) &&
                    rg_take_contents_bytes(&reply, contents);
    return finish(&reply, ok);
}

static bool take_dispatches(const struct rg_digest_run *run, struct rg_device *device,
                            int stages_run, struct rg_dispatches *all)
{
    struct rg_message reply;
    bool ok = call_for_run(run, device, RG_CALL_DISPATCHES, stages_run, &reply);
    const int count = ok ? rg_take_index(&reply, INT32_MAX) : 0;
    for (int i = 0; ok && i < count; i++) {
        ok = rg_array_fit(&all->rows, &all->room, i + 1, sizeof(*all->rows), "dispatches");
        if (!ok)
            break;
        struct rg_dispatched *row = &all->rows[all->count++];
        *row = (struct rg_dispatched){0};
        ok = rg_take_dispatched(&reply, row) && rg_take_dispatched_after(&reply, row);
    }
    return finish(&reply, ok);
}

static bool run_dispatched(struct rg_dispatched *dispatched, struct rg_device *device)
{
    struct rg_message request = {0}, reply;
    rg_put_text(&request, device->info.name);
    rg_put_dispatched(&request, dispatched);
    const bool ok = rg_worker_call(rg_remote_worker(device), RG_CALL_DISPATCH, &request, &reply) &&
                    rg_take_dispatched_after(&reply, dispatched);
    rg_message_free(&request);
    return finish(&reply, ok);
}

static void *take_code(struct rg_device *device, const struct rg_kernel *kernel,
                       enum rg_code_kind kind, size_t *size)
{
    struct rg_message request = {0}, reply;
    rg_put_text(&request, device->info.name);
    rg_put_text(&request, kernel->name);
    rg_put_int(&request, kind);
    const bool ok = rg_worker_call(rg_remote_worker(device), RG_CALL_KERNEL_CODE, &request, &reply);
    rg_message_free(&request);
    return take_bytes(&reply, ok, 0, size);
}

const struct rg_session_ways rg_remote_session = {
    .open = open_remote,
    .close = close_remote,
    .step = step,
    .draw = draw,
    .sync = wait_for_all,
    .frames = run_frames,
    .count = count,
    .stages = time_stages,
    .time = tell_time,
    .code = tell_code,
    .read = read_picture,
    .tell = tell,
    .read_state = read_state,
    .obeys = obeys,
    .texture = texture,
    .take_digests = take_digests,
    .take_contents = take_contents,
    .take_dispatches = take_dispatches,
    .run_dispatched = run_dispatched,
    .take_code = take_code,
};
