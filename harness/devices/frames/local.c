// The one table of the calls about sessions and runs, as this process does them.
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "core/base/array.h"
#include "core/base/log.h"
#include "core/device/pass.h"
#include "core/techniques/stages/stages.h"
#include "harness/console/clock.h"
#include "harness/console/interrupt.h"
#include "harness/devices/frames/calling.h"
#include "harness/devices/frames/messages.h"
#include "harness/devices/frames/recorder.h"

// --- simulating and drawing ---

static bool step(struct rg_session *session, const void *request, void *reply)
{
    (void)request;
    (void)reply;
    return session->technique->step(session->instance);
}

static bool draw(struct rg_session *session, const void *request, void *reply)
{
    (void)request;
    (void)reply;
    return session->technique->draw(session->instance);
}

static bool wait_for_all(struct rg_session *session, const void *request, void *reply)
{
    (void)request;
    (void)reply;
    return rg_device_sync(session->device);
}

static bool run_frames(struct rg_session *session, int frames)
{
    const struct rg_technique *technique = session->technique;
    bool ok = true;
    for (int i = 0; ok && i < frames && !rg_interrupted(); i++)
        ok = technique->step(session->instance) && technique->draw(session->instance);
    return ok && rg_device_sync(session->device);
}

static bool frames(struct rg_session *session, const void *request, void *reply)
{
    const struct rg_asked *asked = request;
    double *wall_ms = reply;
    const double start_ms = rg_now_ms();
    const bool ok = run_frames(session, asked->number);
    *wall_ms = rg_now_ms() - start_ms;
    return ok;
}

static bool count(struct rg_session *session, const void *request, void *reply)
{
    (void)request;
    rg_tally_begin(session->device, reply);
    const bool ok = run_frames(session, 1);
    rg_tally_end(session->device);
    return ok;
}

struct stage_clock {
    struct rg_session *session;
    struct rg_told_stages *told;
    double last_ms;
    bool ok;
};

static void after_stage(const struct rg_opened_stage *stage, void *user)
{
    struct stage_clock *clock = user;
    struct rg_told_stages *told = clock->told;
    clock->ok =
        rg_device_sync(clock->session->device) && clock->ok &&
        rg_array_fit(&told->rows, &told->room, told->count + 1, sizeof(*told->rows), "stages");
    const double now_ms = rg_now_ms();
    if (clock->ok)
        told->rows[told->count++] =
            (struct rg_told_stage){stage->row.kernel, now_ms - clock->last_ms};
    clock->last_ms = now_ms;
}

static bool stages(struct rg_session *session, const void *request, void *reply)
{
    struct stage_clock clock = {session, reply, rg_now_ms(), true};
    (void)request;
    session->instance->after_stage = after_stage;
    session->instance->user = &clock;
    const bool ok = run_frames(session, 1);
    session->instance->after_stage = NULL;
    return ok && clock.ok;
}

static bool tell_time(struct rg_session *session, const void *request, void *reply)
{
    (void)request;
    return rg_device_time(session->device, reply);
}

static void add_pass_code(const void *bytes, size_t size, void *user)
{
    struct rg_session_code *code = user;
    code->passes.hash = XXH3_64bits_withSeed(bytes, size, code->passes.hash);
    code->passes.bytes += (int64_t)size;
}

static bool tell_code(struct rg_session *session, const void *request, void *reply)
{
    const struct rg_instance *instance = session->instance;
    struct rg_session_code *code = reply;
    (void)request;
    *code = (struct rg_session_code){.libraries = rg_libraries_hash()};
    rg_program_id(code->program);
    for (int i = 0; i < instance->stage_count; i++)
        if (instance->stages[i].owns_pass &&
            !rg_pass_code(instance->stages[i].pass, add_pass_code, code))
            return false;
    return true;
}

// --- picture, state and account ---

static bool read_picture(struct rg_session *session, const void *request, void *reply)
{
    struct rg_told_bytes *told = reply;
    (void)request;
    told->bytes = rg_frame_read(session->instance, &told->size);
    return told->bytes;
}

static bool tell(struct rg_session *session, const void *request, void *reply)
{
    const struct rg_instance *instance = session->instance;
    struct rg_account *account = reply;
    (void)request;
    *account = (struct rg_account){.frame = instance->frame,
                                   .counter_count = instance->counter_count,
                                   .fact_count = instance->fact_count};
    memcpy(account->counters, instance->counters, sizeof(account->counters));
    memcpy(account->facts, instance->facts, sizeof(account->facts));
    return true;
}

static bool read_state(struct rg_session *session, const void *request, void *reply)
{
    const struct rg_asked *asked = request;
    struct rg_told_bytes *told = reply;
    if (asked->number >= session->instance->state_count)
        return rg_error("a session has no state of the number %d", asked->number);
    const struct rg_state *state = &session->instance->state[asked->number];
    struct rg_buf *buf = state->asset->buf;
    told->layout = *state;
    told->layout.asset = NULL;
    told->layout.words = rg_asset_words(session->instance, NULL, state->asset);
    told->size = buf->size;
    told->bytes = malloc(buf->size);
    if (!told->bytes)
        return rg_harness_error("buffer '%s': no memory for %zu bytes", state->name, buf->size);
    return rg_buf_read(buf, 0, told->bytes, (int64_t)buf->size);
}

const struct rg_law *rg_session_law(const struct rg_session *session, int number)
{
    const struct rg_law *law = session->technique->proof->laws;
    for (int i = 0; law->name && i < number; i++)
        law++;
    return law->name ? law : NULL;
}

static bool obeys(struct rg_session *session, const void *request, void *reply)
{
    const struct rg_asked *asked = request;
    struct rg_told_law *told = reply;
    const struct rg_law *law = rg_session_law(session, asked->number);
    if (!law)
        return rg_error("a session's technique has no such law");
    told->holds = law->holds(session->instance, told->detail, sizeof(told->detail));
    return told->holds || *told->detail; // else the state could not be read
}

static bool texture(struct rg_session *session, const void *request, void *reply)
{
    const struct rg_instance *instance = session->instance;
    const struct rg_asked *asked = request;
    struct rg_told_texture *told = reply;
    for (int i = 0; i < instance->texture_count && !told->is_found; i++) {
        const struct rg_texture *found = &instance->textures[i];
        if (asked->name && !strcmp(found->name, asked->name))
            *told = (struct rg_told_texture){true, found->image->desc, found->first_level};
    }
    return true;
}

// --- runs whose stages are examined, and kernels alone ---

static bool digests(struct rg_device *device, const void *request, void *reply)
{
    const struct rg_asked_run *asked = request;
    return rg_recorder_take(&asked->run, device, reply);
}

static bool contents(struct rg_device *device, const void *request, void *reply)
{
    const struct rg_asked_run *asked = request;
    struct rg_told_contents *told = reply;
    return rg_recorder_contents(&asked->run, device, asked->row, &told->contents, &told->state);
}

static bool dispatches(struct rg_device *device, const void *request, void *reply)
{
    const struct rg_asked_run *asked = request;
    return rg_recorder_dispatches(&asked->run, device, asked->row, reply);
}

// A worker's reply is another struct than the request, which lends it the contents before the run.
static bool dispatch(struct rg_device *device, const void *request, void *reply)
{
    struct rg_dispatched *told = reply;
    if (request != reply)
        *told = *(const struct rg_dispatched *)request;
    return rg_dispatched_run(told, device);
}

static bool kernel_code(struct rg_device *device, const void *request, void *reply)
{
    const struct rg_asked *asked = request;
    struct rg_told_bytes *told = reply;
    const struct rg_kernel *kernel = asked->name ? rg_kernel_find(asked->name) : NULL;
    if (!kernel || asked->number >= RG_CODE_COUNT)
        return rg_error("a call names no kernel, or no kind of code");
    told->bytes = rg_recorder_code(device, kernel, (enum rg_code_kind)asked->number, &told->size);
    return told->bytes;
}

static bool compile(struct rg_device *device, const void *request, void *reply)
{
    const struct rg_asked *asked = request;
    struct rg_pass *pass = rg_pass_create(device, asked->name ? asked->name : "");
    (void)reply;
    rg_pass_destroy(pass);
    return pass;
}

// --- the table ---

#define REQUEST(S, fields) .request = (fields), .request_size = sizeof(S)
#define REPLY(S, fields)   .reply = (fields), .reply_size = sizeof(S)
#define ASKED              REQUEST(struct rg_asked, rg_asked_fields)
#define RUN                REQUEST(struct rg_asked_run, rg_asked_run_fields)

const struct rg_frame_call rg_frame_calls[RG_CALL_COUNT_OF_CALLS] = {
    [RG_CALL_STEP] = {step},
    [RG_CALL_DRAW] = {draw},
    [RG_CALL_SYNC] = {wait_for_all},
    [RG_CALL_FRAMES] = {frames, ASKED, REPLY(double, rg_ms_fields)},
    [RG_CALL_COUNT] = {count, REPLY(struct rg_tally, rg_told_tally_fields)},
    [RG_CALL_STAGES] = {stages, REPLY(struct rg_told_stages, rg_told_stages_fields)},
    [RG_CALL_TIME] = {tell_time, REPLY(int64_t, rg_time_fields)},
    [RG_CALL_CODE] = {tell_code, REPLY(struct rg_session_code, rg_told_code_fields)},
    [RG_CALL_READ] = {read_picture, REPLY(struct rg_told_bytes, rg_told_bytes_fields)},
    [RG_CALL_TELL] = {tell, REPLY(struct rg_account, rg_told_account_fields)},
    [RG_CALL_READ_STATE] = {read_state, ASKED, REPLY(struct rg_told_bytes, rg_told_bytes_fields)},
    [RG_CALL_OBEYS] = {obeys, ASKED, REPLY(struct rg_told_law, rg_told_law_fields)},
    [RG_CALL_TEXTURE] = {texture, ASKED, REPLY(struct rg_told_texture, rg_told_texture_fields)},
    [RG_CALL_DIGESTS] = {.of_run = digests, RUN, REPLY(struct rg_digests, rg_told_digests_fields)},
    [RG_CALL_CONTENTS] = {.of_run = contents,
                          RUN,
                          REPLY(struct rg_told_contents, rg_told_contents_fields)},
    [RG_CALL_DISPATCHES] = {.of_run = dispatches,
                            RUN,
                            REPLY(struct rg_dispatches, rg_told_dispatches_fields)},
    [RG_CALL_DISPATCH] = {.of_run = dispatch,
                          REQUEST(struct rg_dispatched, rg_asked_dispatched_fields),
                          REPLY(struct rg_dispatched, rg_told_dispatched_fields)},
    [RG_CALL_KERNEL_CODE] = {.of_run = kernel_code,
                             ASKED,
                             REPLY(struct rg_told_bytes, rg_told_bytes_fields)},
    [RG_CALL_COMPILE] = {.of_run = compile, ASKED},
};
