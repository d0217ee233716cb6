// How two sides of a cell, or one and its baseline, are compared, and how a difference is told.
// Stand-ins run the cells, so that every result can be made.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/compare/blame/blame.h"
#include "harness/compare/gate/run/running.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/logged.h"

#define SHA_A "0123456789abcdef"
#define SHA_B "fedcba9876543210"

// --- stand-ins ---

static struct rg_device devices[RG_SIDES], reference;
static struct rg_baseline_row results[RG_SIDES]; // what a side's device leaves
static int takes[RG_SIDES];                      // how often it ran
static bool has_room, are_alike, does_hold, does_open, is_blamed;
static enum rg_outcome ends_with; // of pictures that are not alike
static int holds_asked;
static struct {
    struct rg_device *device, *truth;
    int frames, calls;
} blamed;

void rg_baseline_take(const struct rg_gate_cell *cell, struct rg_device *device,
                      struct rg_baseline_row *row, struct rg_picture *picture)
{
    const int side = device == &devices[RG_SIDE_B];
    (void)cell;
    takes[side]++;
    *row = results[side];
    picture->width = 10 + side;
}

bool rg_alike_has_room(const struct rg_gate_cell *cell, struct rg_agreement *agreement)
{
    (void)cell;
    agreement->outcome = has_room ? RG_OK : RG_LACKING;
    return has_room;
}

bool rg_alike_pictures(const struct rg_gate_cell *cell, const struct rg_drawn *a,
                       const struct rg_drawn *b, struct rg_agreement *agreement)
{
    (void)cell;
    assert_string_equal(a->name, "old");
    assert_string_equal(b->name, "new");
    assert_ptr_equal(a->device, &devices[RG_SIDE_A]);
    assert_ptr_equal(b->device, &devices[RG_SIDE_B]);
    assert_int_equal(a->picture.width, 10);
    assert_int_equal(b->picture.width, 11);
    agreement->outcome = are_alike ? RG_OK : ends_with;
    return are_alike;
}

bool rg_truth_open(struct rg_truth *truth)
{
    truth->device = does_open ? &reference : NULL;
    return does_open;
}

bool rg_truth_holds(struct rg_truth *truth, const struct rg_gate_cell *cell,
                    struct rg_device *device, const struct rg_picture *picture,
                    struct rg_agreement *agreement)
{
    (void)cell;
    assert_ptr_equal(device, &devices[RG_SIDE_B]);
    assert_int_equal(picture->width, 11);
    holds_asked++;
    truth->device = &reference;
    return does_hold || rg_agreement_differs(agreement, "another picture");
}

bool rg_blame_find(const struct rg_digest_run *run, struct rg_device *device,
                   struct rg_device *truth, struct rg_blame *blame)
{
    blamed.device = device;
    blamed.truth = truth;
    blamed.frames = run->frames;
    blamed.calls++;
    *blame = (struct rg_blame){.found = is_blamed};
    snprintf(blame->text, sizeof(blame->text), "stage rain");
    return true;
}

// --- a case ---

static const struct rg_gate_cell cell = {.name = "rain", .frames = 3};
static struct rg_side sides[RG_SIDES];
static struct rg_truth truth;
static struct rg_gate_case of;

// A result with a state, a counter and a count of work.
static struct rg_baseline_row result(void)
{
    struct rg_baseline_row row = {.outcome = RG_OK,
                                  .picture = SHA_A,
                                  .state_count = 1,
                                  .states = {{"wet", SHA_A}},
                                  .counters = {1, {{"drops", 5}}}};
    row.work.items = 7;
    row.code = (struct rg_session_code){.libraries = 1};
    return row;
}

// Two sides that are alike, whose tier is T0. `before`: the baseline's row in place of A.
static void begin(const struct rg_baseline_row *before)
{
    memset(takes, 0, sizeof(takes));
    memset(&blamed, 0, sizeof(blamed));
    memset(&truth, 0, sizeof(truth));
    results[RG_SIDE_A] = results[RG_SIDE_B] = result();
    results[RG_SIDE_B].code.libraries = 2;
    has_room = are_alike = does_hold = does_open = is_blamed = true;
    ends_with = RG_FAIL;
    holds_asked = 0;
    for (int side = 0; side < RG_SIDES; side++) {
        devices[side].info.tier = RG_T0;
        sides[side].device = &devices[side];
    }
    of = (struct rg_gate_case){.cell = &cell,
                               .name = "rain.new",
                               .sides = {before ? NULL : &sides[RG_SIDE_A], &sides[RG_SIDE_B]},
                               .before = before,
                               .devices = {before ? "new" : "old", before ? NULL : "new"},
                               .device_count = before ? 1 : 2};
}

static void agree(enum rg_outcome outcome, const char *message)
{
    rg_gate_agree(&of, &truth, "folder");
    assert_string_equal(of.agreement.message, message);
    assert_int_equal(of.agreement.outcome, outcome);
    assert_string_equal(of.agreement.folder, "folder");
    assert_string_equal(of.agreement.name, "rain.new");
}

// --- two sides ---

static void sides_that_are_alike_agree_and_have_code(void **state)
{
    (void)state;
    begin(NULL);
    agree(RG_OK, "");
    assert_true(of.agreement.has_code);
    assert_true(isnan(of.agreement.pixels) && isnan(of.agreement.difference));
    assert_int_equal(of.agreement.code[RG_SIDE_A].libraries, 1);
    assert_int_equal(of.agreement.code[RG_SIDE_B].libraries, 2);
    assert_true(takes[RG_SIDE_A] == 1 && takes[RG_SIDE_B] == 1);
    assert_int_equal(blamed.calls, 0);
    begin(NULL);
    has_room = false;
    agree(RG_LACKING, "");
    assert_int_equal(takes[RG_SIDE_A] + takes[RG_SIDE_B], 0);
}

static void a_side_that_fails_ends_the_case_under_its_name(void **state)
{
    (void)state;
    for (int side = 0; side < RG_SIDES; side++)
        for (int ours = 0; ours < 2; ours++) {
            begin(NULL);
            results[side].outcome = RG_CRASH;
            results[side].is_ours = ours;
            snprintf(results[side].why, sizeof(results[side].why), "it fell");
            agree(RG_CRASH, "it fell");
            assert_int_equal(of.agreement.is_ours, ours);
            assert_ptr_equal(of.agreement.device, of.devices[side]);
            assert_int_equal(takes[RG_SIDE_B], side == RG_SIDE_B);
            assert_false(of.agreement.has_code);
        }
}

static void a_difference_of_pictures_is_blamed_on_a_stage(void **state)
{
    (void)state;
    begin(NULL);
    are_alike = false;
    agree(RG_FAIL, "");
    assert_true(of.agreement.has_code);
    assert_string_equal(of.agreement.details, "stage rain");
    assert_ptr_equal(blamed.device, &devices[RG_SIDE_B]);
    assert_ptr_equal(blamed.truth, &devices[RG_SIDE_A]);
    assert_int_equal(blamed.frames, 3);
    begin(NULL);
    are_alike = is_blamed = false;
    agree(RG_FAIL, "");
    assert_string_equal(of.agreement.details, "");
    begin(NULL); // without rain nothing was compared
    are_alike = false;
    ends_with = RG_NOTHING;
    agree(RG_NOTHING, "");
    assert_false(of.agreement.has_code);
    assert_int_equal(blamed.calls, 0);
}

// One thing that B leaves otherwise, and what is said about it.
static void edit(int what, struct rg_baseline_row *b)
{
    switch (what) {
    case 0:
        snprintf(b->states[0].digest, RG_DIGEST_SIZE, SHA_B);
        break;
    case 1:
        snprintf(b->states[0].name, sizeof(b->states[0].name), "dry");
        break;
    case 2:
        b->state_count = 0;
        break;
    case 3:
        b->counters.counters[0].value = 6;
        break;
    case 4:
        snprintf(b->counters.counters[0].name, sizeof(b->counters.counters[0].name), "rays");
        break;
    case 5:
        b->counters.count = 0;
        break;
    case 6:
        b->work.items = 8;
        break;
    case 7:
        b->work.bytes_read = 1;
        break;
    default: // what no API has to share, and what no device can count
        b->work.dispatches = 99;
        b->work.fragments = -1;
    }
}

static const char *const said_of_a[] = {
    "the state 'wet' differs after 3 frames",
    "the state 'dry' is new",
    "there are 0 states, and there were 1",
    "the counter 'drops' is 5 and 6",
    "a counter is 'drops' and 'rays'",
    "there are 1 and 0 counters",
    "a frame has 7 and 8 items",
    "a frame has 0 and 1 bytes_read",
    "",
};
enum { EDITS = sizeof(said_of_a) / sizeof(said_of_a[0]) };

static void states_counters_and_work_must_be_the_same(void **state)
{
    (void)state;
    for (int i = 0; i < EDITS; i++) {
        begin(NULL);
        edit(i, &results[RG_SIDE_B]);
        agree(*said_of_a[i] ? RG_FAIL : RG_OK, said_of_a[i]);
        assert_int_equal(blamed.calls, *said_of_a[i] != 0);
    }
    for (int i = 0; i < 3; i++) { // with a looser tier states may differ
        begin(NULL);
        devices[i % RG_SIDES].info.tier = RG_T1;
        edit(i, &results[RG_SIDE_B]);
        agree(RG_OK, "");
    }
}

// --- a baseline ---

static void a_picture_as_in_the_baseline_is_right_if_it_was(void **state)
{
    (void)state;
    static const char other[] = "the picture is another than the baseline's, and holds T0 against "
                                "cpu:reference as it draws now";
    static const struct {
        enum rg_outcome before;
        bool is_same, holds;
        enum rg_outcome outcome;
        int asked;
        const char *said;
    } rows[] = {
        {RG_OK, true, false, RG_OK, 0, ""},
        {RG_FAIL, true, true, RG_OK, 1, ""},
        {RG_OK, false, true, RG_OK, 1, other},
        {RG_FAIL, false, true, RG_OK, 1, other},
        {RG_OK, false, false, RG_FAIL, 1, "another picture"},
        {RG_FAIL, true, false, RG_FAIL, 1, "another picture"},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_baseline_row before = result();
        before.outcome = rows[i].before;
        begin(&before);
        snprintf(results[RG_SIDE_B].picture, RG_DIGEST_SIZE, rows[i].is_same ? SHA_A : SHA_B);
        does_hold = rows[i].holds;
        agree(rows[i].outcome, rows[i].said);
        assert_int_equal(holds_asked, rows[i].asked);
        assert_int_equal(takes[RG_SIDE_A], 0);
        assert_int_equal(blamed.calls, rows[i].outcome == RG_FAIL);
        assert_false(of.agreement.has_code);
    }
    const struct rg_baseline_row before = result();
    begin(&before); // the picture is told, and not the state
    edit(0, &results[RG_SIDE_B]);
    snprintf(results[RG_SIDE_B].picture, RG_DIGEST_SIZE, SHA_B);
    does_hold = false;
    agree(RG_FAIL, "another picture");
}

static void what_differs_from_the_baseline_is_named(void **state)
{
    (void)state;
    for (int i = 0; i < EDITS; i++) {
        const struct rg_baseline_row before = result();
        begin(&before);
        edit(i, &results[RG_SIDE_B]);
        const char *said =
            i ? said_of_a[i] : "the state 'wet' has digest " SHA_B ", and had " SHA_A;
        agree(*said ? RG_FAIL : RG_OK, said);
        if (!*said)
            continue;
        assert_string_equal(of.agreement.details, "stage rain");
        assert_ptr_equal(blamed.device, &devices[RG_SIDE_B]);
        assert_ptr_equal(blamed.truth, &reference);
    }
}

// Where no stage differs from cpu:reference now, the device is not what has changed.
static void what_all_devices_do_otherwise_is_not_blamed_on_one(void **state)
{
    (void)state;
    static const char begins[] = "cpu:reference leaves the same bits after every stage now: what "
                                 "has changed is ";
    static const struct {
        bool holds, opens;
        const char *libraries, *said; // said: "": nothing
    } rows[] = {
        {true, true, "", "what raingauge computes, and not how the device does"},
        {true, true, "glibc 2.41 and not 2.36",
         "what the host computes with, glibc 2.41 and not 2.36, and not how the device does"},
        {false, true, "", ""},
        {true, false, "", ""},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        const struct rg_baseline_row before = result();
        char due[400] = "";
        begin(&before);
        snprintf(truth.libraries, sizeof(truth.libraries), "%s", rows[i].libraries);
        edit(rows[i].holds ? 6 : 8, &results[RG_SIDE_B]);
        if (!rows[i].holds)
            snprintf(results[RG_SIDE_B].picture, RG_DIGEST_SIZE, SHA_B);
        does_hold = rows[i].holds;
        does_open = rows[i].opens;
        is_blamed = false;
        if (*rows[i].said)
            snprintf(due, sizeof(due), "%s%s", begins, rows[i].said);
        agree(RG_FAIL, rows[i].holds ? "a frame has 7 and 8 items" : "another picture");
        assert_string_equal(of.agreement.details, due);
    }
}

static void an_ending_is_held_against_that_of_the_baseline(void **state)
{
    (void)state;
    static const struct {
        enum rg_outcome before, now, outcome;
        const char *said;
    } rows[] = {
        {RG_CRASH, RG_CRASH, RG_CRASH, "it fell, as in the baseline"},
        {RG_OK, RG_CRASH, RG_CRASH, "it fell"},
        {RG_CRASH, RG_TIMEOUT, RG_TIMEOUT, "it fell"},
        {RG_OK, RG_UNSUPPORTED, RG_FAIL, "it ran when the baseline was made: it fell"},
        {RG_FAIL, RG_UNSUPPORTED, RG_FAIL, "it ran when the baseline was made: it fell"},
        {RG_CRASH, RG_UNSUPPORTED, RG_UNSUPPORTED, "it fell"},
        {RG_UNSUPPORTED, RG_UNSUPPORTED, RG_UNSUPPORTED, "it fell, as in the baseline"},
        {RG_CRASH, RG_OK, RG_OK,
         "the baseline has it as crash, and no states, counters or times to hold it against; "
         "`raingauge baseline --update` has it anew"},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_baseline_row before = {.outcome = rows[i].before, .picture = SHA_A};
        begin(&before);
        results[RG_SIDE_B].outcome = rows[i].now;
        snprintf(results[RG_SIDE_B].why, sizeof(results[RG_SIDE_B].why), "it fell");
        agree(rows[i].outcome, rows[i].said);
        assert_null(of.agreement.device);
        assert_int_equal(of.agreement.code[RG_SIDE_B].libraries, 2);
    }
}

// No driver drew a picture, so that none is blamed for one that differs.
static void a_side_that_does_not_open_fails_the_case(void **state)
{
    (void)state;
    struct rg_baseline_row before = result();
    begin(NULL);
    rg_unsupported("no such device");
    rg_gate_agree_fails(&of, "old");
    assert_int_equal(of.agreement.outcome, RG_UNSUPPORTED);
    assert_string_equal(of.agreement.device, "old");
    assert_false(of.agreement.is_ours);
    begin(&before);
    rg_unsupported("no such device");
    rg_gate_agree_fails(&of, "new");
    assert_int_equal(of.agreement.outcome, RG_FAIL);
    assert_true(of.agreement.is_ours);
    assert_string_equal(of.agreement.message, "it ran when the baseline was made: no such device");
}

// --- advice ---

static struct rg_launches launches(double a, double b, double c)
{
    return (struct rg_launches){3, {a, b, c}};
}

// Twice as slow as in the baseline, by yardsticks that take 1, 2 and 4 times as long; one is
// unknown.
static void advice_tells_the_time_by_each_yardstick(void **state)
{
    (void)state;
    const struct rg_launches then[RG_YARDSTICKS] = {launches(3, 1, 2), launches(1, 1, 9),
                                                    launches(5, 5, 5)};
    const struct rg_launches now[RG_YARDSTICKS] = {launches(2, 2, 9), launches(2, 2, 2),
                                                   launches(20, 1, 30), launches(1, 1, 1)};
    struct rg_gate_row row = {.a_ms = {.median = 4}, .b_ms = {.median = 8.25}};
    struct rg_timed_cell timed = {.outcome = RG_OK};
    struct rg_agreement agreement = {.message = "a remark"};
    row.decision.units = 8;
    row.decision.ratio = 2;
    rg_gate_advise(&row, &timed, then, now, &agreement);
    assert_string_equal(agreement.details, "chain takes 1.00 times as long: 2.00 by it\n"
                                           "vector takes 2.00 times as long: 1.00 by it\n"
                                           "copy takes 4.00 times as long: 0.50 by it");
    assert_string_equal(agreement.message,
                        "a remark; advisory, for its key is another: a frame takes 2.00 times as "
                        "long (8.25 ms, 4 ms in the baseline), and 0.50 to 2.00 times by the "
                        "yardsticks");
    row = (struct rg_gate_row){.launches = 40, .disturbed = 33}; // 7 are too few for the first look
    agreement = (struct rg_agreement){.message = ""};
    rg_gate_advise(&row, &timed, then, now, &agreement);
    assert_string_equal(agreement.message,
                        "advisory, and no time counts: of 40 launches 33 were disturbed");
    assert_string_equal(agreement.details, "");
    row.launches = 0;
    agreement = (struct rg_agreement){.message = ""};
    rg_gate_advise(&row, &timed, then, now, &agreement);
    assert_string_equal(agreement.message, "advisory: no time was taken");
    assert_string_equal(agreement.details, "");
    timed = (struct rg_timed_cell){.outcome = RG_CRASH, .is_ours = true, .why = "it fell"};
    rg_gate_advise(&row, &timed, then, now, &agreement);
    assert_string_equal(agreement.message, "it fell");
    assert_int_equal(agreement.outcome, RG_CRASH);
    assert_true(agreement.is_ours);
}

int main(void)
{
    rg_log_listen(log_last, NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sides_that_are_alike_agree_and_have_code),
        cmocka_unit_test(a_side_that_fails_ends_the_case_under_its_name),
        cmocka_unit_test(a_difference_of_pictures_is_blamed_on_a_stage),
        cmocka_unit_test(states_counters_and_work_must_be_the_same),
        cmocka_unit_test(a_picture_as_in_the_baseline_is_right_if_it_was),
        cmocka_unit_test(what_differs_from_the_baseline_is_named),
        cmocka_unit_test(what_all_devices_do_otherwise_is_not_blamed_on_one),
        cmocka_unit_test(an_ending_is_held_against_that_of_the_baseline),
        cmocka_unit_test(a_side_that_does_not_open_fails_the_case),
        cmocka_unit_test(advice_tells_the_time_by_each_yardstick),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
