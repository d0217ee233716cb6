// A session whose instance lives in a worker (harness/devices/serving/sessions.c serves its calls).
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

// Asks for a call of a session: its number goes before what `request` holds, which is freed. What
// comes back is a struct of these fields; NULL: nothing but success does. False, with one logged
// line, on failure.
static bool ask_with(const struct rg_session *session, enum rg_call call,
                     struct rg_message *request, const struct rg_field *fields, void *all)
{
    struct rg_message whole = {0};
    rg_put_int(&whole, session->number);
    rg_put(&whole, request->bytes, request->size);
    whole.failed = whole.failed || request->failed;
    const bool ok = rg_worker_still_has(worker_of(session), session->life) &&
                    rg_worker_fetch(worker_of(session), call, &whole, fields, all);
    rg_message_free(&whole);
    rg_message_free(request);
    return ok;
}

static bool ask(const struct rg_session *session, enum rg_call call, const struct rg_field *fields,
                void *all)
{
    return ask_with(session, call, &(struct rg_message){0}, fields, all);
}

static bool open_remote(struct rg_session *session, const struct rg_subject *subject)
{
    struct rg_message request = {0};
    struct rg_told_session told = {0};
    struct rg_worker *worker = worker_of(session);
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

// What is gone with its worker needs no closing, and no line.
static void close_remote(struct rg_session *session)
{
    if (rg_worker_has(worker_of(session), session->life) &&
        !ask(session, RG_CALL_SESSION_CLOSE, NULL, NULL))
        rg_worker_closes_badly(worker_of(session));
}

// --- simulating and drawing ---

static bool step(struct rg_session *session)
{
    return ask(session, RG_CALL_STEP, NULL, NULL);
}

static bool draw(struct rg_session *session)
{
    return ask(session, RG_CALL_DRAW, NULL, NULL);
}

static bool wait_for_all(struct rg_session *session)
{
    return ask(session, RG_CALL_SYNC, NULL, NULL);
}

static bool run_frames(struct rg_session *session, int frames, double *wall_ms)
{
    struct rg_message request = {0};
    double ms = 0;
    rg_put_int(&request, frames);
    const bool ok = ask_with(session, RG_CALL_FRAMES, &request, rg_ms_fields, &ms);
    if (wall_ms)
        *wall_ms = ms;
    return ok;
}

static bool count(struct rg_session *session, struct rg_tally *tally)
{
    return ask(session, RG_CALL_COUNT, rg_told_tally_fields, tally);
}

static bool time_stages(struct rg_session *session,
                        void (*tell)(const char *kernel, double ms, void *user), void *user)
{
    struct rg_told_stages told = {0};
    const bool ok = ask(session, RG_CALL_STAGES, rg_told_stages_fields, &told);
    for (int i = 0; ok && i < told.count; i++)
        tell(told.rows[i].kernel, told.rows[i].ms, user);
    free(told.rows);
    return ok;
}

static bool tell_time(struct rg_session *session, int64_t *time_ns)
{
    return ask(session, RG_CALL_TIME, rg_time_fields, time_ns);
}

static bool tell_code(struct rg_session *session, struct rg_session_code *code)
{
    *code = (struct rg_session_code){.libraries = 0};
    return ask(session, RG_CALL_CODE, rg_told_code_fields, code);
}

// --- its picture, its state, and what it tells of itself ---

// The bytes of what was told; NULL, and freed, where that failed.
static void *bytes_of(struct rg_told_bytes *told, bool ok, size_t *size)
{
    *size = told->size;
    if (ok)
        return told->bytes;
    free(told->bytes);
    return NULL;
}

static void *read_picture(struct rg_session *session, size_t *size)
{
    struct rg_told_bytes told = {0};
    bool ok = ask(session, RG_CALL_READ, rg_told_bytes_fields, &told);
    const size_t due =
        (size_t)session->width * (size_t)session->height * (size_t)rg_format_size(RG_RGBA16F);
    if (ok && told.size != due)
        ok = rg_driver_error("device '%s': a picture from its process has %zu bytes, not %zu",
                             session->device->info.name, told.size, due);
    return bytes_of(&told, ok, size);
}

// Of a session that has gone nothing is told.
static bool tell(const struct rg_session *session, struct rg_account *account)
{
    *account = (struct rg_account){0};
    const bool told = ask(session, RG_CALL_TELL, rg_told_account_fields, account);
    if (!told)
        *account = (struct rg_account){0};
    return told;
}

static void *read_state(struct rg_session *session, int index, struct rg_state *layout,
                        size_t *size)
{
    struct rg_message request = {0};
    struct rg_told_bytes told = {0};
    rg_put_int(&request, index);
    const bool ok = ask_with(session, RG_CALL_READ_STATE, &request, rg_told_bytes_fields, &told);
    *layout = told.layout;
    return bytes_of(&told, ok, size);
}

static bool obeys(const struct rg_session *session, const struct rg_law *law, char *detail,
                  size_t size)
{
    struct rg_message request = {0};
    struct rg_told_law told = {0};
    rg_put_int(&request, law - session->technique->proof->laws);
    const bool ok = ask_with(session, RG_CALL_OBEYS, &request, rg_told_law_fields, &told);
    snprintf(detail, size, "%s", ok ? told.detail : rg_last_error());
    return ok && told.holds;
}

static bool texture(const struct rg_session *session, const char *name, struct rg_image_desc *desc,
                    int *first_level)
{
    struct rg_message request = {0};
    struct rg_told_texture told = {0};
    rg_put_text(&request, name);
    const bool ok = ask_with(session, RG_CALL_TEXTURE, &request, rg_told_texture_fields, &told);
    if (!ok || !told.is_found)
        return false;
    *desc = told.desc;
    *first_level = told.first_level;
    return true;
}

// --- runs whose stages are looked at ---

static void put_run(struct rg_message *request, const struct rg_digest_run *run,
                    const struct rg_device *device, int row)
{
    rg_put_text(request, device->info.full);
    rg_put_subject(request, &run->subject);
    rg_put_int(request, run->frames);
    rg_put_int(request, row);
}

static bool take_digests(const struct rg_digest_run *run, struct rg_device *device,
                         struct rg_digests *digests)
{
    struct rg_message request = {0};
    put_run(&request, run, device, 0);
    const bool ok = rg_worker_fetch(rg_remote_worker(device), RG_CALL_DIGESTS, &request,
                                    rg_told_digests_fields, digests);
    rg_message_free(&request);
    if (!ok)
        rg_digests_free(digests);
    return ok;
}

static bool take_contents(const struct rg_digest_run *run, struct rg_device *device, int row,
                          struct rg_contents *contents, struct rg_state *state)
{
    struct rg_message request = {0};
    struct rg_told_contents told = {.contents = {.size = 0}};
    put_run(&request, run, device, row);
    const bool ok = rg_worker_fetch(rg_remote_worker(device), RG_CALL_CONTENTS, &request,
                                    rg_told_contents_fields, &told);
    rg_message_free(&request);
    *contents = told.contents;
    *state = told.state;
    return ok;
}

static bool take_dispatches(const struct rg_digest_run *run, struct rg_device *device,
                            int stages_run, struct rg_dispatches *all)
{
    struct rg_message request = {0}, reply;
    put_run(&request, run, device, stages_run);
    bool ok = rg_worker_call(rg_remote_worker(device), RG_CALL_DISPATCHES, &request, &reply);
    const int count = ok ? rg_take_index(&reply, INT32_MAX) : 0;
    for (int i = 0; ok && i < count; i++) {
        ok = rg_array_fit(&all->rows, &all->room, i + 1, sizeof(*all->rows), "dispatches");
        if (!ok)
            break;
        struct rg_dispatched *row = &all->rows[all->count++];
        *row = (struct rg_dispatched){0};
        ok = rg_take_dispatched(&reply, row) && rg_take_dispatched_after(&reply, row);
    }
    rg_message_free(&request);
    return rg_worker_finish(&reply, ok);
}

static bool run_dispatched(struct rg_dispatched *dispatched, struct rg_device *device)
{
    struct rg_message request = {0}, reply;
    rg_put_text(&request, device->info.full);
    rg_put_dispatched(&request, dispatched);
    const bool ok = rg_worker_call(rg_remote_worker(device), RG_CALL_DISPATCH, &request, &reply) &&
                    rg_take_dispatched_after(&reply, dispatched);
    rg_message_free(&request);
    return rg_worker_finish(&reply, ok);
}

static void *take_code(struct rg_device *device, const struct rg_kernel *kernel,
                       enum rg_code_kind kind, size_t *size)
{
    struct rg_message request = {0};
    struct rg_told_bytes told = {0};
    rg_put_text(&request, device->info.full);
    rg_put_text(&request, kernel->name);
    rg_put_int(&request, kind);
    const bool ok = rg_worker_fetch(rg_remote_worker(device), RG_CALL_KERNEL_CODE, &request,
                                    rg_told_bytes_fields, &told);
    rg_message_free(&request);
    return bytes_of(&told, ok, size);
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
