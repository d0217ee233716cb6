// When a gate has no time left for another launch, by a clock that only the test moves.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "harness/compare/gate/sides/times.h"
#include "harness/console/clock.h"

static double now_ms;

// Replaces the program's clock.
double rg_now_ms(void)
{
    return now_ms;
}

// A gate of 1000 ms after launch number `launch`, which took `took_ms` and ended at `at_ms`.
static struct rg_gate_times after(int launch, double took_ms, double at_ms)
{
    now_ms = at_ms;
    return (struct rg_gate_times){.end_ms = 1000,
                                  .first_look = 8,
                                  .launch = launch,
                                  .is_launched = took_ms > 0,
                                  .began_ms = at_ms - took_ms};
}

static void a_gate_ends_where_no_look_is_to_be_had(void **state)
{
    (void)state;
    static const struct {
        int launch;
        double took_ms, at_ms;
        bool is_over;
        double look_ms; // when it is expected; 0: it has passed
    } rows[] = {
        {0, 0, 100, false, 100},    // no launch was taken yet
        {0, 0, 1000, true, 1000},   // no time is left
        {0, 500, 700, false, 4200}, // the first launch ends nothing; its look is given
        {1, 100, 300, false, 900},  // six more
        {1, 120, 300, true, 1020},
        {6, 100, 800, false, 900},
        {6, 100, 901, true, 1001},
        {7, 100, 800, false, 0}, // after the look each launch counts by itself
        {7, 100, 901, true, 0},
        {20, 100, 500, false, 0},
        {3, 0, 999, false, 999}, // from a journal: no launch took time
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_gate_times times = after(rows[i].launch, rows[i].took_ms, rows[i].at_ms);
        if (rg_times_are_over(&times) != rows[i].is_over || times.look_ms != rows[i].look_ms)
            fail_msg("row %zu: a look at %g ms", i, times.look_ms);
        times.end_ms = 0; // no limit
        assert_false(rg_times_are_over(&times));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_gate_ends_where_no_look_is_to_be_had)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
