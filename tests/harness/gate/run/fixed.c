// Cases of a gate for fixed functions, which are compared with a baseline's or another driver's.
// Stand-ins draw them.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "backends/backend.h"
#include "core/base/log.h"
#include "harness/compare/gate/run/running.h"
#include "harness/console/clock.h"
#include "harness/devices/measure/serving/fixed_pairs.h"
#include "shaders/fixed/fixed.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/logged.h"

// --- stand-ins ---

static struct rg_device devices[RG_SIDES];
static json_t *digests[RG_SIDES]; // that a side's device leaves
static enum rg_outcome failed[RG_SIDES];
static const char *falls;        // the device that does not start
static bool is_within[RG_SIDES]; // the bounds of linear
static double now_ms;

double rg_now_ms(void)
{
    return now_ms;
}

static int side_of(const struct rg_device *device)
{
    return device == &devices[RG_SIDE_B];
}

bool rg_side_launch(struct rg_side *side)
{
    if (falls && !strcmp(side->name, falls))
        return rg_crash_error("%s fell", side->name);
    side->device = &devices[!strcmp(side->name, "gl")];
    return true;
}

// A draw without a digest failed on a side that failed, and else left a wrong picture.
void rg_fixed_draw_all(struct rg_device *device, struct rg_fixed_left *left)
{
    const int side = side_of(device);
    now_ms += 750;
    *left = (struct rg_fixed_left){.failed = failed[side], .digests = json_incref(digests[side])};
    for (int i = 0; i < rg_fixed_count(); i++) {
        const char *feature = rg_fixed_draws[i].feature;
        left->is_within[i] = is_within[side] && !strcmp(feature, "linear");
        left->outcomes[i] = json_object_get(digests[side], feature) ? RG_OK
                            : failed[side] != RG_OK                 ? failed[side]
                                                                    : RG_FAIL;
    }
}

// One backend with fixed functions and one without, whatever the build has.
const struct rg_backend *rg_backend_of(const char *name)
{
    static const struct rg_backend cpu = {.name = "cpu"},
                                   vulkan = {.name = "vulkan", .fixed_draw = rg_device_fixed_draw};
    return !strcmp(name, "cpu") ? &cpu : &vulkan;
}

// --- a device that has three functions ---

static struct rg_known known;
static struct rg_baseline baseline;
static const struct rg_gate_pairs pairs = {.count = 1, .all = {{{"old", "gl"}}}};
static struct rg_gate_request request;
static struct rg_gate gate;
static struct rg_running_gate run;
static struct rg_known_result results[RG_FIXED_MAX_DRAWS];

static json_t *left(const char *linear, const char *stencil)
{
    json_t *json = json_pack("{s:s, s:s}", "linear", linear, "nearest", "2222");
    if (stencil)
        json_object_set_new(json, "stencil", json_string(stencil));
    return json;
}

static json_t *parts(const char *device)
{
    return json_pack("{s:s, s:s, s:s, s:s, s:s}", "cpu", "Xeon", "features", "avx2", "variables",
                     "", "driver", "Mesa", "device", device);
}

static void begin(bool has_baseline, json_t *then, json_t *now)
{
    static const char llvmpipe[] = "llvmpipe (LLVM 15.0.6, 256 bits)";
    memset(&run, 0, sizeof(run));
    memset(&gate, 0, sizeof(gate));
    memset(failed, 0, sizeof(failed));
    falls = NULL;
    now_ms = 1000;
    is_within[RG_SIDE_A] = is_within[RG_SIDE_B] = true;
    digests[RG_SIDE_A] = then;
    digests[RG_SIDE_B] = now;
    request = (struct rg_gate_request){.pairs = &pairs, .known = &known, .today = 20500};
    baseline = (struct rg_baseline){.device_count = 1, .devices = {{"gl", parts(llvmpipe)}}};
    baseline.passport =
        json_pack("{s:[{s:s, s:O}]}", "devices", "name", "gl", "fixed_functions", then);
    request.baseline = has_baseline ? &baseline : NULL;
    gate.results = results;
    run.asked = &request;
    run.gate = &gate;
    run.side_count = 2;
    run.sides[RG_SIDE_B].has_fixed = true;
    run.sides[RG_SIDE_B].parts = parts(llvmpipe);
    for (int side = 0; side < RG_SIDES; side++) {
        run.sides[side].name = pairs.all[0].names[side];
        snprintf(run.sides[side].info.name, RG_DEVICE_NAME_SIZE, "%s", run.sides[side].name);
        snprintf(run.sides[side].info.device, sizeof(run.sides[side].info.device), "%s", llvmpipe);
        snprintf(run.sides[side].info.driver, sizeof(run.sides[side].info.driver), "Mesa %d", side);
    }
}

static void end(void)
{
    json_decref(digests[RG_SIDE_A]);
    json_decref(digests[RG_SIDE_B]);
    json_decref(run.sides[RG_SIDE_B].parts);
    rg_baseline_free(&baseline);
    gate.results = NULL;
    rg_gate_free(&gate);
}

static void assert_case(int i, const char *name, enum rg_ending ending, bool compared,
                        const char *message)
{
    assert_at_least(gate.report.case_count, i + 1);
    const struct rg_report_case *c = &gate.report.cases[i];
    assert_string_equal(c->name, name);
    assert_string_equal(c->message, message);
    assert_int_equal(c->ending, ending);
    assert_int_equal(c->is_compared, compared);
    assert_string_equal(c->technique, "fixed");
    assert_true(c->device_count == 1 && !strcmp(c->devices[0], "gl"));
}

// --- a baseline ---

static void digests_of_the_baseline_are_counted(void **state)
{
    (void)state;
    begin(true, left("1111", "3333"), left("1111", "3333"));
    assert_true(rg_gate_hold_fixed(&run));
    assert_int_equal(gate.report.case_count, 1);
    assert_case(0, "fixed.gl", RG_ENDING_PASS, true, "3 digests are the baseline's");
    assert_equals(gate.report.cases[0].seconds, 0.75);
    assert_true(gate.is_told && gate.result_count == 0);
    assert_string_equal(gate.drivers[0], "Mesa 1");
    end();
    begin(true, left("1111", "3333"), left("0000", NULL));
    assert_true(rg_gate_hold_fixed(&run));
    assert_int_equal(gate.report.case_count, 3);
    assert_case(0, "fixed/linear.gl", RG_ENDING_DIFFERS, true,
                "0000 and not 1111, which is the baseline's");
    assert_case(1, "fixed/stencil.gl", RG_ENDING_DIFFERS, true,
                "leaves no digest and not 3333, which is the baseline's");
    assert_case(2, "fixed.gl", RG_ENDING_PASS, true, "1 digest is the baseline's, and 2 are not");
    assert_int_equal(gate.result_count, 2);
    assert_string_equal(results[1].cell, "fixed/stencil");
    assert_string_equal(results[1].device, "gl");
    assert_string_equal(results[1].driver, "Mesa 1");
    assert_true(results[1].outcome == RG_FAIL && isnan(results[1].pixels));
    end();
    begin(true, left("1111", NULL), left("1111", "3333")); // what is new is no difference
    assert_true(rg_gate_hold_fixed(&run));
    assert_case(0, "fixed.gl", RG_ENDING_PASS, true, "2 digests are the baseline's");
    end();
}

// A draw that was not made ends as what kept it from that, and is not compared.
static void digests_that_fail_have_the_failure(void **state)
{
    (void)state;
    static const struct {
        enum rg_outcome failed;
        enum rg_ending ending;
    } rows[] = {{RG_CRASH, RG_ENDING_CRASH},
                {RG_LACKING, RG_ENDING_LACKING},
                {RG_NOTHING, RG_ENDING_NOTHING_MEASURED}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        begin(true, left("1111", "3333"), left("1111", NULL));
        failed[RG_SIDE_B] = rows[i].failed;
        assert_true(rg_gate_hold_fixed(&run));
        assert_int_equal(gate.report.case_count, 2);
        assert_case(0, "fixed/stencil.gl", rows[i].ending, false, "could not be drawn");
        assert_case(1, "fixed.gl", RG_ENDING_PASS, true,
                    "2 digests are the baseline's, 1 could not be drawn");
        assert_int_equal(results[0].outcome, rows[i].failed);
        assert_int_equal(results[0].is_foreign, rows[i].failed == RG_LACKING);
        end();
    }
}

static void expectations_name_them(void **state)
{
    (void)state;
    static const char text[] = "fail fixed/*\n  device gl\n  driver Mesa 1\n  outcome fail\n"
                               "  reason r\n  since 2026-01-01\n  until 2026-12-31\n";
    assert_true(rg_known_add_text(&known, "known", text, strlen(text), RG_FORM_OWN));
    begin(true, left("1111", NULL), left("0000", NULL));
    assert_true(rg_gate_hold_fixed(&run));
    assert_case(0, "fixed/nearest.gl", RG_ENDING_UNEXPECTED_PASS, true, "fixed");
    assert_case(1, "fixed/linear.gl", RG_ENDING_EXPECTED_FAILURE, true,
                "expected: 0000 and not 1111, which is the baseline's");
    assert_true(results[0].outcome == RG_OK && gate.result_count == 2);
    end();
    rg_known_free(&known);
}

static void what_cannot_be_compared_is_skipped_and_says_why(void **state)
{
    (void)state;
    static const struct {
        const char *part, *value;
        enum rg_ending ending;
        const char *why;
    } rows[] = {
        {"cpu", "Epyc", RG_ENDING_SKIPPED, "cpu Xeon and not Epyc"},
        {"features", "sse2", RG_ENDING_SKIPPED, "features avx2 and not sse2"},
        {"variables", "X=1", RG_ENDING_SKIPPED, "variables unknown and not X=1"},
        {"device", "llvmpipe (LLVM 9, 128 bits)", RG_ENDING_SKIPPED,
         "device llvmpipe (LLVM, 256 bits) and not llvmpipe (LLVM, 128 bits)"},
        {"device", "llvmpipe (LLVM 9, 256 bits)", RG_ENDING_PASS, NULL},
        {"driver", "Mesa 9", RG_ENDING_PASS, NULL},
        {NULL, "name", RG_ENDING_UNSUPPORTED, "the device did not open"},
        {NULL, "end", RG_ENDING_INCONCLUSIVE, "the time was over"},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        char due[200] = "3 digests are the baseline's";
        begin(true, left("1111", "3333"), left("1111", "3333"));
        if (rows[i].part)
            json_object_set_new(baseline.devices[0].parts, rows[i].part,
                                json_string(rows[i].value));
        else if (!strcmp(rows[i].value, "name"))
            *run.sides[RG_SIDE_B].info.name = 0;
        else
            run.end_ms = 1000;
        if (rows[i].why)
            snprintf(due, sizeof(due), "3 digests are not compared: %s", rows[i].why);
        assert_true(rg_gate_hold_fixed(&run));
        assert_int_equal(gate.report.case_count, 1);
        assert_case(0, "fixed.gl", rows[i].ending, !rows[i].why, due);
        end();
    }
}

// --- two drivers ---

// A digest may differ where both drivers are within the draw's bounds; others may not.
static void two_drivers_may_differ_as_the_apis_allow(void **state)
{
    (void)state;
    static const struct {
        bool a, b, strict;
        enum rg_ending ending;
        const char *said, *all;
    } rows[] = {
        {true, true, false, RG_ENDING_PASS, "differs from old's, and both are within bounds",
         "2 digests are old's, 1 differs as the APIs allow"},
        {true, true, true, RG_ENDING_DIFFERS, "differs from old's, and both are within bounds",
         "2 digests are old's, 1 differs as the APIs allow"},
        {false, true, false, RG_ENDING_DIFFERS, "0000 and not 1111, which is old's",
         "2 digests are old's, and 1 is not"},
        {true, false, false, RG_ENDING_DIFFERS, "0000 and not 1111, which is old's",
         "2 digests are old's, and 1 is not"},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        begin(false, left("1111", "3333"), left("0000", "3333"));
        is_within[RG_SIDE_A] = rows[i].a;
        is_within[RG_SIDE_B] = rows[i].b;
        request.strict = rows[i].strict;
        assert_true(rg_gate_hold_fixed(&run));
        assert_int_equal(gate.report.case_count, 2);
        assert_case(0, "fixed/linear.gl", rows[i].ending, true, rows[i].said);
        assert_case(1, "fixed.gl", RG_ENDING_PASS, true, rows[i].all);
        assert_equals(gate.report.cases[1].seconds, 1.5);
        end();
    }
    begin(false, left("1111", "3333"), left("1111", "4444")); // no bound is known of this one
    assert_true(rg_gate_hold_fixed(&run));
    assert_case(0, "fixed/stencil.gl", RG_ENDING_DIFFERS, true,
                "4444 and not 3333, which is old's");
    end();
}

// A baseline says which of its pictures were within bounds; those of older ones do not.
static void a_baselines_digest_may_differ_as_the_apis_allow(void **state)
{
    (void)state;
    static const struct {
        const char *was; // within its bounds then; NULL: the baseline does not say
        bool is, strict;
        enum rg_ending ending;
    } rows[] = {
        {"linear", true, false, RG_ENDING_PASS},     {"linear", true, true, RG_ENDING_DIFFERS},
        {"linear", false, false, RG_ENDING_DIFFERS}, {"nearest", true, false, RG_ENDING_DIFFERS},
        {NULL, true, false, RG_ENDING_DIFFERS},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        const bool allowed = i < 2;
        begin(true, left("1111", "3333"), left("0000", "3333"));
        is_within[RG_SIDE_B] = rows[i].is;
        request.strict = rows[i].strict;
        if (rows[i].was)
            json_object_set_new(json_array_get(json_object_get(baseline.passport, "devices"), 0),
                                "within_bounds", json_pack("[i, s]", 7, rows[i].was));
        assert_true(rg_gate_hold_fixed(&run));
        assert_int_equal(gate.report.case_count, 2);
        assert_case(0, "fixed/linear.gl", rows[i].ending, true,
                    allowed ? "differs from the baseline's, and both are within bounds"
                            : "0000 and not 1111, which is the baseline's");
        assert_case(1, "fixed.gl", RG_ENDING_PASS, true,
                    allowed ? "2 digests are the baseline's, 1 differs as the APIs allow"
                            : "2 digests are the baseline's, and 1 is not");
        end();
    }
}

static void two_drivers_that_leave_nothing_to_compare_say_so(void **state)
{
    (void)state;
    char due[200];
    for (int i = 0; i < 6; i++) {
        begin(false, left("1111", NULL), left("1111", NULL));
        enum rg_ending ending = RG_ENDING_CRASH;
        const char *why = NULL, *message = i ? "gl fell" : "old fell";
        if (i < 2) {
            falls = i ? "gl" : "old";
        } else if (i == 2) {
            failed[RG_SIDE_A] = RG_TIMEOUT;
            ending = RG_ENDING_TIMEOUT;
            why = "A could not draw them";
        } else if (i == 3) {
            json_object_clear(digests[RG_SIDE_A]);
            ending = RG_ENDING_UNSUPPORTED;
            why = "A draws none of them";
        } else if (i == 4) {
            *run.sides[RG_SIDE_A].info.name = 0;
            ending = RG_ENDING_UNSUPPORTED;
            why = "the device did not open";
        } else {
            snprintf(run.sides[RG_SIDE_A].info.device, sizeof(run.sides[0].info.device),
                     "llvmpipe");
            ending = RG_ENDING_SKIPPED;
            why = "device llvmpipe (LLVM, 256 bits) and not llvmpipe";
        }
        snprintf(due, sizeof(due), "%d digests are not compared: %s", rg_fixed_count(),
                 why ? why : "");
        assert_true(rg_gate_hold_fixed(&run));
        assert_int_equal(gate.report.case_count, 1);
        assert_case(0, "fixed.gl", ending, false, why ? due : message);
        end();
    }
}

static void what_the_shard_does_not_have_is_not_drawn(void **state)
{
    (void)state;
    begin(true, left("1111", NULL), left("0000", NULL));
    run.sides[RG_SIDE_B].has_fixed = false;
    assert_true(rg_gate_hold_fixed(&run));
    assert_true(gate.is_told && !gate.report.case_count);
    end();
}

static void a_pair_has_a_case_of_them_if_the_baseline_has_digests(void **state)
{
    (void)state;
    begin(true, left("1111", NULL), left("1111", NULL));
    assert_true(rg_gate_has_fixed(&baseline, &pairs.all[0]));
    const struct rg_gate_pair other = {{"", "old"}};
    assert_false(rg_gate_has_fixed(&baseline, &other));
    static const struct {
        struct rg_gate_pair pair;
        bool has;
    } rows[] = {
        {{{"vulkan", "vulkan@VK_DRIVER_FILES=new.json"}}, true},
        {{{"vulkan", "vulkan@NOTE=1"}}, false},
        {{{"cpu", "cpu@LD_LIBRARY_PATH=/new"}}, false},
        {{{"gl", "vulkan@VK_DRIVER_FILES=new.json"}}, false},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
        assert_int_equal(rg_gate_has_fixed(NULL, &rows[i].pair), rows[i].has);
    end();
}

int main(void)
{
    rg_log_listen(log_last, NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(digests_of_the_baseline_are_counted),
        cmocka_unit_test(digests_that_fail_have_the_failure),
        cmocka_unit_test(expectations_name_them),
        cmocka_unit_test(what_cannot_be_compared_is_skipped_and_says_why),
        cmocka_unit_test(two_drivers_may_differ_as_the_apis_allow),
        cmocka_unit_test(a_baselines_digest_may_differ_as_the_apis_allow),
        cmocka_unit_test(two_drivers_that_leave_nothing_to_compare_say_so),
        cmocka_unit_test(what_the_shard_does_not_have_is_not_drawn),
        cmocka_unit_test(a_pair_has_a_case_of_them_if_the_baseline_has_digests),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
