// The exit status of a gate, the devices that it requires, and the results that files of
// expectations are held against.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/compare/gate/run/gate.h"
#include "harness/console/exit.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/logged.h"

static void add(struct rg_report *report, const char *device, enum rg_ending ending, bool compared)
{
    assert_true(rg_report_add(report, &(struct rg_report_case){.name = device,
                                                               .devices = &device,
                                                               .device_count = 1,
                                                               .ending = ending,
                                                               .is_compared = compared,
                                                               RG_UNMEASURED}));
}

// --- the exit status ---

enum { NONE = -1 };

// Up to three endings; of expected failures and flakes, whether pictures were compared.
static void a_gate_ends_as_its_worst_case_if_any_was_compared(void **state)
{
    (void)state;
    static const struct {
        int endings[3];
        bool compared;
        int exit;
    } rows[] = {
        {{RG_ENDING_PASS, NONE}, true, RG_EXIT_PASS},
        {{RG_ENDING_IMPROVED, NONE}, true, RG_EXIT_PASS},
        {{RG_ENDING_PASS, RG_ENDING_REGRESSED, RG_ENDING_LACKING}, true, RG_EXIT_FAIL},
        {{RG_ENDING_LACKING, RG_ENDING_INCONCLUSIVE, RG_ENDING_PASS}, true, RG_EXIT_HARNESS},
        {{RG_ENDING_INCONCLUSIVE, RG_ENDING_NOTHING_MEASURED, NONE}, true, RG_EXIT_INCONCLUSIVE},
        {{RG_ENDING_PASS, RG_ENDING_NOTHING_MEASURED, NONE}, true, RG_EXIT_NOTHING},
        {{RG_ENDING_SETUP, NONE}, false, RG_EXIT_FAIL},
        {{RG_ENDING_UNEXPECTED_PASS, RG_ENDING_PASS, NONE}, true, RG_EXIT_FAIL},
        {{RG_ENDING_UNSUPPORTED, RG_ENDING_PASS, NONE}, true, RG_EXIT_PASS},
        {{RG_ENDING_UNSUPPORTED, RG_ENDING_SKIPPED, NONE}, true, RG_EXIT_UNSUPPORTED},
        {{RG_ENDING_UNSUPPORTED, RG_ENDING_FLAKE, NONE}, true, RG_EXIT_PASS},
        {{RG_ENDING_UNSUPPORTED, RG_ENDING_FLAKE, NONE}, false, RG_EXIT_UNSUPPORTED},
        {{RG_ENDING_SKIPPED, RG_ENDING_SKIPPED, NONE}, true, RG_EXIT_NOTHING},
        {{RG_ENDING_SKIPPED, RG_ENDING_PASS, NONE}, true, RG_EXIT_PASS},
        {{RG_ENDING_EXPECTED_FAILURE, RG_ENDING_FLAKE, NONE}, false, RG_EXIT_NOTHING},
        {{RG_ENDING_EXPECTED_FAILURE, NONE}, true, RG_EXIT_PASS},
        {{NONE}, true, RG_EXIT_NOTHING},
    };
    const struct rg_gate_request whole = {.shard = {1, 1}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_gate gate = {.case_count = 0};
        for (int k = 0; k < 3 && rows[i].endings[k] != NONE; k++)
            add(&gate.report, "cpu", (enum rg_ending)rows[i].endings[k], rows[i].compared);
        logged_lines = 0;
        if (rg_gate_exit(&whole, &gate) != rows[i].exit)
            fail_msg("row %zu: %d", i, rg_gate_exit(&whole, &gate));
        assert_int_equal(logged_lines,
                         rows[i].exit == RG_EXIT_NOTHING &&
                             !rg_report_count(&gate.report, RG_ENDING_NOTHING_MEASURED));
        rg_gate_free(&gate);
    }
}

static void a_gate_of_nothing_says_why(void **state)
{
    (void)state;
    const struct rg_gate_request request = {.shard = {5, 6}};
    struct rg_gate gate = {.chosen = 4};
    assert_int_equal(rg_gate_exit(&request, &gate), RG_EXIT_NOTHING);
    assert_string_equal(logged, "gate: shard 5 of 6 has none of 4 cases; make it 4 shards at most");
    gate.chosen = 0;
    assert_int_equal(rg_gate_exit(&request, &gate), RG_EXIT_NOTHING);
    assert_string_equal(
        logged, "gate: no case has a name of --gtest_filter; --gtest_list_tests prints names");
    add(&gate.report, "cpu", RG_ENDING_SKIPPED, false);
    add(&gate.report, "gl", RG_ENDING_SKIPPED, false);
    assert_int_equal(rg_gate_exit(&request, &gate), RG_EXIT_NOTHING);
    assert_string_equal(
        logged, "gate: none of 2 cases was compared to its end; mend what their lines name");
    rg_gate_free(&gate);
}

// --- required devices ---

static void a_required_device_fails_if_none_of_its_cells_was_compared(void **state)
{
    (void)state;
    static const struct {
        enum rg_ending ending;
        bool compared, over;
        const char *require, *added; // NULL: no case is added
    } rows[] = {
        {RG_ENDING_PASS, true, false, "gl", NULL},
        {RG_ENDING_SKIPPED, false, false, "gl", "required.gl"},
        {RG_ENDING_SKIPPED, false, false, "gl@X=1", "required.gl@X=1"},
        {RG_ENDING_SKIPPED, false, false, "cpu,gl", "required.gl"},
        {RG_ENDING_SKIPPED, false, false, "vulkan", NULL}, // it has no cells, which is told before
        {RG_ENDING_FLAKE, false, false, "gl", "required.gl"},
        {RG_ENDING_FLAKE, true, false, "gl", NULL},
        {RG_ENDING_INCONCLUSIVE, false, true, "gl", NULL},
        {RG_ENDING_INCONCLUSIVE, false, false, "gl", "required.gl"},
        {RG_ENDING_CRASH, false, false, "gl", NULL}, // it fails as it is
        {RG_ENDING_UNSUPPORTED, false, false, "gl", NULL},
        {RG_ENDING_SKIPPED, false, false, "", NULL},
        {RG_ENDING_SKIPPED, false, false, NULL, NULL},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        const char *const devices[] = {"cpu", "gl@X=1"};
        struct rg_report report = {.case_count = 0};
        assert_true(rg_report_add(&report, &(struct rg_report_case){.name = "one",
                                                                    .devices = devices,
                                                                    .device_count = 2,
                                                                    .ending = rows[i].ending,
                                                                    .is_compared = rows[i].compared,
                                                                    .is_over = rows[i].over,
                                                                    RG_UNMEASURED}));
        add(&report, "cpu", RG_ENDING_PASS, true);
        assert_true(rg_gate_hold_required(rows[i].require, &report));
        if (report.case_count != 2 + (rows[i].added != NULL))
            fail_msg("row %zu: %d cases", i, report.case_count);
        if (rows[i].added) {
            assert_string_equal(report.cases[2].name, rows[i].added);
            assert_int_equal(report.cases[2].ending, RG_ENDING_ERROR);
            assert_non_null(strstr(report.cases[2].message, ": none of its cells was compared"));
            assert_string_equal(report.cases[2].message, logged);
        }
        rg_report_free(&report);
    }
    struct rg_report report = {.case_count = 0};
    assert_false(rg_gate_hold_required("gl,", &report));
    rg_report_free(&report);
}

// --- results ---

static const char text_of_cells[] = "one raster 16x16 1\ntwo raster 16x16 1\n";

// A case on gl whose pictures differ.
static struct rg_gate_case made(const struct rg_gate_cell *cell)
{
    struct rg_gate_case c = {.cell = cell,
                             .name = strdup(cell->name),
                             .devices = {"gl"},
                             .device_count = 1,
                             .driver = "Mesa",
                             .expectation = -1,
                             .is_compared = true,
                             .agreement = {.outcome = RG_FAIL, .pixels = 7, .difference = 0.5}};
    return c;
}

// First the cells of devices that are left out, cell by cell; then the cases, of which nothing is
// known where their own driver did nothing.
static void nothing_is_known_of_what_did_not_run(void **state)
{
    (void)state;
    struct rg_known known = {.count = 0};
    struct rg_gate_cells cells;
    const struct rg_gate_pairs pairs = {.count = 1};
    assert_true(rg_gate_cells_of("cells", text_of_cells, strlen(text_of_cells), &cells));
    const struct rg_gate_request request = {.cells = &cells,
                                            .pairs = &pairs,
                                            .known = &known,
                                            .left = {2, {"vulkan", "opencl"}},
                                            .shard = {1, 1}};
    struct rg_gate gate = {.case_count = 4, .cases = calloc(4, sizeof(*gate.cases))};
    assert_non_null(gate.cases);
    for (int i = 0; i < 4; i++)
        gate.cases[i] = made(&cells.cells[i % 2]);
    gate.cases[1].is_compared = false;
    gate.cases[1].agreement.is_ours = true;
    gate.cases[2].is_compared = false;
    gate.cases[2].is_skipped = true;
    gate.cases[2].agreement.outcome = RG_UNSUPPORTED;
    gate.cases[3].is_compared = false;
    gate.cases[3].agreement.outcome = RG_UNSUPPORTED;
    assert_true(rg_gate_report(&request, &gate));
    assert_int_equal(gate.result_count, 8);
    assert_true(gate.is_told && gate.told_count == 4 && gate.report.case_count == 4);
    for (int i = 0; i < 4; i++) {
        const struct rg_known_result *left = &gate.results[i], *own = &gate.results[4 + i];
        assert_string_equal(left->cell, i < 2 ? "one" : "two");
        assert_string_equal(left->device, i % 2 ? "opencl" : "vulkan");
        assert_true(!left->driver && left->outcome == RG_UNSUPPORTED && isnan(left->pixels));
        assert_string_equal(own->cell, i % 2 ? "two" : "one");
        assert_string_equal(own->device, "gl");
        assert_int_equal(own->driver != NULL, i == 0 || i == 2);
        assert_int_equal(own->outcome, i ? RG_UNSUPPORTED : RG_FAIL);
    }
    assert_true(gate.results[4].pixels == 7 && gate.results[4].difference == 0.5);
    rg_gate_free(&gate);
    rg_gate_cells_free(&cells);
}

// Another shard may have compared a device that this one did not. A shard of googletest is a gate
// of its own.
static void a_shard_leaves_required_devices_to_all_together(void **state)
{
    (void)state;
    struct rg_known known = {.count = 0};
    struct rg_gate_cells cells;
    const struct rg_gate_pairs pairs = {.count = 1};
    assert_true(rg_gate_cells_of("cells", text_of_cells, strlen(text_of_cells), &cells));
    for (int i = 0; i < 4; i++) {
        const struct rg_gate_request request = {.cells = &cells,
                                                .pairs = &pairs,
                                                .known = &known,
                                                .require = "gl",
                                                .shard = {1, 1 + i % 2},
                                                .is_apart = i / 2};
        struct rg_gate gate = {.case_count = 1, .cases = calloc(1, sizeof(*gate.cases))};
        assert_non_null(gate.cases);
        gate.cases[0] = made(&cells.cells[0]);
        gate.cases[0].is_compared = false;
        gate.cases[0].agreement.outcome = RG_OK;
        assert_true(rg_gate_report(&request, &gate));
        assert_int_equal(gate.report.case_count, i == 1 ? 1 : 2);
        assert_int_equal(gate.told_count, 1);
        rg_gate_free(&gate);
    }
    rg_gate_cells_free(&cells);
}

int main(void)
{
    rg_log_listen(log_last, NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_gate_ends_as_its_worst_case_if_any_was_compared),
        cmocka_unit_test(a_gate_of_nothing_says_why),
        cmocka_unit_test(a_required_device_fails_if_none_of_its_cells_was_compared),
        cmocka_unit_test(nothing_is_known_of_what_did_not_run),
        cmocka_unit_test(a_shard_leaves_required_devices_to_all_together),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
