// A driver may have overwritten a worker's replies: the harness refuses a damaged reply in one
// line, and can use whatever it takes.
#include <limits.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/console/exit.h"
#include "harness/devices/devices.h"
#include "harness/devices/frames/digests.h"
#include "harness/devices/frames/messages.h"
#include "harness/devices/frames/session.h"
#include "harness/devices/measure/job.h"
#include "harness/devices/workers/device.h"
#include "harness/devices/workers/serve.h"
#include "tests/tools/expect.h"

// --- in the worker ---

// The damage to the worker's replies; a test chooses it by RG_TEST_DAMAGE.
enum damage {
    NOTHING,
    ENDLESS_TEXT,
    NO_TIER,
    NO_END,
    NO_OUTCOME,
    NO_REASON,
    LONGER,
    TOO_MANY,
    NO_FORMAT,
    LEVELS,
    LAYERS,
    WIDE,
    BYTES,
    HALF_A_ROW,
    LONG_TEXT,
    ABSENT, // no damage: there is no driver
    TWO     // nor here: there are two devices
};

static enum damage damage(void)
{
    return (enum damage)atoi(getenv("RG_TEST_DAMAGE"));
}

static struct rg_device_info info(void)
{
    struct rg_device_info info = {.name = "toy", .device = "Toy", .tier = RG_T1};
    const int no_tier = RG_TIER_COUNT;
    if (damage() == ENDLESS_TEXT)
        memset(info.driver, 'v', sizeof(info.driver));
    if (damage() == NO_TIER)
        memcpy(&info.tier, &no_tier, sizeof(info.tier));
    return info;
}

static bool list(struct rg_message *request, struct rg_message *reply)
{
    static struct rg_told_list told = {.count = 1};
    const int64_t many = INT_MAX;
    (void)request;
    const int no_outcome = RG_OUTCOME_COUNT;
    told.infos[0] = told.infos[1] = info();
    strcpy(told.infos[1].name, "toy:1");
    told.count = damage() == TWO ? 2 : damage() != NO_REASON && damage() != ABSENT;
    if (damage() == ABSENT)
        told.outcome = RG_UNSUPPORTED;
    strcpy(told.why, damage() == ABSENT ? "toy: no driver" : "");
    if (damage() == NO_OUTCOME)
        memcpy(&told.outcome, &no_outcome, sizeof(told.outcome));
    rg_put_fields(reply, rg_told_list_fields, &told);
    if (damage() == TOO_MANY)
        memcpy(reply->bytes, &many, sizeof(many));
    reply->size -= damage() == NO_END;
    return true;
}

static bool open(struct rg_message *request, struct rg_message *reply)
{
    const struct rg_told_device told = {info(), 0};
    (void)request;
    if (damage() == ABSENT)
        return rg_unsupported("device 'toy': no driver");
    rg_put_fields(reply, rg_told_device_fields, &told);
    reply->size -= damage() == NO_END;
    if (damage() == LONGER)
        rg_put_int(reply, 0);
    return true;
}

// Logs more lines than the harness takes, and fails.
static bool chatter(struct rg_message *request, struct rg_message *reply)
{
    (void)request;
    (void)reply;
    for (int i = 0; i < 5000; i++)
        rg_warning("line %d", i);
    return rg_driver_error("the end");
}

static bool shut(struct rg_message *request, struct rg_message *reply)
{
    (void)request;
    rg_put_fields(reply, rg_closed_fields, &(bool){!getenv("RG_TEST_UNCLEAN")});
    return true;
}

// Fails without a reason.
static bool fall_silent(struct rg_message *request, struct rg_message *reply)
{
    (void)request;
    (void)reply;
    return false;
}

static bool nod(struct rg_message *request, struct rg_message *reply)
{
    (void)request;
    (void)reply;
    return true;
}

enum { WIDTH = 3, HEIGHT = 5, TEXELS = WIDTH * HEIGHT + 1 * 2 };
enum { ONE_LEVEL_MORE = TEXELS + RG_MAX_LEVELS - 1 }; // than an image can have

// An image of halves with two levels.
static bool contents(struct rg_message *request, struct rg_message *reply)
{
    static const uint16_t texels[ONE_LEVEL_MORE];
    int64_t bytes = 2 * TEXELS;
    struct rg_image_desc desc = {RG_R16F, WIDTH, HEIGHT, 1, 2};
    const int no_format = RG_FORMAT_COUNT;
    (void)request;
    if (damage() == NO_FORMAT)
        memcpy(&desc.format, &no_format, sizeof(desc.format));
    if (damage() == LEVELS) {
        desc.levels = RG_MAX_LEVELS + 1;
        bytes = sizeof(texels);
    }
    desc.layers = damage() == LAYERS ? -1 : desc.layers;
    if (damage() == WIDE)
        desc.width = desc.height = desc.layers = INT_MAX;
    const size_t size = (size_t)bytes - (damage() == BYTES);
    const struct rg_told_contents told = {.contents = {desc, size, (void *)(uintptr_t)texels}};
    rg_put_fields(reply, rg_told_contents_fields, &told);
    return true;
}

// Like rg_digests, but with one byte more for a stage's name.
struct long_digest {
    int64_t frame;
    int stages_run;
    char stage[RG_ASSET_NAME + 1], asset[RG_ASSET_NAME];
    uint64_t hash;
    int64_t weight;
};
struct long_digests {
    int count;
    int64_t room;
    struct long_digest *rows;
};

static void put_long_text(struct rg_message *reply)
{
    static const struct rg_field row_fields[] = {
        RG_FIELD_INTEGER(struct long_digest, frame, 0, INT64_MAX),
        RG_FIELD_INTEGER(struct long_digest, stages_run, 0, INT32_MAX),
        RG_FIELD_TEXT(struct long_digest, stage),
        RG_FIELD_TEXT(struct long_digest, asset),
        RG_FIELD_BYTES(struct long_digest, hash),
        RG_FIELD_INTEGER(struct long_digest, weight, 0, INT64_MAX),
        RG_FIELDS_END,
    };
    static const struct rg_field fields[] = {
        RG_FIELD_LIST(struct long_digests, rows, row_fields, INT32_MAX),
        RG_FIELDS_END,
    };
    struct long_digest row = {.frame = 1};
    memset(row.stage, 's', RG_ASSET_NAME);
    rg_put_fields(reply, fields, &(struct long_digests){.count = 1, .rows = &row});
}

static bool digests(struct rg_message *request, struct rg_message *reply)
{
    struct rg_digest row = {.frame = 1};
    const struct rg_digests told = {.count = 1, .rows = &row};
    (void)request;
    if (damage() == LONG_TEXT) {
        put_long_text(reply);
        return true;
    }
    rg_put_fields(reply, rg_told_digests_fields, &told);
    reply->size -= damage() == HALF_A_ROW ? reply->size / 2 : 0;
    return true;
}

static bool open_session(struct rg_message *request, struct rg_message *reply)
{
    (void)request;
    rg_put_fields(reply, rg_told_session_fields, &(struct rg_told_session){0, 0});
    return true;
}

static bool run_frames(struct rg_message *request, struct rg_message *reply)
{
    const double wall_ms = 1;
    (void)request;
    rg_put_fields(reply, rg_ms_fields, &wall_ms);
    return true;
}

static bool count(struct rg_message *request, struct rg_message *reply)
{
    const struct rg_tally tally = {.runs = 1};
    (void)request;
    rg_put_fields(reply, rg_told_tally_fields, &tally);
    return true;
}

// Ends the worker after RG_TEST_TOLD calls.
static bool tell(struct rg_message *request, struct rg_message *reply)
{
    static int calls;
    const struct rg_account account = {.frame = 1};
    (void)request;
    if (calls++ == atoi(getenv("RG_TEST_TOLD")))
        _exit(3);
    rg_put_fields(reply, rg_told_account_fields, &account);
    return true;
}

static rg_service *const services[RG_CALL_COUNT_OF_CALLS] = {
    [RG_CALL_LIST] = list,         [RG_CALL_OPEN] = open,
    [RG_CALL_CLOSE] = shut,        [RG_CALL_SESSION_OPEN] = open_session,
    [RG_CALL_SESSION_CLOSE] = nod, [RG_CALL_STEP] = nod,
    [RG_CALL_SYNC] = nod,          [RG_CALL_FRAMES] = run_frames,
    [RG_CALL_COUNT] = count,       [RG_CALL_TELL] = tell,
    [RG_CALL_CONTENTS] = contents, [RG_CALL_DIGESTS] = digests,
    [RG_CALL_PROBE] = chatter,     [RG_CALL_AUDIT] = fall_silent,
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

static void set_damage(enum damage damage)
{
    const char digits[] = {(char)('0' + damage / 10), (char)('0' + damage % 10), 0};
    setenv("RG_TEST_DAMAGE", digits, 1);
    lines = 0;
}

static int backend_count(void)
{
    int count = 0;
    while (rg_backends[count])
        count++;
    return count;
}

static void a_damaged_list_is_a_failure_of_its_backend(void **state)
{
    static const enum damage all[] = {ENDLESS_TEXT, NO_TIER,   NO_END,
                                      NO_OUTCOME,   NO_REASON, TOO_MANY};
    static struct rg_device_list list;
    (void)state;
    set_damage(NOTHING);
    rg_devices_list(&list);
    assert_int_equal(list.count, backend_count());
    assert_int_equal(list.missing_count, 0);
    for (size_t i = 0; i < sizeof(all) / sizeof(all[0]); i++) {
        set_damage(all[i]);
        rg_devices_list(&list);
        assert_int_equal(list.count, 0);
        assert_int_equal(list.missing_count, backend_count());
        for (int b = 0; b < list.missing_count; b++) {
            assert_int_equal(list.missing[b].outcome, RG_ERROR);
            assert_non_null(strstr(list.missing[b].why, "is damaged"));
        }
    }
}

static void a_list_has_each_backend_s_devices_in_order(void **state)
{
    static struct rg_device_list list;
    (void)state;
    set_damage(TWO);
    rg_devices_list(&list);
    assert_int_equal(list.count, 2 * backend_count());
    assert_int_equal(list.missing_count, 0);
    for (int i = 0; i < list.count; i++) {
        assert_ptr_equal(list.backends[i], rg_backends[i / 2]);
        assert_int_equal(list.backend_index[i], i % 2);
        assert_string_equal(list.infos[i].name, i % 2 ? "toy:1" : "toy");
    }
    set_damage(ABSENT);
    rg_devices_list(&list);
    assert_int_equal(list.count, 0);
    assert_int_equal(list.missing_count, backend_count());
    for (int i = 0; i < list.missing_count; i++) {
        assert_ptr_equal(list.missing[i].backend, rg_backends[i]);
        assert_int_equal(list.missing[i].outcome, RG_UNSUPPORTED);
        assert_string_equal(list.missing[i].why, "toy: no driver");
    }
    assert_int_equal(lines, 0);
    set_damage(NO_END);
    rg_devices_list(&list);
    char due[100];
    const int last = backend_count() - 1;
    snprintf(due, sizeof(due), "%s: device '%s': a message", rg_backends[last]->name,
             rg_backends[last]->name);
    assert_memory_equal(list.missing[last].why, due, strlen(due));
}

// Each device is opened in a process of its own, the first in its backend's worker. Devices that
// fail are left out.
static void all_devices_are_opened_but_those_that_fail(void **state)
{
    static struct rg_devices devices;
    (void)state;
    set_damage(TWO);
    assert_int_equal(rg_devices_open("all", &devices), 0);
    assert_int_equal(devices.count, 2 * backend_count());
    assert_int_equal(devices.absent_count, 0);
    for (int i = 0; i < devices.count; i++)
        for (int k = 0; k < i; k++)
            assert_int_not_equal(rg_worker_process(rg_remote_worker(devices.devices[i])),
                                 rg_worker_process(rg_remote_worker(devices.devices[k])));
    assert_true(rg_devices_close(&devices));
    assert_int_equal(lines, 0);
    set_damage(ABSENT);
    assert_int_equal(rg_devices_open("all", &devices), RG_EXIT_UNSUPPORTED);
    assert_int_equal(devices.absent_count, backend_count());
    const int last = backend_count() - 1;
    assert_string_equal(devices.absent[last].name, rg_backends[last]->name);
    assert_string_equal(devices.absent[last].why, "toy: no driver");
    assert_int_equal(devices.absent[last].outcome, RG_UNSUPPORTED);
    assert_int_equal(lines, backend_count()); // a warning for each
    set_damage(LONGER);                       // only of the reply to opening
    assert_int_equal(rg_devices_open("all", &devices), RG_EXIT_FAIL);
    assert_int_equal(devices.count, 0);
    assert_int_equal(devices.absent_count, backend_count());
    assert_string_equal(devices.absent[0].name, "toy");
    assert_int_equal(devices.absent[0].outcome, RG_ERROR);
    assert_non_null(strstr(devices.absent[0].why, "is damaged"));
}

// Of named devices one that fails ends the opening. Where a driver is absent, the others are tried
// all the same.
static void named_devices_are_opened_one_by_one(void **state)
{
    static struct rg_devices devices;
    (void)state;
    set_damage(NOTHING);
    assert_int_equal(rg_devices_open("new=toy,toy@A=1", &devices), 0);
    assert_int_equal(devices.count, 2);
    assert_string_equal(devices.devices[0]->info.name, "new");
    assert_string_equal(devices.devices[0]->info.full, "toy");
    assert_string_equal(devices.devices[1]->info.name, "toy@A=1");
    assert_string_equal(devices.devices[1]->info.full, "toy@A=1");
    assert_string_equal(devices.devices[1]->backend->name, rg_backends[0]->name);
    assert_true(rg_devices_close(&devices));
    assert_int_equal(rg_devices_open("new=toy,new=toy", &devices), RG_EXIT_USAGE);
    assert_int_equal(devices.count, 0);
    assert_string_equal(rg_last_error(), "--device: 'new' stands there twice; name it once");
    assert_int_equal(rg_devices_open("toy,toy", &devices), 0); // is compared with itself
    assert_true(rg_devices_close(&devices));
    set_damage(ABSENT);
    assert_int_equal(rg_devices_open("new=toy,toy", &devices), RG_EXIT_UNSUPPORTED);
    assert_int_equal(devices.absent_count, 2);
    assert_string_equal(devices.absent[0].name, "new");
    assert_string_equal(devices.absent[1].why, "device 'toy': no driver");
    assert_int_equal(devices.absent[1].outcome, RG_UNSUPPORTED);
    // A required device that is absent or fails is a failure, in one line of its own.
    char toy[] = "toy";
    const struct rg_devices_asked asked = {.names = toy, .require = toy, .timeout_s = 100};
    lines = 0;
    assert_int_equal(rg_devices_open_asked(&asked, &devices), RG_EXIT_FAIL);
    assert_string_equal(rg_last_error(), "--require toy: device 'toy': no driver");
    set_damage(LONGER);
    assert_int_equal(rg_devices_open_asked(&asked, &devices), RG_EXIT_FAIL);
    assert_int_equal(lines, 1);
    assert_int_equal(rg_devices_open("toy,new=toy", &devices), RG_EXIT_FAIL);
    assert_int_equal(devices.absent_count, 1);
    assert_string_equal(devices.absent[0].name, "toy");
    assert_int_equal(devices.count, 0);
}

static void a_device_that_cannot_be_is_not_opened(void **state)
{
    static const enum damage all[] = {ENDLESS_TEXT, NO_TIER, NO_END, LONGER};
    (void)state;
    for (size_t i = 0; i < sizeof(all) / sizeof(all[0]); i++) {
        set_damage(all[i]);
        assert_null(rg_devices_open_one("toy"));
        assert_int_equal(rg_failure_take().fault, RG_FAULT_DRIVER);
        assert_non_null(strstr(rg_last_error(), "device 'toy': a message"));
        assert_int_equal(lines, 1);
    }
}

// Opens the device, which this damage does not prevent; returns whether the contents were taken.
static bool take_contents(enum damage damage)
{
    const struct rg_technique *technique = rg_technique_find("raster");
    void *settings = rg_settings_create(technique);
    const struct rg_digest_run run = {{technique, settings, 8, 8}, 1};
    struct rg_contents contents = {0};
    struct rg_state state;
    set_damage(damage);
    struct rg_device *device = rg_devices_open_one("toy");
    assert_non_null(device);
    const bool ok = rg_digests_contents(&run, device, 0, &contents, &state);
    if (ok) {
        const uint16_t behind = 0;
        assert_int_equal(contents.size, 2 * TEXELS);
        // Comparisons read whole words, so the bytes after the contents must be 0.
        assert_memory_equal((char *)contents.bytes + contents.size, &behind, sizeof(behind));
    }
    rg_contents_free(&contents);
    assert_true(rg_device_close(device));
    free(settings);
    return ok;
}

static void contents_are_what_is_said_of_them(void **state)
{
    (void)state;
    assert_true(take_contents(NOTHING));
    assert_int_equal(lines, 0);
    for (enum damage damage = NO_FORMAT; damage <= BYTES; damage++) {
        if (take_contents(damage))
            fail_msg("damage %d is taken", (int)damage);
        assert_int_equal(lines, 1);
    }
}

static void digests_are_whole_rows(void **state)
{
    const struct rg_technique *technique = rg_technique_find("raster");
    void *settings = rg_settings_create(technique);
    const struct rg_digest_run run = {{technique, settings, 8, 8}, 1};
    (void)state;
    static const enum damage all[] = {NOTHING, HALF_A_ROW, LONG_TEXT};
    for (int i = 0; i < 3; i++) {
        struct rg_digests taken = {0};
        set_damage(all[i]);
        struct rg_device *device = rg_devices_open_one("toy");
        assert_non_null(device);
        assert_int_equal(rg_digests_take(&run, device, &taken), !i);
        assert_int_equal(taken.count, !i);
        assert_int_equal(lines, i > 0);
        rg_digests_free(&taken);
        assert_true(rg_device_close(device));
    }
    free(settings);
}

static void what_closed_badly_has_not_closed(void **state)
{
    (void)state;
    set_damage(NOTHING);
    for (int unclean = 0; unclean < 2; unclean++) {
        if (unclean)
            setenv("RG_TEST_UNCLEAN", "1", 1);
        struct rg_device *device = rg_devices_open_one("toy");
        assert_non_null(device);
        assert_int_equal(rg_device_close(device), !unclean);
        static struct rg_devices devices;
        assert_int_equal(rg_devices_open("toy,toy@A=1", &devices), 0);
        assert_int_equal(rg_devices_end(&devices, RG_EXIT_PASS),
                         unclean ? RG_EXIT_FAIL : RG_EXIT_PASS);
        unsetenv("RG_TEST_UNCLEAN");
    }
    assert_int_equal(lines, 0); // the cause was logged before
}

static void lines_are_bounded_and_the_error_is_kept(void **state)
{
    (void)state;
    set_damage(NOTHING);
    struct rg_device *device = rg_devices_open_one("toy");
    assert_non_null(device);
    assert_false(rg_worker_ask(rg_remote_worker(device), RG_CALL_PROBE, NULL));
    assert_between(lines, 2, 1000);
    assert_non_null(strstr(rg_last_error(), "the end"));
    assert_true(rg_device_close(device));
}

// A failing call gives its reason in its reply, even after an earlier call gave one.
static void a_call_that_fails_says_why(void **state)
{
    (void)state;
    for (int was_told = 0; was_told < 2; was_told++) {
        set_damage(NOTHING);
        struct rg_device *device = rg_devices_open_one("toy");
        assert_non_null(device);
        if (was_told)
            assert_false(rg_worker_ask(rg_remote_worker(device), RG_CALL_PROBE, NULL));
        lines = 0;
        assert_false(rg_worker_ask(rg_remote_worker(device), RG_CALL_AUDIT, NULL));
        assert_int_equal(lines, 1);
        assert_non_null(strstr(rg_last_error(), "a message between processes is damaged"));
        assert_true(rg_device_close(device));
    }
}

// If a worker ends while it reports a session, the record fails and counts nothing.
static void what_is_not_told_ends_a_record(void **state)
{
    const struct rg_technique *technique = rg_technique_find("raster");
    void *settings = rg_settings_create(technique);
    (void)state;
    set_damage(NOTHING);
    for (int told = 0; told < 4; told++) { // 0: when opened; 1, 2: before and after the count
        struct rg_record record = {0};
        setenv("RG_TEST_TOLD", (const char *const[]){"0", "1", "2", "3"}[told], 1);
        struct rg_device *device = rg_devices_open_one("toy");
        assert_non_null(device);
        struct rg_job job = {.subject = {technique, settings, 8, 8},
                             .device = device,
                             .check_frames = 2,
                             .record = &record};
        const bool is_open = rg_job_open(&job);
        assert_int_equal(is_open, told > 0);
        assert_int_equal(is_open && rg_job_count(&job), told == 3);
        assert_int_equal(record.outcome, told == 3 ? RG_OK : RG_CRASH);
        rg_job_close(&job);
        assert_true(rg_device_close(device));
    }
    free(settings);
}

int main(int argc, char **argv)
{
    if (argc == 3 && !strcmp(argv[1], RG_WORKER_ARGUMENT))
        return rg_serve(argv[2], services);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_damaged_list_is_a_failure_of_its_backend),
        cmocka_unit_test(a_list_has_each_backend_s_devices_in_order),
        cmocka_unit_test(all_devices_are_opened_but_those_that_fail),
        cmocka_unit_test(named_devices_are_opened_one_by_one),
        cmocka_unit_test(a_device_that_cannot_be_is_not_opened),
        cmocka_unit_test(contents_are_what_is_said_of_them),
        cmocka_unit_test(digests_are_whole_rows),
        cmocka_unit_test(what_closed_badly_has_not_closed),
        cmocka_unit_test(lines_are_bounded_and_the_error_is_kept),
        cmocka_unit_test(a_call_that_fails_says_why),
        cmocka_unit_test(what_is_not_told_ends_a_record),
    };
    rg_workers.program = "/proc/self/exe";
    rg_log_listen(count_line, NULL);
    return cmocka_run_group_tests_name("damage", tests, NULL, NULL);
}
