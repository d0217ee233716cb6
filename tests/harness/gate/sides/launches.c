// What a launch takes of a cell: which side is timed when, how often, and which time counts. A
// stand-in's frames last as the test says, by a clock that nothing else moves.
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "core/base/log.h"
#include "harness/compare/gate/sides/times.h"
#include "harness/console/clock.h"
#include "harness/devices/frames/session.h"
#include "harness/devices/measure/others.h"
#include "harness/devices/measure/sampling.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/logged.h"

// --- stand-ins ---

enum { MOST_EVENTS = 4096 };
static double now_ms, frame_ms[RG_SIDES];
static double grows_ms[RG_SIDES];   // by which a side's frame is longer than its last timing's
static double stolen_ms;            // that the machine takes while a launch is timed
static double rested_ms;            // the last rest
static bool few;                    // the user asks for few timings
static const char *falls, *refuses; // the side that does not start, or opens no cell
static int fails_at,
    frames_at; // the call of rg_session_frames that fails, from 1; how many were made
static char events[MOST_EVENTS];
static struct rg_device devices[RG_SIDES];

static void note(char event)
{
    const size_t length = strlen(events);
    if (length + 1 >= MOST_EVENTS)
        fail_msg("more than %d events", MOST_EVENTS);
    events[length] = event;
    events[length + 1] = 0;
}

double rg_now_ms(void)
{
    return now_ms;
}

bool rg_sampling_few(void)
{
    return few;
}

// L and l: A and B are launched.
bool rg_side_launch(struct rg_side *side)
{
    const bool is_b = *side->name == 'b';
    note(is_b ? 'l' : 'L');
    if (falls && !strcmp(side->name, falls))
        return rg_crash_error("%s fell", side->name);
    side->device = &devices[is_b];
    return true;
}

void rg_side_close(struct rg_side *side)
{
    side->device = NULL;
}

// O and o: A and B are opened; A and B: they are timed; C and c: they are closed.
struct rg_session *rg_session_run(struct rg_device *device, const struct rg_subject *subject,
                                  int frames)
{
    (void)subject;
    assert_int_equal(frames, 3);
    note(device == &devices[RG_SIDE_B] ? 'o' : 'O');
    if (refuses && device == &devices[*refuses == 'b'])
        return rg_driver_error_null("it refuses");
    return (struct rg_session *)device;
}

void rg_session_close(struct rg_session *session)
{
    if (session)
        note((struct rg_device *)session == &devices[RG_SIDE_B] ? 'c' : 'C');
}

bool rg_session_frames(struct rg_session *session, int frames, double *wall_ms)
{
    const bool is_b = (struct rg_device *)session == &devices[RG_SIDE_B];
    if (++frames_at == fails_at)
        return rg_timeout_error("it hung");
    note(is_b ? 'B' : 'A');
    *wall_ms = frames * frame_ms[is_b];
    now_ms += *wall_ms;
    frame_ms[is_b] += grows_ms[is_b];
    return true;
}

struct rg_processors rg_processors_now(const pid_t *ours, int our_count)
{
    static double taken_ms;
    (void)ours;
    (void)our_count;
    taken_ms += stolen_ms;
    return (struct rg_processors){.count = 1, .at_ms = now_ms, .stolen_ms = taken_ms};
}

struct rg_taken rg_taken_between(const struct rg_processors *before,
                                 const struct rg_processors *after)
{
    return (struct rg_taken){.stolen = (after->stolen_ms - before->stolen_ms) / 1000, .others = 1};
}

int nanosleep(const struct timespec *rest, struct timespec *left)
{
    (void)left;
    rested_ms = 1e3 * (double)rest->tv_sec + 1e-6 * (double)rest->tv_nsec;
    now_ms += rested_ms;
    return 0;
}

// Y: a yardstick is taken.
double rg_yardstick_take(struct rg_yardstick_room *room, enum rg_yardstick yardstick)
{
    (void)room;
    note('Y');
    return 10 + yardstick;
}

// --- a cell on two sides ---

static const struct rg_gate_cell cell = {.name = "rain", .frames = 3};
static struct rg_side sides[RG_SIDES];
static struct rg_timed_cell timed;
static struct rg_gate_times times;
static struct rg_launches yardsticks[RG_YARDSTICKS];
static struct rg_yardstick_room room;

// Frames of A and B last so long. `is_pair`: else B runs alone.
static void begin(bool is_pair, double a_ms, double b_ms)
{
    now_ms = 1000;
    frame_ms[RG_SIDE_A] = a_ms;
    frame_ms[RG_SIDE_B] = b_ms;
    grows_ms[RG_SIDE_A] = grows_ms[RG_SIDE_B] = stolen_ms = 0;
    few = false;
    falls = refuses = NULL;
    fails_at = frames_at = 0;
    *events = 0;
    memset(yardsticks, 0, sizeof(yardsticks));
    sides[RG_SIDE_A] = (struct rg_side){.name = "a"};
    sides[RG_SIDE_B] = (struct rg_side){.name = "b"};
    timed = (struct rg_timed_cell){
        .cell = &cell, .name = "rain.b", .sides = {is_pair ? sides : NULL, &sides[RG_SIDE_B]}};
    times = (struct rg_gate_times){
        .side_count = 2, .sides = sides, .cell_count = 1, .cells = &timed, .first_look = 16};
}

static struct rg_quads take(bool b_first)
{
    struct rg_quads quads = {.log = NAN};
    assert_true(rg_times_launch(4, &times));
    *events = 0;
    if (!rg_times_take(0, b_first, &quads, &times))
        fail_msg("%s", rg_last_error());
    return quads;
}

// --- slots ---

// A timing takes at least 1 ms, and a slot at least 9 ms and three timings.
static void slots_are_long_enough_for_the_clock(void **state)
{
    (void)state;
    static const struct {
        bool is_pair, few;
        double a_ms, b_ms;
        int frames, timings;
    } rows[] = {
        {true, false, 2, 2, 1, 5},          {true, false, 0.1, 0.1, 10, 9},
        {true, false, 0.25, 1, 2, 9}, // by the geometric mean, 0.5 ms
        {true, false, 40, 40, 1, 3},        {true, true, 2, 2, 1, 3},
        {false, false, 99, 4.5, 1, 3},      {false, false, 99, 0.3, 4, 8},
        {true, false, 1e-7, 1e-7, 1000, 9},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        begin(rows[i].is_pair, rows[i].a_ms, rows[i].b_ms);
        few = rows[i].few;
        take(false);
        if (timed.slot.frames != rows[i].frames || timed.slot.timings != rows[i].timings)
            fail_msg("row %zu: %d timings of %d frames", i, timed.slot.timings, timed.slot.frames);
    }
    begin(true, 2, 2);
    timed.slot = (struct rg_slot){3, 4}; // the baseline's, or that of an earlier launch
    take(false);
    assert_true(timed.slot.frames == 3 && timed.slot.timings == 4);
}

// --- blocks ---

// Both are warmed up by two calls. Then come three blocks of slots of one timing each.
static void blocks_alternate_and_begin_as_drawn(void **state)
{
    (void)state;
    begin(true, 2, 2);
    timed.slot = (struct rg_slot){1, 1};
    take(false);
    assert_string_equal(events, "OoAABB"
                                "ABBA"
                                "BAAB"
                                "ABBA"
                                "Cc");
    begin(true, 2, 2);
    timed.slot = (struct rg_slot){1, 2};
    take(true);
    assert_string_equal(events, "oOAABB"
                                "BBAAAABB"
                                "AABBBBAA"
                                "BBAAAABB"
                                "Cc");
    begin(false, 99, 2);
    timed.slot = (struct rg_slot){1, 2};
    take(true);
    assert_string_equal(events, "lo"
                                "BB"
                                "BB"
                                "BB"
                                "BB"
                                "c");
}

// Frames grow with each call: warming up leaves them at 7 ms and 6 ms. A's blocks have 7 and 9 ms,
// 11 and 13, 15 and 17; B's 6 and 7, 8 and 9, 10 and 11.
static void a_launch_counts_the_medians_of_its_blocks(void **state)
{
    (void)state;
    begin(true, 3, 4);
    grows_ms[RG_SIDE_A] = 2;
    grows_ms[RG_SIDE_B] = 1;
    timed.slot = (struct rg_slot){1, 1};
    const struct rg_quads quads = take(false);
    assert_equals(quads.a_ms, 12);
    assert_equals(quads.b_ms, 8.5);
    assert_at_most(fabs(quads.log - log(8 * 9 / (11.0 * 13)) / 2), 1e-12);
    assert_false(quads.is_disturbed);
    begin(false, 99, 4);
    grows_ms[RG_SIDE_B] = 1;
    timed.slot = (struct rg_slot){1, 1};
    const struct rg_quads alone = take(false);
    assert_true(alone.a_ms == 0 && alone.b_ms == 7 && alone.log == log(7));
}

// Of a slot's timings the median counts, of a frame: 6, 7 and 8 ms of two frames.
static void a_slot_counts_the_median_of_its_timings(void **state)
{
    (void)state;
    begin(false, 99, 4);
    grows_ms[RG_SIDE_B] = 1;
    timed.slot = (struct rg_slot){2, 3};
    assert_equals(take(false).b_ms, 10); // slots of 6 to 8, 9 to 11 and 12 to 14
}

// Only what a hypervisor takes counts, above a twentieth of the time.
static void a_launch_is_disturbed_by_another_machine(void **state)
{
    (void)state;
    begin(true, 2, 2);
    stolen_ms = 50;
    assert_false(take(false).is_disturbed);
    begin(true, 2, 2);
    stolen_ms = 51;
    assert_true(take(false).is_disturbed);
}

// After eight disturbed launches, each is followed by a rest of 10 ms to a second, which never goes
// beyond the end.
static void disturbed_launches_rest(void **state)
{
    (void)state;
    static const double rests_ms[] = {0,  0,  0,  0,   0,   0,   0,    0,   10,
                                      20, 40, 80, 160, 320, 640, 1000, 1000};
    begin(true, 2, 2);
    stolen_ms = 51;
    for (size_t i = 0; i < sizeof(rests_ms) / sizeof(rests_ms[0]); i++) {
        rested_ms = 0;
        take(false);
        assert_below(fabs(rested_ms - rests_ms[i]), 1e-9);
    }
    times.end_ms = now_ms + 500;
    take(false);
    assert_below(fabs(now_ms - times.end_ms), 1e-6);
    stolen_ms = rested_ms = times.end_ms = 0;
    take(false);
    stolen_ms = 51;
    take(false);
    assert_equals(rested_ms, 0);
}

// --- launches ---

static void sides_take_turns_at_being_opened(void **state)
{
    (void)state;
    begin(true, 2, 2);
    sides[RG_SIDE_A].device = sides[RG_SIDE_B].device = &devices[0]; // of the launch before
    assert_true(rg_times_launch(0, &times));
    assert_string_equal(events, "Ll");
    assert_true(times.launch == 0 && times.is_launched && times.began_ms == 1000);
    *events = 0;
    assert_true(rg_times_launch(1, &times));
    assert_string_equal(events, "lL");
}

static void a_side_alone_is_opened_by_its_first_row(void **state)
{
    (void)state;
    begin(false, 99, 2);
    times.room = &room;
    times.yardsticks = yardsticks;
    assert_true(rg_times_launch(0, &times));
    assert_string_equal(events, "YYYY");
    for (int i = 0; i < RG_YARDSTICKS; i++)
        assert_true(yardsticks[i].count == 1 && yardsticks[i].ms[0] == 10 + i);
    for (int i = 1; i < RG_SHIFT_SAMPLES + 3; i++)
        assert_true(rg_times_launch(i, &times));
    assert_int_equal(yardsticks[0].count, RG_SHIFT_SAMPLES);
    for (int i = 0; i < 2; i++) { // each launch has a process of its own
        struct rg_quads quads;
        *events = 0;
        assert_true(rg_times_launch(i, &times));
        assert_true(rg_times_take(0, false, &quads, &times));
        assert_memory_equal(events, "YYYYlo", 6);
    }
}

// All rows of a pair end with the side that does not start.
static void a_side_that_falls_ends_all_rows_of_its_pair(void **state)
{
    (void)state;
    static const char *const names[] = {"a", "b"};
    for (int i = 0; i < 4; i++) {
        struct rg_timed_cell two[2];
        begin(true, 2, 2);
        two[0] = two[1] = timed;
        times.cell_count = 2;
        times.cells = two;
        falls = names[i / 2];
        assert_false(rg_times_launch(i, &times)); // A first, then B first
        assert_true(times.failed && !times.is_launched);
        for (int k = 0; k < 2; k++) {
            assert_int_equal(two[k].side, i / 2);
            assert_int_equal(two[k].outcome, RG_CRASH);
        }
    }
}

static void a_cell_that_hangs_ends_on_the_side_that_ran(void **state)
{
    (void)state;
    static const struct {
        int fails_at, side;
    } rows[] = {{1, RG_SIDE_A}, {4, RG_SIDE_B}, {5, RG_SIDE_A}, {6, RG_SIDE_B}, {10, RG_SIDE_A}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_quads quads;
        begin(true, 2, 2);
        timed.slot = (struct rg_slot){1, 1};
        assert_true(rg_times_launch(0, &times));
        fails_at = rows[i].fails_at;
        assert_false(rg_times_take(0, false, &quads, &times));
        assert_int_equal(timed.outcome, RG_TIMEOUT);
        assert_string_equal(timed.why, "it hung");
        assert_int_equal(timed.side, rows[i].side);
        assert_string_equal(events + strlen(events) - 2, "Cc");
    }
}

static void a_cell_that_does_not_open_ends_on_its_side(void **state)
{
    (void)state;
    static const char *const names[] = {"a", "b"};
    for (int i = 0; i < 4; i++) {
        struct rg_quads quads;
        begin(true, 2, 2);
        refuses = names[i / 2];
        timed.side = !(i / 2);
        assert_true(rg_times_launch(0, &times));
        assert_false(rg_times_take(0, i % 2, &quads, &times));
        assert_int_equal(timed.side, i / 2);
        assert_int_equal(timed.outcome, RG_ERROR);
    }
}

// A device ran before, so that one that is gone is an error.
static void a_device_that_is_gone_is_an_error(void **state)
{
    (void)state;
    begin(true, 2, 2);
    rg_unsupported("no such device");
    assert_false(rg_timed_cell_fails(&timed));
    assert_true(timed.outcome == RG_ERROR && !timed.is_ours);
    rg_harness_error("no memory");
    assert_false(rg_timed_cell_fails(&timed));
    assert_true(timed.outcome == RG_LACKING && timed.is_ours);
}

// --- time that is left ---

// Warming up takes 3 frames of each side: 12 ms. Three blocks of four slots of 10 ms take 120 ms,
// and three slots of B alone 30 ms.
static void a_cell_without_room_is_over(void **state)
{
    (void)state;
    static const struct {
        bool is_pair;
        double end_ms;
        bool is_over;
    } rows[] = {{true, 1133, false}, {true, 1132, true}, {false, 1037, false}, {false, 1036, true},
                {true, 0, false},    {true, 1000, true}, {false, 0, false}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_quads quads;
        begin(rows[i].is_pair, 2, 2);
        times.end_ms = rows[i].end_ms;
        assert_true(rg_times_launch(0, &times));
        if (rg_times_take(0, false, &quads, &times) == rows[i].is_over)
            fail_msg("row %zu", i);
        assert_int_equal(timed.is_over, rows[i].is_over);
        assert_int_equal(timed.outcome, RG_OK);
        if (rows[i].end_ms == 1000)
            assert_null(strchr(events, 'A')); // nothing was opened
        else if (!rows[i].is_over)
            assert_at_most(fabs(timed.seconds - (rows[i].is_pair ? 0.132 : 0.036)), 1e-9);
    }
}

// The first look of 16 launches is expected by what this one takes: at least its blocks.
static void a_cell_that_is_over_tells_when_a_look_would_come(void **state)
{
    (void)state;
    struct rg_quads quads;
    begin(true, 2, 2);
    times.end_ms = 1100;
    assert_true(rg_times_launch(6, &times));
    assert_false(rg_times_take(0, false, &quads, &times));
    assert_equals(times.look_ms, 1012 + (16 - 6) * 120);
    begin(true, 2, 2);
    times.end_ms = 1100;
    assert_true(rg_times_launch(16, &times)); // it has passed
    assert_false(rg_times_take(0, false, &quads, &times));
    assert_equals(times.look_ms, 0);
}

// --- the journal ---

// Launches of the journal are not taken again, and no process is started for them.
static void launches_of_the_journal_are_not_taken_again(void **state)
{
    (void)state;
    struct rg_quads quads;
    begin(true, 2, 2);
    times.journal = rg_gate_journal_open("/nonexistent/out", json_object(), true);
    assert_non_null(times.journal);
    rg_gate_journal_add(times.journal, "rain.b", 1, &(struct rg_quads){0.5, 7, 8, true});
    for (int launch = 0; launch < 3; launch++) {
        *events = 0;
        assert_true(rg_times_launch(launch, &times));
        assert_string_equal(events, "");
        assert_true(rg_times_take(0, false, &quads, &times));
        assert_int_equal(strncmp(events, "LlOo", 4) != 0, launch == 1);
        assert_int_equal(*events == 0, launch == 1);
        assert_int_equal(quads.a_ms == 7 && quads.b_ms == 8 && quads.is_disturbed, launch == 1);
        assert_true(rg_gate_journal_find(times.journal, "rain.b", launch, &quads));
    }
    *events = 0;
    falls = "a";
    assert_true(rg_times_launch(4, &times));
    for (int row = 0; row < 2; row++) // nothing is started a second time
        assert_false(rg_times_take(0, false, &quads, &times));
    assert_string_equal(events, "L");
    rg_gate_journal_close(times.journal, false);
}

int main(void)
{
    rg_log_listen(log_last, NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slots_are_long_enough_for_the_clock),
        cmocka_unit_test(blocks_alternate_and_begin_as_drawn),
        cmocka_unit_test(a_launch_counts_the_medians_of_its_blocks),
        cmocka_unit_test(a_slot_counts_the_median_of_its_timings),
        cmocka_unit_test(a_launch_is_disturbed_by_another_machine),
        cmocka_unit_test(disturbed_launches_rest),
        cmocka_unit_test(sides_take_turns_at_being_opened),
        cmocka_unit_test(a_side_alone_is_opened_by_its_first_row),
        cmocka_unit_test(a_side_that_falls_ends_all_rows_of_its_pair),
        cmocka_unit_test(a_cell_that_hangs_ends_on_the_side_that_ran),
        cmocka_unit_test(a_cell_that_does_not_open_ends_on_its_side),
        cmocka_unit_test(a_device_that_is_gone_is_an_error),
        cmocka_unit_test(a_cell_without_room_is_over),
        cmocka_unit_test(a_cell_that_is_over_tells_when_a_look_would_come),
        cmocka_unit_test(launches_of_the_journal_are_not_taken_again),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
