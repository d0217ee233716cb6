// A worker that lies. Any byte of a reply may change, numbers become ones that no message has,
// replies are cut or lengthened, and announced sizes are wrong. The harness must not crash, read
// beyond a reply, or wait for ever. It must name the device when it refuses a reply.
//
// The harness keeps the first reply to each call and tampers with it on arrival, so that a
// million calls take minutes. Now and then it asks the worker again, which lies about the size that
// it sends before a message. `--runs N --seed S` sets the number of calls.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "core/base/log.h"
#include "core/device/probe.h"
#include "harness/devices/devices.h"
#include "harness/devices/measure/ceilings.h"
#include "harness/devices/measure/serving/messages.h"
#include "harness/devices/measure/serving/serving.h"
#include "harness/devices/measure/timer_audit.h"
#include "harness/devices/workers/channel.h"
#include "harness/devices/workers/device.h"
#include "harness/devices/frames/digests.h"
#include "harness/devices/frames/messages.h"
#include "harness/devices/frames/session.h"

static uint64_t state;

static uint32_t chance(uint32_t end)
{
    state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (uint32_t)(state >> 33) % end;
}

// --- the lie ---

static int64_t odd_number(int64_t size)
{
    const int64_t odd[] = {-1,        0,         1,        INT64_C(1) << 60, INT64_MIN, INT64_MAX,
                           INT32_MAX, INT32_MIN, size + 1, size - 1,         size / 2,  1 << 20};
    return odd[chance(sizeof(odd) / sizeof(odd[0]))];
}

static void tamper(struct rg_message *m)
{
    const uint32_t size = (uint32_t)m->size;
    const int64_t number = odd_number(m->size);
    const uint32_t kind = chance(8), at = size ? chance(size) : 0;
    if (!size)
        return;
    if (kind < 3) // kind 0 stays in the first bytes, since large blocks follow their description
        for (uint32_t i = 0; i <= chance(4); i++)
            m->bytes[chance(kind ? size : size < 256 ? size : 256)] = (char)chance(256);
    else if (kind < 5 && size >= 8)
        memcpy(m->bytes + (kind == 3 ? at & ~7u : chance(size < 64 ? size : 64)) % (size - 7),
               &number, 8);
    else if (kind == 5)
        m->size = at;
    else if (kind == 6)
        rg_put(m, (const char[64]){0}, 1 + chance(64));
    else
        memset(m->bytes + at, (int)chance(3) - 1, chance(size - at + 1));
}

// --- in the worker: sizes of messages ---

static bool is_worker;

ssize_t __real_send(int socket, const void *bytes, size_t size, int flags);
ssize_t __wrap_send(int socket, const void *bytes, size_t size, int flags);

ssize_t __wrap_send(int socket, const void *bytes, size_t size, int flags)
{
    static int sent; // the first messages open its device and its session
    char told[sizeof(int64_t)];
    if (!is_worker || size != sizeof(told) || ++sent < 40 || chance(8))
        return __real_send(socket, bytes, size, flags);
    memcpy(told, bytes, size);
    told[chance(sizeof(told))] = (char)chance(256);
    const size_t said = chance(4) ? size : 1 + chance(sizeof(told));
    return __real_send(socket, told, said, flags) < 0 ? -1 : (ssize_t)size;
}

// --- in the harness: replies ---

static struct rg_message known[RG_CALL_COUNT_OF_CALLS]; // sound replies, by call
static bool is_sound; // while each call's reply is still being learned
static enum rg_call asked;
static bool is_sent; // to the worker; otherwise the known reply answers

static void copy(struct rg_message *to, const char *bytes, int64_t size)
{
    rg_message_free(to);
    rg_put(to, bytes, size);
}

// Begins a successful reply: the success, the fault, the outcome and one line come before its
// result.
static void begin_reply(struct rg_message *reply)
{
    rg_message_free(reply);
    rg_put_int(reply, true);
    rg_put_int(reply, RG_FAULT_INPUT);
    rg_put_int(reply, RG_OK);
    rg_put_int(reply, 1);
    rg_put_int(reply, RG_LOG_INFO);
    rg_put_text(reply, "a line");
}

static void keep_sound(const struct rg_message *reply)
{
    static const int64_t head[] = {true, RG_FAULT_NONE, RG_OK, 0}; // no lines
    if (reply->size < (int64_t)sizeof(head) || memcmp(reply->bytes, head, sizeof(head)) != 0)
        return;
    begin_reply(&known[asked]);
    rg_put(&known[asked], reply->bytes + sizeof(head), reply->size - (int64_t)sizeof(head));
}

// Makes up the replies that would take long.
static void make_up(void)
{
    struct rg_probe_result results[RG_PROBE_COUNT] = {{.compared = 0}};
    for (int i = 0; i < RG_PROBE_COUNT; i++)
        results[i].compared = RG_PROBE_INPUTS;
    begin_reply(&known[RG_CALL_SESSION_CLOSE]); // a new session follows
    begin_reply(&known[RG_CALL_KERNEL_CODE]);   // builds without drivers have no code
    rg_put_fields(&known[RG_CALL_KERNEL_CODE], rg_told_bytes_fields,
                  &(struct rg_told_bytes){"code", 4, {.name = NULL}});
    begin_reply(&known[RG_CALL_PROBE]);
    rg_put_fields(&known[RG_CALL_PROBE], rg_probe_fields, results);
    begin_reply(&known[RG_CALL_AUDIT]);
    rg_put_fields(&known[RG_CALL_AUDIT], rg_audit_fields,
                  &(struct rg_timer_audit){.passes = 3, .ratio = 1});
    begin_reply(&known[RG_CALL_CEILINGS]);
    rg_put_fields(&known[RG_CALL_CEILINGS], rg_ceilings_fields, &(struct rg_ceilings){1, 2, 3});
}

bool __real_rg_channel_send(struct rg_channel *channel, const struct rg_message *head,
                            const struct rg_message *body);
bool __wrap_rg_channel_send(struct rg_channel *channel, const struct rg_message *head,
                            const struct rg_message *body);

bool __wrap_rg_channel_send(struct rg_channel *channel, const struct rg_message *head,
                            const struct rg_message *body)
{
    int64_t call = 0;
    if (is_worker)
        return __real_rg_channel_send(channel, head, body);
    memcpy(&call, head->bytes, sizeof(call));
    asked = (enum rg_call)call;
    // The worker gets no second dispatch: one that came from a lie would run with any parameters.
    is_sent = !known[call].size ||
              (call != RG_CALL_DISPATCH && call != RG_CALL_SESSION_CLOSE && !chance(1000));
    return !is_sent || __real_rg_channel_send(channel, head, body);
}

enum rg_arrival __real_rg_channel_receive(struct rg_channel *channel, struct rg_message *message,
                                          int timeout_ms);
enum rg_arrival __wrap_rg_channel_receive(struct rg_channel *channel, struct rg_message *message,
                                          int timeout_ms);

enum rg_arrival __wrap_rg_channel_receive(struct rg_channel *channel, struct rg_message *message,
                                          int timeout_ms)
{
    enum rg_arrival arrival = RG_ARRIVED;
    *message = (struct rg_message){0};
    if (is_worker || is_sent)
        arrival = __real_rg_channel_receive(channel, message, timeout_ms);
    else
        copy(message, known[asked].bytes, known[asked].size);
    if (is_worker || arrival != RG_ARRIVED)
        return arrival;
    if (is_sent && is_sound && asked != RG_CALL_CLOSE)
        keep_sound(message);
    if (!is_sound && chance(8))
        tamper(message);
    return RG_ARRIVED;
}

// --- in the harness ---

static int lines;
static int damaged, unnamed; // lines about damaged messages, and those without the device

static void hear(enum rg_log_level level, const char *line, void *user)
{
    (void)user;
    lines += level == RG_LOG_ERROR;
    damaged += strstr(line, "is damaged") != NULL;
    unnamed += strstr(line, "is damaged") && !strstr(line, "'cpu'");
}

struct asked {
    struct rg_device *device;
    struct rg_session *session;
    struct rg_digest_run run;
    struct rg_dispatches dispatches; // those of the last reply
};

static void tell_stage(const char *kernel, double ms, void *user)
{
    *(double *)user += ms + (double)strlen(kernel);
}

static bool ask_device(struct asked *a, uint32_t which)
{
    static struct rg_told_list list;
    static struct rg_told_device told;
    static struct rg_probe_result results[RG_PROBE_COUNT];
    struct rg_timer_audit audit = {.passes = 0};
    struct rg_ceilings ceilings;
    struct rg_worker *worker = rg_remote_worker(a->device);
    struct rg_message request = {0};
    bool ok = false;
    if (which == 0) {
        rg_put_text(&request, "cpu");
        ok = rg_worker_fetch(worker, RG_CALL_OPEN, &request, rg_told_device_fields, &told);
    } else if (which == 1) {
        rg_put_int(&request, 0);
        ok = rg_worker_fetch(worker, RG_CALL_LIST, &request, rg_told_list_fields, &list);
    } else if (which == 2)
        ok = rg_worker_fetch(worker, RG_CALL_PROBE, NULL, rg_probe_fields, results);
    else if (which == 3)
        ok = rg_worker_fetch(worker, RG_CALL_AUDIT, NULL, rg_audit_fields, &audit);
    else
        ok = rg_worker_fetch(worker, RG_CALL_CEILINGS, NULL, rg_ceilings_fields, &ceilings);
    rg_message_free(&request);
    return ok;
}

static bool ask_run(struct asked *a, uint32_t which)
{
    struct rg_digests digests = {0};
    struct rg_contents contents = {0};
    struct rg_state layout;
    size_t size;
    bool ok = false;
    if (which == 0) {
        ok = rg_digests_take(&a->run, a->device, &digests);
        rg_digests_free(&digests);
    } else if (which == 1) {
        ok = rg_digests_contents(&a->run, a->device, 0, &contents, &layout);
        rg_contents_free(&contents);
    } else if (which == 2) {
        rg_dispatches_free(&a->dispatches);
        ok = rg_digests_dispatches(&a->run, a->device, 1, &a->dispatches);
        if (!ok)
            rg_dispatches_free(&a->dispatches);
    } else if (which == 3) {
        ok = a->dispatches.count == 0 || rg_digests_dispatch(&a->dispatches.rows[0], a->device);
    } else {
        void *code = rg_digests_code(a->device, rg_kernel_find("flow_blur"), RG_CODE_OPENCL, &size);
        ok = code;
        free(code);
    }
    return ok;
}

static bool ask_session(struct asked *a, uint32_t which)
{
    struct rg_session *s = a->session;
    struct rg_tally tally;
    struct rg_session_code code;
    struct rg_account account;
    struct rg_image_desc desc;
    struct rg_state layout;
    char detail[64];
    double ms = 0;
    int64_t time_ns;
    size_t size = 0;
    int level;
    void *bytes = NULL;
    switch (which) {
    case 0:
        return rg_session_step(s);
    case 1:
        return rg_session_frames(s, 1, &ms);
    case 2:
        return rg_session_count(s, &tally);
    case 3:
        return rg_session_stages(s, tell_stage, &ms);
    case 4:
        return rg_session_time(s, &time_ns);
    case 5:
        return rg_session_code(s, &code);
    case 6:
        return rg_session_tell(s, &account);
    case 7:
        return rg_session_texture(s, "environment", &desc, &level) || !lines;
    case 8:
        return rg_session_obeys(s, rg_session_law(s, 0), detail, sizeof(detail)) || !lines;
    case 9:
        bytes = rg_session_read(s, &size);
        break;
    default:
        bytes = rg_session_read_state(s, 0, &layout, &size);
        break;
    }
    const bool ok = bytes;
    free(bytes);
    return ok;
}

static void close_all(struct asked *a)
{
    rg_session_close(a->session);
    if (a->device)
        rg_device_close(a->device);
    a->session = NULL;
    a->device = NULL;
}

// Opens the device and the session if they are not open; leaves a worker that has ended. Each
// worker has its own lies.
static bool open_all(struct asked *a)
{
    char seed[32];
    snprintf(seed, sizeof(seed), "%llu", (unsigned long long)state);
    setenv("RG_TEST_SEED", seed, 1);
    if (a->session && !rg_session_lives(a->session))
        close_all(a);
    if (!a->device)
        a->device = rg_devices_open_one("cpu");
    for (int i = 0; a->device && !a->session && i < 8; i++)
        a->session = rg_session_open(a->device, &a->run.subject);
    if (!a->session)
        close_all(a);
    return a->session;
}

static bool ask(struct asked *a, uint32_t which)
{
    if (which < 10)
        return ask_device(a, which / 2);
    if (which < 20)
        return ask_run(a, which / 2 - 5);
    if (which == 20) {
        rg_session_close(a->session);
        a->session = rg_session_open(a->device, &a->run.subject);
        return a->session;
    }
    return ask_session(a, which % 11);
}

static int try_all(uint64_t runs)
{
    const struct rg_technique *technique = rg_technique_find("flow");
    void *defaults = rg_settings_create(technique);
    void *settings =
        rg_settings_copy(technique, defaults, "environment_px=16 resolution_px=16 model=");
    struct asked a = {.run = {{technique, settings, 16, 16}, 1}};
    uint64_t told = 0, well = 0;
    bool is_silent = false, is_well = true;
    make_up();
    is_sound = true;
    for (uint32_t which = 0; which < 64; which++) // asks for everything at least twice
        is_well = is_well && open_all(&a) && ask(&a, which);
    if (!is_well)
        printf("a sound worker fails: %s\n", rg_last_error());
    is_sound = false;
    rg_workers.timeout_s = 1; // an announced message may never come
    while (told < runs && !is_silent) {
        if (told % 1000 == 0)
            alarm(300);
        lines = 0;
        const bool ok = open_all(&a) && ask(&a, chance(64));
        told++;
        well += ok;
        is_silent = !ok && !lines;
    }
    printf("%llu replies, of which %llu were taken; %d of %d lines name no device\n",
           (unsigned long long)told, (unsigned long long)well, unnamed, damaged);
    if (is_silent)
        printf("the last was refused without a line\n");
    close_all(&a);
    rg_dispatches_free(&a.dispatches);
    free(settings);
    free(defaults);
    // The worker's own log lines may be reported as another error, which names no device.
    return is_silent || !is_well || !well || well == told || unnamed * 1000 > damaged;
}

int main(int argc, char **argv)
{
    if (argc == 3 && !strcmp(argv[1], RG_WORKER_ARGUMENT)) {
        state = strtoull(getenv("RG_TEST_SEED"), NULL, 10);
        is_worker = true;
        return rg_serving(argv[2]);
    }
    if (argc != 5 || strcmp(argv[1], "--runs") != 0 || strcmp(argv[3], "--seed") != 0)
        return 2;
    rg_workers.program = "/proc/self/exe";
    rg_workers.timeout_s = 60;
    rg_log_listen(hear, NULL);
    state = strtoull(argv[4], NULL, 10);
    return try_all(strtoull(argv[2], NULL, 10));
}
