// A session whose instance lives in this process.
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "core/base/log.h"
#include "core/device/pass.h"
#include "harness/console/clock.h"
#include "harness/console/interrupt.h"
#include "harness/frames/ways.h"
#include "harness/frames/recorder.h"

static bool open_local(struct rg_session *session, const struct rg_subject *subject)
{
    session->instance = rg_instance_open(subject->technique, session->device, subject->settings,
                                         subject->width, subject->height);
    if (session->instance)
        session->state_count = session->instance->state_count;
    return session->instance;
}

static void close_local(struct rg_session *session)
{
    rg_instance_close(session->instance);
}

// --- simulating and drawing ---

static bool step(struct rg_session *session)
{
    return session->technique->step(session->instance);
}

static bool draw(struct rg_session *session)
{
    return session->technique->draw(session->instance);
}

static bool wait_for_all(struct rg_session *session)
{
    return rg_device_sync(session->device);
}

static bool run_frames(struct rg_session *session, int frames, double *wall_ms)
{
    const double start_ms = rg_now_ms();
    bool ok = true;
    for (int i = 0; ok && i < frames && !rg_interrupted(); i++)
        ok = step(session) && draw(session);
    ok = ok && wait_for_all(session);
    if (wall_ms)
        *wall_ms = rg_now_ms() - start_ms;
    return ok;
}

static bool count(struct rg_session *session, struct rg_tally *tally)
{
    rg_tally_begin(session->device, tally);
    const bool ok = run_frames(session, 1, NULL);
    rg_tally_end(session->device);
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
    clock->ok = wait_for_all(clock->session) && clock->ok;
    const double now_ms = rg_now_ms();
    clock->tell(stage->row.kernel, now_ms - clock->last_ms, clock->user);
    clock->last_ms = now_ms;
}

static bool time_stages(struct rg_session *session,
                        void (*tell)(const char *kernel, double ms, void *user), void *user)
{
    struct stage_clock clock = {session, tell, user, rg_now_ms(), true};
    session->instance->after_stage = after_stage;
    session->instance->user = &clock;
    const bool ok = run_frames(session, 1, NULL);
    session->instance->after_stage = NULL;
    return ok && clock.ok;
}

static bool tell_time(struct rg_session *session, int64_t *time_ns)
{
    return rg_device_time(session->device, time_ns);
}

static void add_pass_code(const void *bytes, size_t size, void *user)
{
    struct rg_session_code *code = user;
    code->passes.hash = XXH3_64bits_withSeed(bytes, size, code->passes.hash);
    code->passes.bytes += (int64_t)size;
}

static bool tell_code(struct rg_session *session, struct rg_session_code *code)
{
    const struct rg_instance *instance = session->instance;
    *code = (struct rg_session_code){.libraries = rg_libraries_hash()};
    rg_program_id(code->program);
    for (int i = 0; i < instance->stage_count; i++)
        if (instance->stages[i].owns_pass &&
            !rg_pass_code(instance->stages[i].pass, add_pass_code, code))
            return false;
    return true;
}

// --- its picture, its state, and what it tells of itself ---

static void *read_picture(struct rg_session *session, size_t *size)
{
    return rg_frame_read(session->instance, size);
}

static bool tell(const struct rg_session *session, struct rg_account *account)
{
    const struct rg_instance *instance = session->instance;
    *account = (struct rg_account){.frame = instance->frame,
                                   .counter_count = instance->counter_count,
                                   .fact_count = instance->fact_count};
    memcpy(account->counters, instance->counters, sizeof(account->counters));
    memcpy(account->facts, instance->facts, sizeof(account->facts));
    return true;
}

static void *read_state(struct rg_session *session, int index, struct rg_state *layout,
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

static bool obeys(const struct rg_session *session, const struct rg_law *law, char *detail,
                  size_t size)
{
    return law->holds(session->instance, detail, size);
}

static bool texture(const struct rg_session *session, const char *name, struct rg_image_desc *desc,
                    int *first_level)
{
    const struct rg_instance *instance = session->instance;
    for (int i = 0; i < instance->texture_count; i++) {
        const struct rg_texture *found = &instance->textures[i];
        if (strcmp(found->name, name))
            continue;
        *desc = found->image->desc;
        *first_level = found->first_level;
        return true;
    }
    return false;
}

const struct rg_session_ways rg_local_session = {
    .open = open_local,
    .close = close_local,
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
    .take_digests = rg_recorder_take,
    .take_contents = rg_recorder_contents,
    .take_dispatches = rg_recorder_dispatches,
    .run_dispatched = rg_dispatched_run,
    .take_code = rg_recorder_code,
};
