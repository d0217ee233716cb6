// What a course gets to time a gate's cases, and what a case keeps of it. Stand-ins take the place
// of the course and of the journal.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "harness/compare/gate/run/running.h"
#include "harness/console/clock.h"
#include "tests/tools/expect.h"

// --- stand-ins ---

enum { MOST = 4 };
static double now_ms;
static struct {
    int count;
    struct rg_gate_rule rule;
    uint32_t seed;
    bool has_before;
    struct rg_gate_sample before[MOST];
    struct rg_gate_times times;
    struct rg_timed_cell cells[MOST];
} courses[2];
// The results of a course, by row; the rows of the advised course come last.
static struct {
    enum rg_course_end end;
    enum rg_outcome outcome;
    int launches, disturbed;
} ends[MOST];
static double looked_ms;
static int course_count, row_count, rooms_open;
static char codes[MOST][600]; // "NAME: CODE" of each row that the journal is told of

double rg_now_ms(void)
{
    return now_ms;
}

bool rg_course_run(const struct rg_gate_rule *rule, const struct rg_quad_source *source,
                   uint32_t seed, struct rg_gate_row *rows)
{
    struct rg_gate_times *times = source->user;
    assert_true(source->launch == rg_times_launch && source->take == rg_times_take &&
                source->is_over == rg_times_are_over);
    courses[course_count].count = times->cell_count;
    courses[course_count].rule = *rule;
    courses[course_count].seed = seed;
    courses[course_count].has_before = source->before;
    if (source->before)
        memcpy(courses[course_count].before, source->before,
               (size_t)times->cell_count * sizeof(*source->before));
    courses[course_count].times = *times;
    memcpy(courses[course_count++].cells, times->cells,
           (size_t)times->cell_count * sizeof(*times->cells));
    for (int i = 0; i < times->cell_count; i++, row_count++) {
        rows[i] = (struct rg_gate_row){.end = ends[row_count].end,
                                       .launches = ends[row_count].launches,
                                       .disturbed = ends[row_count].disturbed};
        rows[i].decision.ratio = 1 + row_count;
        times->cells[i].outcome = ends[row_count].outcome;
        times->cells[i].seconds = 0.5;
    }
    times->look_ms = looked_ms;
    times->launch = 99; // as it is left by a course
    times->is_launched = times->failed = true;
    return true;
}

void rg_gate_journal_expect(struct rg_gate_journal *journal, const char *name, const char *code)
{
    (void)journal;
    for (int i = 0; i < MOST; i++)
        if (!*codes[i]) {
            snprintf(codes[i], sizeof(codes[i]), "%s: %s", name, code);
            return;
        }
}

bool rg_yardsticks_open(struct rg_yardstick_room *room)
{
    (void)room;
    rooms_open++;
    return true;
}

void rg_yardsticks_close(struct rg_yardstick_room *room)
{
    (void)room;
}

// --- a gate whose cases agree ---

static struct rg_gate_cell cell;
static int journal; // stands for one
static struct rg_baseline baseline;
static struct rg_baseline_row before[MOST];
static const struct rg_gate_pairs pairs = {.count = 2};
static struct rg_gate_request request;
static struct rg_running_gate run;
static struct rg_gate_case cases[MOST];
static const char *const names[MOST] = {"a", "b", "c", "d"};

// Cases a and d are timed, c is advised, b is neither. They are those of the second pair.
static void begin(bool has_baseline)
{
    memset(courses, 0, sizeof(courses));
    memset(ends, 0, sizeof(ends));
    memset(codes, 0, sizeof(codes));
    memset(&run, 0, sizeof(run));
    course_count = row_count = rooms_open = 0;
    now_ms = 5000;
    looked_ms = 0;
    for (int i = 0; i < MOST; i++)
        before[i] = (struct rg_baseline_row){.slot = {7 + i, 5}, .launches = {2, {1, 4 + i}}};
    request = (struct rg_gate_request){.pairs = &pairs,
                                       .baseline = has_baseline ? &baseline : NULL,
                                       .margin = 0.25,
                                       .shard = {1, 1}};
    run.asked = &request;
    run.side_count = 4;
    run.start_ms = 2000;
    run.end_ms = 9000;
    run.journal = (struct rg_gate_journal *)&journal;
    for (int i = 0; i < MOST; i++)
        cases[i] =
            (struct rg_gate_case){.cell = &cell,
                                  .name = (char *)names[i],
                                  .pair = has_baseline ? 0 : 1,
                                  .seconds = 2,
                                  .sides = {has_baseline ? NULL : &run.sides[2], &run.sides[3]},
                                  .before = has_baseline ? &before[i] : NULL,
                                  .is_timed = i == 0 || i == 3,
                                  .is_advised = has_baseline && i == 2};
}

// --- what is timed ---

static void cases_of_a_pair_are_timed_in_one_course(void **state)
{
    (void)state;
    begin(false);
    assert_true(rg_gate_time(&run, cases, MOST));
    assert_int_equal(course_count, 1);
    assert_int_equal(courses[0].count, 2);
    assert_int_equal(courses[0].seed, RG_COURSE_SEED);
    assert_false(courses[0].has_before);
    const struct rg_gate_times *times = &courses[0].times;
    assert_true(times->side_count == 2 && times->sides == &run.sides[2]);
    assert_true(times->end_ms == 9000 && times->yardsticks == run.yardsticks && !times->room);
    assert_ptr_equal(times->journal, run.journal);
    assert_int_equal(times->first_look, 16);
    for (int i = 0; i < 2; i++) {
        const struct rg_timed_cell *timed = &courses[0].cells[i];
        assert_string_equal(timed->name, i ? "d" : "a");
        assert_ptr_equal(timed->cell, &cell);
        assert_ptr_equal(timed->sides[RG_SIDE_A], &run.sides[2]);
        assert_ptr_equal(timed->sides[RG_SIDE_B], &run.sides[3]);
        assert_int_equal(timed->slot.frames, 0);
    }
    assert_int_equal(rooms_open, 0);
}

// Advice has a course of its own, of one look, that no margin ends and no journal keeps.
static void with_a_baseline_advice_is_taken_apart(void **state)
{
    (void)state;
    begin(true);
    assert_true(rg_gate_time(&run, cases, MOST));
    assert_true(course_count == 2 && courses[0].count == 2 && courses[1].count == 1);
    assert_int_equal(rooms_open, 1);
    for (int i = 0; i < 2; i++) {
        const struct rg_gate_times *times = &courses[i].times;
        assert_true(times->side_count == 4 && times->sides == run.sides && times->room);
        assert_ptr_equal(times->journal, i ? NULL : run.journal);
        assert_true(times->launch == 0 && !times->is_launched && !times->failed);
        assert_int_equal(times->first_look, 8);
        assert_true(courses[i].has_before);
    }
    for (int i = 0; i < 3; i++) {
        const int row = i == 1, number = i == 0 ? 0 : i == 1 ? 3 : 2; // a and d, then c
        const struct rg_gate_sample *sample = &courses[i / 2].before[row];
        const struct rg_timed_cell *timed = &courses[i / 2].cells[row];
        assert_true(sample->count == 2 && sample->logs[0] == 0);
        assert_true(sample->logs[1] == log(4 + number));
        assert_int_equal(timed->side, RG_SIDE_B);
        assert_true(timed->slot.frames == 7 + number && timed->slot.timings == 5);
    }
    assert_true(courses[0].rule.look_count == 3 && courses[1].rule.look_count == 1);
    assert_true(courses[0].rule.margin == 0.25 && isinf(courses[1].rule.margin));
}

static void nothing_is_opened_where_nothing_is_to_be_timed(void **state)
{
    (void)state;
    begin(true);
    for (int i = 0; i < MOST; i++)
        cases[i].is_timed = cases[i].is_advised = false;
    assert_true(rg_gate_time(&run, cases, MOST));
    assert_int_equal(course_count + rooms_open, 0);
    begin(true);
    for (int i = 0; i < MOST; i++)
        cases[i].is_timed = false;
    assert_true(rg_gate_time(&run, cases, MOST));
    assert_true(course_count == 1 && rooms_open == 1 && courses[0].rule.look_count == 1);
}

// Pairs share the error, and with it shards; all devices of a baseline are one course.
static void courses_share_the_error(void **state)
{
    (void)state;
    for (int baselined = 0; baselined < 2; baselined++)
        for (int shards = 1; shards < 3; shards++) {
            begin(baselined);
            request.shard.count = shards;
            run.family[baselined ? 0 : 1] = 10;
            assert_true(rg_gate_time(&run, cases, MOST));
            assert_near(courses[0].rule.error,
                        0.01 / (baselined ? 1 : 2) * (shards > 1 ? 2 / 10.0 : 1), 1e-14);
            assert_int_equal(courses[0].rule.is_apart, baselined);
        }
}

// --- the code that runs ---

static void set_code(struct rg_gate_case *c, int side, const char *program, uint64_t libraries,
                     uint64_t passes)
{
    c->agreement.code[side] =
        (struct rg_session_code){.libraries = libraries, .passes = {passes, 0}};
    snprintf(c->agreement.code[side].program, RG_BUILD_ID_SIZE, "%s", program);
}

static void the_journal_is_told_of_the_code_of_both_sides(void **state)
{
    (void)state;
    begin(false);
    for (int i = 0; i < MOST; i++) {
        set_code(&cases[i], RG_SIDE_A, "ab12", 0x1f, 2 + (unsigned)i);
        set_code(&cases[i], RG_SIDE_B, "cd34", 3, 0x4e);
    }
    assert_true(rg_gate_time(&run, cases, MOST));
    assert_string_equal(codes[0], "a: ab12 000000000000001f 0000000000000002, "
                                  "cd34 0000000000000003 000000000000004e");
    assert_string_equal(codes[1], "d: ab12 000000000000001f 0000000000000005, "
                                  "cd34 0000000000000003 000000000000004e");
    assert_string_equal(codes[2], "");
    begin(false);
    run.journal = NULL;
    assert_true(rg_gate_time(&run, cases, MOST));
    assert_string_equal(codes[0], "");
}

// --- what a case keeps ---

static void a_case_keeps_what_its_row_found(void **state)
{
    (void)state;
    begin(false);
    ends[0].end = RG_END_BROKEN;
    ends[0].outcome = RG_CRASH;
    ends[1].end = RG_END_DECIDED;
    ends[1].outcome = RG_CRASH; // a side fell after it was decided
    assert_true(rg_gate_time(&run, cases, MOST));
    assert_int_equal(cases[0].times.outcome, RG_CRASH);
    assert_int_equal(cases[3].times.outcome, RG_OK);
    assert_true(cases[0].row.decision.ratio == 1 && cases[3].row.decision.ratio == 2);
    assert_true(cases[0].seconds == 2.5 && cases[1].seconds == 2);
    assert_int_equal(cases[3].rule.rows, 2);
    assert_string_equal(cases[3].times.name, "d");
    assert_false(cases[0].times.is_over);
    assert_true(run.has_looked);
}

// A row that the end of time met before its first look leaves the gate without any.
static void a_gate_has_looked_once_enough_launches_count(void **state)
{
    (void)state;
    static const struct {
        enum rg_course_end end;
        int launches, disturbed;
        bool has_looked;
    } rows[] = {
        {RG_END_OVER, 15, 0, false}, {RG_END_OVER, 16, 0, true},    {RG_END_OVER, 17, 2, false},
        {RG_END_OVER, 18, 2, true},  {RG_END_DECIDED, 16, 0, true}, {RG_END_DISTURBED, 3, 3, true},
        {RG_END_BROKEN, 0, 0, true},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        begin(false);
        cases[3].is_timed = false;
        ends[0].end = rows[i].end;
        ends[0].launches = rows[i].launches;
        ends[0].disturbed = rows[i].disturbed;
        assert_true(rg_gate_time(&run, cases, MOST));
        if (run.has_looked != rows[i].has_looked)
            fail_msg("row %zu", i);
        assert_int_equal(cases[0].times.is_over, rows[i].end == RG_END_OVER);
    }
}

// The time of the first look counts from the pair's start; the longest of all pairs is kept.
static void the_latest_first_look_is_kept(void **state)
{
    (void)state;
    begin(false);
    looked_ms = 7000;
    run.look_ms = 3000;
    assert_true(rg_gate_time(&run, cases, MOST));
    assert_equals(run.look_ms, 5000);
    begin(false);
    looked_ms = 7000;
    run.look_ms = 6000;
    assert_true(rg_gate_time(&run, cases, MOST));
    assert_equals(run.look_ms, 6000);
}

static void a_gate_without_an_end_is_never_over(void **state)
{
    (void)state;
    begin(false);
    run.end_ms = 5000;
    assert_true(rg_gate_is_over(&run));
    run.end_ms = 5001;
    assert_false(rg_gate_is_over(&run));
    run.end_ms = 0;
    assert_false(rg_gate_is_over(&run));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cases_of_a_pair_are_timed_in_one_course),
        cmocka_unit_test(with_a_baseline_advice_is_taken_apart),
        cmocka_unit_test(nothing_is_opened_where_nothing_is_to_be_timed),
        cmocka_unit_test(courses_share_the_error),
        cmocka_unit_test(the_journal_is_told_of_the_code_of_both_sides),
        cmocka_unit_test(a_case_keeps_what_its_row_found),
        cmocka_unit_test(a_gate_has_looked_once_enough_launches_count),
        cmocka_unit_test(the_latest_first_look_is_kept),
        cmocka_unit_test(a_gate_without_an_end_is_never_over),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
