// A whole gate without devices: stand-ins open sides, compare cells and time them, by a clock that
// only the test moves.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/compare/gate/run/running.h"
#include "harness/compare/gate/run/gate.h"
#include "harness/console/clock.h"
#include "harness/console/exit.h"
#include "harness/record/passport/key.h"
#include "harness/record/passport/passport.h"
#include "tests/harness/gate/cells/read.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/logged.h"

// --- stand-ins ---

enum { MOST = 8 };
static struct {
    double now_ms;
    const char *absent, *bad, *falls; // the device that is not there, whose name is none, or that
                                      // does not start a second time
    const char *closes_badly, *lacks;
    double compare_ms; // that a comparison takes
    double course_ms;  // and a course
    enum rg_outcome agrees;
    enum rg_course_end end; // of all rows
    enum rg_verdict_of_two verdict;
    bool journal_is_lost;
} script;
static struct {
    struct rg_side *sides;
    char compared[MOST * 40], timed[MOST * 40]; // names with a blank after each
    char libraries[RG_KEY_TEXT];
    double ends_ms[MOST]; // when a course has to end
    int courses;
    json_t *key;
    bool fresh, is_done;
    char folder[40];
} seen;
static struct rg_device device;
static struct rg_gate_request request;

double rg_now_ms(void)
{
    return script.now_ms;
}

static bool is(const char *name, const char *one)
{
    return one && !strcmp(name, one);
}

bool rg_side_launch(struct rg_side *side)
{
    if (is(side->name, script.falls)) {
        rg_driver_error("%s falls", side->name);
        return false;
    }
    side->device = &device;
    return true;
}

void rg_side_close(struct rg_side *side)
{
    side->device = NULL;
}

void rg_side_look(struct rg_side *side)
{
    side->is_name = !is(side->name, script.bad);
    side->is_there = !is(side->name, script.absent);
    if (!seen.sides)
        seen.sides = request.baseline ? side - 1 : side; // with a baseline, A is none
    for (const struct rg_side *before = seen.sides; before < side; before++)
        assert_null(before->device);
    side->was_closed_badly = is(side->name, script.closes_badly);
    side->was_lacking = is(side->name, script.lacks);
    if (side->is_name && side->is_there) {
        struct rg_device_info *info = &side->info;
        side->device = &device;
        snprintf(info->name, sizeof(info->name), "%s", side->name);
        snprintf(info->full, sizeof(info->full), "%s", side->name);
        snprintf(info->driver, sizeof(info->driver), "Mesa %s", side->name);
    }
}

bool rg_gate_has_fixed(const struct rg_baseline *baseline, const struct rg_gate_pair *pair)
{
    (void)baseline;
    (void)pair;
    return false;
}

// Only the sides of the case may run meanwhile.
void rg_gate_agree(struct rg_gate_case *c, struct rg_truth *truth, const char *folder)
{
    assert_true(is("pictures", folder));
    snprintf(seen.libraries, sizeof(seen.libraries), "%s", truth->libraries);
    for (int i = 0; i < 4; i++) {
        const struct rg_side *side = &seen.sides[i];
        const bool is_own = side == c->sides[RG_SIDE_A] || side == c->sides[RG_SIDE_B];
        assert_int_equal(side->device != NULL, is_own);
    }
    snprintf(seen.compared + strlen(seen.compared), sizeof(seen.compared) - strlen(seen.compared),
             "%s ", c->name);
    script.now_ms += script.compare_ms;
    c->agreement =
        (struct rg_agreement){.outcome = script.agrees, .pixels = NAN, .difference = NAN};
}

bool rg_course_run(const struct rg_gate_rule *rule, const struct rg_quad_source *source,
                   uint32_t seed, struct rg_gate_row *rows)
{
    const struct rg_gate_times *times = source->user;
    (void)seed;
    seen.ends_ms[seen.courses++] = times->end_ms;
    for (int i = 0; i < rule->rows; i++) {
        snprintf(seen.timed + strlen(seen.timed), sizeof(seen.timed) - strlen(seen.timed), "%s%s ",
                 isinf(rule->margin) ? "~" : "", times->cells[i].name);
        rows[i] = (struct rg_gate_row){.end = script.end};
        rows[i].decision.units = script.end == RG_END_OVER ? 0 : 16;
        rows[i].decision.verdict = script.verdict;
    }
    script.now_ms += script.course_ms;
    return true;
}

bool rg_yardsticks_open(struct rg_yardstick_room *room)
{
    (void)room;
    return true;
}

void rg_yardsticks_close(struct rg_yardstick_room *room)
{
    (void)room;
}

struct rg_gate_journal *rg_gate_journal_open(const char *folder, json_t *key, bool fresh)
{
    static int kept;
    snprintf(seen.folder, sizeof(seen.folder), "%s", folder);
    seen.key = key;
    seen.fresh = fresh;
    return (struct rg_gate_journal *)&kept;
}

void rg_gate_journal_expect(struct rg_gate_journal *journal, const char *name, const char *code)
{
    (void)journal;
    (void)name;
    (void)code;
}

bool rg_gate_journal_close(struct rg_gate_journal *journal, bool is_done)
{
    seen.is_done = is_done;
    return !journal || !script.journal_is_lost ||
           rg_harness_error("launches.csv: the disk is full");
}

// --- a gate of two cells and two pairs ---

static const char text_of_cells[] = "one raster 16x16 1\ntwo raster 16x16 1 seed=7\n";
static struct rg_known known;
static const struct rg_gate_pairs pairs = {.count = 2, .all = {{{"old", "gl"}}, {{"cpu", "new"}}}};
static struct rg_gate gate;

static int set_up(void **state)
{
    (void)state;
    return read_cells(text_of_cells);
}

static void begin(void)
{
    memset(&script, 0, sizeof(script));
    memset(&seen, 0, sizeof(seen));
    memset(&gate, 0, sizeof(gate));
    script.verdict = RG_TWO_PASS;
    script.now_ms = 10000;
    log_forget();
    request = (struct rg_gate_request){.cells = &cells,
                                       .pairs = &pairs,
                                       .known = &known,
                                       .margin = 0.05,
                                       .pictures = "pictures",
                                       .shard = {1, 1}};
}

static void end(void)
{
    json_decref(seen.key);
    rg_gate_free(&gate);
}

#define ALL "one.gl two.gl one.new two.new "

static void all_cells_are_compared_then_timed_pair_by_pair(void **state)
{
    (void)state;
    begin();
    assert_int_equal(rg_gate_run(&request, &gate), RG_EXIT_PASS);
    assert_string_equal(seen.compared, ALL);
    assert_string_equal(seen.timed, ALL);
    assert_int_equal(seen.courses, 2);
    assert_true(gate.is_told && gate.report.case_count == 4);
    assert_string_equal(gate.note, "A  old: Mesa old\nB  gl: Mesa gl\n"
                                   "A  cpu: Mesa cpu\nB  new: Mesa new\n");
    assert_non_null(strstr(gate.report.passport, "Mesa new"));
    end();
}

static void what_ends_a_gate_early_has_its_status(void **state)
{
    (void)state;
    static const struct {
        const char *absent, *bad, *falls, *badly, *lacks, *require;
        bool is_lost;
        int exit, cases, beyond;
    } rows[] = {
        {.exit = RG_EXIT_PASS, .cases = 4},
        {.bad = "cpu", .exit = RG_EXIT_USAGE},
        {.bad = "new", .exit = RG_EXIT_USAGE},
        {.absent = "cpu", .require = "new", .exit = RG_EXIT_PASS, .cases = 4},
        {.absent = "cpu", .require = "cpu", .exit = RG_EXIT_FAIL, .cases = 1},
        {.falls = "cpu", .exit = RG_EXIT_FAIL, .cases = 4},
        {.badly = "old", .exit = RG_EXIT_FAIL, .cases = 4, .beyond = RG_EXIT_FAIL},
        {.badly = "new", .exit = RG_EXIT_FAIL, .cases = 4, .beyond = RG_EXIT_FAIL},
        {.lacks = "gl", .exit = RG_EXIT_HARNESS, .cases = 4, .beyond = RG_EXIT_HARNESS},
        {.lacks = "gl", .badly = "gl", .exit = RG_EXIT_FAIL, .cases = 4, .beyond = RG_EXIT_FAIL},
        {.is_lost = true, .exit = RG_EXIT_HARNESS, .cases = 4, .beyond = RG_EXIT_HARNESS},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        begin();
        script.absent = rows[i].absent;
        script.bad = rows[i].bad;
        script.falls = rows[i].falls;
        script.closes_badly = rows[i].badly;
        script.lacks = rows[i].lacks;
        script.journal_is_lost = rows[i].is_lost;
        request.folder = "kept";
        request.require = rows[i].require;
        const int exit = rg_gate_run(&request, &gate);
        if (exit != rows[i].exit || gate.report.case_count != rows[i].cases)
            fail_msg("row %zu: exit status %d, %d cases", i, exit, gate.report.case_count);
        assert_int_equal(gate.beyond, rows[i].beyond);
        assert_int_equal(gate.is_told, rows[i].cases > 0);
        assert_int_equal(seen.is_done, rows[i].cases == 4);
        end();
    }
}

static void a_side_that_falls_ends_its_own_cells(void **state)
{
    (void)state;
    static const char *const names[] = {"cpu", "new"};
    for (int side = 0; side < RG_SIDES; side++) {
        char due[40];
        begin();
        script.falls = names[side];
        snprintf(due, sizeof(due), "%s: %s falls", names[side], names[side]);
        assert_int_equal(rg_gate_run(&request, &gate), RG_EXIT_FAIL);
        assert_string_equal(seen.compared, "one.gl two.gl ");
        assert_string_equal(seen.timed, "one.gl two.gl ");
        for (int i = 0; i < 4; i++) {
            const struct rg_report_case *c = &gate.report.cases[i];
            assert_int_equal(c->ending, i < 2 ? RG_ENDING_PASS : RG_ENDING_ERROR);
            assert_string_equal(c->message, i < 2 ? "" : due);
            assert_int_equal(c->is_compared, i < 2);
        }
        end();
    }
}

// Cases that differ are not timed, nor are any if the gate is asked for pictures alone.
static void only_what_agrees_is_timed(void **state)
{
    (void)state;
    begin();
    script.agrees = RG_FAIL;
    assert_int_equal(rg_gate_run(&request, &gate), RG_EXIT_FAIL);
    assert_true(!*seen.timed && gate.report.cases[3].ending == RG_ENDING_DIFFERS);
    end();
    begin();
    request.pictures_only = true;
    request.folder = "kept";
    assert_int_equal(rg_gate_run(&request, &gate), RG_EXIT_PASS);
    assert_string_equal(seen.compared, ALL);
    assert_true(!*seen.timed && !*seen.folder);
    end();
}

static void what_is_to_be_skipped_does_not_run(void **state)
{
    (void)state;
    static const char text[] = "skip two\n  reason r\n  since 2026-01-01\n  until 2026-12-31\n";
    assert_true(rg_known_add_text(&known, "known", text, strlen(text), RG_FORM_OWN));
    begin();
    request.today = 20500;
    assert_int_equal(rg_gate_run(&request, &gate), RG_EXIT_PASS);
    assert_string_equal(seen.compared, "one.gl one.new ");
    assert_int_equal(gate.report.cases[1].ending, RG_ENDING_SKIPPED);
    end();
    rg_known_free(&known);
}

// --- the journal ---

// The gate's key in the journal, after a change of what the times depend on.
static char *key_of(int change, const char *absent)
{
    struct rg_gate_pairs other = pairs;
    struct rg_gate_cells fewer = {.count = 1, .cells = cells.cells};
    begin();
    request.folder = "kept";
    request.fresh = change == 0;
    script.absent = absent; // the passport does not name it
    switch (change) {
    case 1:
        request.margin = 0.06;
        break;
    case 2:
        request.filter = "*";
        break;
    case 3:
        request.shard.count = 2;
        break;
    case 4:
        snprintf(other.all[1].names[RG_SIDE_A], RG_DEVICE_NAME_SIZE, "opencl");
        request.pairs = &other;
        break;
    case 5:
        snprintf(other.all[0].names[RG_SIDE_B], RG_DEVICE_NAME_SIZE, "opencl");
        request.pairs = &other;
        break;
    case 6:
        request.cells = &fewer;
        break;
    default:
        break;
    }
    assert_int_equal(rg_gate_run(&request, &gate), RG_EXIT_PASS);
    assert_string_equal(seen.folder, "kept");
    assert_int_equal(seen.fresh, change == 0);
    char *text = json_dumps(seen.key, JSON_SORT_KEYS);
    end();
    return text;
}

static void a_journal_is_of_one_choice_of_cells_sides_and_margin(void **state)
{
    (void)state;
    static const char *const absent[] = {NULL, NULL, NULL, NULL, "cpu", "gl", NULL};
    char *first = key_of(0, NULL), *again = key_of(99, NULL);
    assert_string_equal(first, again);
    free(again);
    free(first);
    for (int change = 1; change <= 6; change++) {
        first = key_of(0, absent[change]);
        char *other = key_of(change, absent[change] ? "opencl" : NULL);
        if (!strcmp(first, other))
            fail_msg("change %d: the same key", change);
        free(other);
        free(first);
    }
}

// --- the budget ---

// Pairs share what is left when each begins: 90 s of two, then 60 s.
static void pairs_share_what_is_left_of_the_budget(void **state)
{
    (void)state;
    begin();
    request.budget_s = 100;
    request.begin_ms = 1000;
    script.now_ms = 11000;
    script.compare_ms = 5000;
    script.course_ms = 20000;
    assert_int_equal(rg_gate_run(&request, &gate), RG_EXIT_PASS);
    assert_true(seen.courses == 2 && seen.ends_ms[0] == 56000 && seen.ends_ms[1] == 101000);
    end();
    begin();
    script.course_ms = 1e9;
    assert_int_equal(rg_gate_run(&request, &gate), RG_EXIT_PASS);
    assert_true(seen.ends_ms[0] == 0 && seen.ends_ms[1] == 0);
    end();
}

// The first cell alone is compared, which takes 60 s. Two take 120 s, and a launch as long: after
// 16 of them 2040 s, for two pairs, and 4 s before the first began.
static void a_budget_without_a_look_is_refused_with_what_is_needed(void **state)
{
    (void)state;
    begin();
    request.budget_s = 50;
    request.begin_ms = 6000;
    script.compare_ms = 60000;
    script.end = RG_END_OVER;
    script.verdict = RG_TWO_INCONCLUSIVE;
    assert_int_equal(rg_gate_run(&request, &gate), RG_EXIT_USAGE);
    assert_string_equal(seen.compared, "one.gl ");
    assert_string_equal(seen.timed, "one.gl ");
    assert_string_equal(logged,
                        "--budget: the first look, after 16 launches, comes about 4084 s after the "
                        "start, so that nothing is decided within 50 s; give 4084s or more, or "
                        "gate fewer cells");
    assert_false(seen.is_done);
    for (int i = 1; i < 4; i++) {
        const struct rg_report_case *c = &gate.report.cases[i];
        assert_int_equal(c->ending, RG_ENDING_INCONCLUSIVE);
        assert_true(c->is_over && !c->is_compared);
        assert_string_equal(c->message, "the time was over before it was compared");
    }
    assert_equals(gate.report.cases[0].seconds, 60);
    end();
    begin(); // also if all time is over before the first
    request.budget_s = 1;
    script.end = RG_END_OVER;
    script.verdict = RG_TWO_INCONCLUSIVE;
    assert_int_equal(rg_gate_run(&request, &gate), RG_EXIT_USAGE);
    assert_string_equal(seen.compared, "one.gl ");
    end();
}

// --- a baseline ---

static const struct rg_gate_pairs alone = {.count = 2, .all = {{{"", "gl"}}, {{"", "new"}}}};

// A baseline of both devices; the second has another key. Of a cell there are no times.
static struct rg_baseline baseline_of(void)
{
    struct rg_baseline baseline = {.device_count = 2};
    struct rg_device_info infos[2] = {{.name = "gl", .driver = "Mesa gl"},
                                      {.name = "new", .driver = "Mesa new"}};
    baseline.passport = rg_passport_json(infos, 2);
    for (int i = 0; i < 2; i++) {
        json_t *described = rg_passport_device(&infos[i]);
        snprintf(baseline.devices[i].name, RG_DEVICE_NAME_SIZE, "%s", i ? "new" : "gl");
        baseline.devices[i].parts = rg_key_parts(baseline.passport, described);
        json_decref(described);
    }
    json_object_set_new(baseline.devices[1].parts, "driver", json_string("Mesa 9"));
    for (int i = 0; i < 4; i++) {
        struct rg_baseline_row *row = rg_baseline_add(&baseline);
        assert_non_null(row);
        snprintf(row->cell, sizeof(row->cell), "%s", cells.cells[i % 2].name);
        snprintf(row->device, sizeof(row->device), "%s", i < 2 ? "gl" : "new");
        row->launches = (struct rg_launches){i == 1 ? 0 : 2, {1, 2}};
    }
    return baseline;
}

// The baseline's libraries were others than this host's.
static void libraries_that_differ_are_told_as_now_and_then(void **state)
{
    (void)state;
    struct rg_baseline baseline = baseline_of();
    json_t *libraries =
        json_object_get(json_object_get(baseline.passport, "raingauge"), "libraries");
    void *first = json_object_iter(libraries);
    assert_non_null(first);
    const char *name = json_object_iter_key(first);
    char due[256];
    snprintf(due, sizeof(due), "%s %s and not 0.0.1", name,
             json_string_value(json_object_iter_value(first)));
    json_object_set_new(libraries, name, json_string("0.0.1"));
    begin();
    request.pairs = &alone;
    request.baseline = &baseline;
    request.folder = "kept";
    assert_int_equal(rg_gate_run(&request, &gate), RG_EXIT_PASS);
    assert_string_equal(seen.libraries, due);
    end();
    rg_baseline_free(&baseline);
}

static void times_under_another_key_are_advice(void **state)
{
    (void)state;
    struct rg_baseline baseline = baseline_of();
    char due[400], key[RG_KEY_SIZE];
    begin();
    request.pairs = &alone;
    request.baseline = &baseline;
    request.folder = "kept";
    assert_int_equal(rg_gate_run(&request, &gate), RG_EXIT_PASS);
    assert_string_equal(seen.compared, ALL);
    assert_string_equal(seen.timed, "one.gl ~one.new ~two.new ");
    rg_key_hash(baseline.devices[0].parts, key);
    snprintf(due, sizeof(due), "gl: Mesa gl\ngl: key %s, as the baseline's\nnew: Mesa new\n", key);
    assert_memory_equal(gate.note, due, strlen(due));
    rg_key_hash(baseline.devices[1].parts, key);
    assert_non_null(strstr(gate.note, key));
    assert_non_null(
        strstr(gate.note, ", so that times are advisory: driver Mesa new and not Mesa 9\n"));
    // The journal is of these times.
    json_t *before = json_object_get(seen.key, "baseline");
    assert_int_equal(json_object_size(before), 4);
    assert_true(json_equal(json_object_get(before, "one.gl"), json_object_get(before, "one.new")));
    assert_false(json_equal(json_object_get(before, "one.gl"), json_object_get(before, "two.gl")));
    end();
    rg_baseline_free(&baseline);
}

int main(void)
{
    rg_log_listen(log_last, NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_cells_are_compared_then_timed_pair_by_pair),
        cmocka_unit_test(what_ends_a_gate_early_has_its_status),
        cmocka_unit_test(a_side_that_falls_ends_its_own_cells),
        cmocka_unit_test(only_what_agrees_is_timed),
        cmocka_unit_test(what_is_to_be_skipped_does_not_run),
        cmocka_unit_test(a_journal_is_of_one_choice_of_cells_sides_and_margin),
        cmocka_unit_test(pairs_share_what_is_left_of_the_budget),
        cmocka_unit_test(a_budget_without_a_look_is_refused_with_what_is_needed),
        cmocka_unit_test(libraries_that_differ_are_told_as_now_and_then),
        cmocka_unit_test(times_under_another_key_are_advice),
    };
    return cmocka_run_group_tests(tests, set_up, free_cells);
}
