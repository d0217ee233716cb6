// What a worker found out about a device, over which a driver has written: counts that exceed what
// is counted, numbers that are none, bytes that are no bool. Each is refused in one line, and what
// was found before stays.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/devices/devices.h"
#include "harness/devices/workers/device.h"
#include "harness/devices/workers/serve.h"
#include "harness/doctor/report.h"
#include "harness/frames/messages.h"
#include "harness/frames/session.h"
#include "harness/measure/messages.h"

// What is written over a reply: eight bytes, or one.
struct damage {
    enum rg_call call;
    size_t at; // bytes
    enum { INTEGER, NUMBER, BYTE, NONE } kind;
    int64_t integer;
    double number;
};

#define INFO(field)  offsetof(struct rg_device_info, field)
#define OP(i, field) ((size_t)(3 * (i) + (field)) * 8) // 0: compared, 1: different, 2: ulps

// All are refused.
static const struct damage damages[] = {
    {RG_CALL_OPEN, INFO(software), BYTE, 2, 0},
    {RG_CALL_OPEN, INFO(limits.has_clock), BYTE, 255, 0},
    {RG_CALL_OPEN, INFO(limits.has_queries), BYTE, 3, 0},
    {RG_CALL_OPEN, INFO(limits.max_buffer_bytes), INTEGER, -1, 0},
    {RG_CALL_OPEN, INFO(limits.max_groups[1]) + 3, BYTE, 0x80, 0},
    {RG_CALL_OPEN, INFO(limits.slot_end.images) + 3, BYTE, 0x80, 0},
    {RG_CALL_OPEN, INFO(limits.formats[2].max_px) + 3, BYTE, 0x80, 0},
    {RG_CALL_PROBE, OP(0, 0), INTEGER, RG_PROBE_INPUTS + 1, 0},
    {RG_CALL_PROBE, OP(0, 0), INTEGER, RG_PROBE_INPUTS - 1, 0},
    {RG_CALL_PROBE, OP(3, 1), INTEGER, RG_PROBE_INPUTS + 1, 0},
    {RG_CALL_PROBE, OP(3, 1), INTEGER, -1, 0},
    {RG_CALL_PROBE, OP(2, 2), INTEGER, INT64_C(1) << 32, 0},
    {RG_CALL_PROBE, OP(5, 2), INTEGER, -1, 0},
    {RG_CALL_PROBE, OP(RG_PROBE_COUNT - 1, 2), INTEGER, 7, 0}, // apart, and none differs
    {RG_CALL_AUDIT, 0, INTEGER, 0, 0},
    {RG_CALL_AUDIT, 0, INTEGER, INT64_MAX, 0},
    {RG_CALL_AUDIT, 8, INTEGER, 2, 0},
    {RG_CALL_AUDIT, 16, NUMBER, 0, NAN},
    {RG_CALL_AUDIT, 16, NUMBER, 0, -1},
    {RG_CALL_AUDIT, 24, NUMBER, 0, INFINITY},
    {RG_CALL_AUDIT, 32, NUMBER, 0, NAN},
    {RG_CALL_AUDIT, 40, NUMBER, 0, -INFINITY},
    {RG_CALL_AUDIT, 48, NUMBER, 0, -1},
    {RG_CALL_AUDIT, 56, NUMBER, 0, 1e300},
    {RG_CALL_CEILINGS, 0, NUMBER, 0, NAN},
    {RG_CALL_CEILINGS, 8, NUMBER, 0, INFINITY},
    {RG_CALL_CEILINGS, 16, NUMBER, 0, -1},
    {RG_CALL_FRAMES, 0, NUMBER, 0, NAN},
    {RG_CALL_FRAMES, 0, NUMBER, 0, -1},
    {RG_CALL_STAGES, 18, NUMBER, 0, INFINITY}, // behind their count and a name of one letter
    {RG_CALL_STAGES, 0, INTEGER, 2, 0},
    {RG_CALL_COUNT, offsetof(struct rg_tally, items), INTEGER, -2, 0},
    {RG_CALL_TEXTURE, 8 + sizeof(struct rg_image_desc), INTEGER, RG_MAX_LEVELS, 0},
    {RG_CALL_TEXTURE, 8 + sizeof(struct rg_image_desc), INTEGER, -1, 0},
    {RG_CALL_HELLO, 0, NONE, 0, 0}, // nothing: the last
};
enum { DAMAGES = sizeof(damages) / sizeof(damages[0]), NO_DAMAGE = DAMAGES - 1 };

// --- in the worker ---

static bool hurt(struct rg_message *reply, enum rg_call call)
{
    const struct damage *d = &damages[atoi(getenv("RG_TEST_DAMAGE"))];
    if (d->call != call || d->kind == NONE)
        return true;
    const unsigned char byte = (unsigned char)d->integer;
    const void *value = d->kind == BYTE     ? (const void *)&byte
                        : d->kind == NUMBER ? (const void *)&d->number
                                            : (const void *)&d->integer;
    memcpy(reply->bytes + d->at, value, d->kind == BYTE ? 1 : 8);
    return true;
}

static bool open(struct rg_message *request, struct rg_message *reply)
{
    const struct rg_device_info info = {.name = "toy", .device = "Toy", .tier = RG_T1};
    (void)request;
    RG_PUT(reply, info);
    rg_put_int(reply, 0);
    return hurt(reply, RG_CALL_OPEN);
}

static bool probe(struct rg_message *request, struct rg_message *reply)
{
    struct rg_probe_result results[RG_PROBE_COUNT];
    (void)request;
    rg_probe_name(results);
    for (int i = 0; i < RG_PROBE_COUNT; i++)
        results[i].compared = RG_PROBE_INPUTS;
    results[1].different = 2; // zeros of unlike signs, which are not apart
    results[2].different = RG_PROBE_INPUTS;
    results[2].largest_ulps = UINT32_MAX;
    rg_put_probe(reply, results);
    return hurt(reply, RG_CALL_PROBE);
}

static bool audit(struct rg_message *request, struct rg_message *reply)
{
    const struct rg_timer_audit audit = {.passes = 3,
                                         .wall_ms = 1,
                                         .has_timer = true,
                                         .api_ms = 2,
                                         .ratio = 2,
                                         .trusted = true, // which a ratio of 2 is not
                                         .sync_us = 0,
                                         .dispatch_us = 0.5,
                                         .round_trip_us = 7};
    (void)request;
    rg_put_audit(reply, &audit);
    return hurt(reply, RG_CALL_AUDIT);
}

static bool ceilings(struct rg_message *request, struct rg_message *reply)
{
    const struct rg_ceilings ceilings = {1, 2, 3};
    (void)request;
    rg_put_ceilings(reply, &ceilings);
    return hurt(reply, RG_CALL_CEILINGS);
}

static bool nod(struct rg_message *request, struct rg_message *reply)
{
    (void)request;
    (void)reply;
    return true;
}

static bool open_session(struct rg_message *request, struct rg_message *reply)
{
    (void)request;
    rg_put_int(reply, 0);
    rg_put_int(reply, 0);
    return true;
}

static bool tell(struct rg_message *request, struct rg_message *reply)
{
    const struct rg_account account = {.frame = 1};
    (void)request;
    rg_put_account(reply, &account);
    return true;
}

static bool run_frames(struct rg_message *request, struct rg_message *reply)
{
    const double wall_ms = 1;
    (void)request;
    RG_PUT(reply, wall_ms);
    return hurt(reply, RG_CALL_FRAMES);
}

static bool stages(struct rg_message *request, struct rg_message *reply)
{
    const double ms = 1;
    (void)request;
    rg_put_int(reply, 1);
    rg_put_text(reply, "k");
    RG_PUT(reply, ms);
    return hurt(reply, RG_CALL_STAGES);
}

static bool count(struct rg_message *request, struct rg_message *reply)
{
    const struct rg_tally tally = {.runs = 1, .fragments = -1};
    (void)request;
    rg_put_tally(reply, &tally);
    return hurt(reply, RG_CALL_COUNT);
}

static bool texture(struct rg_message *request, struct rg_message *reply)
{
    const struct rg_image_desc desc = {RG_R16F, 4, 4, 1, 3};
    (void)request;
    rg_put_int(reply, 1);
    RG_PUT(reply, desc);
    rg_put_int(reply, 1);
    return hurt(reply, RG_CALL_TEXTURE);
}

static rg_service *const services[RG_CALL_COUNT_OF_CALLS] = {
    [RG_CALL_OPEN] = open,         [RG_CALL_CLOSE] = nod,
    [RG_CALL_PROBE] = probe,       [RG_CALL_AUDIT] = audit,
    [RG_CALL_CEILINGS] = ceilings, [RG_CALL_SESSION_OPEN] = open_session,
    [RG_CALL_SESSION_CLOSE] = nod, [RG_CALL_TELL] = tell,
    [RG_CALL_FRAMES] = run_frames, [RG_CALL_STAGES] = stages,
    [RG_CALL_COUNT] = count,       [RG_CALL_TEXTURE] = texture,
};

// --- in the harness ---

static int lines;

static void count_line(enum rg_log_level level, const char *line, void *user)
{
    (void)level;
    (void)line;
    (void)user;
    lines++;
}

static void set_damage(int number)
{
    const char digits[] = {(char)('0' + number / 10), (char)('0' + number % 10), 0};
    setenv("RG_TEST_DAMAGE", digits, 1);
    lines = 0;
}

static struct rg_examination examined(int number)
{
    struct rg_examination e = {.info.name = "toy"};
    set_damage(number);
    rg_doctor_examine(&e);
    return e;
}

static void what_is_sound_is_taken(void **state)
{
    (void)state;
    const struct rg_examination e = examined(NO_DAMAGE);
    assert_true(e.measured);
    assert_int_equal(e.status, RG_FAIL); // two operations differ
    assert_string_equal(e.probe[2].name, "multiply");
    assert_int_equal(e.probe[1].different, 2);
    assert_int_equal(e.probe[1].largest_ulps, 0);
    assert_true(e.probe[2].largest_ulps == UINT32_MAX);
    assert_true(e.probe[RG_PROBE_COUNT - 1].builtin && !e.probe[0].builtin);
    assert_int_equal(e.timer.passes, 3);
    assert_true(e.timer.has_timer && !e.timer.trusted && e.timer.round_trip_us == 7);
    assert_true(e.ceilings.memory_gb_s == 1 && e.ceilings.arithmetic_gop_s == 3);
    assert_int_equal(lines, 0);
}

static void what_cannot_be_ends_an_examination(void **state)
{
    (void)state;
    for (int i = 0; i < NO_DAMAGE && damages[i].call <= RG_CALL_CEILINGS; i++) {
        const struct rg_examination e = examined(i);
        if (e.status != RG_ERROR || e.measured || lines != 1 || !strstr(e.why, "is damaged"))
            fail_msg("damage %d: status %d, %d lines, %s", i, (int)e.status, lines, e.why);
        assert_int_equal(e.opened, damages[i].call > RG_CALL_OPEN);
        assert_int_equal(e.probed, damages[i].call > RG_CALL_PROBE);
        assert_int_equal(e.audited, damages[i].call > RG_CALL_AUDIT);
    }
}

static void hear(const char *kernel, double ms, void *user)
{
    (void)user;
    assert_string_equal(kernel, "k");
    assert_true(ms == 1);
}

static bool ask(struct rg_session *session, enum rg_call call)
{
    double wall_ms;
    struct rg_tally tally;
    struct rg_image_desc desc;
    int first_level;
    return call == RG_CALL_FRAMES   ? rg_session_frames(session, 1, &wall_ms)
           : call == RG_CALL_STAGES ? rg_session_stages(session, hear, NULL)
           : call == RG_CALL_COUNT  ? rg_session_count(session, &tally)
                                    : rg_session_texture(session, "t", &desc, &first_level);
}

static void what_a_session_cannot_say_is_refused(void **state)
{
    const struct rg_technique *technique = rg_technique_find("raster");
    void *settings = rg_settings_create(technique);
    const struct rg_subject subject = {technique, settings, 8, 8};
    (void)state;
    for (int i = 0; i < NO_DAMAGE; i++) {
        if (damages[i].call <= RG_CALL_CEILINGS)
            continue;
        for (int sound = 0; sound < 2; sound++) {
            set_damage(sound ? NO_DAMAGE : i);
            struct rg_device *device = rg_devices_open_one("toy");
            assert_non_null(device);
            struct rg_session *session = rg_session_open(device, &subject);
            assert_non_null(session);
            if (ask(session, damages[i].call) != sound || lines != !sound)
                fail_msg("damage %d, sound %d: %d lines", i, sound, lines);
            rg_session_close(session);
            assert_true(rg_device_close(device));
        }
    }
    free(settings);
}

int main(int argc, char **argv)
{
    if (argc == 3 && !strcmp(argv[1], RG_WORKER_ARGUMENT))
        return rg_serve(argv[2], services);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_sound_is_taken),
        cmocka_unit_test(what_cannot_be_ends_an_examination),
        cmocka_unit_test(what_a_session_cannot_say_is_refused),
    };
    rg_workers.program = "/proc/self/exe";
    rg_log_listen(count_line, NULL);
    return cmocka_run_group_tests_name("findings", tests, NULL, NULL);
}
