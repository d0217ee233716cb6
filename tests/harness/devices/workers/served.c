// What a worker serves, and what its technique, its runs and its kernels tell: the same as in this
// process, and what the test knows of them.
#include "harness/devices/measure/serving/serving.h"

#include "core/device/pass.h"
#include "harness/devices/frames/digests.h"
#include "harness/devices/frames/messages.h"
#include "harness/devices/workers/held.h"
#include "tests/harness/devices/workers/pair.h"
#include "tests/tools/expect.h"

// Settings of flow that take little time.
#define FEW                                                                                        \
    "view=pane panes=mirror environment=sky environment_px=16 reflection_px=16 resolution_px=64"

// Whether a digest is the first of its asset.
static bool is_first(const struct rg_digest *rows, int at)
{
    bool is_new = true;
    for (int i = 0; i < at; i++)
        is_new = is_new && strcmp(rows[i].asset, rows[at].asset) != 0;
    return is_new;
}

// The words of an asset in a run, whose digest is theirs.
static int64_t words_of(const struct rg_digest_run *run, struct rg_device *device,
                        const struct rg_digest *rows, int at)
{
    struct rg_contents contents;
    struct rg_state layout;
    assert_true(rg_digests_contents(run, device, at, &contents, &layout));
    assert_true(rg_contents_hash(&contents) == rows[at].hash);
    const int64_t words = (int64_t)contents.size / 4;
    rg_contents_free(&contents);
    return words;
}

// Digests count stages, frames and work from the opening on: the items of all stages, and the words
// of each asset once.
static void digests_say_how_far_the_run_was(void **state)
{
    (void)state;
    struct pair pair = open_pair("raster", "billboards=10", 0);
    const struct rg_digest_run run = {pair.subject, 2};
    struct rg_digests digests = {0};
    struct stages stages[2] = {{0}};
    struct rg_tally tally;
    int64_t work = 0;
    for (int i = 0; i < 2; i++) { // the same two frames, once told by stages, once counted
        assert_true(rg_session_stages(pair.sessions[LOCAL], note_stage, &stages[i]));
        assert_true(rg_session_count(pair.sessions[REMOTE], &tally));
        work += tally.items;
    }
    assert_true(rg_digests_take(&run, pair.devices[LOCAL], &digests));
    const struct rg_digest *rows = digests.rows, *last = &rows[digests.count - 1];
    assert_string_equal(rows[0].stage, "");
    assert_int_equal(rows[0].frame, 0);
    assert_int_equal(rows[0].stages_run, 0);
    assert_int_equal(last->stages_run, stages[0].count + stages[1].count);
    assert_int_equal(last->frame, 2);
    assert_string_equal(last->asset, "target");
    for (int i = 0; i < digests.count; i++) {
        const int at = rows[i].stages_run - 1;
        assert_string_equal(rows[i].stage, at < 0 ? ""
                                           : at < stages[0].count
                                               ? stages[0].kernels[at]
                                               : stages[1].kernels[at - stages[0].count]);
        if (is_first(rows, i))
            work += words_of(&run, pair.devices[LOCAL], rows, i);
    }
    assert_int_equal(last->weight, work);
    struct rg_contents none;
    struct rg_state layout;
    *logged = 0;
    assert_false(rg_digests_contents(&run, pair.devices[LOCAL], digests.count, &none, &layout));
    assert_non_null(strstr(logged, "a second run on cpu has not come as far as the first"));
    rg_digests_free(&digests);
    close_pair(&pair);
}

// --- what is told, by a technique whose laws and states the test knows ---

static bool holds(const struct rg_instance *instance, char *detail, size_t size)
{
    (void)instance;
    snprintf(detail, size, "all is well");
    return true;
}

static bool fails(const struct rg_instance *instance, char *detail, size_t size)
{
    snprintf(detail, size, "broken in frame %d", (int)instance->frame);
    return false;
}

static bool cannot_tell(const struct rg_instance *instance, char *detail, size_t size)
{
    (void)instance;
    (void)detail;
    (void)size;
    return false;
}

static void each_law_is_checked_by_its_number(void **state)
{
    (void)state;
    static const struct rg_law laws[] = {
        {"first", holds}, {"second", fails}, {"third", cannot_tell}, {NULL, NULL}};
    struct rg_proof proof = {.laws = laws};
    struct rg_technique technique = *rg_technique_find("raster");
    struct rg_device *device = rg_device_open("cpu");
    void *settings = rg_settings_create(&technique);
    const struct rg_subject subject = {&technique, settings, 8, 8};
    technique.proof = &proof;
    struct rg_session *session = rg_session_run(device, &subject, 3);
    char detail[100] = "before";
    assert_true(rg_session_obeys(session, &laws[0], detail, sizeof(detail)));
    assert_string_equal(detail, "all is well");
    assert_false(rg_session_obeys(session, &laws[1], detail, sizeof(detail)));
    assert_string_equal(detail, "broken in frame 3");
    assert_false(rg_session_obeys(session, &laws[2], detail, sizeof(detail)));
    assert_string_equal(detail, "");
    for (int i = 0; i < 3; i++)
        assert_ptr_equal(rg_session_law(session, i), &laws[i]);
    assert_null(rg_session_law(session, 3));
    assert_null(rg_session_law(session, 9));
    rg_session_close(session);
    assert_true(rg_device_close(device));
    free(settings);
}

static void what_a_session_does_not_have_is_refused(void **state)
{
    (void)state;
    struct pair pair = open_pair("flow", FEW, 1);
    const int states = rg_session_state_count(pair.sessions[LOCAL]);
    for (int i = 0; i < 2; i++) {
        struct rg_state layout;
        size_t size;
        char due[100];
        *logged = 0;
        assert_null(rg_session_read_state(pair.sessions[i], states, &layout, &size));
        snprintf(due, sizeof(due), "a session has no state of the number %d\n", states);
        assert_string_equal(logged, due);
        void *words = rg_session_read_state(pair.sessions[i], states - 1, &layout, &size);
        assert_non_null(words);
        free(words);
    }
    close_pair(&pair);
}

static void the_code_is_this_program_s(void **state)
{
    (void)state;
    struct pair pair = open_pair("flow", FEW, 1);
    char program[RG_BUILD_ID_SIZE];
    rg_program_id(program);
    for (int i = 0; i < 2; i++) {
        struct rg_session_code code;
        int64_t first_ns = 0, next_ns = 0;
        assert_true(rg_session_code(pair.sessions[i], &code));
        assert_string_equal(code.program, program);
        assert_int_equal(code.passes.bytes, 0); // cpu compiles none
        assert_true(code.libraries != 0);
        assert_true(rg_session_time(pair.sessions[i], &first_ns));
        assert_true(rg_session_frames(pair.sessions[i], 3, NULL));
        assert_true(rg_session_time(pair.sessions[i], &next_ns));
        assert_above(next_ns, first_ns);
    }
    close_pair(&pair);
}

// --- services, in this process ---

// Calls a service with a request; returns whether it was served.
static bool serve(enum rg_call call, struct rg_message *request, struct rg_message *reply)
{
    *reply = (struct rg_message){0};
    const bool ok = rg_services[call](request, reply);
    rg_message_free(request);
    return ok;
}

static bool serve_number(enum rg_call call, int64_t number, struct rg_message *reply)
{
    struct rg_message request = {0};
    rg_put_int(&request, number);
    return serve(call, &request, reply);
}

// Opens a session as a worker does, and returns its number.
static int64_t serve_session(const char *name, const struct rg_subject *subject)
{
    struct rg_message request = {0}, reply;
    rg_put_text(&request, name);
    rg_put_int(&request, INT64_C(1) << 40);
    rg_put_subject(&request, subject);
    assert_true(serve(RG_CALL_SESSION_OPEN, &request, &reply));
    struct rg_told_session told = {-1, -1};
    assert_true(rg_take_fields(&reply, rg_told_session_fields, &told));
    rg_message_free(&reply);
    return told.number;
}

static void sessions_have_numbers_of_their_own(void **state)
{
    (void)state;
    void *settings = settings_of("raster", "", "");
    const struct rg_subject subject = {rg_technique_find("raster"), settings, 8, 8};
    struct rg_message request = {0}, reply;
    *logged = 0;
    assert_false(serve(RG_CALL_PROBE, &request, &reply));
    assert_string_equal(logged, "its device has gone with its process\n");
    assert_int_equal(serve_session("cpu@A=1", &subject), 0);
    assert_int_equal(serve_session("cpu@A=1", &subject), 1);
    assert_true(serve_number(RG_CALL_STEP, 1, &reply));
    assert_true(serve_number(RG_CALL_SESSION_CLOSE, 0, &reply));
    *logged = 0;
    assert_false(serve_number(RG_CALL_STEP, 0, &reply));
    assert_string_equal(logged, "session 0: is closed\n");
    assert_false(serve_number(RG_CALL_SESSION_CLOSE, 0, &reply));
    assert_int_equal(serve_session("cpu@A=1", &subject), 2);
    assert_false(serve_number(RG_CALL_STEP, 3, &reply));
    assert_true(serve_number(RG_CALL_STEP, 2, &reply));
    assert_true(serve(RG_CALL_CLOSE, &request, &reply));
    bool is_clean = false;
    assert_true(rg_take_fields(&reply, rg_closed_fields, &is_clean));
    assert_true(is_clean);
    rg_message_free(&reply);
    assert_int_equal(serve_session("cpu", &subject), 0); // of another device
    assert_true(serve(RG_CALL_CLOSE, &request, &reply));
    rg_message_free(&reply);
    free(settings);
}

static void expect_loading(const char *first, const char *second, const char *due)
{
    struct rg_message request = {0}, reply;
    rg_put_int(&request, second ? 2 : 1);
    rg_put_text(&request, first);
    if (second)
        rg_put_text(&request, second);
    assert_true(serve(RG_CALL_LOAD, &request, &reply));
    const char *why = rg_take_text(&reply);
    assert_int_equal(strncmp(why, due, strlen(due)), 0);
    assert_int_equal(!*why, !*due);
    rg_message_free(&reply);
}

static void one_library_of_those_named_is_enough(void **state)
{
    (void)state;
    expect_loading("libm.so.6", NULL, "");
    expect_loading("/none/a.so", "libm.so.6", "");
    expect_loading("/none/a.so", NULL, "/none/a.so: cannot open");
    expect_loading("/none/a.so", "/none/b.so", "/none/a.so: cannot open");
}

static void a_backend_lists_its_devices(void **state)
{
    (void)state;
    static struct rg_told_list told;
    struct rg_message request = {0}, reply;
    int cpu = 0;
    while (strcmp(rg_backends[cpu]->name, "cpu") != 0)
        cpu++;
    assert_true(serve_number(RG_CALL_LIST, cpu, &reply));
    assert_true(rg_take_fields(&reply, rg_told_list_fields, &told));
    rg_message_free(&reply);
    assert_int_equal(told.count, 2);
    assert_string_equal(told.infos[0].name, "cpu");
    assert_string_equal(told.infos[1].name, "cpu:reference");
    rg_put_text(&request, "cpu:reference@A=1");
    assert_true(serve(RG_CALL_OPEN, &request, &reply));
    static struct rg_told_device opened;
    assert_true(rg_take_fields(&reply, rg_told_device_fields, &opened));
    rg_message_free(&reply);
    assert_int_equal(opened.backend, cpu);
    assert_string_equal(opened.info.name, "cpu:reference");
    assert_true(serve(RG_CALL_CLOSE, &request, &reply));
    rg_message_free(&reply);
    assert_true(serve(RG_CALL_HELLO, &request, &reply));
    assert_string_equal(rg_take_text(&reply), rg_serving_hello());
    rg_message_free(&reply);
}
// --- dispatches ---

static const struct rg_digest *digest_after(const struct rg_digests *digests, int stage)
{
    const struct rg_digest *row = digests->rows;
    while (row->stages_run != stage)
        row++;
    return row;
}

// A dispatch that was kept leaves what its stage left, and leaves it again when it is replayed.
static void check_dispatch(struct rg_device *device, struct rg_dispatched *dispatched, uint64_t due)
{
    bool is_found = false;
    struct rg_contents *written = NULL;
    for (int i = 0; i < dispatched->kernel->slot_count; i++) {
        const struct rg_slot_info *slot = &dispatched->kernel->slots[i];
        struct rg_contents *after = &dispatched->after[slot->slot];
        assert_int_equal(after->bytes != NULL, rg_slot_is_written(slot->kind));
        if (!after->bytes || rg_contents_hash(after) != due)
            continue;
        is_found = true;
        written = after;
    }
    assert_true(is_found);
    memset(written->bytes, 0x55, written->size);
    assert_true(rg_digests_dispatch(dispatched, device));
    assert_true(rg_contents_hash(written) == due);
}

static void dispatches_of_a_stage_are_kept_and_replayed(void **state)
{
    (void)state;
    struct pair pair = open_pair("flow", FEW, 0);
    const struct rg_digest_run run = {pair.subject, 1};
    struct rg_digests digests = {0};
    struct stages stages = {0};
    int replayed = 0;
    assert_true(rg_session_stages(pair.sessions[LOCAL], note_stage, &stages));
    assert_true(rg_digests_take(&run, pair.devices[LOCAL], &digests));
    for (int stage = 1; stage <= stages.count && replayed < 4; stage++) {
        const struct rg_kernel *kernel = rg_kernel_find(stages.kernels[stage - 1]);
        if (kernel->draw)
            continue;
        struct rg_dispatches kept;
        struct rg_device *device = pair.devices[replayed++ % 2];
        assert_true(rg_digests_dispatches(&run, device, stage, &kept));
        assert_at_least(kept.count, 1);
        for (int i = 0; i < kept.count; i++)
            assert_ptr_equal(kept.rows[i].kernel, kernel);
        check_dispatch(device, &kept.rows[kept.count - 1], digest_after(&digests, stage)->hash);
        rg_dispatches_free(&kept);
    }
    assert_int_equal(replayed, 4);
    struct rg_dispatches none;
    assert_true(rg_digests_dispatches(&run, pair.devices[LOCAL], stages.count + 1, &none));
    assert_int_equal(none.count, 0);
    rg_dispatches_free(&none);
    rg_digests_free(&digests);
    close_pair(&pair);
}

// A state's contents in a run have its layout, as the session tells it.
static void contents_of_a_state_have_its_layout(void **state)
{
    (void)state;
    struct pair pair = open_pair("flow", FEW, 1);
    const struct rg_digest_run run = {pair.subject, 1};
    struct rg_digests digests = {0};
    int found = 0;
    assert_true(rg_digests_take(&run, pair.devices[LOCAL], &digests));
    for (int s = 0; s < rg_session_state_count(pair.sessions[LOCAL]); s++) {
        struct rg_state due, layout;
        struct rg_contents contents;
        size_t size;
        void *words = rg_session_read_state(pair.sessions[LOCAL], s, &due, &size);
        assert_non_null(words);
        int row = digests.count - 1; // the last of this asset
        while (row >= 0 && strcmp(digests.rows[row].asset, due.name) != 0)
            row--;
        if (row >= 0) {
            assert_true(rg_digests_contents(&run, pair.devices[s % 2], row, &contents, &layout));
            assert_string_equal(layout.name, due.name);
            assert_string_equal(layout.words, due.words);
            assert_int_equal(layout.row, due.row);
            assert_int_equal(layout.margin, due.margin);
            assert_int_equal(contents.size, size);
            assert_memory_equal(contents.bytes, words, size);
            rg_contents_free(&contents);
            found++;
        }
        free(words);
    }
    assert_above(found, 0);
    rg_digests_free(&digests);
    close_pair(&pair);
}

// --- kernels ---

static void a_kernel_s_code_is_the_same(void **state)
{
    (void)state;
    struct pair pair = open_pair("raster", "billboards=10", 0);
    const struct rg_kernel *kernel = rg_kernel_find("probe_copy");
    int found = 0;
    static const enum rg_code_kind kinds[] = {RG_CODE_GLSL, RG_CODE_SPIRV, RG_CODE_OPENCL};
    for (int k = 0; k < 3; k++) {
        void *code[2];
        size_t sizes[2];
        for (int i = 0; i < 2; i++) {
            code[i] = rg_digests_code(pair.devices[i], kernel, kinds[k], &sizes[i]);
            if (!code[i]) // a build without drivers has none
                assert_int_equal(rg_failure_take().fault, RG_FAULT_NONE);
        }
        assert_int_equal(!code[LOCAL], !code[REMOTE]);
        if (code[LOCAL]) {
            found++;
            assert_int_equal(sizes[LOCAL], sizes[REMOTE]);
            assert_memory_equal(code[LOCAL], code[REMOTE], sizes[LOCAL]);
            if (kinds[k] == RG_CODE_SPIRV)
                assert_memory_equal(code[LOCAL], &(uint32_t){0x07230203}, 4);
        }
        free(code[LOCAL]);
        free(code[REMOTE]);
    }
    close_pair(&pair);
    if (!found)
        skip(); // a build without drivers
}

static void a_kernel_is_compiled(void **state)
{
    (void)state;
    struct pair pair = open_pair("raster", "billboards=10", 0);
    for (int i = 0; i < 2; i++)
        assert_true(rg_digests_compile(pair.devices[i], rg_kernel_find("probe_copy")));
    close_pair(&pair);
}

// --- memory ---

static void a_device_s_memory_is_its_process_s(void **state)
{
    (void)state;
    enum { BYTES = 64 << 20 };
    struct pair pair = open_pair("raster", "billboards=10", 0);
    const pid_t process = rg_worker_process(rg_remote_worker(pair.devices[REMOTE]));
    const int64_t before = rg_remote_held_bytes(pair.devices[LOCAL]);
    const int64_t theirs = rg_remote_held_bytes(pair.devices[REMOTE]);
    char *volatile more = malloc(BYTES); // so that it is written
    assert_non_null(more);
    memset(more, 1, BYTES);
    assert_at_least(rg_remote_held_bytes(pair.devices[LOCAL]) - before, BYTES / 2);
    assert_at_most(rg_remote_held_bytes(pair.devices[REMOTE]) - theirs, BYTES / 2);
    assert_at_most(rg_held_bytes(process) - theirs, BYTES / 2);
    assert_above(theirs, 0);
    free(more);
    close_pair(&pair);
}

int main(int argc, char **argv)
{
    if (argc == 3 && !strcmp(argv[1], RG_WORKER_ARGUMENT))
        return rg_serving(argv[2]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(digests_say_how_far_the_run_was),
        cmocka_unit_test(each_law_is_checked_by_its_number),
        cmocka_unit_test(what_a_session_does_not_have_is_refused),
        cmocka_unit_test(the_code_is_this_program_s),
        cmocka_unit_test(sessions_have_numbers_of_their_own),
        cmocka_unit_test(one_library_of_those_named_is_enough),
        cmocka_unit_test(a_backend_lists_its_devices),
        cmocka_unit_test(dispatches_of_a_stage_are_kept_and_replayed),
        cmocka_unit_test(contents_of_a_state_have_its_layout),
        cmocka_unit_test(a_kernel_s_code_is_the_same),
        cmocka_unit_test(a_kernel_is_compiled),
        cmocka_unit_test(a_device_s_memory_is_its_process_s),
    };
    rg_log_listen(keep, NULL);
    return cmocka_run_group_tests_name("services of workers", tests, NULL, NULL);
}
