// A driver may have overwritten a worker's findings about a device: counts above their bound,
// numbers that are NaN or infinite, bytes that are no bool. The harness refuses each in one line,
// and keeps earlier findings.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/compare/doctor/doctor.h"
#include "harness/devices/devices.h"
#include "harness/devices/measure/drawing.h"
#include "harness/devices/measure/serving/messages.h"
#include "harness/devices/workers/device.h"
#include "harness/devices/workers/serve.h"
#include "harness/devices/frames/messages.h"
#include "harness/devices/frames/session.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/logged.h"

// The bytes written over a struct before it is put into a reply.
struct damage {
    enum rg_call call;
    size_t at, size; // bytes
    int64_t integer;
    double number; // used if the integer is NUMBER
};

#define NUMBER         INT64_MIN
#define WORD(S, field) offsetof(S, field), sizeof(((S *)0)->field)
#define BYTE(S, field) offsetof(S, field), 1
#define OF_INFO(call, field, value)                                                                \
    {                                                                                              \
        call, WORD(struct rg_told_device, info.field), value, 0                                    \
    }
#define OF_OP(i, field, value)                                                                     \
    {                                                                                              \
        RG_CALL_PROBE, (i) * sizeof(struct rg_probe_result) + WORD(struct rg_probe_result, field), \
            value, 0                                                                               \
    }
#define OF(name, S, field, value)                                                                  \
    {                                                                                              \
        RG_CALL_##name, WORD(S, field), value, 0                                                   \
    }
#define OF_NUMBER(name, S, field, value)                                                           \
    {                                                                                              \
        RG_CALL_##name, WORD(S, field), NUMBER, value                                              \
    }

// The harness refuses each, except the last, which damages nothing.
static const struct damage damages[] = {
    OF_INFO(RG_CALL_OPEN, software, 2),
    OF_INFO(RG_CALL_OPEN, native, 2),
    OF_INFO(RG_CALL_OPEN, limits.has_clock, 255),
    OF_INFO(RG_CALL_OPEN, limits.has_queries, 3),
    OF_INFO(RG_CALL_OPEN, limits.max_buffer_bytes, -1),
    OF_INFO(RG_CALL_OPEN, limits.max_groups[1], INT32_MIN),
    OF_INFO(RG_CALL_OPEN, limits.slot_end.images, -1),
    OF_INFO(RG_CALL_OPEN, limits.formats[2].max_px, -1),
    OF(OPEN, struct rg_told_device, backend, RG_MAX_BACKENDS),
    OF_OP(0, compared, RG_PROBE_INPUTS + 1),
    OF_OP(0, compared, RG_PROBE_INPUTS - 1),
    OF_OP(3, different, RG_PROBE_INPUTS + 1),
    OF_OP(3, different, -1),
    OF_OP(RG_PROBE_COUNT - 1, largest_ulps, 7), // an error in ulps without a differing input
    OF(DRAWING, struct rg_drawing, count, RG_DRAWING_FORMATS + 1),
    OF(DRAWING, struct rg_drawing, count, -1),
    OF(DRAWING, struct rg_drawing, formats[0].format, RG_FORMAT_NONE),
    OF(DRAWING, struct rg_drawing, formats[0].format, RG_R32F),
    OF(DRAWING, struct rg_drawing, formats[0].differing, RG_DRAWING_PIXELS + 1),
    OF_NUMBER(DRAWING, struct rg_drawing, ms, NAN),
    OF(AUDIT, struct rg_timer_audit, passes, 0),
    OF(AUDIT, struct rg_timer_audit, passes, -1),
    OF(AUDIT, struct rg_timer_audit, has_timer, 2),
    OF_NUMBER(AUDIT, struct rg_timer_audit, wall_ms, NAN),
    OF_NUMBER(AUDIT, struct rg_timer_audit, wall_ms, -1),
    OF_NUMBER(AUDIT, struct rg_timer_audit, api_ms, INFINITY),
    OF_NUMBER(AUDIT, struct rg_timer_audit, ratio, NAN),
    OF_NUMBER(AUDIT, struct rg_timer_audit, sync_us, -INFINITY),
    OF_NUMBER(AUDIT, struct rg_timer_audit, dispatch_us, -1),
    OF_NUMBER(AUDIT, struct rg_timer_audit, round_trip_us, 1e300),
    OF_NUMBER(CEILINGS, struct rg_ceilings, memory_gb_s, NAN),
    OF_NUMBER(CEILINGS, struct rg_ceilings, cache_gb_s, INFINITY),
    OF_NUMBER(CEILINGS, struct rg_ceilings, arithmetic_gop_s, -1),
    {RG_CALL_FRAMES, 0, 8, NUMBER, NAN},
    {RG_CALL_FRAMES, 0, 8, NUMBER, -1},
    OF_NUMBER(STAGES, struct rg_told_stage, ms, INFINITY),
    {RG_CALL_STAGES, 0, 8, 0, 0}, // no name
    OF(COUNT, struct rg_tally, items, -2),
    OF(TEXTURE, struct rg_told_texture, first_level, RG_MAX_LEVELS),
    OF(TEXTURE, struct rg_told_texture, first_level, -1),
    OF(TEXTURE, struct rg_told_texture, desc.format, RG_FORMAT_COUNT),
    OF(TEXTURE, struct rg_told_texture, desc.levels, 0),
    {RG_CALL_HELLO, 0, 0, 0, 0}, // the last damages nothing
};
enum { DAMAGES = sizeof(damages) / sizeof(damages[0]), NO_DAMAGE = DAMAGES - 1 };

// --- in the worker ---

static void hurt(void *told, enum rg_call call)
{
    const struct damage *d = &damages[atoi(getenv("RG_TEST_DAMAGE"))];
    if (d->call == call)
        memcpy((char *)told + d->at,
               d->integer == NUMBER ? (const void *)&d->number : (const void *)&d->integer,
               d->size);
}

static bool open(struct rg_message *request, struct rg_message *reply)
{
    struct rg_told_device told = {{.name = "toy", .device = "Toy", .tier = RG_T1}, 0};
    (void)request;
    hurt(&told, RG_CALL_OPEN);
    rg_put_fields(reply, rg_told_device_fields, &told);
    return true;
}

static bool probe(struct rg_message *request, struct rg_message *reply)
{
    struct rg_probe_result results[RG_PROBE_COUNT];
    (void)request;
    rg_probe_name(results);
    for (int i = 0; i < RG_PROBE_COUNT; i++)
        results[i].compared = RG_PROBE_INPUTS;
    if (!getenv("RG_TEST_WELL")) {
        results[1].different = 2; // zeros of unlike signs, which are 0 ulps apart
        results[2].different = RG_PROBE_INPUTS;
        results[2].largest_ulps = UINT32_MAX;
    }
    hurt(results, RG_CALL_PROBE);
    rg_put_fields(reply, rg_probe_fields, results);
    return true;
}

static bool drawing(struct rg_message *request, struct rg_message *reply)
{
    struct rg_drawing drawing = {.count = 1, .formats = {{RG_RGBA16F, RG_DRAWING_PIXELS}}, .ms = 2};
    (void)request;
    if (getenv("RG_TEST_WELL"))
        drawing = (struct rg_drawing){
            .count = 2, .formats = {{RG_RGBA8, 12}, {RG_RGBA16F, atoi(getenv("RG_TEST_WELL"))}}};
    hurt(&drawing, RG_CALL_DRAWING);
    rg_put_fields(reply, rg_drawing_fields, &drawing);
    return true;
}

static bool audit(struct rg_message *request, struct rg_message *reply)
{
    struct rg_timer_audit audit = {.passes = 3,
                                   .wall_ms = 1,
                                   .has_timer = true,
                                   .api_ms = 2,
                                   .ratio = 2,
                                   .trusted = true, // a lie: a ratio of 2 is not trusted
                                   .sync_us = 0,
                                   .dispatch_us = 0.5,
                                   .round_trip_us = 7};
    (void)request;
    hurt(&audit, RG_CALL_AUDIT);
    rg_put_fields(reply, rg_audit_fields, &audit);
    return true;
}

static bool ceilings(struct rg_message *request, struct rg_message *reply)
{
    struct rg_ceilings ceilings = {1, 2, 3};
    (void)request;
    hurt(&ceilings, RG_CALL_CEILINGS);
    rg_put_fields(reply, rg_ceilings_fields, &ceilings);
    return true;
}

static bool shut(struct rg_message *request, struct rg_message *reply)
{
    (void)request;
    rg_put_fields(reply, rg_closed_fields, &(bool){true});
    return true;
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
    rg_put_fields(reply, rg_told_session_fields, &(struct rg_told_session){0, 0});
    return true;
}

static bool tell(struct rg_message *request, struct rg_message *reply)
{
    const struct rg_account account = {.frame = 1};
    (void)request;
    rg_put_fields(reply, rg_told_account_fields, &account);
    return true;
}

static bool run_frames(struct rg_message *request, struct rg_message *reply)
{
    double wall_ms = 1;
    (void)request;
    hurt(&wall_ms, RG_CALL_FRAMES);
    rg_put_fields(reply, rg_ms_fields, &wall_ms);
    return true;
}

static bool stages(struct rg_message *request, struct rg_message *reply)
{
    struct rg_told_stage row = {"k", 1};
    const struct rg_told_stages told = {.count = 1, .rows = &row};
    (void)request;
    hurt(&row, RG_CALL_STAGES);
    rg_put_fields(reply, rg_told_stages_fields, &told);
    return true;
}

static bool count(struct rg_message *request, struct rg_message *reply)
{
    struct rg_tally tally = {.runs = 1, .fragments = -1};
    (void)request;
    hurt(&tally, RG_CALL_COUNT);
    rg_put_fields(reply, rg_told_tally_fields, &tally);
    return true;
}

static bool texture(struct rg_message *request, struct rg_message *reply)
{
    struct rg_told_texture told = {true, {RG_R16F, 4, 4, 1, 3}, 1};
    (void)request;
    hurt(&told, RG_CALL_TEXTURE);
    rg_put_fields(reply, rg_told_texture_fields, &told);
    return true;
}

static rg_service *const services[RG_CALL_COUNT_OF_CALLS] = {
    [RG_CALL_OPEN] = open,
    [RG_CALL_CLOSE] = shut,
    [RG_CALL_PROBE] = probe,
    [RG_CALL_DRAWING] = drawing,
    [RG_CALL_AUDIT] = audit,
    [RG_CALL_CEILINGS] = ceilings,
    [RG_CALL_SESSION_OPEN] = open_session,
    [RG_CALL_SESSION_CLOSE] = nod,
    [RG_CALL_TELL] = tell,
    [RG_CALL_FRAMES] = run_frames,
    [RG_CALL_STAGES] = stages,
    [RG_CALL_COUNT] = count,
    [RG_CALL_TEXTURE] = texture,
};

// --- in the harness ---

static void set_damage(int number)
{
    const char digits[] = {(char)('0' + number / 10), (char)('0' + number % 10), 0};
    setenv("RG_TEST_DAMAGE", digits, 1);
    logged_lines = 0;
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
    char due[100];
    snprintf(due, sizeof(due), "2 of %d operations that kernels use give other bits than C",
             RG_PROBE_OP_COUNT);
    assert_string_equal(e.why, due);
    assert_string_equal(e.info.device, "Toy");
    assert_string_equal(e.probe[2].name, "multiply");
    assert_int_equal(e.probe[1].different, 2);
    assert_int_equal(e.probe[1].largest_ulps, 0);
    assert_equals(e.probe[2].largest_ulps, UINT32_MAX);
    assert_true(e.probe[RG_PROBE_COUNT - 1].builtin && !e.probe[0].builtin);
    assert_int_equal(e.drawing.count, 1);
    assert_int_equal(e.drawing.formats[0].format, RG_RGBA16F);
    assert_int_equal(e.drawing.formats[0].differing, RG_DRAWING_PIXELS);
    assert_int_equal(e.timer.passes, 3);
    assert_true(e.timer.has_timer);
    assert_true(!e.timer.trusted);
    assert_equals(e.timer.round_trip_us, 7);
    assert_equals(e.ceilings.memory_gb_s, 1);
    assert_equals(e.ceilings.arithmetic_gop_s, 3);
    assert_int_equal(logged_lines, 0);
}

// Drawings are judged where all operations give the same bits, by the device's tier.
static void a_device_that_draws_wrongly_is_not_well(void **state)
{
    (void)state;
    setenv("RG_TEST_WELL", "12", 1);
    const struct rg_examination well = examined(NO_DAMAGE);
    assert_int_equal(well.status, RG_OK);
    assert_string_equal(well.why, "");
    setenv("RG_TEST_WELL", "13", 1);
    const struct rg_examination wrong = examined(NO_DAMAGE);
    assert_int_equal(wrong.status, RG_FAIL);
    assert_string_equal(wrong.why,
                        "13 of 12288 pixels drawn into RGBA16F, with depth and blending, "
                        "are not what cpu:reference draws");
    unsetenv("RG_TEST_WELL");
    assert_int_equal(logged_lines, 0);
}

// Only a name that no device can have is the user's error.
static void a_name_that_cannot_be_is_unknown(void **state)
{
    (void)state;
    struct rg_examination e = {.info.name = "toy@"};
    rg_doctor_examine(&e);
    assert_true(e.is_unknown && !e.opened);
    assert_non_null(strstr(e.why, "no KEY=value follows its '@'"));
    const struct rg_examination damaged = examined(0); // while it is opened
    assert_false(damaged.is_unknown || damaged.opened);
}

static void what_cannot_be_ends_an_examination(void **state)
{
    (void)state;
    for (int i = 0; i < NO_DAMAGE && damages[i].call <= RG_CALL_CEILINGS; i++) {
        const struct rg_examination e = examined(i);
        if (e.status != RG_ERROR || e.measured || logged_lines != 1 || !strstr(e.why, "is damaged"))
            fail_msg("damage %d: status %d, %d lines, %s", i, (int)e.status, logged_lines, e.why);
        assert_int_equal(e.opened, damages[i].call > RG_CALL_OPEN);
        assert_int_equal(e.probed, damages[i].call > RG_CALL_PROBE);
        assert_int_equal(e.drawn, damages[i].call > RG_CALL_DRAWING);
        assert_int_equal(e.audited, damages[i].call > RG_CALL_AUDIT);
    }
}

static void hear(const char *kernel, double ms, void *user)
{
    (void)user;
    assert_string_equal(kernel, "k");
    assert_equals(ms, 1);
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
            if (ask(session, damages[i].call) != sound || logged_lines != !sound)
                fail_msg("damage %d, sound %d: %d lines", i, sound, logged_lines);
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
        cmocka_unit_test(a_device_that_draws_wrongly_is_not_well),
        cmocka_unit_test(a_name_that_cannot_be_is_unknown),
        cmocka_unit_test(what_cannot_be_ends_an_examination),
        cmocka_unit_test(what_a_session_cannot_say_is_refused),
    };
    rg_workers.program = "/proc/self/exe";
    rg_log_listen(log_last, NULL);
    return cmocka_run_group_tests_name("findings", tests, NULL, NULL);
}
