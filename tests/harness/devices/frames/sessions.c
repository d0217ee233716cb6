// A session in a worker gives the same bytes as one in this process, and ends with its worker.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/base/memory.h"
#include "harness/devices/devices.h"
#include "harness/devices/frames/digests.h"
#include "harness/devices/frames/session.h"
#include "harness/devices/measure/serving/serving.h"
#include "harness/devices/workers/device.h"
#include "tests/harness/devices/workers/pair.h"
#include "tests/tools/expect.h"

enum { FRAMES = 5 };

static void devices_tell_the_same_of_themselves(void **state)
{
    (void)state;
    struct pair pair = open_flow(0);
    const struct rg_device_info *local = &pair.devices[LOCAL]->info;
    const struct rg_device_info *remote = &pair.devices[REMOTE]->info;
    assert_string_equal(local->name, remote->name);
    assert_string_equal(local->device, remote->device);
    assert_string_equal(local->driver, remote->driver);
    assert_string_equal(local->api, remote->api);
    assert_int_equal(local->tier, remote->tier);
    assert_memory_equal(&local->limits.formats, &remote->limits.formats,
                        sizeof(local->limits.formats));
    assert_string_equal(pair.devices[REMOTE]->backend->name, "cpu");
    close_pair(&pair);
}

static void pictures_are_the_same(void **state)
{
    (void)state;
    struct pair pair = open_flow(FRAMES);
    for (int round = 0; round < 2; round++) {
        size_t sizes[2];
        void *texels[2];
        struct rg_picture pictures[2] = {{0}};
        for (int i = 0; i < 2; i++) {
            texels[i] = rg_session_read(pair.sessions[i], &sizes[i]);
            assert_true(rg_session_picture(pair.sessions[i], texels[i], &pictures[i]));
        }
        assert_int_equal(sizes[LOCAL], sizes[REMOTE]);
        assert_memory_equal(texels[LOCAL], texels[REMOTE], sizes[LOCAL]);
        assert_memory_equal(pictures[LOCAL].texels, pictures[REMOTE].texels,
                            (size_t)rg_picture_values(&pictures[LOCAL]) * sizeof(float));
        for (int i = 0; i < 2; i++) {
            rg_picture_destroy(&pictures[i]);
            free(texels[i]);
            double wall_ms = -1;
            assert_true(rg_session_frames(pair.sessions[i], 2, &wall_ms));
            assert_above(wall_ms, 0);
        }
    }
    close_pair(&pair);
}

static void states_are_the_same(void **state)
{
    (void)state;
    struct pair pair = open_flow(FRAMES);
    const int count = rg_session_state_count(pair.sessions[LOCAL]);
    assert_above(count, 0);
    assert_int_equal(count, rg_session_state_count(pair.sessions[REMOTE]));
    for (int s = 0; s < count; s++) {
        struct rg_state layouts[2];
        size_t sizes[2];
        void *words[2];
        for (int i = 0; i < 2; i++)
            words[i] = rg_session_read_state(pair.sessions[i], s, &layouts[i], &sizes[i]);
        assert_int_equal(sizes[LOCAL], sizes[REMOTE]);
        assert_memory_equal(words[LOCAL], words[REMOTE], sizes[LOCAL]);
        assert_string_equal(layouts[LOCAL].name, layouts[REMOTE].name);
        assert_int_equal(layouts[LOCAL].row, layouts[REMOTE].row);
        assert_int_equal(layouts[LOCAL].margin, layouts[REMOTE].margin);
        assert_string_equal(layouts[LOCAL].words, s == 0 ? "f" : "u"); // the water is floats
        assert_string_equal(layouts[REMOTE].words, layouts[LOCAL].words);
        free(words[LOCAL]);
        free(words[REMOTE]);
    }
    close_pair(&pair);
}

static void accounts_and_counts_are_the_same(void **state)
{
    (void)state;
    struct pair pair = open_flow(FRAMES);
    struct rg_tally tallies[2];
    struct rg_account accounts[2];
    for (int i = 0; i < 2; i++) {
        assert_true(rg_session_count(pair.sessions[i], &tallies[i]));
        assert_true(rg_session_tell(pair.sessions[i], &accounts[i]));
    }
    assert_memory_equal(&tallies[LOCAL], &tallies[REMOTE], sizeof(tallies[LOCAL]));
    assert_above(tallies[LOCAL].runs, 0);
    assert_int_equal(accounts[LOCAL].frame, FRAMES + 1);
    assert_int_equal(accounts[REMOTE].frame, FRAMES + 1);
    assert_int_equal(accounts[LOCAL].counter_count, accounts[REMOTE].counter_count);
    assert_int_equal(accounts[LOCAL].fact_count, accounts[REMOTE].fact_count);
    assert_above(accounts[LOCAL].counter_count, 0);
    assert_above(accounts[LOCAL].fact_count, 0);
    for (int i = 0; i < accounts[LOCAL].counter_count; i++) {
        assert_string_equal(accounts[LOCAL].counters[i].name, accounts[REMOTE].counters[i].name);
        assert_int_equal(accounts[LOCAL].counters[i].value, accounts[REMOTE].counters[i].value);
    }
    for (int i = 0; i < accounts[LOCAL].fact_count; i++) {
        assert_string_equal(accounts[LOCAL].facts[i].name, accounts[REMOTE].facts[i].name);
        assert_string_equal(accounts[LOCAL].facts[i].text, accounts[REMOTE].facts[i].text);
        assert_equals(accounts[LOCAL].facts[i].number, accounts[REMOTE].facts[i].number);
    }
    close_pair(&pair);
}

static void stages_are_told_in_the_same_order(void **state)
{
    (void)state;
    struct pair pair = open_flow(FRAMES);
    struct stages told[2] = {{0}};
    for (int i = 0; i < 2; i++)
        assert_true(rg_session_stages(pair.sessions[i], note_stage, &told[i]));
    assert_above(told[LOCAL].count, 3);
    assert_int_equal(told[LOCAL].count, told[REMOTE].count);
    for (int i = 0; i < told[LOCAL].count; i++)
        assert_string_equal(told[LOCAL].kernels[i], told[REMOTE].kernels[i]);
    assert_above(told[REMOTE].ms, 0);
    close_pair(&pair);
}

// Laws say the same of the same state.
static void laws_and_textures_are_the_same(void **state)
{
    (void)state;
    struct pair pair = open_flow(FRAMES);
    int laws = 0;
    for (const struct rg_law *law = pair.subject.technique->proof->laws; law->name; law++) {
        char details[2][256] = {"", ""};
        const bool holds = rg_session_obeys(pair.sessions[LOCAL], law, details[LOCAL], 256);
        assert_int_equal(holds, rg_session_obeys(pair.sessions[REMOTE], law, details[REMOTE], 256));
        assert_string_equal(details[LOCAL], details[REMOTE]);
        assert_ptr_equal(rg_session_law(pair.sessions[REMOTE], laws), law);
        laws++;
    }
    assert_above(laws, 0);
    assert_null(rg_session_law(pair.sessions[REMOTE], laws));
    struct rg_image_desc descs[2];
    int levels[2];
    for (int i = 0; i < 2; i++) {
        assert_true(rg_session_texture(pair.sessions[i], "environment", &descs[i], &levels[i]));
        assert_false(rg_session_texture(pair.sessions[i], "nothing", &descs[i], &levels[i]));
    }
    assert_memory_equal(&descs[LOCAL], &descs[REMOTE], sizeof(descs[LOCAL]));
    assert_int_equal(levels[LOCAL], levels[REMOTE]);
    close_pair(&pair);
}

static void digests_are_the_same(void **state)
{
    (void)state;
    struct pair pair = open_flow(0);
    const struct rg_digest_run run = {pair.subject, 2};
    struct rg_digests digests[2] = {{0}};
    for (int i = 0; i < 2; i++)
        assert_true(rg_digests_take(&run, pair.devices[i], &digests[i]));
    assert_int_equal(digests[LOCAL].count, digests[REMOTE].count);
    assert_memory_equal(digests[LOCAL].rows, digests[REMOTE].rows,
                        (size_t)digests[LOCAL].count * sizeof(*digests[LOCAL].rows));
    for (int row = 0; row < digests[LOCAL].count; row += digests[LOCAL].count / 3) {
        struct rg_contents contents[2];
        struct rg_state states[2];
        for (int i = 0; i < 2; i++)
            assert_true(rg_digests_contents(&run, pair.devices[i], row, &contents[i], &states[i]));
        assert_int_equal(contents[LOCAL].size, contents[REMOTE].size);
        assert_memory_equal(contents[LOCAL].bytes, contents[REMOTE].bytes, contents[LOCAL].size);
        assert_int_equal(contents[LOCAL].desc.width, contents[REMOTE].desc.width);
        assert_int_equal(!states[LOCAL].name, !states[REMOTE].name);
        assert_int_equal(!states[LOCAL].words, !!contents[LOCAL].desc.levels);
        if (states[LOCAL].words)
            assert_string_equal(states[LOCAL].words, states[REMOTE].words);
        for (int i = 0; i < 2; i++)
            rg_contents_free(&contents[i]);
    }
    for (int i = 0; i < 2; i++)
        rg_digests_free(&digests[i]);
    close_pair(&pair);
}

// A kernel replayed alone leaves what it left in its run, and one that fails has not run.
static void kernels_alone_do_the_same(void **state)
{
    (void)state;
    struct pair pair = open_flow(0);
    const struct rg_digest_run run = {pair.subject, 1};
    struct rg_dispatches dispatches = {0};
    assert_true(rg_digests_dispatches(&run, pair.devices[LOCAL], 1, &dispatches));
    assert_at_least(dispatches.count, 1);
    const struct rg_dispatched *due = &dispatches.rows[0];
    assert_true(due->was_kept);
    for (int i = 0; i < 2; i++) {
        struct rg_dispatched again = *due;
        memset(again.after, 0, sizeof(again.after));
        assert_true(rg_digests_dispatch(&again, pair.devices[i]));
        for (int slot = 0; slot < RG_MAX_SLOTS; slot++) {
            assert_int_equal(again.after[slot].size, due->after[slot].size);
            if (again.after[slot].size)
                assert_memory_equal(again.after[slot].bytes, due->after[slot].bytes,
                                    due->after[slot].size);
            rg_contents_free(&again.after[slot]);
        }
        again.extent.width = -1;
        assert_false(rg_digests_dispatch(&again, pair.devices[i]));
        rg_failure_take();
    }
    rg_dispatches_free(&dispatches);
    close_pair(&pair);
}

// File names, choices and numbers reach the worker unchanged: of drops of one size, and of the
// default spectrum.
static void settings_arrive_as_they_are(void **state)
{
    (void)state;
    static const char *const rains[] = {
        "spectrum=off drops_m2_s=20 atlas=small city=small depth_map_px=128 geometry=off seed=7",
        "kept_share=0.001 atlas=small city=small depth_map_px=128 geometry=off seed=7"};
    for (int rain = 0; rain < 2; rain++) {
        struct pair pair = open_pair("streaks", rains[rain], FRAMES);
        size_t sizes[2];
        void *texels[2];
        for (int i = 0; i < 2; i++)
            texels[i] = rg_session_read(pair.sessions[i], &sizes[i]);
        assert_memory_equal(texels[LOCAL], texels[REMOTE], sizes[LOCAL]);
        free(texels[LOCAL]);
        free(texels[REMOTE]);
        close_pair(&pair);
    }
}

static void what_the_worker_refuses_is_refused_here(void **state)
{
    (void)state;
    struct pair pair = open_flow(0);
    void *settings =
        rg_settings_copy(pair.subject.technique, pair.settings, "environment=/nowhere/at-all.ktx");
    struct rg_subject subject = pair.subject;
    subject.settings = settings;
    char lines[2][2048];
    for (int i = 0; i < 2; i++) {
        *logged = 0;
        assert_null(rg_session_open(pair.devices[i], &subject));
        assert_int_equal(rg_failure_take().fault, RG_FAULT_INPUT);
        strcpy(lines[i], logged);
    }
    assert_non_null(strstr(lines[LOCAL], "/nowhere/at-all.ktx"));
    assert_string_equal(lines[LOCAL], lines[REMOTE]);
    free(settings);
    close_pair(&pair);
}

// A worker that ends takes its sessions along; the device works again for the next session.
static void a_session_ends_with_its_worker(void **state)
{
    (void)state;
    struct pair pair = open_flow(FRAMES);
    struct rg_worker *worker = rg_remote_worker(pair.devices[REMOTE]);
    struct rg_session *session = pair.sessions[REMOTE], *next;
    struct rg_account account = {.frame = 77};
    kill(rg_worker_process(worker), SIGKILL);
    *logged = 0;
    assert_false(rg_session_step(session));
    assert_int_equal(rg_failure_take().outcome, RG_CRASH);
    assert_non_null(strstr(logged, "device 'cpu': its driver crashed (Killed)"));
    assert_false(rg_session_draw(session));
    assert_int_equal(rg_failure_take().outcome, RG_CRASH);
    assert_false(rg_session_tell(session, &account));
    assert_int_equal(account.frame, 0);
    assert_int_equal(rg_worker_life(worker), 1); // a call of a lost session starts no other worker

    next = rg_session_run(pair.devices[REMOTE], &pair.subject, 2);
    assert_non_null(next);
    assert_int_equal(rg_worker_life(worker), 2);
    assert_false(rg_session_step(session)); // it stays lost, though a new session has its number
    assert_true(rg_session_step(next));
    assert_true(rg_session_tell(next, &account));
    assert_int_equal(account.frame, 3);
    *logged = 0;
    rg_session_close(session);
    assert_true(rg_session_step(next));
    assert_string_equal(logged, "");
    pair.sessions[REMOTE] = next;
    close_pair(&pair);
}

static void devices_have_an_environment(void **state)
{
    (void)state;
    rg_workers.program = "/proc/self/exe";
    struct rg_devices devices;
    assert_int_equal(
        rg_devices_open("cpu@RG_CPU_LEVEL=plain,cpu:reference@A=\"1,2\",cpu", &devices), 0);
    assert_int_equal(devices.count, 3);
    assert_string_equal(devices.devices[0]->info.name, "cpu@RG_CPU_LEVEL=plain");
    assert_non_null(strstr(devices.devices[0]->info.api, "plain"));
    assert_string_equal(devices.devices[1]->info.name, "cpu:reference@A=\"1,2\"");
    assert_string_equal(devices.devices[2]->info.name, "cpu");
    assert_true(rg_devices_close(&devices));
    assert_null(rg_devices_open_one("cpu@RG_CPU_LEVEL=v99"));
}

// A worker cannot take memory that another holds, until it is given back or that process has ended.
// It runs last, since an allowed size cannot be taken back.
static void workers_share_what_the_user_allows(void **state)
{
    (void)state;
    struct pair pair = open_flow(0);
    const int64_t before = rg_memory_taken();
    rg_session_close(pair.sessions[REMOTE]);
    rg_session_close(pair.sessions[LOCAL]);
    const int64_t idle = rg_memory_taken();
    const int64_t one = (before - idle) / 2;
    assert_above(one, 1 << 16);
    struct rg_device *other = rg_devices_open_one("cpu:reference");
    pair.sessions[REMOTE] = rg_session_open(pair.devices[REMOTE], &pair.subject);
    assert_non_null(pair.sessions[REMOTE]);
    assert_int_equal(rg_memory_taken(), idle + one);
    // A second session of a device shares what is around it, and takes the less for that.
    struct rg_session *second = rg_session_open(pair.devices[REMOTE], &pair.subject);
    assert_non_null(second);
    const int64_t two = rg_memory_taken() - idle;
    assert_above(two, one + one / 2);
    assert_below(two, 2 * one);
    rg_session_close(second);
    rg_memory_allow(idle + two + one / 2);
    second = rg_session_open(pair.devices[REMOTE], &pair.subject); // both fit
    assert_non_null(second);
    assert_int_equal(rg_memory_taken(), idle + two);
    *logged = 0;
    assert_null(rg_session_open(other, &pair.subject));
    assert_int_equal(rg_failure_take().fault, RG_FAULT_INPUT);
    assert_non_null(strstr(logged, " of --memory are left"));
    assert_null(rg_session_open(pair.devices[LOCAL], &pair.subject)); // this process cannot either

    kill(rg_worker_process(rg_remote_worker(pair.devices[REMOTE])), SIGKILL);
    assert_false(rg_session_step(pair.sessions[REMOTE]));
    assert_int_equal(rg_memory_taken(), idle);
    pair.sessions[LOCAL] = rg_session_open(other, &pair.subject);
    assert_non_null(pair.sessions[LOCAL]);
    rg_session_close(second);
    close_pair(&pair);
    assert_int_equal(rg_memory_taken(), 0);
    assert_true(rg_device_close(other));
}

int main(int argc, char **argv)
{
    if (argc == 3 && !strcmp(argv[1], RG_WORKER_ARGUMENT))
        return rg_serving(argv[2]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(devices_tell_the_same_of_themselves),
        cmocka_unit_test(pictures_are_the_same),
        cmocka_unit_test(states_are_the_same),
        cmocka_unit_test(accounts_and_counts_are_the_same),
        cmocka_unit_test(stages_are_told_in_the_same_order),
        cmocka_unit_test(laws_and_textures_are_the_same),
        cmocka_unit_test(digests_are_the_same),
        cmocka_unit_test(kernels_alone_do_the_same),
        cmocka_unit_test(settings_arrive_as_they_are),
        cmocka_unit_test(what_the_worker_refuses_is_refused_here),
        cmocka_unit_test(a_session_ends_with_its_worker),
        cmocka_unit_test(devices_have_an_environment),
        cmocka_unit_test(workers_share_what_the_user_allows),
    };
    rg_log_listen(keep, NULL);
    return cmocka_run_group_tests_name("sessions in workers", tests, NULL, NULL);
}
