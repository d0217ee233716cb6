// The course of a gate, with times that the test makes: how often cells are timed, in which order,
// and when the course ends.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "harness/judge/course.h"
#include "tests/harness/judge/chance.h"
#include "tests/tools/expect.h"

enum { MOST_ROWS = 4 };

// Times of rows whose B takes `ratios` times as long as A.
struct script {
    double ratios[MOST_ROWS];
    double later_ratio;   // of row 0 from launch `later` on
    int later;            // 0: never
    int broken_row, over; // the row that breaks, -1: none; launches until time is over, 0: never
    int lost;             // launches until none can be made any more; 0: 2000
    int disturbed_every;  // row 0 keeps one quad of so many; 0: all
    double noise;
    int launches, taken[MOST_ROWS], b_first[MOST_ROWS];
    int first_row[MOST_ROWS]; // how often a row came first in a launch
    bool is_first;
    int last_launch;
};

static bool launch(int number, void *user)
{
    struct script *s = user;
    assert_int_equal(number, s->launches);
    s->launches++;
    s->is_first = true;
    return number < (s->lost ? s->lost : 2000);
}

static bool take(int row, bool b_first, struct rg_quads *quads, void *user)
{
    struct script *s = user;
    const bool is_later = !row && s->later && s->launches > s->later;
    const double b_ms =
        10 * (is_later ? s->later_ratio : s->ratios[row]) * exp(s->noise * (2 * uniform() - 1));
    s->first_row[row] += s->is_first;
    s->is_first = false;
    s->taken[row]++;
    s->b_first[row] += b_first;
    *quads = (struct rg_quads){log(b_ms / 10), 10, b_ms, false};
    quads->is_disturbed = !row && s->disturbed_every && s->taken[row] % s->disturbed_every;
    if (quads->is_disturbed)
        quads->log = quads->b_ms = 1e6;
    return row != s->broken_row || s->taken[row] < 5;
}

static bool is_over(void *user)
{
    const struct script *s = user;
    return s->over && s->launches >= s->over;
}

static void run(struct script *s, int rows, struct rg_gate_row *found)
{
    const struct rg_gate_rule rule = rg_gate_rule_of(rows);
    const struct rg_quad_source source = {launch, take, is_over, s, NULL};
    state_of_chance = 5;
    assert_true(rg_course_run(&rule, &source, RG_COURSE_SEED, found));
}

#define SCRIPT(...) ((struct script){.noise = 0.004, .broken_row = -1, __VA_ARGS__})

// Equal sides end at the first look that can tell; a change ends when it was confirmed.
static void test_verdicts(void **state)
{
    (void)state;
    struct rg_gate_row found[4];
    struct script s = SCRIPT(.ratios = {1, 1.06, 0.9, 1.01});
    run(&s, 4, found);
    static const enum rg_verdict_of_two due[] = {RG_TWO_PASS, RG_TWO_REGRESSED, RG_TWO_IMPROVED,
                                                 RG_TWO_PASS};
    static const int launches[] = {16, 32, 32, 16};
    for (int row = 0; row < 4; row++) {
        assert_int_equal(found[row].decision.verdict, due[row]);
        assert_int_equal(found[row].end, RG_END_DECIDED);
        assert_int_equal(found[row].launches, launches[row]);
        assert_int_equal(s.taken[row], launches[row]);
        assert_int_equal(found[row].before.verdict, launches[row] > 16 ? due[row] : 0);
        assert_below(fabs(found[row].decision.ratio - s.ratios[row]), 0.004);
        assert_below(fabs(found[row].a_ms.median - 10), 1e-9);
        assert_below(fabs(found[row].b_ms.median - 10 * s.ratios[row]), 0.05);
    }
    assert_int_equal(s.launches, 32);
}

// Orders are drawn by chance: in no quad does one side, and in no launch does one row, come first
// much more often.
static void test_orders(void **state)
{
    (void)state;
    struct rg_gate_row found[4];
    struct script s = SCRIPT(.ratios = {1, 1, 1, 1});
    s.noise = 0.6;
    run(&s, 4, found);
    for (int row = 0; row < 4; row++) {
        assert_int_equal(found[row].decision.verdict, RG_TWO_INCONCLUSIVE);
        assert_int_equal(found[row].end, RG_END_LOOKS);
        assert_int_equal(s.taken[row], 256);
        assert_between(s.b_first[row], 96, 160);
        assert_between(s.first_row[row], 40, 88);
    }
}

// A slow-down that is gone when it is measured again is no regression.
static void test_confirmation(void **state)
{
    (void)state;
    struct rg_gate_row found[1];
    struct script s = SCRIPT(.ratios = {1.1}, .later_ratio = 1, .later = 16);
    run(&s, 1, found);
    assert_int_equal(found[0].decision.verdict, RG_TWO_INCONCLUSIVE);
    assert_int_equal(found[0].end, RG_END_UNCONFIRMED);
    assert_int_equal(found[0].before.verdict, RG_TWO_REGRESSED);
    assert_int_equal(found[0].launches, 32);
    s = SCRIPT(.ratios = {1.1}, .later_ratio = 0.9, .later = 16);
    run(&s, 1, found);
    assert_int_equal(found[0].end, RG_END_UNCONFIRMED);
}

// A confirmation starts from the first look: if a change is plain by then, it needs no more
// launches than that look has.
static void test_first_look_again(void **state)
{
    (void)state;
    struct rg_gate_row found[1];
    struct script s = SCRIPT(.ratios = {1.045});
    s.noise = 0.08;
    run(&s, 1, found);
    const int units = found[0].before.units;
    assert_above(units, 16);
    s = SCRIPT(.ratios = {1.045}, .later_ratio = 1.3, .later = units);
    s.noise = 0.08;
    run(&s, 1, found);
    assert_int_equal(found[0].before.units, units);
    assert_int_equal(found[0].decision.units, 16);
    assert_int_equal(found[0].launches, units + 16);
}

// A row that breaks ends alone.
static void test_ends(void **state)
{
    (void)state;
    struct rg_gate_row found[2];
    struct script s = SCRIPT(.ratios = {1, 1});
    s.broken_row = 1;
    run(&s, 2, found);
    assert_int_equal(found[0].decision.verdict, RG_TWO_PASS);
    assert_int_equal(found[1].decision.verdict, RG_TWO_INCONCLUSIVE);
    assert_int_equal(found[1].end, RG_END_BROKEN);
    assert_int_equal(s.taken[1], 5);
    assert_int_equal(found[1].launches, 4); // the fifth gave no times
    assert_below(fabs(found[1].b_ms.median - 10), 0.05);
}

// When time is over, or a launch cannot be made, all rows end. A row that was found once and not
// confirmed tells what its last launches gave.
static void test_cut_short(void **state)
{
    (void)state;
    struct rg_gate_row found[2];
    for (int is_lost = 0; is_lost < 2; is_lost++) {
        struct script s = SCRIPT(.ratios = {1.1, 1});
        *(is_lost ? &s.lost : &s.over) = 20;
        run(&s, 2, found);
        assert_int_equal(s.launches, is_lost ? 21 : 20);
        assert_int_equal(found[0].end, is_lost ? RG_END_BROKEN : RG_END_OVER);
        assert_int_equal(found[0].decision.verdict, RG_TWO_INCONCLUSIVE);
        assert_int_equal(found[0].launches, 20);
        assert_int_equal(found[0].before.verdict, RG_TWO_REGRESSED);
        assert_int_equal(found[0].before.units, 16);
        assert_int_equal(found[0].decision.units, 4);
        assert_below(fabs(found[0].b_ms.median - 11), 0.05);
        assert_int_equal(found[1].end, RG_END_DECIDED);
        assert_int_equal(found[1].decision.verdict, RG_TWO_PASS);
    }
    struct script s = SCRIPT(.ratios = {1, 1}, .over = 1);
    s.launches = 1;
    const struct rg_gate_rule rule = rg_gate_rule_of(2);
    const struct rg_quad_source source = {launch, take, is_over, &s, NULL};
    assert_true(rg_course_run(&rule, &source, RG_COURSE_SEED, found)); // over at once
    assert_int_equal(found[1].end, RG_END_OVER);
    assert_equals(found[1].decision.ratio, 1);
    assert_equals(found[1].a_ms.median, 0);
}

// On equal sides, none of 300 courses ends with a verdict but pass or inconclusive. The machine is
// faster now for one side and now for the other, for some launches each.
static bool take_linked(int row, bool b_first, struct rg_quads *quads, void *user)
{
    double *last = user;
    (void)row;
    (void)b_first;
    double noise = 0;
    for (int i = 0; i < 12; i++)
        noise += uniform() - 0.5;
    *last = 0.4 * *last + 0.0275 * noise;
    *quads = (struct rg_quads){*last, 10, 10 * exp(*last), false};
    return true;
}

static bool launch_any(int number, void *user)
{
    (void)user;
    return number >= 0;
}

static void test_linked_noise(void **state)
{
    (void)state;
    const struct rg_gate_rule rule = rg_gate_rule_of(1);
    for (uint32_t i = 0; i < 300; i++) {
        double last = 0;
        struct rg_gate_row found;
        const struct rg_quad_source source = {launch_any, take_linked, NULL, &last, NULL};
        assert_true(rg_course_run(&rule, &source, i, &found));
        assert_int_not_equal(found.decision.verdict, RG_TWO_REGRESSED);
        assert_int_not_equal(found.decision.verdict, RG_TWO_IMPROVED);
    }
}

// Disturbed quads do not count, whatever their times; others replace them.
static void test_disturbed(void **state)
{
    (void)state;
    struct rg_gate_row found[1];
    struct script s = SCRIPT(.ratios = {1}, .disturbed_every = 2);
    run(&s, 1, found);
    assert_int_equal(found[0].decision.verdict, RG_TWO_PASS);
    assert_int_equal(found[0].launches, 32);
    assert_int_equal(found[0].disturbed, 16);
    s = SCRIPT(.ratios = {1}, .disturbed_every = 2); // one of two counts, so twice as long
    s.noise = 0.6;
    run(&s, 1, found);
    assert_int_equal(found[0].end, RG_END_LOOKS);
    assert_int_equal(found[0].launches, 512);
    s = SCRIPT(.ratios = {1}, .disturbed_every = 1 << 30);
    run(&s, 1, found);
    assert_int_equal(found[0].end, RG_END_DISTURBED);
    assert_int_equal(found[0].launches, 33);
}

// Beyond 32 disturbed launches a row ends if these are more than three times those that count: with
// three of four disturbed after 33 and 10, with two of three never.
static void test_hopeless(void **state)
{
    (void)state;
    struct rg_gate_row found[1];
    struct script s = SCRIPT(.ratios = {1}, .disturbed_every = 4);
    run(&s, 1, found);
    assert_int_equal(found[0].end, RG_END_DISTURBED);
    assert_int_equal(found[0].launches, 43);
    assert_int_equal(found[0].disturbed, 33);
    assert_int_equal(found[0].decision.verdict, RG_TWO_INCONCLUSIVE);
    assert_below(fabs(found[0].b_ms.median - 10), 0.05); // without those of disturbed ones
    s = SCRIPT(.ratios = {1}, .disturbed_every = 3);
    s.noise = 0.6;
    run(&s, 1, found);
    assert_int_equal(found[0].end, RG_END_LOOKS);
    assert_int_equal(found[0].launches, 768);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_verdicts),     cmocka_unit_test(test_orders),
        cmocka_unit_test(test_confirmation), cmocka_unit_test(test_first_look_again),
        cmocka_unit_test(test_ends),         cmocka_unit_test(test_disturbed),
        cmocka_unit_test(test_linked_noise), cmocka_unit_test(test_cut_short),
        cmocka_unit_test(test_hopeless),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
