// What a gate's case tells of all that was found about it: ending, message, details, measures.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/compare/gate/run/cases.h"
#include "harness/devices/names.h"
#include "tests/harness/gate/cells/read.h"
#include "tests/tools/expect.h"

#define CELL  "rain/one"
#define DAYS  "\n  reason r\n  since 2026-01-01\n  until 2026-12-31\n"
#define SAME  0x1234567800000000u
#define OTHER 0x9abcdef000000000u

static const char text_of_cells[] = CELL " raster 64x48 3 seed=7  billboards=5\n";
static struct rg_known known;
static struct rg_report report; // of the case that was told last
static struct rg_gate_request request = {.known = &known, .pictures = "out", .today = 20500};

static int set_up(void **state)
{
    (void)state;
    return read_cells(text_of_cells);
}

// A case whose sides agree; the caller says what else was found.
static struct rg_gate_case made(const char *a, const char *b)
{
    return (struct rg_gate_case){.cell = cells.cells,
                                 .name = "rain/one.b",
                                 .devices = {a, b},
                                 .device_count = 2,
                                 .expectation = -1,
                                 .agreement = {.outcome = RG_OK, .pixels = NAN, .difference = NAN}};
}

struct told {
    struct rg_report_case report;
    struct rg_known_result result;
};

static struct told tell(struct rg_gate_case *c)
{
    struct told told;
    rg_report_free(&report);
    assert_true(rg_gate_case_tell(c, &request, &report, &told.result));
    told.report = report.cases[0];
    assert_non_null(told.report.details);
    return told;
}

// --- endings ---

static void a_case_ends_as_its_times_do_if_its_sides_agree(void **state)
{
    (void)state;
    static const struct {
        enum rg_outcome agreed, timed;
        bool is_timed, was_over, times_are_over;
        int units;
        enum rg_verdict_of_two verdict;
        enum rg_ending ending;
        enum rg_outcome result;
    } rows[] = {
        {RG_OK, RG_OK, true, false, false, 16, RG_TWO_PASS, RG_ENDING_PASS, RG_OK},
        {RG_OK, RG_OK, true, false, false, 16, RG_TWO_REGRESSED, RG_ENDING_REGRESSED, RG_OK},
        {RG_OK, RG_OK, true, false, false, 16, RG_TWO_IMPROVED, RG_ENDING_IMPROVED, RG_OK},
        {RG_OK, RG_OK, true, false, false, 16, RG_TWO_INCONCLUSIVE, RG_ENDING_INCONCLUSIVE, RG_OK},
        {RG_OK, RG_OK, true, false, false, 0, RG_TWO_INCONCLUSIVE, RG_ENDING_NOTHING_MEASURED,
         RG_OK},
        {RG_OK, RG_OK, true, false, true, 0, RG_TWO_INCONCLUSIVE, RG_ENDING_INCONCLUSIVE, RG_OK},
        {RG_OK, RG_CRASH, true, false, false, 16, RG_TWO_PASS, RG_ENDING_CRASH, RG_CRASH},
        {RG_OK, RG_TIMEOUT, true, false, true, 0, RG_TWO_PASS, RG_ENDING_TIMEOUT, RG_TIMEOUT},
        {RG_OK, RG_CRASH, false, false, false, 16, RG_TWO_REGRESSED, RG_ENDING_PASS, RG_OK},
        {RG_FAIL, RG_CRASH, true, false, false, 16, RG_TWO_PASS, RG_ENDING_DIFFERS, RG_FAIL},
        {RG_NOTHING, RG_OK, false, false, false, 0, RG_TWO_PASS, RG_ENDING_NOTHING_MEASURED,
         RG_NOTHING},
        {RG_UNSUPPORTED, RG_OK, false, true, false, 0, RG_TWO_PASS, RG_ENDING_INCONCLUSIVE,
         RG_UNSUPPORTED},
        {RG_UNSUPPORTED, RG_OK, false, false, false, 0, RG_TWO_PASS, RG_ENDING_UNSUPPORTED,
         RG_UNSUPPORTED},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_gate_case c = made("a", "b");
        c.agreement.outcome = rows[i].agreed;
        c.is_timed = rows[i].is_timed;
        c.is_over = rows[i].was_over;
        c.times.outcome = rows[i].timed;
        c.times.is_over = rows[i].times_are_over;
        c.row.decision.units = rows[i].units;
        c.row.decision.verdict = rows[i].verdict;
        const struct told told = tell(&c);
        if (told.report.ending != rows[i].ending || told.result.outcome != rows[i].result)
            fail_msg("row %zu: %s, %s", i, rg_ending_name(told.report.ending),
                     rg_outcome_name(told.result.outcome));
        assert_int_equal(told.report.is_over, rows[i].was_over);
    }
}

static void only_what_ran_on_both_sides_was_compared(void **state)
{
    (void)state;
    for (int outcome = 0; outcome < RG_OUTCOME_COUNT; outcome++)
        for (int compared = 0; compared < 2; compared++) {
            struct rg_gate_case c = made("a", "b");
            c.agreement.outcome = (enum rg_outcome)outcome;
            c.is_compared = compared;
            const bool counts = compared && (outcome == RG_OK || outcome == RG_FAIL);
            assert_int_equal(rg_gate_case_was_compared(&c), counts);
            assert_int_equal(tell(&c).report.is_compared, counts);
        }
}

// A failure of the other side, of the truth or of raingauge is none of B's driver.
static void a_failure_is_of_the_side_that_failed(void **state)
{
    (void)state;
    static const char *const twice[] = {"gl", "gl"};
    static char other[] = "gl";
    static const struct rg_baseline_row before;
    const struct {
        const char *device;
        bool is_ours, has_baseline, is_timed, is_foreign;
        int side;
    } rows[] = {
        {NULL, false, false, false, false, 0},       {NULL, true, false, false, true, 0},
        {"cpu", false, false, false, true, 0},       {twice[1], false, false, false, false, 0},
        {other, false, false, false, true, 0}, // A may have the same name
        {other, false, true, false, false, 0},       {"cpu:reference", false, true, false, true, 0},
        {"gl", true, true, false, true, 0},          {NULL, false, false, true, false, RG_SIDE_B},
        {NULL, false, false, true, true, RG_SIDE_A},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_gate_case c = made("cpu", twice[1]);
        c.before = rows[i].has_baseline ? &before : NULL;
        c.agreement.device = rows[i].device;
        c.agreement.is_ours = rows[i].is_ours;
        c.agreement.outcome = rows[i].is_timed ? RG_OK : RG_CRASH;
        c.is_timed = rows[i].is_timed;
        c.times.outcome = RG_CRASH;
        c.times.side = rows[i].side;
        if (tell(&c).result.is_foreign != rows[i].is_foreign)
            fail_msg("row %zu", i);
    }
}

// --- messages ---

static void what_stays_open_says_why(void **state)
{
    (void)state;
    static const char coarse[] = "; the clock is too coarse for so short a time";
    static const struct {
        enum rg_course_end end;
        bool is_over;
        const char *said;
    } rows[] = {
        {RG_END_LOOKS, true, "the time was over before it was decided"},
        {RG_END_LOOKS, false, "the interval allows both after the last launch that was planned"},
        {RG_END_DISTURBED, false, "the machine gave its time to others in most launches"},
        {RG_END_UNCONFIRMED, false, "it was found once, and not when it was measured again"},
        {RG_END_OVER, false, "nothing more could be measured"},
    };
    for (size_t i = 0; i < 2 * sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_gate_case c = made("a", "b");
        char due[256];
        c.is_timed = true;
        c.row.end = rows[i / 2].end;
        c.times.is_over = rows[i / 2].is_over;
        c.row.decision.units = 16;
        c.row.decision.is_coarse = i % 2;
        snprintf(due, sizeof(due), "%s%s", rows[i / 2].said, i % 2 ? coarse : "");
        assert_string_equal(tell(&c).report.message, due);
    }
}

static void a_change_is_told_with_its_interval_and_both_times(void **state)
{
    (void)state;
    static const struct rg_baseline_row before;
    static const struct {
        double ratio, low, high, a_ms, b_ms;
        bool has_baseline;
        const char *said;
    } rows[] = {
        {1.1, 1.08, 1.13, 4, 4.4, false, "10.0 % longer (8.0 to 13.0 %): A 4.00 ms, B 4.40 ms"},
        {0.9, 0.85, 0.98, 3.734, 12.34, false, "10.0 % less (2.0 to 15.0 %): A 3.73 ms, B 12.3 ms"},
        {1.25, 0.99, 1.5, 99.96, 123.4, true,
         "25.0 % longer (-1.0 to 50.0 %): baseline 100 ms, now 123 ms"},
        {0.5, 0.25, 1.02, 0.04561, 9.996, true,
         "50.0 % less (-2.0 to 75.0 %): baseline 0.0456 ms, now 10.0 ms"},
        {1.5, 1.25, 2, 0, 99.94, false, "50.0 % longer (25.0 to 100.0 %): A 0 ms, B 99.9 ms"},
        {1.5, 1.25, 2, 823, 1234.5, false, "50.0 % longer (25.0 to 100.0 %): A 823 ms, B 1234 ms"},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_gate_case c = made("a", "b");
        char due[256];
        c.before = rows[i].has_baseline ? &before : NULL;
        c.is_timed = true;
        c.row.a_ms.median = rows[i].a_ms;
        c.row.b_ms.median = rows[i].b_ms;
        c.row.decision = (struct rg_gate_decision){.verdict = rows[i].ratio > 1 ? RG_TWO_REGRESSED
                                                                                : RG_TWO_IMPROVED,
                                                   .ratio = rows[i].ratio,
                                                   .low = rows[i].low,
                                                   .high = rows[i].high,
                                                   .units = 16};
        snprintf(due, sizeof(due), "a frame takes %s", rows[i].said);
        assert_string_equal(tell(&c).report.message, due);
    }
}

static void a_message_has_the_side_the_remark_and_the_times(void **state)
{
    (void)state;
    static const struct {
        const char *device, *remark, *times; // times: why they broke off
        enum rg_outcome outcome;
        const char *said;
    } rows[] = {
        {NULL, "", "", RG_OK, ""},
        {NULL, "a remark", "", RG_OK, "a remark"},
        {"cpu", "it fell", "", RG_CRASH, "cpu: it fell"},
        {NULL, "", "it hung", RG_OK, "it hung"},
        {NULL, "a remark", "it hung", RG_OK, "a remark; it hung"},
        {NULL, "it differs", "it hung", RG_FAIL, "it differs"},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_gate_case c = made("cpu", "b");
        c.agreement.device = rows[i].device;
        c.agreement.outcome = rows[i].outcome;
        snprintf(c.agreement.message, sizeof(c.agreement.message), "%s", rows[i].remark);
        c.is_timed = *rows[i].times;
        c.times.outcome = RG_TIMEOUT;
        c.row.decision.units = 16;
        c.row.decision.verdict = RG_TWO_REGRESSED;
        snprintf(c.times.why, sizeof(c.times.why), "%s", rows[i].times);
        assert_string_equal(tell(&c).report.message, rows[i].said);
    }
}

// --- expectations ---

// The driver that the device tells once it is open decides which expectation holds.
static void a_case_is_expected_by_its_own_driver(void **state)
{
    (void)state;
    static const char text[] = "fail *\n  driver Mesa 22\n  outcome fail" DAYS
                               "skip *\n  driver Mesa 25" DAYS "fail *\n  outcome crash" DAYS;
    static const struct {
        const char *driver; // NULL: the device is not open
        int64_t row;
        bool is_skipped;
        const char *word;
    } rows[] = {{"Mesa 22", 0, false, "expected: it differs"},
                {"Mesa 25", 1, true, "skipped: it differs"},
                {"Mesa 9", 2, false, "fails differently: it differs"},
                {NULL, 2, false, "fails differently: it differs"}};
    assert_true(rg_known_add_text(&known, "known", text, strlen(text), RG_FORM_OWN));
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_device device = {.backend = NULL};
        struct rg_side a = {.name = "cpu"}, b = {.device = rows[i].driver ? &device : NULL};
        struct rg_gate_case c = made("cpu", "b");
        c.sides[RG_SIDE_A] = &a;
        c.sides[RG_SIDE_B] = &b;
        c.agreement.outcome = RG_FAIL;
        snprintf(c.agreement.message, sizeof(c.agreement.message), "it differs");
        snprintf(device.info.driver, sizeof(device.info.driver), "%s",
                 rows[i].driver ? rows[i].driver : "");
        rg_gate_case_expect(&c, &request);
        assert_int_equal(c.expectation, rows[i].row);
        assert_int_equal(c.is_skipped, rows[i].is_skipped);
        const struct told told = tell(&c);
        assert_string_equal(told.report.message, rows[i].word);
        assert_string_equal(told.result.driver, rows[i].driver ? rows[i].driver : "");
    }
    rg_known_free(&known);
}

// --- details ---

static void details_tell_what_a_change_would_have_taken(void **state)
{
    (void)state;
    for (int apart = 0; apart < 2; apart++)
        for (int grouped = 0; grouped < 2; grouped++) {
            struct rg_gate_case c = made("a", "b");
            char due[512];
            c.is_timed = true;
            c.rule = apart ? rg_gate_rule_apart(3) : rg_gate_rule_of(3);
            c.row.launches = 17;
            c.row.disturbed = 1;
            snprintf(c.agreement.details, sizeof(c.agreement.details), "not these");
            c.row.decision = (struct rg_gate_decision){.units = 16,
                                                       .spread = log1p(0.23),
                                                       .shift = 1.01234,
                                                       .smallest = 0.04,
                                                       .error = 0.012,
                                                       .ratio = 1.01,
                                                       .low = 1,
                                                       .high = 1.02,
                                                       .is_grouped = grouped};
            const int least = apart ? 10 : 2, middle = apart ? 15 : 3, most = apart ? 20 : 5;
            snprintf(due, sizeof(due),
                     "17 launches%s, 1 disturbed; a launch scatters by 23.0 %%; shift 1.0123\na "
                     "change would be found: %d %% with %.0f %%, %d %% with %.0f %%, %d %% with "
                     "%.0f %%",
                     grouped ? ", counted in groups, for they follow each other" : "", least,
                     100 * rg_gate_power(&c.rule, &c.row.decision, least / 100.0), middle,
                     100 * rg_gate_power(&c.rule, &c.row.decision, middle / 100.0), most,
                     100 * rg_gate_power(&c.rule, &c.row.decision, most / 100.0));
            assert_string_equal(tell(&c).report.details, due);
            c.row.decision.units = 0; // nothing was measured
            assert_string_equal(tell(&c).report.details, "not these");
        }
}

// Advice is given only where equal code was found slower or faster.
static void details_tell_which_code_ran(void **state)
{
    (void)state;
#define PASSES "; compiled passes 12345678 and "
    static const struct {
        const char *program;
        uint64_t libraries, passes;
        int64_t bytes;
        enum rg_verdict_of_two verdict;
        const char *said;
    } rows[] = {
        {"x", 1, SAME, 0, RG_TWO_PASS,
         "the same program, the same libraries; the API hands out no compiled passes"},
        {"y", 1, SAME, 0, RG_TWO_REGRESSED,
         "another program, the same libraries; the API hands out no compiled passes"},
        {"x", 2, SAME, 70, RG_TWO_REGRESSED,
         "the same program, other libraries" PASSES "12345678, 70 bytes"},
        {"x", 1, OTHER, 70, RG_TWO_IMPROVED,
         "the same program, the same libraries" PASSES "9abcdef0, 70 bytes"},
        {"x", 1, SAME, 70, RG_TWO_IMPROVED,
         "the same program, the same libraries" PASSES
         "12345678, 70 bytes: it is the same code, so look at threads, clocks and memory"},
        {"x", 1, SAME, 0, RG_TWO_REGRESSED,
         "the same program, the same libraries; the API hands out no compiled passes, so look at "
         "the driver's settings, threads, clocks and memory"},
        {"x", 1, SAME, 70, RG_TWO_PASS,
         "the same program, the same libraries" PASSES "12345678, 70 bytes"},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_gate_case c = made("a", "b");
        struct rg_session_code *a = &c.agreement.code[RG_SIDE_A], *b = &c.agreement.code[RG_SIDE_B];
        *a = (struct rg_session_code){"x", 1, {SAME, 5}};
        *b = (struct rg_session_code){"", rows[i].libraries, {rows[i].passes, rows[i].bytes}};
        snprintf(b->program, sizeof(b->program), "%s", rows[i].program);
        c.agreement.has_code = c.is_timed = true;
        c.rule = rg_gate_rule_of(1);
        c.row.decision.verdict = rows[i].verdict;
        c.row.decision.units = 16;
        const char *details = tell(&c).report.details;
        const char *last = strrchr(details, '\n');
        assert_non_null(last);
        assert_string_equal(last + 1, rows[i].said);
    }
}

// The command names A or the truth first, and a short name with what it stands for.
static void details_tell_how_to_find_what_a_looser_tier_costs(void **state)
{
    (void)state;
    const char *names = "new=vulkan@NOTE=1 2";
    struct rg_device_name name;
    assert_true(rg_device_name_read(&names, &name));
    static const struct {
        const char *truth, *b;
        int would_hold;
        const char *devices; // NULL: no command
    } rows[] = {{"cpu", "gl", RG_T2, "cpu,gl"},
                {"cpu:reference", "new", RG_T1, "'cpu:reference,new=vulkan@NOTE=1 2'"},
                {"cpu", "gl", RG_TIER_COUNT, NULL},
                {NULL, "gl", RG_T1, NULL}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_gate_case c = made("gl:1", rows[i].b);
        char due[512] = "stage rain";
        c.agreement.outcome = RG_FAIL;
        c.agreement.truth = rows[i].truth;
        c.agreement.would_hold = rows[i].would_hold;
        snprintf(c.agreement.details, sizeof(c.agreement.details), "stage rain");
        if (rows[i].devices)
            snprintf(due, sizeof(due),
                     "stage rain\nwhich mutants %s would let live: raingauge diff raster --size "
                     "64x48 --frame 3 --set seed=7 --set billboards=5 --device %s --mutants",
                     rg_tier_name((enum rg_tier)rows[i].would_hold), rows[i].devices);
        assert_string_equal(tell(&c).report.details, due);
    }
}

// --- measures, pictures and names ---

static void measures_are_those_of_b_and_unknown_ends_are_none(void **state)
{
    (void)state;
    for (int known_ends = 0; known_ends < 2; known_ends++) {
        struct rg_gate_case c = made("a", "b");
        c.is_timed = true;
        c.rule = rg_gate_rule_of(1);
        c.row.a_ms = (struct rg_interval){4, 3, 5};
        c.row.b_ms = (struct rg_interval){8, 7, 9};
        c.row.decision = (struct rg_gate_decision){.units = 16,
                                                   .ratio = 2,
                                                   .low = known_ends ? 1.5 : 0,
                                                   .high = known_ends ? 2.5 : INFINITY,
                                                   .smallest = known_ends ? 0.02 : INFINITY};
        const struct rg_report_case told = tell(&c).report;
        assert_equals(told.ratio.value, 2);
        assert_true(known_ends ? told.ratio.low == 1.5 : isnan(told.ratio.low));
        assert_true(known_ends ? told.ratio.high == 2.5 : isnan(told.ratio.high));
        assert_true(known_ends ? told.smallest_visible == 0.02 : isnan(told.smallest_visible));
        assert_true(told.time_ms.value == 8 && told.time_ms.low == 7 && told.time_ms.high == 9);
        assert_equals(told.baseline_ms, 4);
        c.row.decision.units = 0;
        assert_true(isnan(tell(&c).report.ratio.value));
        c.row.decision.units = 16;
        c.is_timed = false;
        assert_true(isnan(tell(&c).report.time_ms.value));
    }
}

static void pictures_that_differ_are_named_in_their_order(void **state)
{
    (void)state;
    static const char *const ends[] = {"-a.png", "-b.png", "-flip.png", "-difference.png"};
    struct rg_gate_case c = made("a", "b");
    c.agreement.outcome = RG_FAIL;
    c.agreement.pixels = 12;
    c.agreement.difference = 0.25;
    assert_int_equal(tell(&c).report.attachment_count, 0);
    c.agreement.has_pictures = true;
    const struct told told = tell(&c);
    assert_int_equal(told.report.attachment_count, 4);
    for (int i = 0; i < 4; i++) {
        const char *path = told.report.attachments[i];
        assert_ptr_equal(strstr(path, "out/rain_one.b"), path);
        assert_string_equal(path + strlen(path) - strlen(ends[i]), ends[i]);
    }
    assert_true(told.result.pixels == 12 && told.result.difference == 0.25);
}

static void a_case_has_the_name_and_the_devices_of_its_sides(void **state)
{
    (void)state;
    struct rg_gate_case c = made("cpu", "gl");
    c.seconds = 1.5;
    struct told told = tell(&c);
    assert_string_equal(told.report.name, "rain/one.b");
    assert_string_equal(told.report.technique, "raster");
    assert_int_equal(told.report.device_count, 2);
    assert_string_equal(told.report.devices[0], "cpu");
    assert_string_equal(told.report.devices[1], "gl");
    assert_equals(told.report.seconds, 1.5);
    assert_string_equal(told.result.cell, CELL);
    assert_string_equal(told.result.device, "gl");
    c.devices[0] = "vulkan"; // with a baseline, B alone
    c.device_count = 1;
    told = tell(&c);
    assert_string_equal(told.result.device, "vulkan");
    char *name = rg_gate_case_name("a/b", "gl@X=\n1");
    assert_string_equal(name, "a/b.gl@X=\xe2\x90\x8a"
                              "1");
    free(name);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_case_ends_as_its_times_do_if_its_sides_agree),
        cmocka_unit_test(only_what_ran_on_both_sides_was_compared),
        cmocka_unit_test(a_failure_is_of_the_side_that_failed),
        cmocka_unit_test(what_stays_open_says_why),
        cmocka_unit_test(a_change_is_told_with_its_interval_and_both_times),
        cmocka_unit_test(a_message_has_the_side_the_remark_and_the_times),
        cmocka_unit_test(a_case_is_expected_by_its_own_driver),
        cmocka_unit_test(details_tell_what_a_change_would_have_taken),
        cmocka_unit_test(details_tell_which_code_ran),
        cmocka_unit_test(details_tell_how_to_find_what_a_looser_tier_costs),
        cmocka_unit_test(measures_are_those_of_b_and_unknown_ends_are_none),
        cmocka_unit_test(pictures_that_differ_are_named_in_their_order),
        cmocka_unit_test(a_case_has_the_name_and_the_devices_of_its_sides),
    };
    return cmocka_run_group_tests(tests, set_up, free_cells);
}
